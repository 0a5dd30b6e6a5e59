# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells of a surface in parts are those of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from samples import box, sphere
from volfrep.mesh.float32_repair import Repair, repair_slivers
from volfrep.mesh.open_shells import OpenShells, joined_shells, open_shells
from volfrep.mesh.quality import Inspection, inspect
from volfrep.mesh.topology import touching, vertices_of
from volfrep.mesh.triangle_mesh import TriangleMesh, compact, concatenate


def same(one: Inspection, other: Inspection) -> bool:
    """Whether figures agree, sums up to rounding."""
    near = {
        name: pytest.approx(getattr(other.quality, name), rel=1e-12) for name in ("volume", "area")
    }
    mine, theirs = (replace(each.quality, bounds=None) for each in (one, other))  # type: ignore[arg-type]
    return vars(mine) == {**vars(theirs), **near}


def halves(mesh: TriangleMesh) -> tuple[list[TriangleMesh], list[np.ndarray]]:
    """A mesh in two open parts, and the triangles of each."""
    left = mesh.vertices[mesh.triangles].mean(axis=1)[:, 0] < 0.3
    rows = [np.flatnonzero(left), np.flatnonzero(~left)]
    return [compact(TriangleMesh(mesh.vertices, mesh.triangles[row])) for row in rows], rows


def pinched(mesh: TriangleMesh) -> TriangleMesh:
    """A mesh with an edge that is all but gone."""
    a, b = mesh.triangles[100, :2]
    vertices = mesh.vertices.copy()
    vertices[b] = vertices[a] + 3e-5
    return TriangleMesh(vertices, mesh.triangles)


def repaired(mesh: TriangleMesh, repair: Repair) -> OpenShells | None:
    """Shells after a repair, by a look at what is new."""
    fresh = vertices_of(repair.piece[repair.new], len(mesh.vertices))
    beside = np.flatnonzero(touching(fresh, mesh.triangles) & repair.stays(mesh))
    return open_shells(mesh).repaired(mesh, repair, beside)


def test_two_halves_of_a_ball_in_a_box_have_the_shells_of_the_whole() -> None:
    mesh = concatenate(sphere(5.0, 3), box((30.0, 30.0, 30.0)).reversed())
    parts, _ = halves(mesh)
    shells = [open_shells(part) for part in parts]
    assert all(each is not None for each in shells)
    # Where both have the same vertex their shells go together.
    ours, theirs = ({tuple(v): k for k, v in enumerate(part.vertices)} for part in parts)
    seam = sorted(set(ours) & set(theirs))
    first, second = (
        shell.at(np.array([number[v] for v in seam]), part, np.arange(len(part.triangles)))
        for shell, part, number in zip(shells, parts, (ours, theirs), strict=True)
    )
    second += len(shells[0].volume)
    joined = joined_shells(shells, first, second, len(mesh.vertices))
    whole = TriangleMesh(
        mesh.vertices, np.concatenate([mesh.triangles[r] for r in halves(mesh)[1]])
    )
    assert same(joined.inspection(whole, 0), inspect(whole))


def test_an_open_surface_tells_its_open_edges_and_no_genus() -> None:
    part, _ = halves(sphere(5.0, 3))[0]
    expected = inspect(part)
    assert expected.quality.open_edges > 0
    found = open_shells(part).inspection(part, expected.quality.open_edges)
    assert found.quality.genus == -1
    assert not found.quality.watertight
    assert found.quality.shells == expected.quality.shells


@pytest.mark.parametrize("where", ["fin", "flipped", "repeated"])
def test_what_is_no_surface_has_no_shells(where: str) -> None:
    mesh = sphere(5.0, 2)
    triangles = mesh.triangles.copy()
    if where == "fin":
        triangles = np.concatenate([triangles, triangles[:1, [0, 1, 2]]])
        triangles[-1, 2] = triangles[40, 0]
    elif where == "flipped":
        triangles[7] = triangles[7, ::-1]
    else:
        triangles[7, 2] = triangles[7, 0]
    assert open_shells(TriangleMesh(mesh.vertices, triangles)) is None


def test_without_a_sliver_the_figures_are_those_of_a_look_at_all_of_it() -> None:
    mesh = concatenate(pinched(sphere(20.0, 3)), sphere(3.0, 2).reversed())
    repair = repair_slivers(mesh, 1e-4)
    assert repair.new.any()
    after = repair.applied(mesh)[0]
    assert len(after.triangles) < len(mesh.triangles)
    # Which shell each triangle is of is told as of the mesh as it was.
    found, expected = repaired(mesh, repair).inspection(after, 0), inspect(after)
    assert same(replace(found, shell=expected.shell), expected)


def test_a_hole_where_a_sliver_was_is_seen() -> None:
    mesh = pinched(sphere(20.0, 3))
    repair = repair_slivers(mesh, 1e-4)
    stay = np.delete(np.arange(len(repair.new)), np.flatnonzero(repair.new)[0])
    origin, new = repair.origin[stay], repair.new[stay]
    less = replace(repair, piece=repair.piece[stay], origin=origin, new=new)
    assert repaired(mesh, less) is None


def test_a_fold_onto_what_was_there_is_seen() -> None:
    """A new triangle once more between three vertices of others, and one to close it."""
    mesh = sphere(20.0, 3)
    piece = mesh.triangles[[0, 0, 0]]
    piece[2] = piece[2, ::-1]
    row, none = np.zeros(1, np.int64), np.zeros(0, np.int64)
    new = np.array([False, True, True])
    twice = Repair(row, piece, np.zeros(3, np.int64), new, none, np.zeros((0, 3)), none)
    assert repaired(mesh, twice) is None


def test_two_shells_that_become_one_are_seen() -> None:
    """A triangle of each goes, and the two holes are joined by a tube."""
    mesh = concatenate(sphere(20.0, 2), sphere(5.0, 2).reversed())
    rows = np.array([0, len(mesh.triangles) - 1])
    (a, b, c), (p, q, r) = mesh.triangles[rows]
    tube = [(a, b, p), (b, r, p), (b, c, r), (c, q, r), (c, a, q), (a, p, q)]
    none, every = np.zeros(0, np.int64), np.zeros(6, np.int64)
    joined = Repair(rows, np.array(tube, np.int32), every, every == 0, none, np.zeros((0, 3)), none)
    after = joined.applied(mesh)[0]
    assert inspect(after).quality.shells == 1
    assert inspect(after).quality.watertight
    assert repaired(mesh, joined) is None
