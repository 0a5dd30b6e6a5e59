# SPDX-License-Identifier: LGPL-2.1-or-later
"""A plot of designs in a panel: two figures of each, of which one can be picked by a click."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.gui.widgets.plot_colours import plot_colours
from freecad_volfrep.translation import translate
from volfrep.util.numbers import round_values

#: Room for the axes' numbers, px: left, top, right, bottom.
MARGINS = (72, 12, 14, 38)
#: A click within so many px of a point picks it.
NEAR = 14
#: Room about what is said where there is no point, px.
EMPTY = 16
#: Lines of the grid along each axis, about.
LINES = 4
#: Colours that are told apart by most eyes (Okabe & Ito, Color Universal Design, 2008).
COLOURS = ("#0072b2", "#e69f00", "#009e73", "#d55e00", "#cc79a7", "#56b4e9", "#606060", "#b8a800")


class StudyPlot(QtWidgets.QWidget):
    """Points of designs by two of their figures, coloured by a word.

    Args:
        picked: called with a design's row when it is clicked.
    """

    def __init__(self, picked: Callable[[dict[str, Any]], None]) -> None:
        super().__init__()
        self.setObjectName("StudyPlot")
        self.setMinimumSize(240, 230)
        self.setCursor(QtCore.Qt.CrossCursor)
        self._picked = picked
        self._rows: list[dict[str, Any]] = []
        self._axes = "", ""
        self._words = ["", ""]
        self._colour = ""
        self._chosen: str | None = None
        self._drawn_in = plot_colours(self)
        #: What is said in the place of points, where there are none.
        self.said_of_none = translate(
            "VolfrepStudy", "Not run yet: choose what varies, then press Start."
        )

    def show_rows(
        self, rows: list[dict[str, Any]], axes: tuple[str, str], words: list[str], colour: str
    ) -> None:
        """Draw the designs that have both figures.

        Args:
            rows: the designs.
            axes: names of the figures to the right and up.
            words: what they are called.
            colour: the name of what colours say.
        """
        self._rows = [r for r in rows if all(_is_number(r.get(name)) for name in axes)]
        self._axes, self._words, self._colour = axes, words, colour
        self.update()

    def choose(self, key: str | None) -> None:
        """Mark a design as the one that was picked."""
        self._chosen = key
        self.update()

    def place_of(self, row: dict[str, Any]) -> QtCore.QPointF:
        """Where a design's point is, px."""
        left, top, right, bottom = MARGINS
        width, height = self.width() - left - right, self.height() - top - bottom
        x, y = (
            (row[name] - low) / (high - low)
            for name, (low, high) in zip(self._axes, map(self._span, self._axes), strict=True)
        )
        return QtCore.QPointF(left + x * width, top + (1.0 - y) * height)

    def mousePressEvent(self, event: Any) -> None:  # noqa: N802
        """Pick the design that is nearest to the click."""
        at = event.pos()
        distances = {
            math.hypot(place.x() - at.x(), place.y() - at.y()): row
            for row in self._rows
            for place in (self.place_of(row),)
        }
        if distances and min(distances) <= NEAR:
            row = distances[min(distances)]
            self.choose(row["key"])
            self._picked(row)

    def paintEvent(self, event: Any) -> None:  # noqa: N802
        """Draw axes and points."""
        painter = QtGui.QPainter(self)
        painter.setRenderHint(QtGui.QPainter.Antialiasing)
        self._drawn_in = plot_colours(self)
        painter.fillRect(self.rect(), self._drawn_in.paper)
        if not self._rows:
            painter.setPen(self._drawn_in.ink)
            room = self.rect().adjusted(EMPTY, EMPTY, -EMPTY, -EMPTY)
            flags = QtCore.Qt.AlignCenter | QtCore.Qt.TextWordWrap
            painter.drawText(room, int(flags), self.said_of_none)
            painter.end()
            return
        self._draw_axes(painter)
        words = list(dict.fromkeys(row.get(self._colour) for row in self._rows))
        for row in self._rows:
            number = words.index(row.get(self._colour))
            colour = self._drawn_in.seen(COLOURS[number % len(COLOURS)])
            place = self.place_of(row)
            painter.setPen(QtCore.Qt.NoPen)
            painter.setBrush(colour)
            painter.drawEllipse(place, 3.5, 3.5)
            painter.setBrush(QtCore.Qt.NoBrush)
            if row["chosen"]:
                painter.setPen(QtGui.QPen(self._drawn_in.ink, 1.0))
                painter.drawEllipse(place, 6.0, 6.0)
            if row["key"] == self._chosen:
                painter.setPen(QtGui.QPen(QtGui.QColor("#d00020"), 2.4))
                painter.drawEllipse(place, 8.5, 8.5)
        self._draw_legend(painter, words)
        painter.end()

    def _draw_axes(self, painter: Any) -> None:
        left, top, right, bottom = MARGINS
        width, height = self.width(), self.height()
        ink, grid = self._drawn_in.ink, self._drawn_in.grid
        for k, name in enumerate(self._axes):
            low, high = self._span(name)
            for value in round_values(low, high, LINES):
                share = (value - low) / (high - low)
                if k == 0:
                    x = left + share * (width - left - right)
                    line = QtCore.QPointF(x, top), QtCore.QPointF(x, height - bottom)
                    box = QtCore.QRectF(x - 40, height - bottom + 2, 80, 14)
                    flags = QtCore.Qt.AlignHCenter
                else:
                    y = top + (1.0 - share) * (height - top - bottom)
                    line = QtCore.QPointF(left, y), QtCore.QPointF(width - right, y)
                    box = QtCore.QRectF(0, y - 7, left - 5, 14)
                    flags = QtCore.Qt.AlignRight | QtCore.Qt.AlignVCenter
                painter.setPen(grid)
                painter.drawLine(*line)
                painter.setPen(ink)
                painter.drawText(box, int(flags), f"{value:.4g}")
        painter.setPen(ink)
        frame = QtCore.QRectF(left, top, width - left - right, height - top - bottom)
        painter.drawRect(frame)
        bottom_line = QtCore.QRectF(left, height - 20, width - left - right, 19)
        painter.drawText(bottom_line, int(QtCore.Qt.AlignHCenter), self._words[0])
        painter.save()
        painter.translate(2, top + frame.height() / 2)
        painter.rotate(-90)
        side = QtCore.QRectF(-frame.height() / 2, 0, frame.height(), 34)
        # What is too long for one line has its unit in the next.
        title = self._words[1]
        if painter.boundingRect(side, 0, title).width() > side.width():
            title = title.replace(", ", ",\n", 1)
        painter.drawText(side, int(QtCore.Qt.AlignHCenter), title)
        painter.restore()

    def _draw_legend(self, painter: Any, words: list[Any]) -> None:
        if len(words) < 2:
            return
        for line, word in enumerate(words[: len(COLOURS)]):
            y = MARGINS[1] + 6 + 13 * line
            painter.setPen(QtCore.Qt.NoPen)
            painter.setBrush(self._drawn_in.seen(COLOURS[line]))
            painter.drawEllipse(QtCore.QPointF(MARGINS[0] + 9, y + 4), 3.5, 3.5)
            painter.setPen(self._drawn_in.ink)
            painter.drawText(QtCore.QPointF(MARGINS[0] + 17, y + 8), str(word))

    def _span(self, name: str) -> tuple[float, float]:
        """The least and the largest of a figure, with a little room on either side."""
        values = [row[name] for row in self._rows]
        low, high = min(values), max(values)
        room = 0.06 * (high - low) or 0.05 * abs(high) or 1.0
        return low - room, high + room


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)
