# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes an infill's mesh beside what the user does, and installs it as one undo step.

A mesh of values that are the last step belongs to that: they are undone and redone together.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.infill.infill_results import loaded_in_steps
from freecad_volfrep.features.jobs.job import State
from freecad_volfrep.gui.in_steps import Stillness
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.undo import FOLLOWS
from freecad_volfrep.gui.view.proxy_mesh import ProxyMesh
from freecad_volfrep.translation import translate

from .background import begin

if TYPE_CHECKING:
    import Mesh

    from freecad_volfrep.features.infill.infill_results import MeshJob
    from volfrep.design.forecast import Forecast
    from volfrep.jobs.pipeline import FilledMesh

#: FreeCAD takes a mesh of more triangles while the user does nothing: it does so in one call, of
#: 0.2 s for each million, and the window is to answer within 0.1 s.
LARGE = 400_000
#: That is for so long; and what is waited for at most, ms.
STILL, LONGEST = 700, 10_000

#: Called once, with whether the mesh is there; or with None where nobody wants it any more,
#: because the infill or its document has gone, or it was asked for anew.
Ended = Callable[["bool | None"], None]


class Update:
    """A mesh that is being made, by the name of the infill; `begin_update` makes it.

    Attributes:
        is_in_panel: whether the infill's panel is open, and its transaction takes the mesh in.
        ended: what is done at the end.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        job: MeshJob,
        is_in_panel: bool = False,
        ended: Ended = lambda _: None,
    ) -> None:
        self._obj, self._doc, self._job = obj, obj.Document, job
        self.is_in_panel, self.ended = is_in_panel, ended
        self._proxy: ProxyMesh | None = None
        self._mesh: Mesh.Mesh = None
        self._pending = list(self._doc.UndoNames) if self._doc.HasPendingTransaction else None
        begin(
            job,
            self._arrive,
            prepare=self._take_over,
            is_wanted=self._is_wanted,
            is_time=self._is_time,
            dropped=self._drop,
        )

    def drop(self) -> None:
        """End it without a word."""
        if self._job.is_under_way:
            self._job.go(State.IDLE)

    def _drop(self) -> None:
        if self._proxy is not None:
            self._proxy.remove()
        self.ended(None)

    def is_as_wanted(self) -> bool:
        """Whether it makes the mesh of the present values."""
        return self._is_wanted() and not self._obj.Proxy.differs(self._obj, self._job)

    def _is_wanted(self) -> bool:
        try:
            return self._job.is_under_way and self._obj.Proxy.job is self._job
        except (ReferenceError, AttributeError):  # deleted, or its document closed
            return False

    def _is_time(self) -> bool:
        """FreeCAD has one transaction a document: ours would end what a panel has begun."""
        return self.is_in_panel or not self._doc.HasPendingTransaction

    def _belongs_to_the_last_step(self) -> bool:
        """Whether the last step is the one that was open when the mesh was asked for."""
        names = list(self._doc.UndoNames)
        return bool(names) and self._pending is not None and names == self._pending[: len(names)]

    def _take_over(self, come: tuple[Forecast, FilledMesh | None]) -> Iterator[None]:
        """Make FreeCAD's mesh; a large one when the user does nothing, after its proxy."""
        filled = come[1]
        if filled is None:
            return
        if len(filled.mesh.triangles) > LARGE:
            self._proxy = ProxyMesh(self._obj, filled)
            stillness = Stillness(QtWidgets.QApplication.instance())
            try:
                yield
                while not stillness.is_there(STILL, LONGEST):
                    yield
            finally:
                stillness.end()
        self._mesh = yield from loaded_in_steps(filled)
        yield

    def _arrive(
        self, come: tuple[Forecast, FilledMesh | None] | None, error: BaseException | None
    ) -> None:
        if self._proxy is not None:
            self._proxy.remove()
        step = translate("VolfrepCommands", "Mesh of {label}").format(label=self._obj.Label)
        if self._belongs_to_the_last_step():
            step += FOLLOWS
        has_step = self._mesh is not None and error is None and not self.is_in_panel
        if has_step:
            self._doc.openTransaction(step)
        try:
            with_mesh = None if come is None else (*come, self._mesh)
            is_there = self._obj.Proxy.arrive(self._obj, with_mesh, error)
        finally:
            if has_step:
                self._doc.commitTransaction()
        self.ended(is_there)


def begin_update(
    obj: App.DocumentObject, *, is_in_panel: bool = False, ended: Ended = lambda _: None
) -> Update | None:
    """Make an infill's mesh for its present values, AutoUpdate or not, and return at once.

    One that is being made for other values is not wanted any more.

    Args:
        obj: the infill.
        is_in_panel: whether its panel's transaction is to take the mesh in.
        ended: what is to be done then.

    Returns:
        None where there is nothing to make: the mesh fits the values, or these make no sense, and
        the object is invalid.
    """
    job = obj.Proxy.begin(obj)
    return None if job is None else Update(obj, job, is_in_panel, ended)


def show_mesh(obj: App.DocumentObject) -> None:
    """Show an infill in place of its solid, and select it unless something else is."""
    obj.Visibility = True
    if obj.Base is not None:
        obj.Base.Visibility = False
    if not Gui.Selection.getSelection():
        Gui.Selection.addSelection(obj)
