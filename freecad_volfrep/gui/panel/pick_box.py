# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picking in the view, in an infill's panel: what for, what was picked, and how it lies."""

from __future__ import annotations

from collections.abc import Callable
from itertools import zip_longest
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep.bridge.solids import face_facets, parent_placement
from freecad_volfrep.features.infill.openings import kept_mesh, thick_faces
from freecad_volfrep.features.infill.picking import (
    DIAMETERS,
    DIRECTION,
    DISTANCES,
    FACES,
    LENGTHS,
    PICKED,
    hole_diameter,
    pick,
    pickable,
    picked_of,
    unpick,
)
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.arrow_handle import ArrowHandle
from freecad_volfrep.gui.draw.prisms import prisms
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.panel_manners import narrow
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import translate
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

from .property_fields import label_of

#: Name of what is drawn of it in the view's scene.
NODE = "VolfrepPicked"
COLOUR = (0.98, 0.55, 0.10)
#: Of an arrow or a point, in lengths of the solid's diagonal.
LONG, THICK, BALL = 0.35, 0.012, 0.015
#: What a face's skin is first given, in thicknesses of the whole one's.
THICKER = 2.0
MOST_LENGTH = 1e4


class PickBox(QtWidgets.QWidget):
    """Lets a user choose a property, and click at what it is to be.

    Args:
        obj: the infill.
        changed: called with the name of a property that was set.
        refused: called with a sentence where something cannot be picked.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        changed: Callable[[str], None],
        refused: Callable[[str], None],
    ) -> None:
        super().__init__()
        self._obj, self._changed, self._refused = obj, changed, refused
        self._was_visible: bool | None = None
        self._is_over = False
        self._picture = _Picture(obj, self._turn, self._let_go)
        self._what = QtWidgets.QComboBox()
        self._what.setObjectName("PickWhat")
        self._what.setAccessibleName(translate("VolfrepTaskPanel", "What to pick"))
        self._pick = QtWidgets.QPushButton(translate("VolfrepTaskPanel", "Pick"))
        self._pick.setObjectName("Pick")
        self._pick.setCheckable(True)
        self._pick.setToolTip(
            translate(
                "VolfrepTaskPanel",
                "Shows the solid: click at a face, an edge, a vertex, an axis or a plane; once "
                "more ends it",
            )
        )
        self._clear = QtWidgets.QPushButton(translate("VolfrepTaskPanel", "Clear"))
        self._clear.setObjectName("ClearPicked")
        self._said = QtWidgets.QLabel()
        self._said.setObjectName("Picked")
        self._said.setWordWrap(True)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        narrow(self._what)
        column.addWidget(self._what)
        self._length, self._length_name = _length_field(), QtWidgets.QLabel()
        self._length_name.setBuddy(self._length)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self._length_name)
        line.addWidget(self._length, 1)
        column.addLayout(line)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self._pick)
        line.addWidget(self._clear)
        column.addLayout(line)
        column.addWidget(self._said)
        self.show_applicable()
        self._what.currentIndexChanged.connect(lambda _: self._begin())
        self._length.valueChanged.connect(self._set_length)
        self._pick.toggled.connect(self._toggle)
        self._clear.clicked.connect(lambda _=False: self._unpick())

    @property
    def lists(self) -> list[Any]:
        """Fields that the wheel is not to change."""
        return [self._what, self._length]

    def show_applicable(self) -> None:
        """Offer what applies now."""
        names = pickable(self._obj)
        if names == [self._what.itemData(k) for k in range(self._what.count())]:
            return
        before = self._what.currentData()
        self._what.blockSignals(True)
        self._what.clear()
        for name in names:
            self._what.addItem(label_of(name), name)
        self._what.setCurrentIndex(max(0, self._what.findData(before)))
        self._what.blockSignals(False)
        self._begin()

    def show_picked(self) -> None:
        """Say what the chosen property is, and draw it while it is picked."""
        name = self._what.currentData()
        value = picked_of(self._obj, name)
        try:
            if name in LENGTHS:
                text = ", ".join(f"{o.Label}: {n} {t:g} mm" for o, n, t in thick_faces(self._obj))
            elif PICKED[name] == FACES:
                text = ", ".join(
                    f"{o.Label}: {', '.join(names)}" if any(names) else o.Label
                    for o, names in value
                )
            else:
                points = value if isinstance(value, list) else [value]
                text = "; ".join(", ".join(f"{part:.4g}" for part in point) for point in points)
            text = text or translate("VolfrepTaskPanel", "nothing picked")
            if PICKED[name] == DIRECTION and self._pick.isChecked():
                text += "\n" + translate(
                    "VolfrepTaskPanel", "drag an end of the arrow in the view to turn it"
                )
            self._said.setText(text)
            self._picture.show(name if self._pick.isChecked() else None)
        except VolfrepError as error:  # a face that is there no more
            self._picture.show(None)
            self._said.setText(localise(str(error)))

    def _begin(self) -> None:
        """Show what was chosen to be picked."""
        name = self._what.currentData()
        for widget in (self._length, self._length_name):
            widget.setVisible(name in LENGTHS or name in DISTANCES or name in DIAMETERS)
        if name in LENGTHS:
            self._length_name.setText(translate("VolfrepTaskPanel", "Thickness"))
        elif name in DIAMETERS:
            self._length_name.setText(translate("VolfrepTaskPanel", "Diameter"))
        else:
            self._length_name.setText(translate("VolfrepTaskPanel", "Distance"))
        self._length.blockSignals(True)
        if name in DISTANCES:
            self._length.setValue(getattr(self._obj, DISTANCES[name]).Value)
        elif name in DIAMETERS:
            self._length.setValue(hole_diameter(self._obj))
        elif name in LENGTHS:
            given = getattr(self._obj, LENGTHS[name])
            self._length.setValue(given[-1] if given else THICKER * self._obj.ShellThickness.Value)
        self._length.blockSignals(False)
        self.show_picked()

    def _set_length(self, value: float) -> None:
        """Take over the one length of all; that of a face or a first hole counts when picked."""
        name = self._what.currentData()
        common = DISTANCES.get(name) or (DIAMETERS.get(name) if getattr(self._obj, name) else None)
        if common and value > 0.0:
            setattr(self._obj, common, value)
            self._changed(common)

    def _turn(self, way: App.Vector) -> None:
        """Take over a direction that the mouse has turned the arrow to."""
        name = self._what.currentData()
        setattr(self._obj, name, way)
        self._changed(name)

    def _let_go(self) -> None:
        """What lay under the mouse when it let go of the arrow was not picked."""
        QtCore.QTimer.singleShot(0, Gui.Selection.clearSelection)

    def begin(self, name: str) -> None:
        """Pick a property that something else has just asked for."""
        self._what.setCurrentIndex(self._what.findData(name))
        self._pick.setChecked(True)

    @property
    def is_picking(self) -> bool:
        """Whether clicks in the view pick; the solid is shown as long as they do."""
        return bool(self._pick.isChecked())

    def end(self) -> None:
        """Pick no more, and leave nothing in the view; once more does nothing."""
        if not self._is_over:
            self._is_over = True
            self._pick.setChecked(False)
            self._picture.show(None)

    def addSelection(self, *_: Any) -> None:  # noqa: N802
        """Called by FreeCAD, which is not done with it yet."""
        QtCore.QTimer.singleShot(0, self._take)

    def _toggle(self, is_on: bool) -> None:
        base = self._obj.Base.ViewObject
        Gui.Selection.clearSelection()
        if is_on:
            self._was_visible = base.Visibility
            base.Visibility = True
            Gui.Selection.addObserver(self)
        elif self._was_visible is not None:
            Gui.Selection.removeObserver(self)
            base.Visibility = self._was_visible
            self._was_visible = None
        self.show_picked()

    def _take(self) -> None:
        """Set the property to what is selected."""
        if not self._pick.isChecked() or self._picture.is_dragged:
            return
        chosen = [
            (item.Object, element, at)
            for item in Gui.Selection.getSelectionEx()
            for element, at in zip_longest(item.SubElementNames or ("",), item.PickedPoints)
        ]
        if not chosen:
            return
        Gui.Selection.clearSelection()
        name = self._what.currentData()
        try:
            for owner, element, at in chosen:
                pick(self._obj, name, owner, element, self._length.value(), at)
        except VolfrepError as error:
            self._refused(str(error))
            return
        self.show_picked()
        self._changed(name)

    def _unpick(self) -> None:
        name = self._what.currentData()
        unpick(self._obj, name)
        self.show_picked()
        self._changed(name)


def _length_field() -> Any:
    """A field for what is beside what is picked: a skin's thickness, a diameter, a distance."""
    field = QtWidgets.QDoubleSpinBox()
    field.setObjectName("PickLength")
    field.setSuffix(" mm")
    field.setRange(0.0, MOST_LENGTH)
    field.setDecimals(2)
    field.setSingleStep(0.5)
    field.setAccessibleName(translate("VolfrepTaskPanel", "Thickness, diameter or distance"))
    field.setToolTip(
        translate(
            "VolfrepTaskPanel",
            "Of faces with a skin of their own: the thickness of those that are picked next; a "
            "face that has another gets it, one that has it goes back to the usual skin, and 0 "
            "leaves it open. Of drain holes: the diameter of all. Of what is kept solid: the "
            "distance from all its faces",
        )
    )
    return field


class _Picture:
    """How what was picked lies, in the view: faces, an arrow whose ends are dragged, balls.

    Args:
        obj: the infill.
        turned: called with the direction that the mouse turns the arrow to.
        released: called when it lets go.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        turned: Callable[[App.Vector], None],
        released: Callable[[], None],
    ) -> None:
        self._obj = obj
        self._turned, self._released = turned, released
        self._handle: ArrowHandle | None = None
        self._scene: Any = None
        self._root: Any = None

    def show(self, name: str | None) -> None:
        """Draw a property in the place of what was drawn last; None: nothing."""
        if self._handle is not None and not self._handle.is_dragged:
            self._handle.remove()
            self._handle = None
        if self._scene is not None:
            self._scene.removeChild(self._root)
            self._scene = None
        if name is None:
            return
        view = Gui.getDocument(self._obj.Document.Name).activeView()
        if not hasattr(view, "getSceneGraph"):
            return
        mesh = self._mesh(name)
        if mesh is None:
            return
        from pivy import coin

        self._root = coin.SoAnnotation()
        self._root.setName(NODE)
        look = drawing.material(COLOUR, 0.4 if PICKED[name] == FACES else 0.0)
        for part in (
            drawing.unpickable(),
            drawing.transform(parent_placement(self._obj)),
            look,
            drawing.faces(mesh),
        ):
            self._root.addChild(part)
        self._scene = view.getSceneGraph()
        self._scene.addChild(self._root)
        if PICKED[name] == DIRECTION and self._handle is None:
            middle, size = self._middle()
            way = np.array(tuple(picked_of(self._obj, name)))
            self._handle = ArrowHandle(
                view, parent_placement(self._obj), middle, LONG * size,
                way / np.linalg.norm(way), self._turned, self._released,
            )  # fmt: skip

    @property
    def is_dragged(self) -> bool:
        """Whether the mouse holds the arrow."""
        return self._handle is not None and self._handle.is_dragged

    def _middle(self) -> tuple[Any, float]:
        """(3,) the middle of the solid's box, and its diagonal, mm."""
        low, high = self._obj.Proxy.read(self._obj)[1].bounds
        return 0.5 * (low + high), float(np.linalg.norm(high - low))

    def _mesh(self, name: str) -> TriangleMesh | None:
        value = picked_of(self._obj, name)
        if PICKED[name] == FACES:
            frame = parent_placement(self._obj)
            found = [
                face_facets(o, element, frame)
                if element
                else np.stack(kept_mesh(o, frame).corners(), axis=1)
                for o, names in value
                for element in names
            ]
            if not found:
                return None
            corners = np.concatenate(found).reshape(-1, 3)
            return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
        middle, size = self._middle()
        if PICKED[name] == DIRECTION:
            return _arrow(middle, np.array(tuple(value)), size)
        points = value if isinstance(value, list) else [value]
        if not points:
            return None
        at = np.array([tuple(point) for point in points], np.float64)
        half = np.array([0.0, 0.0, BALL * size])
        return prisms(at - half, at + half, np.full((len(at), 2), BALL * size))


def _arrow(middle: Any, way: Any, size: float) -> TriangleMesh | None:
    """An arrow through the middle of a solid that is so large."""
    length = float(np.linalg.norm(way))
    if length == 0.0:
        return None
    way = way / length
    tail, head = middle - LONG * size * way, middle + LONG * size * way
    neck = head - 8.0 * THICK * size * way
    thick = THICK * size
    return prisms(
        np.stack([tail, neck]),
        np.stack([neck, head]),
        np.array([[thick, thick], [3.0 * thick, 1e-3 * thick]]),
    )
