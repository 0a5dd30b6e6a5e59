# SPDX-License-Identifier: LGPL-2.1-or-later
"""What no load changes is made in the engine's process while the user picks loads."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from threading import Lock, Thread
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.engines import engines
from freecad_volfrep.features.sizing.as_built import spec_to_size
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from volfrep.design.spec import LatticeSpec
    from volfrep.jobs.sizing import Goal
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.process.engines import Running

#: What is loaded before it is asked for, here and there.
SIZING = "volfrep.jobs.sizing"


class Ahead:
    """The preparation of a sizing, which waits for it; nobody is told of what goes wrong in it.

    The sizing meets that again, and tells it. Values that change meanwhile cost the time it took.
    """

    def __init__(self) -> None:
        self._engines = engines()
        self._changing = Lock()
        self._is_over = False
        self._running: Running = self._engines.warm(SIZING)
        self._made_of: tuple[TriangleMesh, str] | None = None

    def begin(self, obj: App.DocumentObject, goal: Callable[[], Goal], for_print: bool) -> None:
        """Make what an infill needs as it is now."""
        try:
            spec, mesh = obj.Proxy.read(obj)
        except VolfrepError:
            return
        spec = spec_to_size(obj, spec, for_print)
        # To check a solid takes up to a second.
        asked = obj.Proxy, mesh, obj.Base.Label, spec, goal
        Thread(target=self._begin, args=asked, name="volfrep-ahead", daemon=True).start()

    def _begin(
        self, proxy: Any, mesh: TriangleMesh, name: str, spec: LatticeSpec, goal: Callable[[], Goal]
    ) -> None:
        import_module(SIZING)
        from volfrep.jobs.sizing import prepare
        from volfrep.process.worker import Call

        try:
            solid = proxy.checked(mesh, name)
        except VolfrepError:
            return
        with self._changing:
            if self._is_over:
                return
            call = Call(prepare, (solid, spec, goal()), {"cache": proxy.cache}, after=self._running)
            self._made_of, self._running = (solid, spec.digest()), self._engines.begin(call)

    def take(self, solid: TriangleMesh, spec: LatticeSpec) -> Running | None:
        """What is on its way for a solid and a specification; what is for others is ended."""
        with self._changing:
            self._is_over = True
        if self._made_of is None or self._made_of == (solid, spec.digest()):
            return self._running
        self._running.cancel()
        return None

    def cancel(self) -> None:
        """It is not wanted any more: the panel is closed."""
        with self._changing:
            self._is_over = True
        if self._made_of is not None:
            self._running.cancel()
