# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graded lattices whose octants inside stay beside the mesh, looked at some at a time."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import trimesh

import samples
from contract import assert_same_quality
from volfrep.design.grading import RadiusGrading
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.infill import Infill
from volfrep.lattice.assembly import numbers
from volfrep.mesh.open_shells import open_shells
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output.meshes import write_mesh
from volfrep.spatial.winding import Lines, windings
from volfrep.trim.trimmed_surface import TrimmedSurface
from volfrep.util.errors import Cancelled
from volfrep.util.progress import Monitor


@cache
def graded() -> Infill:
    """A box with struts that are thicker at its skin, of which many octants lie inside."""
    radius = RadiusGrading("skin", Profile("linear", 0.5, 0.4), reach=5.0)
    spec = LatticeSpec("CVC", 5.0, 0.5, shell=1.0, radius_grading=radius, resolution=8)
    return Infill(samples.box((29.0, 23.0, 23.0)), spec)


def placed_of(infill):
    """Its octants as they lie in the part, before anything is cut."""
    infill.filling.mesh(is_cut=True)
    return infill.filling._placed[True]


@pytest.mark.costly
def test_octants_inside_stay_beside_the_mesh():
    surface = graded().part.surface
    assert surface.octants is not None
    assert len(surface.mesh.triangles) < surface.triangles
    assert not placed_of(graded()).unsound.any()


def test_what_is_found_of_moved_octants_is_what_their_triangles_show():
    surface = graded().part.surface
    found = surface.inspected(Monitor()).found.quality
    assert_same_quality(found, measure(surface.whole(Monitor())))
    assert found.watertight
    assert found.bodies == 1


@pytest.mark.parametrize("layers", [slice(None), slice(0, 5), slice(4, None)])
def test_shells_stay_known_where_octants_go_into_the_mesh(layers):
    part, known = graded().part.surface, open_shells(graded().part.surface.mesh)
    where = np.zeros_like(part.octants.where)
    where[layers] = part.octants.where[layers]
    assert where.any()
    surface = TrimmedSurface(part.mesh, part.octants, shells=known).with_octants(where, Monitor())
    assert surface.shells is not None
    found = surface.inspected(Monitor()).found
    looked_at = TrimmedSurface(surface.mesh, surface.octants).inspected(Monitor()).found
    assert_same_quality(found.quality, looked_at.quality)
    assert_same_quality(found.quality, part.inspected(Monitor()).found.quality)
    same = np.unique(np.stack([found.shell, looked_at.shell]), axis=1)
    assert same.shape[1] == found.shell.max() + 1 == looked_at.shell.max() + 1


def test_no_shells_are_told_where_octants_do_not_fit():
    part = graded().part.surface
    vertices = part.mesh.vertices.copy()
    vertices[part.rim_rows[0]] += 0.01
    apart = TriangleMesh(vertices, part.mesh.triangles)
    surface = TrimmedSurface(apart, part.octants, shells=open_shells(apart))
    assert surface.with_octants(part.octants.where, Monitor()).shells is None


@pytest.mark.costly
@pytest.mark.slow_but(".stl")
@pytest.mark.parametrize("suffix", [".stl", ".ply", ".obj", ".3mf"])
def test_a_file_holds_what_the_mesh_does(suffix, tmp_path):
    surface, path = graded().part.surface, tmp_path / f"part{suffix}"
    write_mesh(surface, path)
    loaded = trimesh.load(path, process=suffix == ".stl", force="mesh")
    read = measure(TriangleMesh(np.asarray(loaded.vertices, float), loaded.faces.astype(np.int32)))
    mesh = measure(surface.whole(Monitor()))
    assert (read.triangles, read.vertices, read.genus) == (
        mesh.triangles,
        mesh.vertices,
        mesh.genus,
    )
    assert read.watertight
    assert read.volume == pytest.approx(mesh.volume, rel=1e-6)


def test_lines_meet_the_octants_beside_the_mesh():
    surface = graded().part.surface
    met, whole = surface.met_by(Lines(surface.bounds)), windings(surface.whole(Monitor()))
    assert met.volume == pytest.approx(whole.volume, rel=1e-12)
    assert met.odd == pytest.approx(0.0, abs=1e-9)


def moved(change):
    """The octants found to be unsound where some points are changed."""
    placed = placed_of(graded())
    points = placed.points.copy()
    inside = np.argwhere(placed.kept.inside)
    middle = inside[len(inside) // 2]
    surface = graded().part.surface.octants
    kind = int(placed.layout.grid.kind[tuple(middle)])
    octant = placed.octants[placed.layout.grid.keys[kind]]
    own = numbers(surface.layout, octant, middle[None])[0]
    inner = own[(octant.places == 1).all(axis=1)]
    change(points, inner)
    return replace(placed, points=points).deformed.unsound, tuple(middle)


def test_an_octant_whose_facets_fold_is_looked_at():
    def fold(points, inner):
        points[inner] = 2.0 * points[inner].mean(axis=0) - points[inner]

    unsound, place = moved(fold)
    assert unsound[place]


def test_an_octant_whose_vertices_a_file_would_merge_is_looked_at():
    def merge(points, inner):
        far = inner[np.linalg.norm(points[inner] - points[inner[0]], axis=1).argmax()]
        points[far] = points[inner[0]] + 1e-9

    unsound, place = moved(merge)
    assert unsound[place]
    assert unsound.sum() < 60  # and its neighbours at most


def test_unsound_octants_go_into_the_mesh():
    surface = graded().part.surface
    where = np.zeros_like(surface.octants.where)
    where[tuple(np.argwhere(surface.octants.where)[0])] = True
    more = surface.with_octants(where, Monitor())
    assert isinstance(more, TrimmedSurface)
    assert more.triangles == surface.triangles
    assert more.is_joined


def test_a_cancel_is_seen_while_octants_are_looked_at():
    placed = placed_of(graded())
    with pytest.raises(Cancelled):
        _ = replace(placed, monitor=Monitor(lambda *_: False)).deformed
