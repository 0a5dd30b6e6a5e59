# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skin's thickness as what is varied beside the radii of struts.

The thickness at a place is a mean of values at control points, whose weights fade with the
distance in space: so it is smooth, and both sides of a thin wall are alike. What is varied is the
root of each value: stiffness and stress follow it about as they follow a strut's radius (t and t3
in its plane and across it are the root to the power of 2 and 6; a strut has 2 to 4), and mass by
its square, so that one search serves both.

Shells have their middle where the skin's thickness puts it that the model was made with; a search
ends with that of its design by making the model again.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from scipy import sparse
from scipy.spatial import cKDTree

from ..mesh import remesh
from ..util.peaks import most_but_peaks
from ..util.types import Floats, Ints
from .node_radii import NodeRadii
from .shell_elements import UnitBlocks
from .skin import SkinModel
from .structure import Blocks

#: A control point has a say as far as so many times their distance.
_REACH = 2.0
#: So many of the control points are beside a strut.
_BESIDE = 3
#: Shells with this part of the largest share in a value are to hold the stress with it.
_OWN = 0.7
#: However thick a skin is, its inner side keeps this part of the outer one's area.
_INNERMOST = 0.1


def control_points(places: Floats, apart: float) -> Floats:
    """(p, 3) of places (n, 3), so that none is farther than `apart` from one, mm."""
    tree, free = cKDTree(places), np.ones(len(places), bool)
    found = []
    # From one end to the other, so that points lie side by side and not at random.
    for row in np.lexsort(np.round(places / apart).T).tolist():
        if free[row]:
            found.append(row)
            free[tree.query_ball_point(places[row], apart)] = False
    return np.asarray(places[found])


def shares_of(points: Floats, places: Floats, apart: float) -> sparse.csr_matrix:
    """(n, p) weights of control points (p, 3) at places (n, 3); each row sums to 1."""
    near = cKDTree(places).sparse_distance_matrix(
        cKDTree(points), _REACH * apart, output_type="coo_matrix"
    )
    weight = (1.0 - (near.data / (_REACH * apart)) ** 2) ** 2
    result = sparse.csr_matrix((weight, (near.row, near.col)), (len(places), len(points)))
    total = np.asarray(result.sum(axis=1)).ravel()
    return sparse.csr_matrix(sparse.diags(1.0 / total) @ result)


@dataclass(frozen=True, eq=False)
class SkinThickness:
    """A skin whose shells are varied; variables (n + p) are n radii and p roots of thicknesses.

    Attributes:
        skin: the shells, with the thickness that the model was made with.
        first: the row of the skin's first node among the structure's.
        radii: n, how many of the variables are radii.
        points: (p, 3) the control points, mm.
        shares: (t, p) of their values in the thickness of the shells.
        measured: mm3, the skin's volume in the part that the model was made of; None for that of
            its shells.
    """

    skin: SkinModel
    first: int
    radii: int
    points: Floats
    shares: sparse.csr_matrix
    measured: float | None = None

    @cached_property
    def units(self) -> UnitBlocks:
        """The shells' blocks for a thickness of 1 mm, between the structure's nodes."""
        return self.skin.unit_blocks()

    @cached_property
    def most(self) -> Floats:
        """(t,) mm, half of what there is room for: each side has its half of what is solid."""
        return np.asarray(0.5 * self.skin.thickness_below[self.skin.shells.triangles].mean(axis=1))

    @cached_property
    def areas(self) -> Floats:
        """(p,) mm2, what of the shells' area is each control point's."""
        return np.asarray(self.shares.T @ self.skin.shells.area)

    def wanted(self, variables: Floats) -> Floats:
        """(p,) mm, the values at the control points."""
        return np.asarray(variables[self.radii :] ** 2)

    def of_shells(self, variables: Floats) -> Floats:
        """(t,) mm."""
        return np.asarray(np.minimum(self.shares @ self.wanted(variables), self.most))

    def to_variables(self, variables: Floats, changes: Floats) -> Floats:
        """(n + p, k) derivatives, of (t, k) to the thickness of the shells."""
        free = (self.shares @ self.wanted(variables) < self.most)[:, None]
        result = np.zeros((len(variables), changes.shape[1]))
        roots = variables[self.radii :, None]
        result[self.radii :] = 2.0 * roots * (self.shares.T @ np.where(free, changes, 0.0))
        return result

    def blocks(self, variables: Floats) -> Blocks:
        """Stiffness and mass of the skin, and of what is solid between its sides."""
        units, rest = self.units, self.skin.between
        thick = np.repeat(self.of_shells(variables), 9)[:, None, None]
        return Blocks(
            np.concatenate([units.rows, rest.rows]) + self.first,
            np.concatenate([units.columns, rest.columns]) + self.first,
            np.concatenate([thick * units.flat + thick**3 * units.bent, rest.stiffness]),
            np.concatenate([thick * units.heavy + thick**3 * units.turning, rest.mass]),
        )

    def volume(self, variables: Floats) -> float:
        """mm3: of each shell what lies below its outside, which narrows where faces meet."""
        thick = self.of_shells(variables)
        outer, narrows = self._outside
        straight = self._narrowest(thick)
        volume = straight - narrows * straight**2 + _INNERMOST * (thick - straight)
        return self._over_shells * float(outer @ volume)

    def volume_change(self, variables: Floats) -> Floats:
        """(n + p,) its derivative."""
        thick = self.of_shells(variables)
        outer, narrows = self._outside
        inner = np.maximum(1.0 - 2.0 * narrows * thick, _INNERMOST)
        change = self.to_variables(variables, (outer * inner)[:, None])[:, 0]
        return np.asarray(self._over_shells * change)

    @cached_property
    def _outside(self) -> tuple[Floats, Floats]:
        """(t,) the area of shells' outside, mm2, and (t,) by how much less it is half a mm deeper.

        That is known where the model has its middle, and is a mean over control points: next to an
        edge a triangle's own inner side may have turned over.
        """
        triangles, thick = self.skin.shells.triangles, self.skin.shells.thickness
        outside = self.skin.outside.vertices
        middle = 0.5 * (outside + self.skin.inside)
        normal, within = (remesh.normals(places[triangles]) for places in (outside, middle))
        outer = np.linalg.norm(normal, axis=1)
        within = np.einsum("ti,ti->t", normal, within) / np.maximum(outer, 1e-300)
        whole = np.maximum(self.shares.T @ (outer * thick), 1e-300)
        return 0.5 * outer, self.shares @ ((self.shares.T @ (outer - within)) / whole)

    def _narrowest(self, thick: Floats) -> Floats:
        """(t,) mm, of thicknesses (t,) what narrows."""
        narrows = self._outside[1]
        return np.where(
            2.0 * narrows * thick > 1.0 - _INNERMOST,
            0.5 * (1.0 - _INNERMOST) / np.maximum(narrows, 1e-300),
            thick,
        )

    @cached_property
    def _over_shells(self) -> float:
        """The volume that was measured over that of the shells that the model was made with."""
        if self.measured is None:
            return 1.0
        outer, narrows = self._outside
        thick = self.skin.shells.thickness
        return self.measured / float(outer @ (thick - narrows * thick**2))

    def stresses(self, variables: Floats, displacements: Floats) -> Floats:
        """(t, k) the larger von Mises stress of both sides, MPa, of (nodes, 6, k)."""
        return self.skin.stresses(displacements[self.first :], self.of_shells(variables))

    def work(self, variables: Floats, one: Floats, other: Floats) -> Floats:
        """(t, k) N: one dK other to the thickness of each shell, of displacements (nodes, 6, k)."""
        thick, units = self.of_shells(variables)[:, None], self.units
        flat = self._energies(units.flat, one, other)
        return flat + 3.0 * thick**2 * self._energies(units.bent, one, other)

    def mass_work(self, variables: Floats, one: Floats, other: Floats) -> Floats:
        """(t, 1) one dM other, of motions (nodes, 6)."""
        thick, units = self.of_shells(variables)[:, None], self.units
        one, other = one[:, :, None], other[:, :, None]
        heavy = self._energies(units.heavy, one, other)
        return heavy + 3.0 * thick**2 * self._energies(units.turning, one, other)

    def _energies(self, blocks: Floats, one: Floats, other: Floats) -> Floats:
        rows, columns = self.units.rows + self.first, self.units.columns + self.first
        work = np.einsum("cik,cij,cjk->ck", one[rows], blocks, other[columns], optimize=True)
        return np.asarray(work.reshape(-1, 9, work.shape[1]).sum(axis=1))

    def largest(self, stress: Floats) -> Floats:
        """(t,) the largest of (t, k) in each shell, peaks cut off."""
        return np.asarray(np.minimum(stress.max(axis=1), self.peak(stress)))

    def peak(self, stress: Floats) -> float:
        """The stress (t, k) of the worst case, on all but a little of the skin's area."""
        return max(most_but_peaks(row, self.skin.shells.area) for row in stress.T)

    def nearest(self, places: Floats) -> Ints:
        """(k, c) the control points nearest to places (k, 3)."""
        count = min(_BESIDE, len(self.points))
        found = cKDTree(self.points).query(places, k=list(range(1, count + 1)))[1]
        return np.asarray(found).reshape(-1, count)

    def largest_near(self, values: Floats) -> Floats:
        """(p,) the largest of (t,) among the shells that are a control point's own."""
        entries = self.shares.tocoo()
        most = self.shares.max(axis=1).toarray().ravel()
        part = entries.data >= _OWN * most[entries.row]
        result = np.zeros(self.shares.shape[1])
        np.maximum.at(result, entries.col[part], values[entries.row[part]])
        return result


@dataclass(frozen=True, eq=False)
class RadiiAndSkin(NodeRadii):
    """Radii of struts and thickness of the skin as one set of variables.

    `ends` has a column without entries for each value of the skin.

    Attributes:
        skin: what of the variables is the skin's.
    """

    skin: SkinThickness = field(kw_only=True)

    def volume(self, radii: Floats) -> float:
        """mm3, of struts and skin."""
        return super().volume(radii[: self.skin.radii]) + self.skin.volume(radii)

    def volume_change(self, radii: Floats) -> Floats:
        """(n + p,) its derivative to each variable."""
        change = self.skin.volume_change(radii)
        change[: self.skin.radii] += super().volume_change(radii[: self.skin.radii])
        return change


def with_skin(shape: NodeRadii, skin: SkinThickness) -> RadiiAndSkin:
    """Radii with the values of a skin behind them."""
    rows, columns = shape.ends.shape
    ends = shape.ends.tocsr().copy()
    ends.resize(rows, columns + len(skin.points))
    return RadiiAndSkin(ends, shape.filled, shape.comes_out, skin=skin)
