# SPDX-License-Identifier: LGPL-2.1-or-later
"""An arrow in the view whose ends are dragged: it turns about its middle, as the mouse goes.

Coin's own draggers take the mouse only where nothing lies in front of them, and an arrow lies in
its solid. So what counts here is how near the mouse is on the screen; from then on the end that
was taken stays under the mouse, on the sphere about the middle that it lies on.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App
import numpy as np

#: The mouse takes an end within so many pixels of it.
NEAR = 14.0
#: Decimals of a direction that was turned.
DECIMALS = 4


class ArrowHandle:
    """Lets the mouse turn an arrow in a view, until it is removed.

    Args:
        view: FreeCAD's 3D view.
        frame: the coordinate system of the arrow.
        middle: (3,) in it, mm.
        reach: from the middle to each end, mm.
        way: (3,) where it points, of length 1.
        turned: called with the new direction while the mouse moves.
        released: called when the mouse lets go.
    """

    def __init__(
        self,
        view: Any,
        frame: App.Placement,
        middle: Any,
        reach: float,
        way: Any,
        turned: Callable[[App.Vector], None],
        released: Callable[[], None],
    ) -> None:
        from pivy import coin

        self._view, self._reach = view, reach
        self._frame, self._middle = frame, App.Vector(*middle)
        self._way = App.Vector(*way)
        self._turned, self._released = turned, released
        self._end = 0.0
        self._buttons = coin.SoMouseButtonEvent.getClassTypeId()
        self._moves = coin.SoLocation2Event.getClassTypeId()
        self._on_button = view.addEventCallbackPivy(self._buttons, self._button)
        self._on_move = view.addEventCallbackPivy(self._moves, self._move)

    @property
    def is_dragged(self) -> bool:
        """Whether the mouse holds an end."""
        return self._end != 0.0

    def remove(self) -> None:
        """Leave the view's mouse alone."""
        self._view.removeEventCallbackPivy(self._buttons, self._on_button)
        self._view.removeEventCallbackPivy(self._moves, self._on_move)

    def ends(self) -> list[tuple[float, Any]]:
        """Signs of both ends along the arrow, and where they are on the screen, in pixels."""
        places = []
        for sign in (1.0, -1.0):
            end = self._middle + self._way * (sign * self._reach)
            places.append((sign, self._view.getPointOnScreen(self._frame.multVec(end))))
        return places

    def _button(self, node: Any) -> None:
        event = node.getEvent()
        if event.getButton() != event.BUTTON1:
            return
        if event.getState() == event.DOWN:
            x, y = _place(event)
            far = [
                (float(np.hypot(place[0] - x, place[1] - y)), sign) for sign, place in self.ends()
            ]
            distance, sign = min(far)
            if distance <= NEAR:
                self._end = sign
                node.grabEvents()
                node.setHandled()
        elif self.is_dragged:
            self._end = 0.0
            node.releaseEvents()
            node.setHandled()
            self._released()

    def _move(self, node: Any) -> None:
        if not self.is_dragged:
            return
        node.setHandled()
        end = self._on_sphere(*_place(node.getEvent())) - self._middle
        if end.Length == 0.0:
            return
        way = end * (self._end / end.Length)
        self._way = App.Vector(*(round(part, DECIMALS) + 0.0 for part in way))
        self._turned(self._way)

    def _on_sphere(self, x: int, y: int) -> App.Vector:
        """Where a place on the screen meets the sphere of the arrow's ends, on the held one's side.

        Beside the sphere, the nearest point of the line of sight.
        """
        back = self._frame.inverse()
        through = self._view.getPoint(x, y)
        if self._view.getCameraType() == "Perspective":
            eye = self._view.getCameraNode().position.getValue()
            eye = App.Vector(eye[0], eye[1], eye[2])
            sight = through - eye
        else:
            sight = self._view.getViewDirection()
        through, sight = back.multVec(through), back.Rotation.multVec(sight)
        sight.normalize()
        off = self._middle - through
        nearest = through + sight * off.dot(sight)
        room = self._reach**2 - (nearest - self._middle).Length ** 2
        if room <= 0.0:
            return nearest
        towards = 1.0 if (self._way * self._end).dot(sight) > 0.0 else -1.0
        return nearest + sight * (towards * room**0.5)


def _place(event: Any) -> tuple[int, int]:
    """Where the mouse is in the view, in pixels from its lower left corner.

    By its parts: some builds of pivy give a bare pointer for both.
    """
    position = event.getPosition()
    return int(position[0]), int(position[1])
