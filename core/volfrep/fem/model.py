# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a solver is told beside the mesh: what is held, what pulls."""

from __future__ import annotations

from dataclasses import dataclass

from ..util.types import Floats, Ints


@dataclass(frozen=True, eq=False)
class StaticStep:
    """One linear static step: some nodes held, a force shared by others.

    Attributes:
        fixed: rows of the nodes that neither move nor turn.
        loaded: rows of the nodes that carry the force.
        force: (3,) the whole force, N.
        shares: (loaded,) what part of it each loaded node carries; None for equal parts.
    """

    fixed: Ints
    loaded: Ints
    force: tuple[float, float, float]
    shares: Floats | None = None
