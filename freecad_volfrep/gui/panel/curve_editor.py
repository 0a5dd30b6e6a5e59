# SPDX-License-Identifier: LGPL-2.1-or-later
"""A grading's curve over s, whose points are dragged; it writes the grading's formula."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_volfrep.features.infill.curve_points import (
    PRESETS,
    Point,
    added,
    formula_of,
    moved,
    points_of,
    preset,
    taken_over,
    without,
)
from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.translation import figure, marked, translate
from volfrep.design.profile import Profile
from volfrep.util.errors import VolfrepError

#: Of the drawing, px: its height, its margins, a point's radius, and how near a click must be.
HEIGHT, MARGIN, RADIUS, NEAR = 130, 14, 4, 12
#: Places at which a formula is drawn.
SAMPLES = [k / 100 for k in range(101)]
#: What an arrow key moves a point by: along s, and as a share of the largest value.
STEP = 0.02
#: The keys that work the drawing, and where arrows move a point.
_WAYS = {
    QtCore.Qt.Key_Left: (-STEP, 0.0),
    QtCore.Qt.Key_Right: (STEP, 0.0),
    QtCore.Qt.Key_Up: (0.0, STEP),
    QtCore.Qt.Key_Down: (0.0, -STEP),
}
_OUR_KEYS = (
    *_WAYS,
    QtCore.Qt.Key_PageUp,
    QtCore.Qt.Key_PageDown,
    QtCore.Qt.Key_Insert,
    QtCore.Qt.Key_Delete,
)
_NAMES = marked(
    "VolfrepCurve",
    "Rising", "Falling", "Thick in the middle", "Thick at the ends", "Step",
)  # fmt: skip


class CurveEditor(QtWidgets.QWidget):
    """A list of shapes over a drawing.

    Args:
        formula: to begin with.
        title: of the quantity, for who cannot see it.
        changed: called with a formula when the user has moved something.
    """

    def __init__(self, formula: str, title: str, changed: Callable[[str], None]) -> None:
        super().__init__()
        self._changed = changed
        self.shapes = QtWidgets.QComboBox()
        self.shapes.setObjectName("Shapes")
        self.shapes.setMinimumContentsLength(6)
        self.shapes.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        self.shapes.setAccessibleName(translate("VolfrepCurve", "Shape of the curve"))
        self.shapes.addItem(translate("VolfrepCurve", "Shape..."), "")
        for name in PRESETS:
            self.shapes.addItem(translate("VolfrepCurve", name), name)
        self.shapes.activated.connect(self._choose)
        self.drawing = _Drawing(formula, self._write)
        self.drawing.setAccessibleName(title)
        self.drawing.setToolTip(
            translate(
                "VolfrepCurve",
                "Drag a point; double click for a new one, right click to remove one. Keys: Page "
                "Up and Down choose a point, arrows move it, Insert and Delete add and remove.",
            )
        )
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(2)
        column.addWidget(self.shapes)
        column.addWidget(self.drawing)

    def show_formula(self, formula: str) -> None:
        """Draw another formula, typed or from elsewhere."""
        if formula != self.drawing.formula:
            self.drawing.take(formula)

    def _choose(self, row: int) -> None:
        name = self.shapes.itemData(row)
        if name:
            self.drawing.set_points(preset(name, self.drawing.formula), 0)

    def _write(self, formula: str) -> None:
        self._changed(formula)


class _Drawing(QtWidgets.QWidget):
    """The curve and its points, worked by mouse and keys."""

    def __init__(self, formula: str, changed: Callable[[str], None]) -> None:
        super().__init__()
        self.setObjectName("Curve")
        self.setFixedHeight(HEIGHT)
        self.setFocusPolicy(QtCore.Qt.StrongFocus)
        self._changed = changed
        self._dragged = False
        self.chosen = 0
        self.take(formula)

    def take(self, formula: str) -> None:
        """Show a formula; its points where it has some."""
        self.formula = formula
        self.points: tuple[Point, ...] = points_of(formula) or ()
        self.chosen = min(self.chosen, max(len(self.points) - 1, 0))
        try:
            values = Profile("formula", expression=formula)(SAMPLES).tolist()
        except VolfrepError:
            values = []  # the panel says what is wrong with it
        self._line: list[Point] = list(zip(SAMPLES, values, strict=False))
        if not self._dragged:
            self._top = 1.25 * max([value for _, value in (*self._line, *self.points)] or [1.0])
        self.update()

    def set_points(self, points: tuple[Point, ...], chosen: int) -> None:
        """Have a curve through these, and write its formula."""
        self.chosen = chosen
        self.take(formula_of(points))
        self._changed(self.formula)

    def place_of(self, point: Point) -> QtCore.QPointF:
        """Where a point is drawn."""
        area = self._area()
        return QtCore.QPointF(
            area.left() + point[0] * area.width(),
            area.bottom() - point[1] / self._top * area.height(),
        )

    def paintEvent(self, event: QtGui.QPaintEvent) -> None:  # noqa: N802
        """Draw axes, curve and points in the window's own colours."""
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        palette = self.palette()
        painter.fillRect(self.rect(), palette.base())
        area = self._area()
        painter.setPen(palette.mid().color())
        painter.drawRect(area)
        painter.setPen(palette.text().color())
        painter.drawText(QtCore.QPointF(area.left() + 3, area.top() + 12), figure(self._top, 3))
        painter.drawText(QtCore.QPointF(area.left() + 3, area.bottom() - 3), "0")
        below = self.rect().bottom() - 2
        painter.drawText(QtCore.QPointF(area.left(), below), "s = 0")
        width = painter.fontMetrics().boundingRect("s = 1").width()
        painter.drawText(QtCore.QPointF(area.right() - width, below), "s = 1")
        if self._line:
            painter.setPen(QtGui.QPen(palette.highlight().color(), 2))
            painter.drawPolyline(QtGui.QPolygonF([self.place_of(point) for point in self._line]))
        for k, point in enumerate(self.points):
            is_chosen = k == self.chosen and self.hasFocus()
            painter.setPen(QtGui.QPen(palette.text().color(), 1))
            painter.setBrush(palette.highlight() if is_chosen else palette.base())
            size = RADIUS + 2 * is_chosen
            painter.drawEllipse(self.place_of(point), size, size)
        if self.points and self.hasFocus():
            place, value = self.points[self.chosen]
            text = f"s = {figure(place)}: {figure(value, 3)}"
            width = painter.fontMetrics().boundingRect(text).width()
            painter.drawText(QtCore.QPointF(area.right() - width - 4, area.top() + 12), text)

    def mousePressEvent(self, event: QtGui.QMouseEvent) -> None:  # noqa: N802
        """Take hold of the nearest point, or with the right button remove it."""
        near = self._near(event.pos())
        if near is None:
            return
        if event.button() == QtCore.Qt.RightButton:
            self.set_points(without(self.points, near), max(near - 1, 0))
            return
        self.chosen, self._dragged = near, event.button() == QtCore.Qt.LeftButton
        self.update()

    def mouseMoveEvent(self, event: QtGui.QMouseEvent) -> None:  # noqa: N802
        """Drag what is held."""
        if self._dragged:
            self.set_points(moved(self.points, self.chosen, *self._at(event.pos())), self.chosen)

    def mouseReleaseEvent(self, event: QtGui.QMouseEvent) -> None:  # noqa: N802
        """Let go, and find room for what was drawn."""
        if self._dragged:
            self._dragged = False
            self.take(self.formula)

    def mouseDoubleClickEvent(self, event: QtGui.QMouseEvent) -> None:  # noqa: N802
        """A new point; a formula of another form becomes points first."""
        if event.button() == QtCore.Qt.LeftButton and self._become_points():
            self.set_points(*added(self.points, *self._at(event.pos())))

    def event(self, event: QtCore.QEvent) -> bool:
        """Keep keys that are also FreeCAD's shortcuts: Delete would take the selected solid."""
        if event.type() == QtCore.QEvent.ShortcutOverride and event.key() in _OUR_KEYS:
            event.accept()
            return True
        return bool(super().event(event))

    def keyPressEvent(self, event: QtGui.QKeyEvent) -> None:  # noqa: N802
        """Choose a point, move it, add one, remove it."""
        key = event.key()
        if key not in _OUR_KEYS or not self._become_points():
            super().keyPressEvent(event)
            return
        k, last = self.chosen, len(self.points) - 1
        place, value = self.points[k]
        if key in _WAYS:
            along, up = _WAYS[key]
            self.set_points(moved(self.points, k, place + along, value + up * self._top), k)
        elif key == QtCore.Qt.Key_Delete:
            self.set_points(without(self.points, k), max(k - 1, 0))
        elif key == QtCore.Qt.Key_Insert:
            other = self.points[k + 1 if k < last else k - 1]
            middle = 0.5 * (place + other[0]), 0.5 * (value + other[1])
            self.set_points(*added(self.points, *middle))
        else:
            self.chosen = max(k - 1, 0) if key == QtCore.Qt.Key_PageUp else min(k + 1, last)
            self.update()

    def _become_points(self) -> bool:
        """Have points: those of the formula, or some on its curve; whether there are any now."""
        if not self.points:
            try:
                self.points = taken_over(self.formula)
            except VolfrepError:
                return False
        return True

    def _area(self) -> QtCore.QRect:
        return self.rect().adjusted(4, 4, -4, -MARGIN - 4)

    def _at(self, pixel: Any) -> Point:
        """The point that a pixel stands for."""
        area = self._area()
        place = (pixel.x() - area.left()) / max(area.width(), 1)
        value = (area.bottom() - pixel.y()) / max(area.height(), 1) * self._top
        return min(max(place, 0.0), 1.0), min(max(value, 0.0), self._top)

    def _near(self, pixel: Any) -> int | None:
        """The point that a click is meant for; None for none."""
        if not self.points:
            return None
        away = [
            (abs(spot.x() - pixel.x()) + abs(spot.y() - pixel.y()), k)
            for k, spot in enumerate(map(self.place_of, self.points))
        ]
        distance, k = min(away)
        return k if distance <= NEAR else None
