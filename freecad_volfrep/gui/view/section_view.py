# SPDX-License-Identifier: LGPL-2.1-or-later
"""Section View: a lattice infill cut open on the screen by a plane, and not in the document.

FreeCAD's own clipping plane cuts the whole view. This one hangs in the infill's own scene, so that
what lies beside it stays whole, and it can be moved.
"""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep import preferences
from freecad_volfrep.bridge.meshes import from_freecad
from freecad_volfrep.bridge.solids import placed
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.object_dock import ObjectDock, close_docks, docks_of
from freecad_volfrep.translation import translate

from .preview_view import PreviewView

#: Name of the plane in the infill's scene.
NODE = "VolfrepSection"
AXES = "XYZ"
#: The slider's steps from one side of the infill to the other.
STEPS = 1000
#: FreeCAD's own modes in which a mesh's faces are drawn.
OPAQUE_MODES = ("Shaded", "Flat Lines")
#: Where planes were left, by document and object: axis, offset in mm, the other side.
_left: dict[tuple[str, str], tuple[int, float, bool]] = {}


class Section:
    """A clipping plane in the scene of one mesh object, until it is removed.

    Args:
        obj: a mesh object, shown or not.
        preview: what is drawn in its place, if anything: cut as well.
    """

    def __init__(self, obj: App.DocumentObject, preview: PreviewView | None = None) -> None:
        from pivy import coin

        self._obj, self._preview = obj, preview
        self._plane = coin.SoClipPlane()
        self._plane.setName(NODE)
        self._root = obj.ViewObject.RootNode
        # In front of the transform of the object's Placement: in the coordinates of its group,
        # where its Mesh has its bounding box.
        self._root.insertChild(self._plane, 0)
        if preview is not None:
            preview.cut_by(self._plane)
        self._cut_faces: Any = None
        self.show_cut_faces()

    def show_cut_faces(self) -> None:
        """Fill what is cut through: a view of ours does it itself, an opaque mesh gets it here."""
        view = self._obj.ViewObject
        self._drop_cut_faces()
        if _draws_cuts(view) and view.Proxy.show_cut(True):
            return
        if view.DisplayMode not in OPAQUE_MODES or view.Transparency > 0:
            return
        if not self._obj.Mesh.CountFacets:
            return
        mesh = placed(from_freecad(self._obj.Mesh), self._obj.Placement.inverse())
        self._cut_faces = drawing.Inside(drawing.faces(mesh))
        self._cut_faces.paint(preferences.colour(preferences.CUT_COLOUR))
        self._root.insertChild(self._cut_faces.node, self._root.getNumChildren() - 1)

    def cut(self, axis: int, offset: float, keep_far: bool) -> None:
        """Show what lies before the offset in mm along the axis, or what lies beyond it."""
        from pivy import coin

        side = 1.0 if keep_far else -1.0
        normal = [0.0, 0.0, 0.0]
        normal[axis] = side
        self._plane.plane = coin.SbPlane(coin.SbVec3f(*normal), side * offset)

    def remove(self) -> None:
        """Show all of it again."""
        self._drop_cut_faces()
        self._root.removeChild(self._plane)
        if self._preview is not None:
            self._preview.cut_by(None)
        if _draws_cuts(self._obj.ViewObject):
            self._obj.ViewObject.Proxy.show_cut(False)

    def _drop_cut_faces(self) -> None:
        if self._cut_faces is not None:
            self._root.removeChild(self._cut_faces.node)
            self._cut_faces = None


class SectionDock(ObjectDock):
    """The plane's axis, place and side; closing it removes the plane.

    Args:
        obj: the mesh object to cut open.
        preview: what is drawn in its place, if anything.
    """

    NAME = "VolfrepSectionView"

    def __init__(self, obj: App.DocumentObject, preview: PreviewView | None = None) -> None:
        super().__init__(obj, translate("VolfrepSectionView", "Section of {label}"))
        self._preview = preview
        self._section: Section | None = Section(obj, preview)
        self._axis = QtWidgets.QComboBox()
        self._axis.setObjectName("Axis")
        self._axis.addItems(AXES)
        self._offset = QtWidgets.QDoubleSpinBox()
        self._offset.setObjectName("Offset")
        self._offset.setSuffix(" mm")
        self._offset.setKeyboardTracking(False)
        self._slider = QtWidgets.QSlider(QtCore.Qt.Horizontal)
        self._slider.setObjectName("Slider")
        self._slider.setRange(0, STEPS)
        self._flip = QtWidgets.QCheckBox(translate("VolfrepSectionView", "Other side"))
        self._flip.setObjectName("Flip")
        self._lay_out()
        direction = _view_direction()
        self._axis.setCurrentIndex(max(range(3), key=lambda k: abs(direction[k])))
        self._axis.currentIndexChanged.connect(lambda _: self.centre())
        self._slider.valueChanged.connect(lambda step: self._offset.setValue(self._at(step)))
        self._offset.valueChanged.connect(lambda _: self._cut())
        self._flip.toggled.connect(lambda _: self._cut())
        self._key = obj.Document.Uid, obj.Name
        left = _left.get(self._key)
        if left is None:
            self.centre()
        else:
            self._axis.setCurrentIndex(left[0])
            self.centre()
            self._flip.setChecked(left[2])
            self._offset.setValue(left[1])

    def show_cut_faces(self) -> None:
        """Fill what is cut through in the present display mode."""
        if self._section is not None:
            self._section.show_cut_faces()

    def centre(self) -> None:
        """Put the plane in the middle of the mesh along the axis, and open it to the user."""
        self._flip.setChecked(_view_direction()[self._axis.currentIndex()] > 0)
        low, high = self._extent()
        self._offset.setRange(low, high)
        self._offset.setSingleStep((high - low) / 50.0)
        self._offset.setValue(0.5 * (low + high))
        self._cut()

    def slotChangedObject(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Called by FreeCAD: the plane stays where it is while a new mesh may be larger."""
        super().slotChangedObject(obj, name)
        if obj == self._obj and name == "Mesh":
            self._offset.setRange(*self._extent())
            self._cut()
            self.show_cut_faces()

    def take_away(self) -> None:
        """Show all of the infill again; the next section begins where this one was."""
        if self._section is not None:
            left = self._axis.currentIndex(), self._offset.value(), self._flip.isChecked()
            _left[self._key] = left
            self._section.remove()
            self._section = None

    def forget(self, document_too: bool) -> None:
        """The plane is gone with the infill's scene."""
        _left.pop(self._key, None)
        self._section = None

    def _lay_out(self) -> None:
        label = QtWidgets.QLabel(translate("VolfrepSectionView", "Across"))
        label.setToolTip(translate("VolfrepSectionView", "The axis that the plane lies across"))
        column = self.set_line((label, self._axis, self._offset, self._flip))
        column.addWidget(self._slider)
        column.addStretch()

    def _extent(self) -> tuple[float, float]:
        """Of the mesh along the axis, mm; of its preview where there is no mesh yet."""
        axis = self._axis.currentIndex()
        if self._preview is not None and not self._obj.Mesh.CountFacets:
            low, high = self._preview.bounds[:, axis]
            return float(low), float(high)
        box, name = self._obj.Mesh.BoundBox, AXES[axis]
        return getattr(box, f"{name}Min"), getattr(box, f"{name}Max")

    def _at(self, step: int) -> float:
        low, high = self._extent()
        return low + (high - low) * step / STEPS

    def _cut(self) -> None:
        low, high = self._extent()
        offset = self._offset.value()
        self._slider.blockSignals(True)
        self._slider.setValue(round(STEPS * (offset - low) / max(high - low, 1e-9)))
        self._slider.blockSignals(False)
        if self._section is not None:
            self._section.cut(self._axis.currentIndex(), offset, self._flip.isChecked())


def _view_direction() -> tuple[float, float, float]:
    """Where the user looks; down, where the active view is a spreadsheet or the like."""
    view = Gui.ActiveDocument.ActiveView
    x, y, z = view.getViewDirection() if hasattr(view, "getViewDirection") else (0.0, 0.0, -1.0)
    return x, y, z


def open_section(obj: App.DocumentObject, preview: PreviewView | None = None) -> SectionDock:
    """Cut the object open on the screen, in the place of a section that is shown already.

    Args:
        obj: a mesh object.
        preview: what is drawn in its place, if anything: it is cut with it.
    """
    close_docks(SectionDock)
    dock = SectionDock(obj, preview)
    dock.put_up()
    return dock


def close_section(obj: App.DocumentObject) -> bool:
    """Show all of the object again; returns whether it was cut open."""
    return close_docks(SectionDock, obj)


def refresh_section(obj: App.DocumentObject) -> None:
    """Fill cut faces anew where the object is cut open: it is shown in another way."""
    for dock in docks_of(SectionDock):
        if dock.shows(obj):
            dock.show_cut_faces()


def plane_of(obj: App.DocumentObject) -> Any:
    """The clipping plane that cuts an object open on the screen; None where it is whole."""
    root = obj.ViewObject.RootNode
    nodes = (root.getChild(k) for k in range(root.getNumChildren()))
    return next((node for node in nodes if node.getName().getString() == NODE), None)


def _draws_cuts(view: Any) -> bool:
    """Whether an object's own view draws cut faces (`view_provider.LatticeInfillView`)."""
    return hasattr(view.Proxy, "show_cut")
