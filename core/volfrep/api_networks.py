# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script's author needs of graphs: `mesh_network` meshes the nodes and struts of any."""

from __future__ import annotations

import os
from typing import Any

from .api import Part, specified
from .design.cells import find_cell
from .design.networks import make_network, read_network
from .design.spec import LatticeSpec
from .jobs.networks.alone import network_alone
from .util.cache import StageCache
from .util.progress import ProgressCallback


def mesh_network(
    graph: str | os.PathLike[str] | tuple[Any, ...],
    spec: LatticeSpec | None = None,
    *,
    progress: ProgressCallback | None = None,
    **parameters: Any,
) -> Part:
    """The nodes and struts of any graph, meshed as they are in free space.

    To fill a part with it, give ``network=volfrep.design.networks.make_network(...)``, or a
    ``RandomNetwork``, to `volfrep.fill`.

    Args:
        graph: a file (see `volfrep.design.networks.read_network`), or arrays: nodes (n, 3) in
            mm, struts (m, 2), and, if they differ, radii (m,), (m, 2) or (n,) in mm.
        spec: what to make.
        progress: as of `volfrep.fill`.
        parameters: as of `volfrep.fill`.

    Raises:
        VolfrepError: the graph or the specification makes no sense.
        Cancelled: the callback said so.

    >>> import volfrep
    >>> made = volfrep.mesh_network(([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2), (1, 2)]))
    >>> made.report.genus, made.report.bodies
    (1, 1)
    """
    if isinstance(graph, tuple):
        found = make_network(*graph)
    else:
        cell = parameters.get("cell", None if spec is None else spec.cell)
        found = read_network(graph, find_cell(cell) if isinstance(cell, str) else cell)
    wanted = specified(spec, {**parameters, "network": found}, None)
    return Part(network_alone(wanted, progress=progress), wanted, None, StageCache())
