# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's commands: thin, the work is in `features`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.deps import missing_packages
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, translate
from volfrep.util.errors import VolfrepError

from .command import Command, undo_step
from .messages import ask, choose, errors_shown, file_name, tell, tell_error, tell_written
from .qt import QtWidgets
from .selection import (
    infill_in_view,
    selected_infill,
    selected_infill_and_faces,
    selected_infill_or_study,
    selected_mesh,
    selected_or_all_infills,
    selected_solids,
)
from .updating import begin_update, show_mesh

#: Names of FEM models, marked for translation.
MODEL_NAMES = marked("VolfrepCommands", "beams", "tetrahedra")


def fillable_selection() -> list[App.DocumentObject] | None:
    """The selected solids; anything that is selected where packages are missing.

    So a click says what to install.
    """
    if missing_packages():
        return Gui.Selection.getSelection() or None
    return selected_solids() or None


def fill_solids(bases: list[App.DocumentObject]) -> None:
    """Fill one solid by way of its task panel, several with sizes that suit each."""
    doc = App.ActiveDocument
    step = translate("VOLFREP_LatticeInfill", "Lattice Infill")
    if len(bases) == 1:
        doc.openTransaction(step)
        try:
            open_panel(doc, bases[0])
        except BaseException:
            doc.abortTransaction()
            raise
        return  # the panel's OK or Cancel ends the transaction
    question = translate(
        "VolfrepCommands",
        "Fill {count} solids, each with cells that suit its size? A single one opens the panel.",
    ).format(count=len(bases))
    if not ask(question):
        return
    with undo_step(doc, step), errors_shown():
        for base in bases:
            obj = make_suitable_infill(doc, base)
            # Before the next one is there: this recomputes the document.
            begin_update(obj, ended=lambda is_there, obj=obj: show_mesh(obj) if is_there else None)


def open_panel(doc: App.Document, base: App.DocumentObject) -> None:
    """Make an infill with sizes that suit the base, not computed yet, and open its task panel."""
    from .task_panel import TaskPanel

    with errors_shown():
        obj = make_suitable_infill(doc, base)
        Gui.Control.showDialog(TaskPanel(obj))
        return
    doc.abortTransaction()


def make_suitable_infill(doc: App.Document, base: App.DocumentObject) -> App.DocumentObject:
    """An infill with the preferred values, and sizes that suit the base."""
    from freecad_volfrep.bridge.solids import SolidReader, parent_placement
    from freecad_volfrep.features.factory import make_lattice_infill, preferred_values

    low, high = SolidReader().read(base, parent_placement(base)).bounds
    return make_lattice_infill(doc, base, **preferred_values(tuple(high - low)))


def edit_infill(obj: App.DocumentObject) -> None:
    """Open the task panel of an infill."""
    Gui.getDocument(obj.Document.Name).setEdit(obj.Name)


def update_infill(obj: App.DocumentObject) -> None:
    """Compute now, AutoUpdate or not; the mesh comes while the user goes on."""
    begin_update(obj)


def open_faces(selected: tuple[App.DocumentObject, Any]) -> None:
    """Leave the selected faces of the infill's solid without a skin."""
    from freecad_volfrep.features.openings import open_faces

    infill, faces = selected
    with undo_step(infill.Document, translate("VOLFREP_OpenFaces", "Open Faces")):
        open_faces(infill, faces)
        infill.Document.recompute()


def check_print(infill: App.DocumentObject) -> None:
    """Show the overhanging facets in red on the infill, and what else a printer would mind."""
    from freecad_volfrep.features.print_check import make_print_check

    doc = infill.Document
    with undo_step(doc, translate("VOLFREP_PrintCheck", "Print Check")):
        check = make_print_check(doc, infill)
        doc.recompute()
        cancelled = check.Proxy.was_cancelled
        if cancelled:
            doc.removeObject(check.Name)
    if cancelled:
        return
    if check.isValid():
        Gui.Selection.clearSelection()
        App.Console.PrintMessage(f"VOLFREP, {check.Label}:\n{check.Text}\n")


def study_designs(obj: App.DocumentObject) -> None:
    """Open a design study; of an infill, make one first."""
    from freecad_volfrep.features.design_study import DesignStudy, make_design_study

    from .study_panel import open_study

    doc = obj.Document
    if not isinstance(obj.Proxy, DesignStudy):
        with undo_step(doc, translate("VOLFREP_DesignStudy", "Design Study")):
            obj = make_design_study(doc, obj)
            obj.recompute()
    open_study(obj)


def show_section(obj: App.DocumentObject) -> None:
    """Cut the object open on the screen."""
    from .section_view import open_section

    open_section(obj)


def export(obj: App.DocumentObject) -> None:
    """Ask for the file's name and write it."""
    from freecad_volfrep.features.export import (
        chosen_format,
        estimate_export,
        export_mesh,
        formats_of,
    )

    folder = Path(obj.Document.FileName).parent if obj.Document.FileName else Path.home()
    formats = {form.filter: form for form in formats_of(obj)}
    path, chosen = QtWidgets.QFileDialog.getSaveFileName(
        Gui.getMainWindow(),
        translate("VOLFREP_Export", "Export Lattice"),
        str(folder / f"{file_name(obj.Label)}.stl"),
        ";;".join(formats),
    )
    if not path:
        return
    path, form = chosen_format(path, formats[chosen], list(formats.values()))
    with errors_shown(box=True):
        estimate = estimate_export(obj, form)
        if estimate and not ask(
            translate("VolfrepCommands", "{file}: {estimate}. Write it?").format(
                file=Path(path).name, estimate=estimate
            )
        ):
            return
        export_mesh(obj, path, form.content)
        tell_written(path)


def make_solid_of(obj: App.DocumentObject) -> None:
    """Say what each kind of solid takes, ask which, and make it."""
    from freecad_volfrep.features.solids import kinds_of, make_kind

    doc = obj.Document
    kinds = {
        kind.name: (translate("VolfrepSolids", kind.title), lambda kind=kind: kind.predict(obj))
        for kind in kinds_of(obj)
    }
    question = translate("VolfrepCommands", "Make of '{label}':").format(label=obj.Label)
    chosen = _chosen(question, kinds)
    if chosen is None:
        return
    with undo_step(doc, translate("VOLFREP_ToSolid", "Lattice To Solid")), errors_shown():
        make_kind(doc, obj, chosen)
        obj.Visibility = False
    doc.recompute()


def analyse(infill: App.DocumentObject) -> None:
    """Say what each model takes, ask which, and make an analysis of it."""
    from freecad_volfrep.features.fem_analysis import MODELS, estimate_analysis, make_fem_analysis

    chosen = _chosen(
        translate("VolfrepCommands", "Analyse '{label}' with:").format(label=infill.Label),
        {
            model: (
                translate("VolfrepCommands", model),
                lambda m=model: estimate_analysis(infill, m),
            )
            for model in MODELS
        },
    )
    if chosen is None:
        return
    step = translate("VOLFREP_FemAnalysis", "FEM Analysis")
    with undo_step(infill.Document, step), errors_shown():
        make_fem_analysis(infill.Document, infill, chosen)


def size_lattice(infill: App.DocumentObject) -> None:
    """Open the panel in which an infill's struts are sized for the document's load cases."""
    from .size_panel import SizePanel

    with errors_shown():
        Gui.Control.showDialog(SizePanel(infill))


def show_strut_results(infill: App.DocumentObject) -> None:
    """Solve an infill's struts for the document's load cases, and show them in colours."""
    from freecad_volfrep.features.sizing import solve_struts

    from .strut_view import open_struts

    with errors_shown():
        open_struts(infill, solve_struts(infill))


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
        tell_error("\n".join(refused))
        return None
    item = choose(label, list(offered), refused)
    return None if item is None else offered[item]


def preview_only(infill: App.DocumentObject) -> None:
    """Show the struts of the present values without making a mesh, or take them away."""
    from .preview_only import toggle_preview

    with errors_shown():
        if toggle_preview(infill):
            said = translate(
                "VolfrepCommands", "{label}: preview shown, figures in the report view"
            )
        else:
            said = translate("VolfrepCommands", "{label}: preview off")
        tell(said.format(label=infill.Label))


def report_mesh(obj: App.DocumentObject) -> None:
    """Look at a mesh and show what was found in a window."""
    from freecad_volfrep.features.mesh_check import check_mesh

    from .report_window import show_report

    with errors_shown():
        tables = check_mesh(obj)
        title = translate("VolfrepCommands", "Check Mesh: {label}").format(label=obj.Label)
        show_report(title, f"{obj.Label} check", tables)


def show_statistics(infills: list[App.DocumentObject]) -> None:
    """Show the figures of infills in a window."""
    from freecad_volfrep.features.statistics import statistics

    from .report_window import show_report

    name = infills[0].Label if len(infills) == 1 else infills[0].Document.Label
    with errors_shown():
        title = translate("VOLFREP_Statistics", "Statistics")
        show_report(title, f"{name} statistics", statistics(infills))


def browse_cells(_: object) -> None:
    """Open the window of unit cells."""
    from .cell_library import show_cell_library

    show_cell_library()


def open_help(_: object) -> None:
    """Open the window of help pages."""
    from .help_window import show_help

    show_help()


def show_example(name: str) -> None:
    """Model and fill an example in a new document, and look at all of it."""
    from freecad_volfrep.examples.filled import open_example

    with errors_shown():
        infill = open_example(name)
        infill.Base.Visibility = not infill.Mesh.CountFacets  # the part, where it was cancelled
        Gui.activeDocument().activeView().viewIsometric()
        Gui.SendMsgToActiveView("ViewFit")


def always() -> tuple[()]:
    """For commands that need no selection."""
    return ()


def _example(name: str, icon: str, text: str, tip: str) -> Command:
    return Command(
        f"VOLFREP_Example{name}", icon, text, tip, "", always, lambda _: show_example(name)
    )


_TABLE = (
    Command(
        "VOLFREP_LatticeInfill",
        "lattice_infill.svg",
        "Lattice Infill",
        "Make the selected solid light: a closed skin and a strut lattice inside",
        "L, F",
        fillable_selection,
        fill_solids,
    ),
    Command(
        "VOLFREP_Edit",
        "edit.svg",
        "Edit Lattice Infill",
        "Change the selected lattice infill in its panel, with a preview",
        "L, D",
        selected_infill,
        edit_infill,
    ),
    Command(
        "VOLFREP_PreviewOnly",
        "preview_only.svg",
        "Preview Only",
        "Show the struts of the selected lattice infill and their figures without making a mesh; "
        "once more takes them away",
        "L, W",
        infill_in_view,
        preview_only,
    ),
    Command(
        "VOLFREP_Update",
        "update.svg",
        "Update Lattice Infill",
        "Compute the selected lattice infill now, also with AutoUpdate off",
        "L, U",
        selected_infill,
        update_infill,
    ),
    Command(
        "VOLFREP_OpenFaces",
        "open_faces.svg",
        "Open Faces",
        "Select a lattice infill and faces of its solid: they get no skin",
        "L, O",
        selected_infill_and_faces,
        open_faces,
    ),
    Command(
        "VOLFREP_CellLibrary",
        "cell_library.svg",
        "Cell Library",
        "Browse the unit cells, load your own, make one of a sketch, and give it to a lattice "
        "infill",
        "L, C",
        always,
        browse_cells,
    ),
    Command(
        "VOLFREP_CheckMesh",
        "check_mesh.svg",
        "Check Mesh",
        "Report on the selected mesh: closed, bodies, volume, angles, triangles that cross, and "
        "what a file keeps of it",
        "L, M",
        selected_mesh,
        report_mesh,
    ),
    Command(
        "VOLFREP_PrintCheck",
        "print_check.svg",
        "Print Check",
        "See what hangs over, is too thin or holds powder when the selected lattice infill is "
        "printed",
        "L, P",
        selected_infill,
        check_print,
    ),
    Command(
        "VOLFREP_SectionView",
        "section_view.svg",
        "Section View",
        "Cut the selected lattice open on the screen, along a plane that can be moved; the "
        "lattice itself stays whole",
        "L, N",
        selected_mesh,
        show_section,
    ),
    Command(
        "VOLFREP_Statistics",
        "statistics.svg",
        "Statistics",
        "Tables of the selected lattice infills, or of all in the document: cells, struts, "
        "density, mass, times, memory",
        "L, T",
        selected_or_all_infills,
        show_statistics,
    ),
    Command(
        "VOLFREP_Export",
        "export.svg",
        "Export Lattice",
        "Write the selected lattice infill for the printer (STL, 3MF with or without beams, "
        "PLY, OBJ), for CAD (STEP) or for CalculiX",
        "L, X",
        selected_mesh,
        export,
    ),
    Command(
        "VOLFREP_ToSolid",
        "to_solid.svg",
        "Lattice To Solid",
        "Make a Part solid of exact surfaces or of plane faces, links to its joints, or the "
        "struts' axes",
        "L, S",
        selected_mesh,
        make_solid_of,
    ),
    Command(
        "VOLFREP_FemAnalysis",
        "fem_analysis.svg",
        "FEM Analysis",
        "Make an analysis of the selected lattice infill for the FEM workbench, of beams or "
        "of tetrahedra, ready for constraints",
        "L, A",
        selected_infill,
        analyse,
    ),
    Command(
        "VOLFREP_SizeLattice",
        "size_lattice.svg",
        "Size Lattice",
        "Find the radii of the selected lattice infill's struts for the load cases of the FEM "
        "workbench: least mass within limits, or most stiffness at a mass",
        "L, Z",
        infill_in_view,
        size_lattice,
    ),
    Command(
        "VOLFREP_StrutResults",
        "strut_results.svg",
        "Strut Results",
        "Colour the struts of the selected lattice infill by radius, stress, buckling or "
        "displacement under the load cases of the FEM workbench",
        "L, R",
        infill_in_view,
        show_strut_results,
    ),
    Command(
        "VOLFREP_DesignStudy",
        "design_study.svg",
        "Design Study",
        "Try many values of the selected lattice infill's properties, see mass against stiffness, "
        "and give it the best",
        "L, Y",
        selected_infill_or_study,
        study_designs,
    ),
    Command(
        "VOLFREP_Help",
        "help.svg",
        "VOLFREP Help",
        "Read about every command, and a tutorial of five minutes",
        "L, H",
        always,
        open_help,
        computes=False,
    ),
    _example(
        "Bracket",
        "example_bracket.svg",
        "Bracket",
        "Open a bracket on four bolts, filled with a lattice, in a new document",
    ),
    _example(
        "PistonRod",
        "example_piston_rod.svg",
        "Piston Rod",
        "Open a piston rod, filled with a lattice, in a new document",
    ),
)
#: By their names.
COMMANDS = {command.name: command for command in _TABLE}
#: The toolbars, by their names.
TOOLBARS = {
    "VOLFREP": [
        "VOLFREP_LatticeInfill",
        "VOLFREP_Edit",
        "VOLFREP_PreviewOnly",
        "VOLFREP_Update",
        "VOLFREP_OpenFaces",
        "VOLFREP_CellLibrary",
    ],
    QT_TRANSLATE_NOOP("Workbench", "VOLFREP Results"): [
        "VOLFREP_SectionView",
        "VOLFREP_CheckMesh",
        "VOLFREP_PrintCheck",
        "VOLFREP_Statistics",
        "VOLFREP_Export",
        "VOLFREP_ToSolid",
        "VOLFREP_FemAnalysis",
        "VOLFREP_SizeLattice",
        "VOLFREP_StrutResults",
        "VOLFREP_DesignStudy",
    ],
}
#: The submenu of that name.
EXAMPLES = ["VOLFREP_ExampleBracket", "VOLFREP_ExamplePistonRod"]


def register_commands() -> None:
    """Make the commands known to FreeCAD."""
    for name, command in COMMANDS.items():
        Gui.addCommand(name, command)


def applicable_commands() -> list[str]:
    """The commands of the toolbars that apply to the selection, for a context menu."""
    names = [name for names in TOOLBARS.values() for name in names]
    return [name for name in names if COMMANDS[name].IsActive()]
