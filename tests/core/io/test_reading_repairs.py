# SPDX-License-Identifier: LGPL-2.1-or-later
"""Each kind of defect, made in a solid whose volume is known, and mended or refused."""

import numpy as np
import pytest

import samples
from volfrep.io.repair import holes
from volfrep.io.solid import check_solid
from volfrep.io.write.stl import as_read
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh, concatenate
from volfrep.spatial.winding import windings
from volfrep.util.errors import VolfrepError
from winding import disagreement


def soup(mesh):
    """Every triangle with corners of its own."""
    corners = mesh.vertices[mesh.triangles].reshape(-1, 3)
    return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))


def without(mesh, *rows):
    return TriangleMesh(mesh.vertices, np.delete(mesh.triangles, rows, axis=0))


def with_triangle(mesh, corners):
    sheet = TriangleMesh(np.array(corners, float), np.array([[0, 1, 2]], np.int32))
    return concatenate(mesh, sheet)


def mended(mesh, volume, says, rel=1e-12):
    """The mesh is read as a closed solid of that volume, and the repair is told."""
    solid = check_solid(mesh, "part")
    assert solid.volume == pytest.approx(volume, rel=rel)
    assert measure(solid).watertight
    assert any(says in text for text in solid.repairs), solid.repairs
    assert all(text in " ".join(solid.notes) for text in solid.repairs)
    return solid


def test_a_sound_solid_is_left_alone():
    solid = check_solid(samples.plate(48), "plate")
    assert solid.notes == ()


def test_t_junctions_are_joined():
    # A face cut in four about its middle, its neighbours not told.
    part = samples.box()
    corners = part.vertices[part.triangles[0]]
    middles = (corners + np.roll(corners, -1, axis=0)) / 2.0
    rest = without(part, 0)
    for k in range(3):
        rest = with_triangle(rest, [corners[k], middles[k], middles[k - 1]])
    mended(with_triangle(rest, middles), part.volume, "3 T-junctions joined")


def test_slivers_along_edges_are_removed():
    part = samples.box()
    a, b = part.vertices[part.triangles[0][:2]]
    mended(with_triangle(part, [a, b, (a + b) / 2]), part.volume, "1 sliver along edges removed")


def test_cracks_are_closed():
    part = samples.plate(24)
    loose = soup(part)
    noise = np.random.default_rng(6).uniform(-5e-4, 5e-4, loose.vertices.shape)
    cracked = TriangleMesh(loose.vertices + noise, loose.triangles)
    # Each vertex is a mean of several corners, off by less than the noise: 5e-4 of 12 mm.
    mended(cracked, part.volume, "Cracks of up to", rel=1e-4)


def test_a_small_hole_in_a_curved_face_is_closed():
    ball = samples.sphere()
    fan = np.flatnonzero((ball.triangles == ball.triangles[100, 0]).any(axis=1))
    # A cap of 6 facets of 1.3 mm: its height is under 0.1 mm, its share of the volume 3e-5.
    mended(without(ball, *fan), ball.volume, "1 hole closed", rel=1e-4)


def test_flat_holes_are_closed_exactly():
    part = samples.plate(48)
    small = np.flatnonzero(np.ptp(part.vertices[part.triangles][:, :, 0], axis=1) < 0.6)
    mended(without(part, *small[:2]), part.volume, "closed")


def test_a_missing_ring_is_closed_around_its_opening():
    # The rim of a tube: two loops in one plane, the inner one an opening.
    part = samples.ring()
    rim = np.flatnonzero((part.vertices[part.triangles][:, :, 2] == 30.0).all(axis=1))
    solid = mended(without(part, *rim), part.volume, "2 holes closed")
    assert len(solid.triangles) == len(part.triangles)


@pytest.mark.parametrize("more", [0, 40])
def test_the_width_of_a_hole_is_that_of_its_rim(more):
    """However many vertices lie on one of its sides: the diagonal of a square."""
    places = np.linspace(0.0, 1.0, more + 2)[1:-1]
    rim = [(0, 0, 1), *((x, 0, 1) for x in places), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    vertices = np.array([*rim, (0.5, 0.5, 0.0)], float)
    n = len(rim)
    fan = [(k + 1, k, n) for k in range(n - 1)] + [(0, n - 1, n)]
    mesh = TriangleMesh(vertices, np.array(fan, np.int32).reshape(-1, 3)[:, ::-1].copy())
    hole = holes._hole(mesh, np.arange(n))
    assert hole.width == pytest.approx(2.0**0.5)


def test_two_holes_that_touch_in_a_vertex_are_closed():
    part = samples.plate(48)
    at = part.triangles[0, 0]
    around = np.flatnonzero((part.triangles == at).any(axis=1))
    apart = next(
        k
        for k in around[1:]
        if len(np.intersect1d(part.triangles[k], part.triangles[around[0]])) == 1
    )
    mended(without(part, around[0], apart), part.volume, "holes closed")


def test_sheets_without_a_thickness_are_cut_off():
    part = samples.box()
    inside = [[5.0, 5.0, 5.0], [9.0, 5.0, 5.0], [5.0, 9.0, 5.0]]
    a, b = part.vertices[part.triangles[0][:2]]
    fin = [a, b, (a + b) / 2 + [-7.0, -7.0, 0.0]]
    for sheet in (inside, fin):
        mended(with_triangle(part, sheet), part.volume, "1 sheet without a thickness")


def test_a_double_sheet_inside_is_removed():
    part = samples.box()
    sheet = [[5.0, 5.0, 5.0], [9.0, 5.0, 5.0], [5.0, 9.0, 5.0]]
    both = with_triangle(with_triangle(part, sheet), sheet[::-1])
    mended(both, part.volume, "1 sheet without a thickness")


def test_a_surface_with_two_sides_everywhere_is_one():
    part = samples.plate(24)
    mended(concatenate(part, part.reversed()), part.volume, "all of it was double")


def test_repeated_triangles_are_removed_and_counted():
    part = samples.plate(24)
    twice = TriangleMesh(part.vertices, np.concatenate([part.triangles, part.triangles[:7]]))
    mended(twice, part.volume, "7 repeated triangles removed")


def test_wrong_windings_are_turned_and_counted():
    part = samples.plate(24)
    turned = part.triangles.copy()
    turned[:9] = turned[:9, ::-1]
    mended(TriangleMesh(part.vertices, turned), part.volume, "9 triangles turned")
    mended(part.reversed(), part.volume, "The surface turned right side out")


def test_one_of_two_bodies_that_is_inside_out_is_turned():
    apart = samples.box((5.0, 5.0, 5.0), (100.0, 0.0, 0.0)).reversed()
    mended(concatenate(samples.box(), apart), 24_125.0, "12 triangles turned")


@pytest.mark.parametrize("corner", [(1.0, 1.0, 0.0), (1.0, 1.0, 1.0)])
def test_bodies_that_touch_along_an_edge_or_at_a_vertex_are_taken_apart(corner):
    cube = samples.box((1.0, 1.0, 1.0))
    two = concatenate(cube, samples.box((1.0, 1.0, 1.0), corner))
    # What touched is kept apart by some 16 steps of single precision, 1e-7 each.
    solid = mended(two, 2.0, "touch", rel=4e-6)
    # Also to a reader that merges equal corners.
    for mesh in (solid, as_read(solid)):
        assert measure(mesh).watertight
        assert measure(mesh).bodies == 2


def test_a_part_far_from_the_origin_is_warned_about_and_then_refused():
    def at(distance):
        return samples.box(corner=(distance, 0.0, 0.0))

    assert check_solid(at(1e3), "part").notes == ()
    assert "move it to the origin" in check_solid(at(1e4), "part").notes[0]
    with pytest.raises(VolfrepError, match=r"measures 40 x 30 x 20 mm .* another unit\?"):
        check_solid(at(1e5), "part")


@pytest.mark.parametrize("side", [10.0, 6.0])
def test_bodies_that_touch_face_to_face_are_one(side):
    # With equal faces, and with one in the middle of the other.
    gap = (10.0 - side) / 2.0
    two = concatenate(samples.box((10.0,) * 3), samples.box((side,) * 3, (10.0, gap, gap)))
    assert measure(mended(two, 1000.0 + side**3, "united")).bodies == 1


def test_a_surface_that_runs_through_itself_is_united():
    # A bar bent until its end runs through its beginning.
    bar = samples.knot()
    solid = mended(bar, windings(bar, bar.bounds).solid, "with itself", rel=0.02)
    assert windings(solid).odd == 0.0
    assert disagreement(solid, bar) < 0.01
    assert solid.volume < bar.volume - 1.0


def test_a_body_in_a_body_is_ambiguous():
    inner = samples.box((10.0, 10.0, 10.0), (5.0, 5.0, 5.0))
    with pytest.raises(VolfrepError, match=r"near \(.*may be a void or a body too many"):
        check_solid(concatenate(samples.box(), inner), "two")


def test_a_body_in_a_void_is_a_body():
    void = samples.box((30.0, 20.0, 10.0), (5.0, 5.0, 5.0)).reversed()
    core = samples.box((2.0, 2.0, 2.0), (10.0, 10.0, 8.0))
    solid = check_solid(concatenate(samples.box(), void, core), "three")
    assert solid.volume == pytest.approx(24_000.0 - 6_000.0 + 8.0)
    assert solid.repairs == ()


def test_a_void_that_reaches_out_of_its_body_is_refused():
    void = samples.box((10.0, 10.0, 10.0), (35.0, 5.0, 5.0)).reversed()
    with pytest.raises(VolfrepError, match="inside out"):
        check_solid(concatenate(samples.box(), void), "part")


def test_lines_measure_what_is_enclosed_once_and_twice():
    both = concatenate(samples.box(), samples.box((40.0, 30.0, 20.0), (20.0, 5.0, 5.0)))
    met = windings(both)
    twice = 20.0 * 25.0 * 15.0
    # 64 x 64 jittered lines: their error falls with the 3/4th power of their number, 1/500.
    assert met.volume[2] == pytest.approx(twice, rel=0.02)
    assert met.volume[1] == pytest.approx(2 * 24_000.0 - 2 * twice, rel=0.01)
    assert (met.least, met.most) == (0, 2)
    assert ((met.place > [20.0, 5.0, 5.0]) & (met.place < [40.0, 30.0, 20.0])).all()
