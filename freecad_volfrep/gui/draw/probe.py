# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the mouse points at in a 3D view, once it rests for a moment."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_volfrep.gui.qt import QtCore

from . import drawing

#: The mouse rests after so long, ms.
RESTS = 120


class Probe:
    """Picks some shapes where the mouse rests over a view, until it is ended.

    Args:
        view: a 3D view of FreeCAD.
        shapes: the nodes that may be picked now, what moves and cuts them before them.
        hover: called with the point in front, in the coordinates of the shapes (mm), or None.
    """

    def __init__(
        self,
        view: Any,
        shapes: Callable[[], list[Any]],
        hover: Callable[[tuple[float, float, float] | None], None],
    ) -> None:
        from pivy import coin

        self._view, self._shapes, self._hover = view, shapes, hover
        self._place = (0, 0)
        self._timer = QtCore.QTimer()
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._look)
        self._kind = coin.SoLocation2Event.getClassTypeId()
        self._callback = view.addEventCallbackPivy(self._kind, self._moved)

    def end(self, view_is_gone: bool = False) -> None:
        """Pick no more."""
        self._timer.stop()
        if not view_is_gone:
            self._view.removeEventCallbackPivy(self._kind, self._callback)

    def _moved(self, event: Any) -> None:
        place = event.getEvent().getPosition()
        self._place = (place[0], place[1])
        self._timer.start(RESTS)

    def _look(self) -> None:
        self._hover(picked(self._view, self._shapes(), self._place))


def picked(
    view: Any, shapes: list[Any], place: tuple[int, int]
) -> tuple[float, float, float] | None:
    """The point in front of some shapes, in their own coordinates; None where there is none.

    Args:
        view: a 3D view of FreeCAD.
        shapes: nodes, with what moves and cuts them before them.
        place: px, from the lower left corner.
    """
    from pivy import coin

    if not shapes:
        return None
    root = drawing.separate(view.getCameraNode(), *shapes)
    root.ref()
    width, height = view.getSize()
    action = coin.SoRayPickAction(coin.SbViewportRegion(width, height))
    action.setPoint(coin.SbVec2s(*place))
    action.setRadius(1.0)
    action.apply(root)
    found = action.getPickedPoint()
    point = None if found is None else found.getObjectPoint().getValue()
    root.unref()
    return None if point is None else (float(point[0]), float(point[1]), float(point[2]))
