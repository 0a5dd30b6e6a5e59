# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's commands: thin, the work is in `features`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.deps import missing_packages
from volfrep.errors import VolfrepError

from .command import Command, undo_step
from .messages import ask, choose, errors_shown, show_error
from .qt import QtWidgets
from .selection import (
    selected_infill,
    selected_infill_and_faces,
    selected_mesh,
    selected_solids,
)


def fillable_selection() -> list[App.DocumentObject] | None:
    """The selected solids; anything that is selected where packages are missing.

    So a click says what to install.
    """
    if missing_packages():
        return Gui.Selection.getSelection() or None
    return selected_solids() or None


def fill_solids(bases: list[App.DocumentObject]) -> None:
    """Fill one solid by way of its task panel, several at once; a cancelled job leaves nothing."""
    doc = App.ActiveDocument
    doc.openTransaction("Lattice Infill")
    try:
        if len(bases) == 1:
            open_panel(doc, bases[0])
            return  # the panel's OK or Cancel ends the transaction
        kept = fill_selected(doc, bases)
    except BaseException:
        doc.abortTransaction()
        raise
    if not kept:
        doc.abortTransaction()
        return
    doc.commitTransaction()


def open_panel(doc: App.Document, base: App.DocumentObject) -> None:
    """Make an infill with sizes that suit the base, not computed yet, and open its task panel."""
    from .task_panel import TaskPanel

    with errors_shown():
        obj = make_suitable_infill(doc, base)
        Gui.Control.showDialog(TaskPanel(obj))
        return
    doc.abortTransaction()


def make_suitable_infill(doc: App.Document, base: App.DocumentObject) -> App.DocumentObject:
    """An infill with sizes that suit the base."""
    from freecad_volfrep.bridge.solids import SolidReader, parent_placement
    from freecad_volfrep.features.factory import make_lattice_infill, suggested_sizes

    low, high = SolidReader().read(base, parent_placement(base)).bounds
    return make_lattice_infill(doc, base, **suggested_sizes(tuple(high - low)))


def fill_selected(doc: App.Document, bases: list[App.DocumentObject]) -> bool:
    """Fill every base with sizes that suit it and show the results; False if cancelled.

    An infill that cannot be computed stays, marked, so that its sizes can be corrected.
    """
    failures = []
    with errors_shown():
        for base in bases:
            obj = make_suitable_infill(doc, base)
            obj.Proxy.update(obj)  # a large job too: whoever clicks wants it
            if obj.Proxy.was_cancelled:
                return False
            if obj.isValid():
                base.Visibility = False
                Gui.Selection.clearSelection()
                Gui.Selection.addSelection(obj)
            else:
                failures.append(f"{obj.Label}: {obj.getStatusString()}")
        if failures:
            show_error("\n".join(failures))
        return True
    return False


def edit_infill(obj: App.DocumentObject) -> None:
    """Open the task panel of an infill."""
    Gui.getDocument(obj.Document.Name).setEdit(obj.Name)


def update_infill(obj: App.DocumentObject) -> None:
    """Compute now, AutoUpdate or not."""
    with undo_step(obj.Document, "Update Lattice Infill"):
        obj.Proxy.update(obj)


def open_faces(selected: tuple[App.DocumentObject, Any]) -> None:
    """Leave the selected faces of the infill's solid without a skin."""
    from freecad_volfrep.features.openings import open_faces

    infill, faces = selected
    with undo_step(infill.Document, "Open Faces"):
        open_faces(infill, faces)
        infill.Document.recompute()


def check_print(infill: App.DocumentObject) -> None:
    """Show the overhanging facets in red on the infill, and what else a printer would mind."""
    from freecad_volfrep.features.print_check import make_print_check

    doc = infill.Document
    with undo_step(doc, "Print Check"):
        check = make_print_check(doc, infill)
        doc.recompute()
    if check.isValid():
        Gui.Selection.clearSelection()
        App.Console.PrintMessage(f"VOLFREP, {check.Label}:\n{check.Text}\n")


def export(obj: App.DocumentObject) -> None:
    """Ask for the file's name and write it."""
    from freecad_volfrep.features.export import export_mesh, formats_of
    from freecad_volfrep.features.solver_files import CONTENTS, estimate_file

    folder = Path(obj.Document.FileName).parent if obj.Document.FileName else Path.home()
    formats = {form.filter: form for form in formats_of(obj)}
    path, chosen = QtWidgets.QFileDialog.getSaveFileName(
        Gui.getMainWindow(),
        "Export Lattice",
        str(folder / f"{obj.Label}.stl"),
        ";;".join(formats),
    )
    if not path:
        return
    form = formats[chosen]
    if Path(path).suffix.lower() != form.suffix and form.content != "mesh":
        path = str(Path(path).with_suffix(form.suffix))
    elif not Path(path).suffix:
        path += form.suffix
    with errors_shown():
        if form.content in CONTENTS and not ask(
            f"{Path(path).name}: {estimate_file(obj, form.content)}. Write it?"
        ):
            return
        export_mesh(obj, path, form.content)
        App.Console.PrintMessage(f"VOLFREP: {path} written\n")


def make_solid_of(obj: App.DocumentObject) -> None:
    """Say what each kind of solid takes, ask which, and make it."""
    from freecad_volfrep.features.solids import kinds_of, make_kind

    doc = obj.Document
    kinds = {kind.name: (kind.title, lambda kind=kind: kind.predict(obj)) for kind in kinds_of(obj)}
    chosen = _chosen(f"Make of '{obj.Label}':", kinds)
    if chosen is None:
        return
    with undo_step(doc, "Lattice To Solid"), errors_shown():
        make_kind(doc, obj, chosen)
        obj.Visibility = False
    doc.recompute()


def analyse(infill: App.DocumentObject) -> None:
    """Say what each model takes, ask which, and make an analysis of it."""
    from freecad_volfrep.features.fem_analysis import MODELS, estimate_analysis, make_fem_analysis

    chosen = _chosen(
        f"Analyse '{infill.Label}' with:",
        {model: (model, lambda m=model: estimate_analysis(infill, m)) for model in MODELS},
    )
    if chosen is None:
        return
    with undo_step(infill.Document, "FEM Analysis"), errors_shown():
        make_fem_analysis(infill.Document, infill, chosen)


def _chosen(label: str, kinds: dict[str, tuple[str, Callable[[], str]]]) -> str | None:
    """The kind that the user picks by its title and what it will take; None for none.

    `kinds` gives, by name, the title and what predicts; kinds that are refused are named above
    the list, and alone they are an error.
    """
    offered, refused = {}, []
    for name, (title, predict) in kinds.items():
        try:
            offered[f"{title}: {predict()}"] = name
        except VolfrepError as error:
            refused.append(f"{title}: {error}")
    if not offered:
        show_error("\n".join(refused))
        return None
    item = choose(label, list(offered), refused)
    return None if item is None else offered[item]


#: In the order of the toolbar.
COMMANDS = {
    "VOLFREP_LatticeInfill": Command(
        "lattice_infill.svg",
        "Lattice Infill",
        "Make the selected solid light: a closed skin and a strut lattice inside",
        fillable_selection,
        fill_solids,
    ),
    "VOLFREP_Edit": Command(
        "edit.svg",
        "Edit Lattice Infill",
        "Change the selected lattice infill in its panel, with a preview",
        selected_infill,
        edit_infill,
    ),
    "VOLFREP_Update": Command(
        "update.svg",
        "Update Lattice Infill",
        "Compute the selected lattice infill now, also with AutoUpdate off",
        selected_infill,
        update_infill,
    ),
    "VOLFREP_OpenFaces": Command(
        "open_faces.svg",
        "Open Faces",
        "Select a lattice infill and faces of its solid: they get no skin",
        selected_infill_and_faces,
        open_faces,
    ),
    "VOLFREP_PrintCheck": Command(
        "print_check.svg",
        "Print Check",
        "See what hangs over, is too thin or holds powder when the selected lattice infill is "
        "printed",
        selected_infill,
        check_print,
    ),
    "VOLFREP_Export": Command(
        "export.svg",
        "Export Lattice",
        "Write the selected lattice infill for the printer (STL, 3MF with or without beams, "
        "PLY, OBJ), for CAD (STEP) or for CalculiX",
        selected_mesh,
        export,
    ),
    "VOLFREP_ToSolid": Command(
        "to_solid.svg",
        "Lattice To Solid",
        "Make a Part solid of exact surfaces or of plane faces, links to its joints, or the "
        "struts' axes",
        selected_mesh,
        make_solid_of,
    ),
    "VOLFREP_FemAnalysis": Command(
        "fem_analysis.svg",
        "FEM Analysis",
        "Make an analysis of the selected lattice infill for the FEM workbench, of beams or "
        "of tetrahedra, ready for constraints",
        selected_infill,
        analyse,
    ),
}


def register_commands() -> list[str]:
    """Make the commands known to FreeCAD; returns their names in the order of the toolbar."""
    for name, command in COMMANDS.items():
        Gui.addCommand(name, command)
    return list(COMMANDS)
