# SPDX-License-Identifier: LGPL-2.1-or-later
"""Shells against closed forms of plates and beams, and a skin's middle surface."""

import numpy as np
import pytest
import trimesh
from manifold3d import CrossSection, Manifold

from volfrep.fem.model import Case
from volfrep.fem.wedge_mesh import corner_angles, upright, vertex_planes
from volfrep.loads.load_cases import Force, LoadCase, Support
from volfrep.loads.nodal_loads import Body, nodal_case
from volfrep.loads.regions import InPlane
from volfrep.mesh import remesh
from volfrep.mesh.booleans import as_manifold, as_mesh
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.shell_elements import shells_of, worse_side
from volfrep.sizing.skin import Feet, constraints_to, skin_model
from volfrep.sizing.skin_mesh import even_surface
from volfrep.sizing.structure import Structure
from volfrep.sizing.strut_results import columns_of
from volfrep.sizing.tapered_beams import Elastic, beams_of
from volfrep.spatial.proximity import closest_points

STEEL = Elastic(210_000.0, 0.3, 7.85e-9)
NO_STRUTS = beams_of(np.eye(3), np.empty((0, 2), np.int64), STEEL)


def plate(along, across, length, width):
    x, y = np.meshgrid(
        np.linspace(0, length, along + 1), np.linspace(0, width, across + 1), indexing="ij"
    )
    nodes = np.stack([x.ravel(), y.ravel(), 0.0 * x.ravel()], axis=1)
    i, j = np.meshgrid(np.arange(along), np.arange(across), indexing="ij")
    a = (i * (across + 1) + j).ravel()
    b = a + across + 1
    rows = [np.stack([a, b, b + 1], axis=1), np.stack([a, b + 1, a + 1], axis=1)]
    return nodes, np.concatenate(rows)


def turned():
    """A rotation that leaves no axis where it was."""
    return trimesh.transformations.rotation_matrix(0.9, [1, 2, 3])[:3, :3]


def solved(nodes, triangles, thickness, held, force):
    """Displacements in the plate's own axes, of a plate that lies askew."""
    turn = turned()
    shells = shells_of(nodes @ turn.T, triangles, np.array(thickness), STEEL)
    structure = Structure(nodes @ turn.T, NO_STRUTS, fixed_blocks=shells.blocks())
    loads = np.zeros((len(nodes), 6))
    loads[:, :3] = force @ turn.T
    moved, _ = structure.displacements(np.empty((0, 2)), [Case(held, loads)])
    return moved[:, :3, 0] @ turn, shells, moved


def strip(way, size):
    nodes, triangles = plate(20, 2, 100.0, 10.0)
    held = np.repeat(nodes[:, :1] < 1e-9, 6, axis=1)
    tip = nodes[:, 0] > 100 - 1e-9
    force = np.zeros_like(nodes)
    force[tip, way] = size * np.array([0.25, 0.5, 0.25])
    moved, shells, whole = solved(nodes, triangles, 1.0, held, force)
    return moved[tip, way].mean(), shells, whole


def test_a_strip_bends_in_its_plane_and_across_it():
    in_plane = 10 * 100**3 / 3 / 210_000 / (1000 / 12) + 10 * 120 / (210_000 / 2.6) / 10
    assert strip(1, 10.0)[0] == pytest.approx(in_plane, rel=0.01)
    across = 0.1 * 100**3 / 3 / 210_000 / (10 / 12)
    moved, shells, whole = strip(2, 0.1)
    assert moved == pytest.approx(across, rel=0.02)  # it is a plate where it is clamped
    corners = whole[shells.triangles].reshape(len(shells.triangles), 18, -1)
    flat, bent = (block @ corners for block in shells.stress_blocks())
    assert flat == pytest.approx(shells.in_plane(whole), abs=1e-9)
    stress = worse_side(flat, bent)
    assert stress.max() == pytest.approx(0.1 * 100 * 6 / 10, rel=0.06)


def test_a_clamped_square_plate_under_a_force_in_its_middle():
    """w = 0.0056 P a2 / D (S. Timoshenko & S. Woinowsky-Krieger, Theory of Plates and Shells)."""
    nodes, triangles = plate(16, 16, 100.0, 100.0)
    on_edge = (nodes[:, :2] < 1e-9).any(axis=1) | (nodes[:, :2] > 100 - 1e-9).any(axis=1)
    force = np.zeros_like(nodes)
    middle = int(np.argmin(np.linalg.norm(nodes[:, :2] - 50, axis=1)))
    force[middle, 2] = 1.0
    moved, _, _ = solved(nodes, triangles, 1.0, np.repeat(on_edge[:, None], 6, axis=1), force)
    rigidity = 210_000 / 12 / (1 - 0.09)
    assert moved[middle, 2] == pytest.approx(0.0056 * 100**2 / rigidity, rel=0.02)


def test_shells_weigh_what_they_hold():
    nodes, triangles = plate(3, 2, 30.0, 20.0)
    blocks = shells_of(nodes, triangles, np.array(0.5), STEEL).blocks()
    assert blocks.mass[:, 0, 0].sum() == pytest.approx(30 * 20 * 0.5 * STEEL.density)


def box(x, y, z):
    mesh = trimesh.creation.box((x, y, z))
    return TriangleMesh(mesh.vertices, mesh.faces.astype(np.int32))


def test_an_even_surface_keeps_edges_and_volume():
    even = even_surface(box(40, 30, 20), 5.0)
    assert even.volume == pytest.approx(40 * 30 * 20)
    a, b, c = even.corners()
    lengths = np.linalg.norm(np.concatenate([b - a, c - b, a - c]), axis=1)
    assert lengths.max() < 9.0
    assert np.median(lengths) == pytest.approx(5.0, rel=0.3)


def test_a_narrow_ledge_leaves_few_needles():
    """A block on a plate, 0.2 mm in from three of its sides: strips that no triangle fits."""
    parts = (box(40, 40, 10), box(39.6, 30, 20))
    for part, corner in zip(parts, ((0, 0, 0), (0.2, 0.2, 5)), strict=True):
        part.vertices[:] += np.array(corner) - part.bounds[0]
    whole = as_mesh(as_manifold(parts[0]) + as_manifold(parts[1]))
    even = even_surface(whole, 5.0)
    assert (remesh.qualities(np.stack(even.corners(), axis=1)) < 0.1).sum() < 30  # 73 with strips
    assert even.volume == pytest.approx(whole.volume, rel=1e-3)


@pytest.mark.costly
def test_no_triangle_of_an_even_surface_lies_on_its_face():
    """A plate with two round holes: long needles fan out from the holes and are made even."""
    plate = CrossSection.square((40.0, 40.0))
    for middle in (10.0, 30.0):
        plate -= CrossSection.circle(4.0, 64).translate((middle, middle))
    whole = as_mesh(Manifold.extrude(plate, 6.0))
    even = even_surface(whole, 5.0)
    corners = np.stack(even.corners(), axis=1)
    below = closest_points(whole, corners.mean(axis=1))[2]
    outwards = remesh.normals(np.stack(whole.corners(), axis=1))[below]
    own = remesh.normals(corners)
    assert (np.einsum("ij,ij->i", own, outwards) > 0.0).all()
    assert 0.5 * np.linalg.norm(own, axis=1).sum() == pytest.approx(whole.area, rel=5e-3)


def test_a_vertex_on_an_edge_lies_in_both_faces_though_one_of_them_is_a_needle_there():
    """All that it has of the upper face is 10 mm long and 0.01 mm high."""
    vertices = np.array([[0, 0, 0], [-5, 0.01, 0], [5, 0.01, 0], [0, 0, -5]], float)
    triangles = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2]])
    corners = vertices[triangles]
    normal = remesh.normals(corners)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    angles = corner_angles(corners)
    assert angles.sum(axis=1) == pytest.approx(np.pi)
    values, _, held = vertex_planes(vertices, triangles, normal, angles)
    assert held[0].sum() == 2
    assert values[0, 1:] == pytest.approx(np.pi, rel=2e-3)


def test_the_middle_of_a_boxs_skin_is_a_smaller_box():
    skin = skin_model(box(40, 30, 20), 2.0, 5.0, STEEL)
    inner = TriangleMesh(skin.middle, skin.outside.triangles)
    assert inner.volume == pytest.approx(38 * 28 * 18)
    assert skin.shells.thickness == pytest.approx(2.0)


def test_where_the_part_is_thin_both_sides_make_one_solid_plate():
    """A clamped strip of 3 mm under a skin of 2 mm bends as a plate of 3 mm."""
    length, width, thick = 60.0, 12.0, 3.0
    skin = skin_model(box(length, width, thick), 2.0, 2.5, STEEL)
    assert np.median(skin.shells.thickness) == pytest.approx(thick / 2, rel=0.06)
    structure = Structure(skin.middle, NO_STRUTS, fixed_blocks=skin.blocks)
    x = skin.outside.vertices[:, 0]
    held = np.repeat((x < -length / 2 + 1e-6)[:, None], 6, axis=1)
    tip = x > length / 2 - 1e-6
    loads = np.zeros((len(x), 6))
    loads[tip, 2] = 1.0 / tip.sum()
    moved, _ = structure.displacements(np.empty((0, 2)), [Case(held, loads)])
    beam = length**3 / 3 / 210_000 / (width * thick**3 / 12)
    assert moved[tip, 2, 0].mean() == pytest.approx(beam, rel=0.15)


def test_a_pad_is_a_rigid_disc_in_a_plate():
    """A clamped round plate, a force on a rigid disc in its middle (W. C. Young, Roark's Formulas).

    w = P a2 / (16 pi D) (1 - q - 4 q ln(b / a)2 / (1 - q)), q = (b / a)2.
    """
    rings, spokes, rim, disc = 12, 24, 10.0, 2.0
    radii = np.append(0.0, np.linspace(2.5, rim, rings))
    angles = np.arange(spokes) * 2.0 * np.pi / spokes
    around = np.stack([np.cos(angles), np.sin(angles), 0.0 * angles], axis=1)
    nodes = np.concatenate([np.zeros((1, 3)), *(radius * around for radius in radii[1:])])
    k = np.arange(spokes)
    after = (k + 1) % spokes
    triangles = [np.stack([0 * k, 1 + k, 1 + after], axis=1)]
    for ring in range(rings - 1):
        low, high = 1 + spokes * ring, 1 + spokes * (ring + 1)
        triangles.append(np.stack([low + k, high + k, high + after], axis=1))
        triangles.append(np.stack([low + k, high + after, low + after], axis=1))
    pads = np.zeros(len(nodes))
    pads[0] = disc
    shells = shells_of(nodes, np.concatenate(triangles), np.array(0.5), STEEL, pads=pads)
    structure = Structure(nodes, NO_STRUTS, fixed_blocks=shells.blocks())
    held = np.repeat(np.linalg.norm(nodes, axis=1)[:, None] > rim - 1e-6, 6, axis=1)
    loads = np.zeros((len(nodes), 6))
    loads[0, 2] = 3.0
    moved, _ = structure.displacements(np.empty((0, 2)), [Case(held, loads)])
    rigidity, share = 210_000 * 0.5**3 / 12 / (1 - 0.3**2), (disc / rim) ** 2
    lessened = 1 - share - share * np.log(share) ** 2 / (1 - share)
    assert moved[0, 2, 0] == pytest.approx(3 * rim**2 / 16 / np.pi / rigidity * lessened, rel=0.03)


def test_walls_that_meet_bend_from_near_where_they_leave_each_other():
    """Walls of 2 mm about a box of 40 mm: shells of 38 mm, of which 37 mm bend."""
    skin = skin_model(box(40, 40, 40), 2.0, 5.0, STEEL)
    flat = np.abs(skin.shells.axes[skin.shells.panels.of, 2] @ [1.0, 0, 0]) > 0.99
    area = skin.shells.area[np.abs(skin.shells.axes[:, 2] @ [1.0, 0, 0]) > 0.99].sum()
    panels = skin.shells.panels.corners[flat]
    one, two = panels[:, 1] - panels[:, 0], panels[:, 2] - panels[:, 0]
    bending = 0.5 * (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
    assert area == pytest.approx(2 * 38 * 38)
    assert bending.sum() == pytest.approx(2 * 37 * 37, rel=0.02)


#: Work of 200 N pulling a hollow box's end and bending it, N mm, the other end held: boxes of
#: 30 x 20 x 20 mm as 2,928 and 5,344 bricks C3D20R of 1 mm in CalculiX.
HOLLOW = {1.0: (0.93862, 1.58862), 2.0: (0.14639, 0.81997)}


@pytest.mark.parametrize("thick", HOLLOW)
def test_a_hollow_box_is_as_stiff_as_solid_bricks(thick):
    titanium = Elastic(113_800.0, 0.342)
    solid = box(30, 20, 20)
    held = (np.abs(solid.vertices[solid.triangles, 0] + 15.0) < 1e-6).all(axis=1)
    skin = skin_model(solid, thick, 5.0, titanium, fixed=held)
    nodes = skin.outside.vertices
    structure = Structure(nodes, NO_STRUTS, fixed_blocks=skin.blocks)
    facets = skin.outside.triangles.astype(np.int64)
    body = Body(nodes, facets, np.zeros(len(nodes)), np.ones(len(nodes), bool))
    wall, tip = (InPlane((x, 0, 0), (1, 0, 0)) for x in (-15.0, 15.0))
    cases = []
    for force in ((200.0, 0.0, 0.0), (0.0, 0.0, -200.0)):
        laid = nodal_case(body, LoadCase("load", (Support(wall),), (Force(tip, force),)))
        cases.append(Case(laid.fixed, laid.loads))
    moved, _ = structure.displacements(np.empty((0, 2)), cases)
    work = [np.sum(case.loads * moved[:, :, k]) for k, case in enumerate(cases)]
    assert work == pytest.approx(HOLLOW[thick], rel=0.04)


def test_walls_as_thick_as_half_of_a_bar_twist_as_the_closed_form_says():
    """A bar of 7 x 20 mm under a skin of 2.9 mm is as good as solid: J = 0.260 b a3.

    (S. Timoshenko & J. N. Goodier, Theory of Elasticity: a rectangle of sides 1 : 2.86.) Shells
    that do not shear are no stiffer than that: the bar twists 8 % more, of which its hole of 1.2 x
    14.2 mm is 3 %.
    """
    shear = 210_000 / 2.6
    skin = skin_model(box(60, 7, 20), 2.9, 4.5, STEEL)
    nodes = skin.outside.vertices
    structure = Structure(nodes, NO_STRUTS, fixed_blocks=skin.blocks)
    held = np.repeat((nodes[:, 0] < -30 + 1e-6)[:, None], 6, axis=1)
    tip = nodes[:, 0] > 30 - 1e-6
    around = np.cross([1.0, 0.0, 0.0], nodes)
    loads = np.zeros((len(nodes), 6))
    loads[tip, :3] = 1e4 * around[tip] / (nodes[tip, 1:] ** 2).sum()
    moved, _ = structure.displacements(np.empty((0, 2)), [Case(held, loads)])
    turns, places = [], []
    for place in (-15.0, 15.0):  # away from the ends, which cannot warp
        some = np.abs(nodes[:, 0] - place) < 4.0
        turns.append((around[some] * moved[some, :3, 0]).sum() / (nodes[some, 1:] ** 2).sum())
        places.append(nodes[some, 0].mean())
    twist = (turns[1] - turns[0]) / (places[1] - places[0])
    assert 1.0 < twist * shear * 0.260 * 20 * 7**3 / 1e4 < 1.12


def test_what_is_held_is_held_on_the_outside():
    """A wall that ends at a held face reaches to it."""
    solid = box(40, 30, 20)
    held = (np.abs(solid.vertices[solid.triangles, 0] + 20.0) < 1e-6).all(axis=1)
    skin = skin_model(solid, 2.0, 5.0, STEEL, fixed=held)
    assert skin.middle.min(axis=0) == pytest.approx([-20.0, -14.0, -9.0])
    assert skin.middle.max(axis=0) == pytest.approx([19.0, 14.0, 9.0])
    assert skin.inside.min(axis=0) == pytest.approx([-18.0, -13.0, -8.0])


@pytest.mark.costly
def test_wedges_in_corners_keep_the_skins_thickness():
    """Triangles smaller than the skin is thick: the inner side slides along itself."""
    skin = skin_model(box(30, 20, 20), 2.0, 1.8, STEEL)
    outer, triangles = skin.outside.vertices, skin.outside.triangles.astype(np.int64)
    before, after = (
        TriangleMesh(side, skin.outside.triangles)
        for side in (skin.inside, upright(outer, skin.inside, triangles))
    )
    normal = np.cross(*(np.diff(before.vertices[triangles], axis=1)[:, k] for k in (0, 1)))
    outwards = np.einsum("ij,ij->i", normal, before.vertices[triangles].mean(axis=1))
    assert (outwards < 0.0).any()
    assert after.volume == pytest.approx(26 * 16 * 16, rel=1e-6)
    normal = np.cross(*(np.diff(after.vertices[triangles], axis=1)[:, k] for k in (0, 1)))
    assert (np.einsum("ij,ij->i", normal, after.vertices[triangles].mean(axis=1)) > 0.0).all()


def test_struts_find_a_vertex_where_they_meet_the_skin():
    places = np.array([[20.0, 1.7, 2.2], [-20.0, 6.1, -3.3], [3.0, 15.0, 9.8], [3.0, 14.8, -1.0]])
    feet = Feet(places, np.array([1.0, 1.2, 0.8, 0.9]))
    skin = skin_model(box(40, 30, 20), 2.0, 5.0, STEEL, feet=feet)
    vertices = skin.outside.vertices
    assert skin.outside.volume == pytest.approx(40 * 30 * 20)
    away = np.linalg.norm(vertices[:, None] - places, axis=2).min(axis=0)
    assert away.max() < 0.25 * 5.0
    assert np.sort(skin.pads[skin.pads > 0]) == pytest.approx([0.8, 0.9, 1.0, 1.2])


def test_a_strut_that_ends_in_the_skin_moves_with_it():
    skin = skin_model(box(40, 30, 20), 2.0, 5.0, STEEL)
    ends = np.array([[18.0, 3.0, 1.0], [2.0, 13.0, -4.0]])  # on the inner wall
    constraints = constraints_to(skin, ends, np.array([0, 1]), 0)
    turn, shift = np.array([1e-3, -2e-3, 5e-4]), np.array([0.1, 0.2, -0.3])
    rigid = np.concatenate(
        [shift + np.cross(turn, skin.outside.vertices), np.tile(turn, (len(skin.middle), 1))],
        axis=1,
    )
    followed = np.einsum("tlij,tlj->ti", constraints.blocks, rigid[constraints.leaders])
    assert followed[:, :3] == pytest.approx(shift + np.cross(turn, ends))
    assert followed[:, 3:] == pytest.approx(np.tile(turn, (2, 1)))


def test_a_piece_of_a_strut_in_the_corner_of_a_cavity_is_one_body_with_its_walls():
    feet = Feet(np.array([[18.0, 13.0, 0.0]]), np.array([2.0]))
    skin = skin_model(box(40, 30, 20), 2.0, 5.0, STEEL, feet=feet)
    ends = np.array([[18.0, 11.5, 0.0], [16.5, 13.0, 0.0], [18.0, 0.0, 5.0]])
    moved = np.random.default_rng(5).normal(size=(len(skin.middle), 6))
    alone, one_body = (
        np.einsum("tlij,tlj->ti", found.blocks, moved[found.leaders])
        for found in (
            constraints_to(skin, ends, np.arange(3), 0),
            constraints_to(skin, ends, np.arange(3), 0, np.array([[0, 1], [1, 2]])),
        )
    )

    def stretch(followed):
        along = ends[1] - ends[0]
        step = followed[1, :3] - followed[0, :3] - np.cross(followed[0, 3:], along)
        return np.abs(np.append(step, followed[1, 3:] - followed[0, 3:])).max()

    assert stretch(alone) > 0.1
    assert stretch(one_body) < 1e-12
    assert one_body[2] == pytest.approx(alone[2])


@pytest.mark.parametrize(("parts", "within"), [(2, 0.05), (4, 0.01)])
def test_a_pressed_square_plate_buckles_at_4_pi2_d_over_b2(parts, within):
    """Simply supported and pressed in one direction, so that its edges may move in its plane."""
    nodes, triangles = plate(parts, parts, 100.0, 100.0)
    turn = turned()
    shells = shells_of(nodes, triangles, np.array(1.0), STEEL)
    x, y, _ = nodes.T
    ends, sides = (x < 1e-9) | (x > 100 - 1e-9), (y < 1e-9) | (y > 100 - 1e-9)
    held = np.zeros((len(nodes), 6), bool)
    held[:, [0, 1, 5]] = True  # what buckles goes across only
    held[ends | sides, 2] = held[ends, 3] = held[sides, 4] = True
    structure = Structure(nodes, NO_STRUTS, fixed_blocks=shells.blocks())
    moved = np.zeros((len(nodes), 6))
    moved[:, :2] = 1e-4 * np.stack([-x, 0.3 * y], axis=1)
    columns = columns_of(NO_STRUTS, np.empty((0, 2)))
    factor = structure.factored(np.empty((0, 2)), held)
    found = structure.buckling(columns, np.empty((0, 6)), factor, pressed=shells.pressed(moved))[0]
    stress = 4.0 * np.pi**2 * 210_000 / 12 / (1 - 0.3**2) / 100**2
    assert found[0] * 21.0 == pytest.approx(stress, rel=within)
    pulled = structure.buckling(columns, np.empty((0, 6)), factor, pressed=-shells.pressed(moved))
    assert pulled[0][0] > 2.0 * found[0] or not np.isfinite(pulled[0][0])
    askew = shells_of(nodes @ turn.T, triangles, np.array(1.0), STEEL)
    way = np.concatenate([moved[:, :3] @ turn.T, moved[:, 3:] @ turn.T], axis=1)
    mode = np.random.default_rng(0).normal(size=(len(nodes), 6))
    felt = askew.pressed_work(mode)
    forces = askew.in_plane(way[:, :, None])[:, :, 0]  # of 1 mm
    rows = np.repeat(triangles, 3, axis=1).ravel(), np.tile(triangles, (1, 3)).ravel()
    work = np.einsum("ci,cij,cj->", mode[rows[0]], askew.pressed(way), mode[rows[1]])
    assert (felt * forces).sum() == pytest.approx(work)
    pull = np.zeros_like(mode)
    np.add.at(pull, triangles, askew.pressed_gradient(felt))
    assert (pull * way).sum() == pytest.approx(work)
