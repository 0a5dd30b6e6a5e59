# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that make lattice infills and change them: thin, the work is in `features`."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.bridge.solids import SolidReader, parent_placement
from freecad_volfrep.deps import missing_packages
from freecad_volfrep.features.infill.factory import make_lattice_infill, preferred_values
from freecad_volfrep.gui.jobs.updating import begin_update, show_mesh
from freecad_volfrep.gui.messages import ask, errors_shown, tell
from freecad_volfrep.gui.selection import only_solid, selected_solids, wants, why_no_solid
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.view.preview_only import toggle_preview
from freecad_volfrep.translation import translate

#: How the camera is turned about Z and then tilted in the isometric view, degrees.
ISOMETRIC = (45.0, 54.7356)


@wants(
    "Select one or more solids: a Body, a Part, a link to one, a closed mesh.",
    why_no_solid,
)
def fillable_selection() -> list[App.DocumentObject] | None:
    """The selected solids, or the only one there is; where packages are missing anything selected.

    So a click says what to install.
    """
    if missing_packages():
        return Gui.Selection.getSelection() or None
    return selected_solids() or only_solid() or None


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
    from freecad_volfrep.gui.panel.task_panel import TaskPanel

    with errors_shown():
        obj = make_suitable_infill(doc, base)
        Gui.Control.showDialog(TaskPanel(obj))
        return
    doc.abortTransaction()


def make_suitable_infill(doc: App.Document, base: App.DocumentObject) -> App.DocumentObject:
    """An infill with the preferred values, and sizes that suit the base."""
    reader = SolidReader()
    low, high = reader.read(base, parent_placement(base)).bounds
    obj = make_lattice_infill(doc, base, **preferred_values(tuple(high - low)))
    obj.Proxy.take_reader(reader)
    return obj


def edit_infill(obj: App.DocumentObject) -> None:
    """Open the task panel of an infill."""
    Gui.getDocument(obj.Document.Name).setEdit(obj.Name)


def update_infill(obj: App.DocumentObject) -> None:
    """Compute now, AutoUpdate or not; the mesh comes while the user goes on."""
    if begin_update(obj) is None and obj.isValid():
        tell(translate("VolfrepCommands", "{label} is up to date").format(label=obj.Label))


def open_faces(selected: tuple[App.DocumentObject, Any]) -> None:
    """Leave the selected faces of the infill's solid without a skin."""
    from freecad_volfrep.features.infill.openings import open_faces

    infill, faces = selected
    with undo_step(infill.Document, translate("VOLFREP_OpenFaces", "Open Faces")):
        open_faces(infill, faces)
        infill.Document.recompute()
    if infill.isValid() and infill.Mesh.CountFacets:
        Gui.Selection.clearSelection()
        show_mesh(infill)


def preview_only(infill: App.DocumentObject) -> None:
    """Show the struts of the present values without making a mesh, or take them away."""
    if not toggle_preview(infill):
        said = translate("VolfrepCommands", "{label}: preview off")
        tell(said.format(label=infill.Label))


def browse_cells(_: object) -> None:
    """Open the window of unit cells."""
    from freecad_volfrep.gui.cells.cell_library import show_cell_library

    show_cell_library()


def show_example(name: str) -> None:
    """Model and fill an example in a new document, and look at all of it."""
    from freecad_volfrep.examples.filled import EXAMPLES, open_example

    with errors_shown():
        infill = open_example(name)
        infill.Base.Visibility = not infill.Mesh.CountFacets  # the part, where it was cancelled
        turn = App.Rotation(ISOMETRIC[0] + EXAMPLES[name].turned, 0.0, ISOMETRIC[1])
        Gui.activeDocument().activeView().setCameraOrientation(turn.Q)
        Gui.SendMsgToActiveView("ViewFit")
