# SPDX-License-Identifier: LGPL-2.1-or-later
"""Previews that are made beside the window: of the values of now, in the 3D view."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

from freecad_volfrep import preferences
from freecad_volfrep.features.infill.live_preview import LivePreview
from freecad_volfrep.gui.draw.drawn_preview import draw_solid, draw_struts
from freecad_volfrep.gui.latest import Latest
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    import FreeCAD as App

    from freecad_volfrep.features.infill.live_preview import Answer, Asked, Shown
    from freecad_volfrep.gui.draw.drawn_preview import DrawnSolid
    from freecad_volfrep.gui.qt import QtCore
    from volfrep.design.spec import LatticeSpec
    from volfrep.mesh.display_parts import Pieces
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.util.progress import Monitor

    from .preview_view import PreviewView

    #: An answer, and what its struts and its solid are drawn with.
    _Made = tuple[Answer, Pieces | None, DrawnSolid]


@dataclass(frozen=True, eq=False)
class ReadyPreview:
    """A preview, and what it is drawn with.

    Attributes:
        shown: the preview.
        struts, solid: as of `PreviewView.show`.
    """

    shown: Shown
    struts: Pieces | None
    solid: DrawnSolid

    def show_in(self, view: PreviewView, with_grid: bool = False) -> None:
        """Draw it."""
        view.show(self.shown, self.struts, self.solid, with_grid)


class PreviewThread:
    """Previews of one infill, the last that was asked for only.

    Args:
        obj: the infill.
        parent: with which it ends; None: with `drop`.
    """

    def __init__(self, obj: App.DocumentObject, parent: QtCore.QObject | None = None) -> None:
        self._live, self._latest = LivePreview(obj), Latest(parent)
        self._solid: tuple[TriangleMesh, DrawnSolid] | None = None

    def ask(
        self,
        show: Callable[[ReadyPreview], None],
        refuse: Callable[[VolfrepError], None],
        spec: LatticeSpec | None = None,
    ) -> None:
        """Have one made of the present properties, or of another specification.

        Args:
            show: is given it, later.
            refuse: is given why there is none, now or later.
            spec: in place of the properties.
        """
        self._latest.drop()
        try:
            asked = self._live.ask(spec)
        except VolfrepError as error:
            refuse(error)
            return
        most = preferences.read(preferences.MOST_PRISMS)
        self._latest.ask(
            partial(self._make, asked, most), partial(self._hand_on, asked, show, refuse)
        )

    def drop(self) -> None:
        """Show none that is on its way."""
        self._latest.drop()

    def _make(self, asked: Asked, most_prisms: int, monitor: Monitor) -> _Made:
        """On the thread."""
        answer = self._live.answer(asked, monitor)
        monitor.tick()
        struts = draw_struts(answer.preview, most_prisms)
        if self._solid is None or self._solid[0] is not answer.solid:
            self._solid = answer.solid, draw_solid(answer.solid)
        return answer, struts, self._solid[1]

    def _hand_on(
        self,
        asked: Asked,
        show: Callable[[ReadyPreview], None],
        refuse: Callable[[VolfrepError], None],
        made: _Made | None,
        error: BaseException | None,
    ) -> None:
        try:
            if error is not None:
                raise error
            assert made is not None
            answer, struts, solid = made
            ready = ReadyPreview(self._live.shown(asked, answer), struts, solid)
        except VolfrepError as why:
            refuse(why)
        else:
            show(ready)
