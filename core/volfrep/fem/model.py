# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a solver is told beside the mesh: the material, what is held, what pulls."""

from __future__ import annotations

from dataclasses import dataclass

from ..util.errors import VolfrepError
from ..util.types import Floats, Ints


@dataclass(frozen=True)
class Material:
    """A linear elastic material; the default is PETG.

    Attributes:
        name: as it appears in the deck; at most 80 letters, digits, ``-`` and ``_``.
        young: Young's modulus, MPa.
        poisson: Poisson's ratio.
        density: g/cm3.
    """

    name: str = "PETG"
    young: float = 2100.0
    poisson: float = 0.38
    density: float = 1.27

    def __post_init__(self) -> None:
        if not (self.young > 0 and -1 < self.poisson < 0.5 and self.density > 0):
            raise VolfrepError(
                f"The material '{self.name}' must have a modulus and a density above 0 and a "
                "Poisson's ratio between -1 and 0.5."
            )


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
