# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a network is to be: given nodes and struts, or the edges between random points."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...util.content import content_of, freeze
from ...util.errors import VolfrepError
from ...util.numbers import number, number_rows, strut_rows
from ..expression import SAMPLES, Expression, compile_expression
from ..sampled_field import SampledField
from ..scattered_field import PointField

#: Random networks: edges of the points' Voronoi cells, or between points that are neighbours.
KINDS = ("voronoi", "delaunay")
MAX_POINTS = 50_000
MAX_STRUTS = 200_000


@dataclass(frozen=True)
class GivenGraph:
    """Nodes and struts that a user brings; equal to any other of the same content.

    Attributes:
        nodes: (n, 3) float64, mm.
        struts: (m, 2) int64, rows of `nodes`.
        radii: (m, 2) float64, of each strut at its ends, mm; none, (0, 2), for the lattice's own.
        source: the file that it was read from; empty for none.
        thickness: of the layers on the quadrilaterals of that file, mm; 0 for none.
        layers: how many these are.
        widths: (m,) float64, what the lattice's own radius is multiplied by at each strut; none,
            (0,), for 1.
        cell: name of the cell that was laid into a mesh or along faces; empty where the struts are
            given as they are.
    """

    nodes: NDArray[np.float64] = field(compare=False)
    struts: NDArray[np.int64] = field(compare=False)
    radii: NDArray[np.float64] = field(compare=False)
    source: str = field(default="", compare=False)
    thickness: float = field(default=0.0, compare=False)
    layers: int = field(default=1, compare=False)
    widths: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0), compare=False)
    cell: str = field(default="", compare=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        arrays = {
            "nodes": np.float64,
            "struts": np.int64,
            "radii": np.float64,
            "widths": np.float64,
        }
        for name, dtype in arrays.items():
            object.__setattr__(self, name, freeze(getattr(self, name), dtype))
        content = content_of(self.nodes, self.struts, self.radii, self.widths)
        object.__setattr__(self, "_content", content)

    def as_json(self) -> str:
        """It in a few words, which files hold that are handed on: no folders."""
        words = f"{len(self.struts)} struts between {len(self.nodes)} nodes"
        return words + f" of {Path(self.source).name}" * bool(self.source)


@dataclass(frozen=True)
class StretchedCells:
    """The chosen cell side by side, where it is no cube or its struts differ (`UnitCell`).

    Octants are for cubes; such cells are meshed joint by joint, as networks are.
    """

    def as_json(self) -> str:
        """It in a few words."""
        return "cells that are no cubes, or whose struts differ"


@dataclass(frozen=True)
class RandomGraph:
    """The edges between random points in a part.

    Attributes:
        kind: ``voronoi`` (edges of the points' cells) or ``delaunay`` (from point to point).
        points: how many lie in the part; 0 for as many as lie a cell size apart.
        seed: the same gives the same points.
        relax: how often each point moves to the middle of its cell (S. P. Lloyd, IEEE Trans.
            Inf. Theory 28, 1982).
        density: of the points, a formula of s, which is 0 at the wall and 1 at the deepest place,
            or at the field's smallest and largest value; empty for an even one.
        shortest: struts shorter than this are drawn together into one node, mm; 0 for four radii.
        least_angle: of two struts at a node the longer one goes where they meet at less, degrees.
        field: that the density of the points follows in place of the depth; None for the depth.
        on_wall: struts run along the wall, too, where it cuts the faces of Voronoi cells.
    """

    kind: str = "voronoi"
    points: int = 0
    seed: int = 1
    relax: int = 2
    density: str = ""
    shortest: float = 0.0
    least_angle: float = 25.0
    field: PointField | SampledField | None = None
    on_wall: bool = False

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise VolfrepError(
                f"There is no network '{self.kind}': choose one of {', '.join(KINDS)}."
            )
        for name, most in (("points", MAX_POINTS), ("seed", 2**31), ("relax", 50)):
            value = getattr(self, name)
            if value != int(value) or not 0 <= value <= most:
                raise VolfrepError(
                    f"A network's {name} must be a whole number from 0 to {most}, not {value}."
                )
            object.__setattr__(self, name, int(value))
        number("shortest strut", self.shortest, "mm", positive=False)
        number("least angle", self.least_angle, "degrees", positive=False)
        if self.field is not None and not self.density.strip():
            raise VolfrepError(
                "The points of a network follow a field by a density such as '1 + 3 * s': give it."
            )
        if self.on_wall and self.kind != "voronoi":
            raise VolfrepError("Edges on the wall are those of Voronoi cells: choose voronoi.")
        if self.least_angle > 60.0:
            raise VolfrepError(
                f"A least angle of {self.least_angle:g} degrees would leave hardly a strut: keep "
                "it at 60 or below."
            )
        if self.density.strip():
            values = self.formula(SAMPLES)
            if not (np.isfinite(values).all() and values.min() >= 0.0 and values.max() > 0.0):
                raise VolfrepError(
                    f"The density of points '{self.density}' must be a number from 0 up for every "
                    "s from 0 to 1, and above 0 somewhere."
                )

    @property
    def formula(self) -> Expression:
        """The density of the points over s."""
        return compile_expression(self.density.strip() or "1")

    def as_json(self) -> dict[str, Any]:
        """It as plain JSON values."""
        values = {name: getattr(self, name) for name in self.__dataclass_fields__}
        values["field"] = None if self.field is None else Path(self.field.source).name or "points"
        return values


def make_network(
    nodes: object,
    struts: object,
    radii: object = (),
    where: str = "network",
    source: str = "",
    widths: object = (),
) -> GivenGraph:
    """A validated network from lists or arrays; `where` names the source in error messages.

    Struts that are there twice are taken once, nodes without struts are left out.

    Args:
        nodes: (n, 3) mm.
        struts: (m, 2) numbers of nodes from 0.
        radii: (m,) or (m, 2), or of the nodes (n,), mm; none for the lattice's own.
        where: what it is called in errors.
        source: the file that it is from.
        widths: (m,), what the lattice's own radius is multiplied by; none for 1.

    Raises:
        VolfrepError: naming the first node or strut that is wrong.

    >>> bent = make_network([[0, 0, 0], [9, 0, 0], [0, 9, 0]], [(0, 1), (0, 2)])
    >>> bent.nodes.shape, bent.struts.shape
    ((3, 3), (2, 2))
    """
    points, pairs = number_rows(nodes, 3, "node", where), number_rows(struts, 2, "strut", where)
    if len(pairs) > MAX_STRUTS:
        raise VolfrepError(f"The {where} has {len(pairs):,} struts: the limit is {MAX_STRUTS:,}.")
    index = strut_rows(pairs, len(points), where)
    thick = np.asarray(radii, float)
    if thick.size:
        if thick.shape == (len(points),) and len(points) != len(index):
            thick = thick[index]
        elif thick.shape == (len(index),):
            thick = np.repeat(thick[:, None], 2, axis=1)
        if thick.shape != (len(index), 2):
            raise VolfrepError(
                f"In the {where}, radii must be one for each strut, one for each of its ends, or "
                "one for each node."
            )
        bad = np.flatnonzero(~((thick > 0.0) & np.isfinite(thick)).all(axis=1))
        if len(bad):
            raise VolfrepError(f"In the {where}, strut {bad[0]} has a radius that is not above 0.")
    else:
        thick = np.zeros((0, 2))
    length = np.linalg.norm(points[index[:, 1]] - points[index[:, 0]], axis=1)
    bad = np.flatnonzero(length < 1e-6)
    if len(bad):
        raise VolfrepError(
            f"In the {where}, strut {bad[0]} joins node {index[bad[0], 0]} to itself or to one "
            "that lies at the same place."
        )
    flip = index[:, 0] > index[:, 1]
    index[flip] = index[flip][:, ::-1]
    if len(thick):
        thick[flip] = thick[flip][:, ::-1]
    _, first = np.unique(index, axis=0, return_index=True)
    first.sort()
    used, rows = np.unique(index[first], return_inverse=True)
    wide = np.asarray(widths, float)
    return GivenGraph(
        points[used], rows.reshape(-1, 2), thick[first] if len(thick) else thick, source,
        widths=wide[first] if len(wide) else wide,
    )  # fmt: skip


def is_random(network: object) -> bool:
    """Whether a value of the keyword ``network`` stands for random points."""
    return isinstance(network, RandomGraph) or (isinstance(network, str) and network in KINDS)


def with_density_by(network: object, density: PointField | SampledField) -> dict[str, Any]:
    """The keywords by which random points, as of `is_random`, follow a density."""
    if isinstance(network, RandomGraph):
        return {"network": replace(network, density=straight(*density.range), field=density)}
    return {"network_density": density}


def straight(low: float, high: float) -> str:
    """The formula of s that goes from one value to another."""
    return f"{low!r} + {high - low!r} * s"
