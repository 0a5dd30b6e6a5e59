# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a preview is, and how deep points lie in a part: what previews of all lattices share."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass

import numpy as np

from ..design.openings import OpenFace
from ..design.skins.kept_bodies import KeptBody
from ..design.skins.own_faces import FaceSkin, KeptFace
from ..design.spec import LatticeSpec
from ..design.spec_parts import Skin
from ..grid.cell_grid import CellGrid
from ..mesh.quality import inspect
from ..mesh.triangle_mesh import TriangleMesh
from ..shell.domain import find_domain
from ..spatial.proximity import SurfaceIndex, closest_points, index_surface
from ..spatial.rays import inside_points, points_within
from ..util.progress import Monitor
from ..util.types import Bools, Floats

#: The surface is sampled this often along the diagonal of the part's box.
SAMPLES_ALONG = 150.0
#: Points by which the volume within a skin is measured (a power of 2).
VOLUME_POINTS = 14
#: Depths of so many sets of points are kept: a preview asks for four.
KEPT = 4


@dataclass(frozen=True, eq=False)
class Preview:
    """What of the struts lies inside, and what the lattice will come to.

    Attributes:
        start: (k, 3) float64, where the pieces begin, mm.
        end: (k, 3) where they end.
        radii: (k, 2) at both.
        cells: active unit cells, nearly.
        struts: with a piece inside.
        grid: the cells' grid, in lattice space.
        relative_density: of the lattice in what it fills.
        volume: of the part, mm3.
        mass: in g.
        grid_lines: (l, 3) starts and ends of the edges of the active cells, mm.
        spec: what is shown, with the radius that was found where there is a target.
        surface: of walls, their surface as coarse as it is quick, in place of struts.
    """

    start: Floats
    end: Floats
    radii: Floats
    cells: int
    struts: int
    grid: CellGrid
    relative_density: float
    volume: float
    mass: float
    grid_lines: tuple[Floats, Floats]
    spec: LatticeSpec
    surface: TriangleMesh | None = None


class PartDepth:
    """How deep points lie in a part; made once, asked at every change of the lattice.

    Args:
        solid: checked closed mesh, mm.
        open_faces: faces that have no skin, as `LatticeSpec` has them.
        face_skins: faces with a skin thickness of their own.
        keep_solid: what the part stays solid round, and in.
        monitor: asked whether to go on.

    Attributes:
        bodies: how many the part has.
        monitor: the one that is asked now; each preview may have one of its own.

    Raises:
        VolfrepError: a face is not found, or all of them are open.
    """

    def __init__(
        self,
        solid: TriangleMesh,
        open_faces: tuple[OpenFace, ...] = (),
        face_skins: tuple[FaceSkin, ...] = (),
        keep_solid: tuple[KeptFace | KeptBody, ...] = (),
        monitor: Monitor | None = None,
    ) -> None:
        self._solid, self.monitor = solid, monitor or Monitor()
        diagonal = float(np.linalg.norm(np.ptp(solid.bounds, axis=0)))
        self._surface = index_surface(solid, diagonal / SAMPLES_ALONG)
        # A skin without a thickness yet: that is asked for later.
        skin = Skin(1.0, open_faces, face_skins, keep_solid)
        lengths = skin.thicknesses(solid)
        self._is_even = skin.is_even and not open_faces
        self._usual = self._without(~lengths.usual)
        self._others = tuple((self._without(~faces), length) for faces, length in lengths.others)
        self._kept = skin.bodies
        self.bodies = max(1, inspect(solid).quality.bodies)
        self._points = points_within(solid, VOLUME_POINTS)
        self._sampled = self._below_usual(self._points)
        self._sampled[self._below_others(self._points) <= 0.0] = -1.0
        self._domain: tuple[Skin | None, TriangleMesh] | None = None
        self._known: dict[tuple[bytes, float], Floats] = {}

    def domain(self, skin: Skin | None) -> TriangleMesh:
        """What lies below a skin, as the part's own stages find it; the last one is kept."""
        if self._domain is None or self._domain[0] != skin:
            self._domain = skin, find_domain(self._solid, skin, self.monitor).mesh
        return self._domain[1]

    def below_skin(self, points: Floats, shell: float) -> Floats:
        """(n,) how far below a skin (n, 3) points lie, mm; negative in the skin and outside.

        The last `KEPT` answers are kept: another radius asks about the same points.
        """
        key = hashlib.blake2b(points.tobytes()).digest(), shell
        if key not in self._known:
            if len(self._known) == KEPT:
                del self._known[next(iter(self._known))]
            self._known[key] = self._found_below(points, shell)
        return self._known[key].copy()

    def signed_below_skin(self, points: Floats, shell: float) -> Floats:
        """(n,) as `below_skin`, but that it falls all the way outwards, so that it can be drawn."""
        if not self._is_even:
            return self.below_skin(points, shell)
        return self.below_skin(points, 0.0) - shell

    def _found_below(self, points: Floats, shell: float) -> Floats:
        self.monitor.tick()
        depth = self._surface.near(points)[1]
        self.monitor.tick()
        # On which side a point lies does not matter where it is nearer than the skin is thick.
        far = np.flatnonzero(depth > (shell if self._is_even else 0.0))
        outside = far[~inside_points(self._solid, points[far], self.monitor)]
        depth[outside] *= -1.0
        if self._is_even:
            return depth - shell
        below = np.minimum(self._below_usual(points) - shell, self._below_others(points))
        return np.minimum(below, depth)

    def volume_below(self, shell: float) -> float:
        """Volume of what lies below a skin, mm3, within a few percent; never nothing."""
        count = max(0.5, float((self._sampled > shell).sum()))
        return abs(self._solid.volume) * count / len(self._sampled)

    def points_below(self, shell: float) -> Floats:
        """(n, 3) points spread evenly over what lies below a skin."""
        return np.asarray(self._points[self._sampled > shell])

    def _without(self, gone: Bools) -> SurfaceIndex | None:
        """The surface less some triangles; None where nothing is left."""
        if gone.all():
            return None
        return self._surface.without(gone) if gone.any() else self._surface

    def _below_usual(self, points: Floats) -> Floats:
        """(n,) distances to the faces whose skin has no thickness of its own, mm."""
        if self._usual is None:
            return np.full(len(points), np.inf)
        return self._usual.near(points)[1]

    def _below_others(self, points: Floats) -> Floats:
        """(n,) how far beyond the skin of the other faces points lie, and off kept bodies, mm."""
        result = np.full(len(points), np.inf)
        for index, length in self._others:
            if index is not None:
                result = np.minimum(result, index.near(points)[1] - length)
        for body in self._kept:
            distance = closest_points(body, points)[1]
            sign = np.where(inside_points(body, points, self.monitor), -1.0, 1.0)
            result = np.minimum(result, sign * distance)
        return result
