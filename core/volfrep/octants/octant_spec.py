# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the mesh of an octant depends on: sizes, steps, and how far struts show.

Facets have a coarsest size: with fewer than six round a strut its vertices cannot be placed such
that the volume is right.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from ..design.cells import joint_radius

#: The sampling step is at most this, in units of r: no strut slips between the samples.
COARSEST_STEP = 0.75
#: Primitives are kept near a vertex up to this distance beyond the nearest, in wanted edges:
#: vertices move by one edge, and a facet reaches another one further, in both distances.
NEAR_EDGES = 3.0
#: An octant's mesh does not depend on struts farther from it than this, in wanted edges.
INFLUENCE_EDGES = 2.0


@dataclass(frozen=True)
class OctantSpec:
    """What the mesh of an octant depends on, and nothing else.

    Attributes:
        cell_size: L, mm.
        strut_radius: r, mm.
        fillet: joint fillet, mm.
        facets: facet edges along L.
        samples: by how many times samples are nearer to each other than facets need.
        within: facet edges along L that would stray as far as facets may, where fewer of smaller
            ones do with that; 0: `facets`.

    >>> spec = OctantSpec(cell_size=10.0, strut_radius=1.0, fillet=0.0, facets=20)
    >>> spec.edge, spec.steps, spec.step
    (0.5, 10, 0.5)
    """

    cell_size: float
    strut_radius: float
    fillet: float
    facets: int
    samples: int = 1
    within: int = 0

    @property
    def edge(self) -> float:
        """Wanted edge length, mm."""
        return self.cell_size / self.facets

    @property
    def deviation(self) -> float:
        """How far facets may stray from a strut to either side, mm: as far as they do `within`."""
        edge = self.cell_size / (self.within or self.facets)
        return edge**2 / (16.0 * self.strut_radius)

    @property
    def influence(self) -> float:
        """Struts whose axes are farther than this from an octant do not show in it, mm."""
        joint = joint_radius(self.strut_radius, self.cell_size)
        return float(joint + INFLUENCE_EDGES * max(self.edge, self.step) + 2.0 * self.fillet)

    @property
    def reach(self) -> float:
        """Struts whose surfaces are farther than this from a vertex do not matter to it, mm."""
        return NEAR_EDGES * self.edge + 2.0 * self.fillet

    @property
    def step(self) -> float:
        """Between the samples, mm."""
        return 0.5 * self.cell_size / self.steps

    @property
    def steps(self) -> int:
        """Sampling steps along an octant."""
        finest = self.cell_size / (COARSEST_STEP * self.strut_radius)
        return self.samples * math.ceil(0.5 * max(self.facets, finest))
