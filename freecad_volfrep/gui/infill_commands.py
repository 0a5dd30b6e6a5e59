# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that make lattice infills and change them: thin, the work is in `features`."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.deps import missing_packages
from freecad_volfrep.translation import translate

from .command import undo_step
from .messages import errors_shown, tell, tell_error
from .selection import selected_solids


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
    doc.openTransaction(translate("VOLFREP_LatticeInfill", "Lattice Infill"))
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
    """An infill with the preferred values, and sizes that suit the base."""
    from freecad_volfrep.bridge.solids import SolidReader, parent_placement
    from freecad_volfrep.features.factory import make_lattice_infill, preferred_values

    low, high = SolidReader().read(base, parent_placement(base)).bounds
    return make_lattice_infill(doc, base, **preferred_values(tuple(high - low)))


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
            tell_error("\n".join(failures))
        return True
    return False


def edit_infill(obj: App.DocumentObject) -> None:
    """Open the task panel of an infill."""
    Gui.getDocument(obj.Document.Name).setEdit(obj.Name)


def update_infill(obj: App.DocumentObject) -> None:
    """Compute now, AutoUpdate or not."""
    with undo_step(obj.Document, translate("VOLFREP_Update", "Update Lattice Infill")):
        obj.Proxy.update(obj)


def open_faces(selected: tuple[App.DocumentObject, Any]) -> None:
    """Leave the selected faces of the infill's solid without a skin."""
    from freecad_volfrep.features.openings import open_faces

    infill, faces = selected
    with undo_step(infill.Document, translate("VOLFREP_OpenFaces", "Open Faces")):
        open_faces(infill, faces)
        infill.Document.recompute()


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


def browse_cells(_: object) -> None:
    """Open the window of unit cells."""
    from .cell_library import show_cell_library

    show_cell_library()


def show_example(name: str) -> None:
    """Model and fill an example in a new document, and look at all of it."""
    from freecad_volfrep.examples.filled import open_example

    with errors_shown():
        infill = open_example(name)
        infill.Base.Visibility = not infill.Mesh.CountFacets  # the part, where it was cancelled
        Gui.activeDocument().activeView().viewIsometric()
        Gui.SendMsgToActiveView("ViewFit")
