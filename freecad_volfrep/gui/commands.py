# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's commands: thin, the work is in `features`."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep.deps import explain_missing, missing_packages
from volfrep.errors import VolfrepError

from .messages import ask, choose, errors_shown, show_error
from .qt import QtWidgets


def _resources(icon: str, text: str, tip: str) -> dict[str, str]:
    return {"Pixmap": str(ICONS / icon), "MenuText": text, "ToolTip": tip}


def _packages_present() -> bool:
    """Whether the engine can run; says what to install where it cannot."""
    missing = missing_packages()
    if missing:
        App.Console.PrintError(explain_missing(missing) + "\n")
        show_error(explain_missing(missing))
    return not missing


class LatticeInfillCommand:
    """Fill the selected solid by way of its task panel; several at once without. One undo step."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "lattice_infill.svg",
            "Lattice Infill",
            "Make the selected solid light: a closed skin and a strut lattice inside",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when a usable solid is selected and no task panel is open."""
        if Gui.Control.activeDialog():
            return False
        if missing_packages():
            return bool(Gui.Selection.getSelection())  # so that a click says what to install
        from .selection import selected_solids

        return bool(selected_solids())

    def Activated(self) -> None:  # noqa: N802
        """Make the objects and open the panel or compute them; of a cancelled job nothing stays."""
        if not _packages_present():
            return
        from .selection import selected_solids

        doc = App.ActiveDocument
        bases = selected_solids()
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


class UpdateCommand:
    """Compute the selected lattice infill now, AutoUpdate or not."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "update.svg",
            "Update Lattice Infill",
            "Compute the selected lattice infill now, also with AutoUpdate off",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one lattice infill is selected."""
        from .selection import selected_infill

        return selected_infill() is not None

    def Activated(self) -> None:  # noqa: N802
        """Update, in one undo step."""
        if not _packages_present():
            return
        from .selection import selected_infill

        obj = selected_infill()
        doc = obj.Document
        doc.openTransaction("Update Lattice Infill")
        obj.Proxy.update(obj)
        doc.commitTransaction()


class ExportCommand:
    """Write the selected mesh to a file."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "export.svg",
            "Export Lattice",
            "Write the selected lattice infill for the printer (STL, 3MF with or without beams, "
            "PLY, OBJ), for CAD (STEP) or for CalculiX",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one mesh object is selected."""
        from .selection import selected_mesh

        return selected_mesh() is not None

    def Activated(self) -> None:  # noqa: N802
        """Ask for the file's name and write it."""
        if not _packages_present():
            return
        from freecad_volfrep.features.export import export_mesh, formats_of
        from freecad_volfrep.features.solver_files import CONTENTS, estimate_file

        from .selection import selected_mesh

        obj = selected_mesh()
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


class ToSolidCommand:
    """Make a Part solid of the selected mesh, after showing what it costs."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "to_solid.svg",
            "Lattice To Solid",
            "Make a Part solid of exact surfaces or of plane faces, links to its joints, or the "
            "struts' axes",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one mesh object is selected."""
        from .selection import selected_mesh

        return selected_mesh() is not None

    def Activated(self) -> None:  # noqa: N802
        """Predict, ask, make."""
        if not _packages_present():
            return
        from freecad_volfrep.features.solids import kinds_of, make_kind

        from .selection import selected_mesh

        obj = selected_mesh()
        doc = obj.Document
        kinds = {
            kind.name: (kind.title, lambda kind=kind: kind.predict(obj)) for kind in kinds_of(obj)
        }
        chosen = _chosen(f"Make of '{obj.Label}':", kinds)
        if chosen is None:
            return
        doc.openTransaction("Lattice To Solid")
        try:
            with errors_shown():
                make_kind(doc, obj, chosen)
                obj.Visibility = False
        finally:
            doc.commitTransaction()
        doc.recompute()


class OpenFacesCommand:
    """Leave the selected faces of a solid without a skin."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "open_faces.svg",
            "Open Faces",
            "Select a lattice infill and faces of its solid: they get no skin",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one lattice infill and faces are selected."""
        from .selection import selected_infill_and_faces

        return selected_infill_and_faces() is not None

    def Activated(self) -> None:  # noqa: N802
        """Add them to the infill's open faces, in one undo step."""
        if not _packages_present():
            return
        from freecad_volfrep.features.openings import open_faces

        from .selection import selected_infill_and_faces

        infill, faces = selected_infill_and_faces()
        doc = infill.Document
        doc.openTransaction("Open Faces")
        open_faces(infill, faces)
        doc.recompute()
        doc.commitTransaction()


class PrintCheckCommand:
    """Hold the selected lattice infill against a printing process."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "print_check.svg",
            "Print Check",
            "See what hangs over, is too thin or holds powder when the selected lattice infill is "
            "printed",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one lattice infill is selected."""
        from .selection import selected_infill

        return selected_infill() is not None

    def Activated(self) -> None:  # noqa: N802
        """Show the overhanging facets in red on the infill, in one undo step."""
        if not _packages_present():
            return
        from freecad_volfrep.features.print_check import make_print_check

        from .selection import selected_infill

        infill = selected_infill()
        doc = infill.Document
        doc.openTransaction("Print Check")
        check = make_print_check(doc, infill)
        doc.recompute()
        doc.commitTransaction()
        if check.isValid():
            Gui.Selection.clearSelection()
            App.Console.PrintMessage(f"VOLFREP, {check.Label}:\n{check.Text}\n")


class FemAnalysisCommand:
    """Make a finite-element analysis of the selected lattice infill."""

    def GetResources(self) -> dict[str, str]:  # noqa: N802
        """Icon and texts."""
        return _resources(
            "fem_analysis.svg",
            "FEM Analysis",
            "Make an analysis of the selected lattice infill for the FEM workbench, of beams or "
            "of tetrahedra, ready for constraints",
        )

    def IsActive(self) -> bool:  # noqa: N802
        """Active when one lattice infill is selected."""
        from .selection import selected_infill

        return selected_infill() is not None

    def Activated(self) -> None:  # noqa: N802
        """Predict, ask, make, in one undo step."""
        if not _packages_present():
            return
        from freecad_volfrep.features.fem_analysis import (
            MODELS,
            estimate_analysis,
            make_fem_analysis,
        )

        from .selection import selected_infill

        infill = selected_infill()
        chosen = _chosen(
            f"Analyse '{infill.Label}' with:",
            {model: (model, lambda m=model: estimate_analysis(infill, m)) for model in MODELS},
        )
        if chosen is None:
            return
        doc = infill.Document
        doc.openTransaction("FEM Analysis")
        try:
            with errors_shown():
                make_fem_analysis(doc, infill, chosen)
        finally:
            doc.commitTransaction()


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
    "VOLFREP_LatticeInfill": LatticeInfillCommand,
    "VOLFREP_Update": UpdateCommand,
    "VOLFREP_OpenFaces": OpenFacesCommand,
    "VOLFREP_PrintCheck": PrintCheckCommand,
    "VOLFREP_Export": ExportCommand,
    "VOLFREP_ToSolid": ToSolidCommand,
    "VOLFREP_FemAnalysis": FemAnalysisCommand,
}


def register_commands() -> list[str]:
    """Make the commands known to FreeCAD; returns their names in the order of the toolbar."""
    for name, command in COMMANDS.items():
        Gui.addCommand(name, command())
    return list(COMMANDS)
