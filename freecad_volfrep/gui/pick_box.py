# SPDX-License-Identifier: LGPL-2.1-or-later
"""Picking in the view, in an infill's panel: what for, what was picked, and how it lies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep.bridge.solids import face_facets, parent_placement
from freecad_volfrep.features.picking import (
    DIRECTION,
    FACES,
    PICKED,
    pick,
    pickable,
    picked_of,
    unpick,
)
from freecad_volfrep.translation import translate
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

from . import drawing
from .panel_manners import narrow
from .prisms import prisms
from .property_fields import label_of
from .qt import QtCore, QtWidgets

#: Name of what is drawn of it in the view's scene.
NODE = "VolfrepPicked"
COLOUR = (0.98, 0.55, 0.10)
#: Of an arrow or a point, in lengths of the solid's diagonal.
LONG, THICK, BALL = 0.35, 0.012, 0.015


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
        self._picture = _Picture(obj)
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
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self._pick)
        line.addWidget(self._clear)
        column.addLayout(line)
        column.addWidget(self._said)
        self.show_applicable()
        self._what.currentIndexChanged.connect(lambda _: self.show_picked())
        self._pick.toggled.connect(self._toggle)
        self._clear.clicked.connect(lambda _=False: self._unpick())

    @property
    def lists(self) -> list[Any]:
        """Fields that the wheel is not to change."""
        return [self._what]

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
        self.show_picked()

    def show_picked(self) -> None:
        """Say what the chosen property is, and draw it while it is picked."""
        name = self._what.currentData()
        value = picked_of(self._obj, name)
        if PICKED[name] == FACES:
            text = ", ".join(f"{o.Label}: {', '.join(names)}" for o, names in value)
        else:
            points = value if isinstance(value, list) else [value]
            text = "; ".join(", ".join(f"{part:.4g}" for part in point) for point in points)
        self._said.setText(text or translate("VolfrepTaskPanel", "nothing picked"))
        self._picture.show(name if self._pick.isChecked() else None)

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
        if not self._pick.isChecked():
            return
        chosen = [
            (item.Object, element)
            for item in Gui.Selection.getSelectionEx()
            for element in (item.SubElementNames or ("",))
        ]
        if not chosen:
            return
        Gui.Selection.clearSelection()
        name = self._what.currentData()
        try:
            for owner, element in chosen:
                pick(self._obj, name, owner, element)
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


class _Picture:
    """How what was picked lies, in the view: faces, an arrow, balls."""

    def __init__(self, obj: App.DocumentObject) -> None:
        self._obj = obj
        self._scene: Any = None
        self._root: Any = None

    def show(self, name: str | None) -> None:
        """Draw a property in the place of what was drawn last; None: nothing."""
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

    def _mesh(self, name: str) -> TriangleMesh | None:
        value = picked_of(self._obj, name)
        if PICKED[name] == FACES:
            frame = parent_placement(self._obj)
            found = [face_facets(o, element, frame) for o, names in value for element in names]
            if not found:
                return None
            corners = np.concatenate(found).reshape(-1, 3)
            return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
        low, high = self._obj.Proxy.read(self._obj)[1].bounds
        size = float(np.linalg.norm(high - low))
        if PICKED[name] == DIRECTION:
            return _arrow(0.5 * (low + high), np.array(tuple(value)), size)
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
