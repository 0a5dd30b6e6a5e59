# SPDX-License-Identifier: LGPL-2.1-or-later
"""What many tests begin with is computed once: wall and depths of a solid, octants of a cell.

Half of what filling a small part costs. A test that changes the engine (`monkeypatch`) computes
them itself, and so does a run whose progress is followed; what work they were is counted as ever.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any

from volfrep.jobs.kinds import strut_block, strut_lattice
from volfrep.jobs.part_depth import PartDepth
from volfrep.octants.octant_mesh import mesh_octants
from volfrep.shell import domain
from volfrep.util import threads
from volfrep.util.content import content_of
from volfrep.util.progress import Monitor

#: Whether they are shared just now.
ON = [True]
#: As many results of each are kept.
KEPT = 200


def _wall(solid: Any, thickness: float, monitor: Monitor, *more: Any) -> Hashable | None:
    is_open, uneven = (*more, None, None)[:2]
    if uneven is not None:
        return None
    arrays = [solid.vertices, solid.triangles, *([] if is_open is None else [is_open])]
    return content_of(*arrays), float(thickness)


def _octants(cell: Any, spec: Any, keys: Any, monitor: Monitor) -> Hashable:
    return cell, spec, tuple(keys)


def _shared(
    function: Callable[..., Any], key_of: Callable[..., Hashable | None]
) -> Callable[..., Any]:
    kept: dict[Hashable, tuple[Any, dict[str, int]]] = {}

    def once(*given: Any) -> Any:
        (monitor,) = (one for one in given if isinstance(one, Monitor))
        key = key_of(*given) if ON[0] and monitor._callback is None else None
        if key is None:
            return function(*given)
        key = key, threads._wanted
        if key not in kept:
            if len(kept) == KEPT:
                del kept[next(iter(kept))]
            before = dict(monitor.work)
            found = function(*given)
            work = {name: n - before.get(name, 0) for name, n in monitor.work.items()}
            kept[key] = found, work
        else:
            found, work = kept[key]
            for name, amount in work.items():
                if amount:
                    monitor.count(name, amount)
        return dict(found) if isinstance(found, dict) else found

    return once


def share_depths() -> None:
    """How deep points lie in a part that was looked at before, with the last answers to others."""
    find, kept = PartDepth.__init__, {}

    def once(self: PartDepth, solid: Any, *skin: Any, **named: Any) -> None:
        if not ON[0]:
            find(self, solid, *skin, **named)
            return
        key = content_of(solid.vertices, solid.triangles), skin, tuple(sorted(named.items()))
        if key not in kept:
            if len(kept) == KEPT:
                del kept[next(iter(kept))]
            find(self, solid, *skin, **named)
            kept[key] = dict(self.__dict__)
        self.__dict__.update(kept[key])

    PartDepth.__init__ = once  # type: ignore[method-assign]


def share() -> None:
    """From now on, in this process."""
    domain.find_cavity = _shared(domain.find_cavity, _wall)
    strut_block.mesh_octants = strut_lattice.mesh_octants = _shared(mesh_octants, _octants)
    share_depths()
