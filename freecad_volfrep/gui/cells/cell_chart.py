# SPDX-License-Identifier: LGPL-2.1-or-later
"""A chart of cells as of materials: modulus over density, both in powers of ten; a curve a cell."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.gui.widgets.plot_colours import plot_colours

#: Room for the axes' numbers, px: left, top, right, bottom.
MARGINS = (64, 10, 12, 36)
#: A click within so many px of a point picks it.
NEAR = 12
_FOUND, _PICKED, _WANTED = "#0072b2", "#d00020", "#009e73"

#: A place of the chart: density and modulus.
Place = tuple[float, float]


class CellChart(QtWidgets.QWidget):
    """Curves of cells, what is wanted, and the cells that have it, of which one can be picked.

    Args:
        picked: called with the number of the answer that was clicked at.
    """

    def __init__(self, picked: Callable[[int], None]) -> None:
        super().__init__()
        self.setObjectName("CellChart")
        self.setMinimumSize(380, 300)
        self.setCursor(QtCore.Qt.CrossCursor)
        self._picked = picked
        self._curves: Mapping[str, tuple[Sequence[float], Sequence[float]]] = {}
        self._words = "", ""
        self._answers: list[Place] = []
        self._names: list[str] = []
        self._wanted: tuple[float | None, float | None] = None, None
        self._chosen = -1
        self._colours = plot_colours(self)

    def show_curves(
        self, curves: Mapping[str, tuple[Sequence[float], Sequence[float]]], words: tuple[str, str]
    ) -> None:
        """Draw a curve for each cell.

        Args:
            curves: densities and moduli by the names of cells.
            words: what the axes are called.
        """
        self._curves, self._words = curves, words
        self.update()

    def show_answers(
        self,
        names: list[str],
        places: list[Place],
        wanted: tuple[float | None, float | None],
    ) -> None:
        """Mark the cells that have what is wanted.

        Args:
            names: of the cells.
            places: of each.
            wanted: density and modulus; None for any.
        """
        self._names, self._answers, self._wanted, self._chosen = names, places, wanted, -1
        self.update()

    def choose(self, number: int) -> None:
        """Mark an answer as the one that is picked; below 0 for none."""
        self._chosen = number
        self.update()

    def place_of(self, number: int) -> QtCore.QPointF:
        """Where an answer is, px."""
        return self._at(self._answers[number])

    def mousePressEvent(self, event: Any) -> None:  # noqa: N802
        """Pick the answer that is nearest to the click."""
        at = event.pos()
        distances = [
            (math.hypot(place.x() - at.x(), place.y() - at.y()), number)
            for number, place in enumerate(map(self._at, self._answers))
        ]
        if distances and min(distances)[0] <= NEAR:
            self._picked(min(distances)[1])

    def paintEvent(self, event: Any) -> None:  # noqa: N802
        """Draw axes, curves, what is wanted and the answers."""
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        self._colours = plot_colours(self)
        painter.fillRect(self.rect(), self._colours.paper)
        if self._curves:
            self._draw_axes(painter)
            painter.setPen(QtGui.QPen(self._colours.faint, 1.4))
            for densities, moduli in self._curves.values():
                places = map(self._at, zip(densities, moduli, strict=True))
                painter.drawPolyline(QtGui.QPolygonF(list(places)))
            self._draw_wanted(painter)
            self._draw_answers(painter)
        painter.end()

    def _draw_axes(self, painter: Any) -> None:
        left, top, right, bottom = MARGINS
        width, height = self.width(), self.height()
        for value in _marks(*self._span(0)):
            x = self._at((value, self._span(1)[0])).x()
            painter.setPen(self._colours.grid)
            painter.drawLine(QtCore.QPointF(x, top), QtCore.QPointF(x, height - bottom))
            painter.setPen(self._colours.ink)
            box = QtCore.QRectF(x - 40, height - bottom + 2, 80, 14)
            painter.drawText(box, int(QtCore.Qt.AlignHCenter), f"{100.0 * value:g} %")
        for value in _marks(*self._span(1)):
            y = self._at((self._span(0)[0], value)).y()
            painter.setPen(self._colours.grid)
            painter.drawLine(QtCore.QPointF(left, y), QtCore.QPointF(width - right, y))
            painter.setPen(self._colours.ink)
            box = QtCore.QRectF(12, y - 7, left - 17, 14)
            flags = QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter
            painter.drawText(box, int(flags), f"{value:g}")
        painter.setPen(self._colours.ink)
        frame = QtCore.QRectF(left, top, width - left - right, height - top - bottom)
        painter.drawRect(frame)
        line = QtCore.QRectF(left, height - 17, frame.width(), 15)
        painter.drawText(line, int(QtCore.Qt.AlignHCenter), self._words[0])
        painter.save()
        painter.translate(0, top + frame.height() / 2)
        painter.rotate(-90)
        side = QtCore.QRectF(-frame.height() / 2, 0, frame.height(), 14)
        painter.drawText(side, int(QtCore.Qt.AlignHCenter), self._words[1])
        painter.restore()

    def _draw_wanted(self, painter: Any) -> None:
        """Lines at the density and the modulus that are wanted."""
        left, top, right, bottom = MARGINS
        painter.setPen(QtGui.QPen(QtGui.QColor(_WANTED), 1.6, QtCore.Qt.DashLine))
        density, modulus = self._wanted
        (low, high), (least, most) = self._span(0), self._span(1)
        if density is not None and low <= density <= high:
            x = self._at((density, least)).x()
            painter.drawLine(QtCore.QPointF(x, top), QtCore.QPointF(x, self.height() - bottom))
        if modulus is not None and least <= modulus <= most:
            y = self._at((low, modulus)).y()
            painter.drawLine(QtCore.QPointF(left, y), QtCore.QPointF(self.width() - right, y))

    def _draw_answers(self, painter: Any) -> None:
        if 0 <= self._chosen < len(self._names):
            curve = self._curves.get(self._names[self._chosen])
            if curve is not None:
                painter.setPen(QtGui.QPen(QtGui.QColor(_FOUND), 2.0))
                places = map(self._at, zip(*curve, strict=True))
                painter.drawPolyline(QtGui.QPolygonF(list(places)))
        for number, place in enumerate(map(self._at, self._answers)):
            painter.setPen(QtCore.Qt.NoPen)
            painter.setBrush(QtGui.QColor(_FOUND))
            painter.drawEllipse(place, 4.0, 4.0)
            painter.setBrush(QtCore.Qt.NoBrush)
            if number == self._chosen:
                painter.setPen(QtGui.QPen(QtGui.QColor(_PICKED), 2.2))
                painter.drawEllipse(place, 8.0, 8.0)
                # To the side on which there is room.
                is_right = place.x() > 0.6 * self.width()
                side = QtCore.Qt.AlignRight if is_right else QtCore.Qt.AlignLeft
                box = QtCore.QRectF(place.x() - 190 if is_right else place.x() + 12,
                                    place.y() - 20, 178, 16)  # fmt: skip
                painter.setPen(self._colours.ink)
                painter.drawText(box, int(side), self._names[number])

    def _at(self, place: Place) -> QtCore.QPointF:
        left, top, right, bottom = MARGINS
        shares = []
        for value, (low, high) in zip(place, (self._span(0), self._span(1)), strict=True):
            share = math.log(max(value, 1e-30) / low) / math.log(high / low)
            shares.append(min(max(share, 0.0), 1.0))
        return QtCore.QPointF(
            left + shares[0] * (self.width() - left - right),
            top + (1.0 - shares[1]) * (self.height() - top - bottom),
        )

    def _span(self, axis: int) -> tuple[float, float]:
        """The least and the largest value that are shown; five decades at most."""
        values = [value for curve in self._curves.values() for value in curve[axis] if value > 0.0]
        high = max(values) * 1.2
        return max(min(values) / 1.2, high / 1e5), high


def _marks(low: float, high: float) -> list[float]:
    """1, 2 and 5 times powers of ten between two numbers; powers alone where these are many."""
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    steps = (1.0, 2.0, 5.0) if len(decades) <= 4 else (1.0,)
    marks = [float(f"{step}e{decade}") for decade in decades for step in steps]
    return [value for value in marks if low <= value <= high]
