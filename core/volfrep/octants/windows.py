# SPDX-License-Identifier: LGPL-2.1-or-later
"""Windows between struts that are narrower than the samples of marching cubes, seen or not.

Three struts in a triangle leave a hole whose radius is little where they are thick. Samples that
are farther apart close it, and then no facet is made small enough to come near the surface there.
"""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

import numpy as np

from ..design.cells import UnitCell
from ..mesh.topology import edge_keys
from ..util.types import Floats
from .octant import ALL_ACTIVE, OctantKey, octant_primitives, raw_octant, sample_octant
from .octant_spec import OctantSpec

#: So many times finer samples are tried in turn, each held against those of twice as many.
FINER = (1, 2, 3)
#: No more than so many samples along an octant are looked at: they see all but hairs.
MOST_STEPS = 64


@lru_cache(maxsize=64)
def sampled_finely_enough(cell: UnitCell, spec: OctantSpec) -> OctantSpec:
    """What octants are meshed for, with samples that see the windows between a cell's struts.

    The surface of an endless lattice has the Euler characteristic there that it has by twice as
    many samples, or would have with struts thicker or thinner by a deviation. Which octants are
    wanted plays no part, so that all of a lattice are sampled alike.

    Args:
        cell: the unit cell.
        spec: what the octants are meshed for.

    Returns:
        The same where its samples do, or where none of `FINER` do: the struts then touch each
        other nearly, and no samples would see between them.
    """
    for times in FINER:
        tried = replace(spec, samples=times * spec.samples)
        if 2 * tried.steps > MOST_STEPS:
            break
        if _sees_windows(cell, tried):
            return tried
    return spec


def _sees_windows(cell: UnitCell, spec: OctantSpec) -> bool:
    for mirror in range(1 if cell.is_mirror_symmetric else 8):
        key = OctantKey(mirror, ALL_ACTIVE)
        own = octant_primitives(cell, key, spec.cell_size, spec.strut_radius, spec.reach)
        coarse, fine = (
            sample_octant(own, spec.cell_size, steps, spec.fillet)
            for steps in (spec.steps, 2 * spec.steps)
        )
        levels = (0.0, spec.deviation, -spec.deviation)
        wanted = _euler_characteristic(coarse, spec)
        if all(_euler_characteristic(fine + level, spec) != wanted for level in levels):
            return False
    return True


def _euler_characteristic(samples: Floats, spec: OctantSpec) -> int:
    """Of the surface in an octant, open at its faces: vertices less edges and facets."""
    raw = raw_octant(samples, spec.cell_size)
    t = raw.triangles.astype(np.int64)
    start, end = t.ravel(), np.roll(t, -1, axis=1).ravel()
    edges = np.unique(edge_keys(start, end, len(raw.vertices)))
    return len(raw.vertices) - len(edges) + len(t)
