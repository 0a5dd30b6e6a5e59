# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells of a surface in parts are those of the whole."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from samples import box, sphere
from volfrep.mesh.float32_repair import without_slivers
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


def after_repair(mesh: TriangleMesh, shells: OpenShells) -> tuple[TriangleMesh, OpenShells | None]:
    """A mesh without its slivers, and its shells by a look at what is new."""
    found = without_slivers(mesh, 1e-4)
    assert found.number is not None
    assert found.new.any()
    fresh = vertices_of(found.mesh.triangles[found.new], len(found.mesh.vertices))
    beside = np.flatnonzero(touching(fresh, found.mesh.triangles))
    shells_now = shells.rebuilt(mesh, found.mesh, found.origin, found.new, beside, found.number)
    return found.mesh, shells_now


def test_two_halves_of_a_ball_in_a_box_have_the_shells_of_the_whole() -> None:
    mesh = concatenate(sphere(5.0, 3), box((30.0, 30.0, 30.0)).reversed())
    parts, _ = halves(mesh)
    shells = [open_shells(part) for part in parts]
    assert all(each is not None for each in shells)
    # Where both have the same vertex their shells go together.
    ours, theirs = ({tuple(v): k for k, v in enumerate(part.vertices)} for part in parts)
    seam = sorted(set(ours) & set(theirs))
    first = shells[0].at(np.array([ours[v] for v in seam]), parts[0])
    second = shells[1].at(np.array([theirs[v] for v in seam]), parts[1]) + len(shells[0].volume)
    joined = joined_shells(shells, first, second)
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
    after, shells = after_repair(mesh, open_shells(mesh))
    assert len(after.triangles) < len(mesh.triangles)
    assert same(shells.inspection(after, 0), inspect(after))


def test_a_hole_where_a_sliver_was_is_seen() -> None:
    mesh = pinched(sphere(20.0, 3))
    found = without_slivers(mesh, 1e-4)
    goes = np.flatnonzero(found.new)[0]
    stay = np.delete(np.arange(len(found.new)), goes)
    less = TriangleMesh(found.mesh.vertices, found.mesh.triangles[stay])
    new = found.new[stay]
    fresh = vertices_of(less.triangles[new], len(less.vertices))
    beside = np.flatnonzero(touching(fresh, less.triangles))
    shells = open_shells(mesh)
    assert shells.rebuilt(mesh, less, found.origin[stay], new, beside, found.number) is None


def test_a_fold_onto_what_was_there_is_seen() -> None:
    """A new triangle once more between three vertices of others, and one to close it."""
    mesh = sphere(20.0, 3)
    triangles = np.concatenate([mesh.triangles, mesh.triangles[:1], mesh.triangles[:1, ::-1]])
    after = TriangleMesh(mesh.vertices, triangles)
    count = len(mesh.triangles)
    new = np.arange(len(triangles)) >= count
    origin = np.r_[np.arange(count), 0, 0]
    every, number = np.arange(len(triangles)), np.arange(len(mesh.vertices), dtype=np.int32)
    assert open_shells(mesh).rebuilt(mesh, after, origin, new, every, number) is None
