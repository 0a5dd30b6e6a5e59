# SPDX-License-Identifier: LGPL-2.1-or-later
"""Load cases: what is read of a file, what of a body a region takes, and that totals are exact."""

from pathlib import Path

import numpy as np
import pytest
import trimesh
from hypothesis import given
from hypothesis import strategies as st
from scipy.optimize import linprog

from volfrep.loads.load_cases import (
    CONE_MISSES,
    Force,
    LoadCase,
    Moment,
    Pressure,
    Support,
    cone_of,
)
from volfrep.loads.load_file import read_load_cases
from volfrep.loads.nodal_loads import (
    Body,
    nodal_case,
    nodal_loads,
    nodes_in,
    resultant,
    share_of,
)
from volfrep.loads.regions import (
    AllOf,
    AnyOf,
    InBox,
    InCylinder,
    InPlane,
    NearPoint,
    OnFacets,
    OnLine,
)
from volfrep.mesh.smooth_faces import smooth_faces
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.util.errors import VolfrepError

LEFT = InPlane((0.0, 0.0, 0.0), (1.0, 0.0, 0.0))
RIGHT = InPlane((30.0, 0.0, 0.0), (-2.0, 0.0, 0.0))


def mesh_of(solid):
    return TriangleMesh(np.array(solid.vertices, float), np.array(solid.faces, np.int32))


def box(size=(30.0, 20.0, 10.0), edge=3.0):
    """A box with a corner at the origin, its facets about that long."""
    solid = trimesh.creation.box(size)
    solid.apply_translation(np.array(size) / 2)
    return mesh_of(solid.subdivide_to_size(edge) if edge else solid)


def skin(mesh=None, turns=True):
    mesh = mesh or box()
    count = len(mesh.vertices)
    return Body(
        mesh.vertices, mesh.triangles.astype(np.int64), np.zeros(count), np.full(count, turns)
    )


def lattice(nodes, reach=0.5):
    nodes = np.array(nodes, float)
    return Body(
        nodes, np.zeros((0, 3), np.int64), np.full(len(nodes), reach), np.ones(len(nodes), bool)
    )


def grid(shape=(4, 3, 3), step=10.0):
    axes = [step * np.arange(count) for count in shape]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


# --- what a region takes -------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("region", "area"),
    [
        (LEFT, 200.0),
        (InBox((-1, -1, -1), (31, 21, 0)), 600.0),
        (AllOf((LEFT, InBox((0, 0, 0), (0, 20, 5)))), 100.0),
        (AnyOf((LEFT, RIGHT)), 400.0),
        (AnyOf((LEFT, LEFT)), 200.0),
    ],
)
def test_a_region_takes_its_part_of_the_surface(region, area):
    mesh = box(edge=1.0)
    share = share_of(skin(mesh), region)
    assert share.area == pytest.approx(area, rel=0.05 if isinstance(region, AllOf) else 1e-9)
    assert share.weights.sum() == pytest.approx(1.0)


def test_a_cylinder_of_the_holes_own_radius_takes_its_wall_and_nothing_of_the_faces():
    tube = mesh_of(trimesh.creation.annulus(r_min=4.0, r_max=15.0, height=6.0, sections=64))
    share = share_of(skin(tube), InCylinder((0, 0, 0), (0, 0, 3), 4.0))
    wall = 64 * 2 * 4.0 * np.sin(np.pi / 64) * 6.0
    assert share.area == pytest.approx(wall)
    # A hole pushed outwards from inside is not pushed as a whole.
    assert np.abs(share.pushes.sum(axis=0)).max() < 1e-9
    half = share_of(skin(tube), InCylinder((0, 0, -3), (0, 0, 1), 4.5, length=6.0))
    assert half.area == pytest.approx(wall)


def test_joints_belong_to_a_face_that_their_material_reaches():
    body = lattice(grid() + np.array([0.4, 0.0, 0.0]))
    assert len(nodes_in(body, LEFT)) == 9
    assert len(nodes_in(body, InBox((-1, -1, -1), (11, 1, 1)))) == 2
    with pytest.raises(VolfrepError, match=r"Nothing of the part lies in the plane .* 0.4 mm off"):
        nodes_in(lattice(body.nodes, reach=0.1), LEFT)


def test_a_point_takes_the_nearest_node_and_a_line_those_along_it():
    body = lattice(grid())
    assert nodes_in(body, NearPoint((10.4, 9.0, 0.3))).tolist() == [12]
    assert len(nodes_in(body, NearPoint((0, 0, 0), 10.0))) == 4
    line = OnLine(np.array([[0.0, 0, 0], [15, 0, 0], [15, 10, 0]]), "edge 3")
    assert len(nodes_in(body, line)) == 2
    assert line.distance(np.array([[15.0, 5, 2], [-3, 0, 4]])).tolist() == [2.0, 5.0]
    with pytest.raises(
        VolfrepError, match=r"point .500, 0, 0.: the nearest node, at .30, 0, 0., is"
    ):
        nodes_in(body, NearPoint((500, 0, 0)))


def test_facets_picked_elsewhere_are_found_on_a_finer_mesh():
    coarse, fine = box(edge=0), box(edge=2.0)
    top = smooth_faces(coarse)
    number = top[np.argmax(coarse.vertices[coarse.triangles][:, :, 2].sum(axis=1))]
    picked = OnFacets(np.stack(coarse.corners(), axis=1)[top == number], "face 6")
    share = share_of(skin(fine), picked)
    assert share.area == pytest.approx(600.0)
    assert set(fine.vertices[share.nodes, 2]) == {10.0}


def test_a_box_has_six_faces_and_a_tube_four_the_largest_first():
    faces = smooth_faces(box())
    areas = [share_of(skin(), OnFacets(np.stack(box().corners(), 1)[faces == k])).area
             for k in range(1, 7)]  # fmt: skip
    assert areas == pytest.approx([600, 600, 300, 300, 200, 200])
    tube = mesh_of(trimesh.creation.annulus(r_min=4.0, r_max=15.0, height=6.0, sections=64))
    assert smooth_faces(tube).max() == 4


# --- totals --------------------------------------------------------------------------------------

VECTORS = st.tuples(*[st.floats(-1e4, 1e4, allow_subnormal=False)] * 3)


@pytest.mark.parametrize("body", [skin(), lattice(grid())], ids=["skin", "lattice"])
@pytest.mark.parametrize("region", [RIGHT, AnyOf((LEFT, RIGHT)), InBox((-1, -1, -1), (40, 4, 40))])
@given(force=VECTORS, at=VECTORS)
def test_a_force_acts_through_its_point_whatever_carries_it(body, region, force, at):
    loads = nodal_loads(body, Force(region, force, at))
    total, moment = resultant(body.nodes, loads, np.array(at))
    size = 1e-9 * (1.0 + np.abs(force).max()) * (1.0 + np.abs(at).max())
    assert np.abs(total - force).max() <= size
    assert np.abs(moment).max() <= 1e2 * size


@pytest.mark.parametrize("body", [skin(turns=False), lattice(grid())], ids=["skin", "lattice"])
@given(moment=VECTORS)
def test_a_moment_is_forces_that_add_up_to_nothing_but_it(body, moment):
    loads = nodal_loads(body, Moment(RIGHT, moment))
    assert not loads[:, 3:].any()
    for about in (np.zeros(3), np.array([3.0, -70.0, 2.0])):
        total, turning = resultant(body.nodes, loads, about)
        assert np.abs(total).max() <= 1e-9 * (1.0 + np.abs(moment).max())
        assert np.abs(turning - moment).max() <= 1e-7 * (1.0 + np.abs(moment).max())


def test_a_force_without_a_point_turns_nothing_at_the_middle_of_its_area():
    body = skin()
    loads = nodal_loads(body, Force(RIGHT, (0.0, -300.0, 40.0)))
    force, moment = resultant(body.nodes, loads, np.array([30.0, 10.0, 5.0]))
    assert force == pytest.approx([0.0, -300.0, 40.0])
    assert moment == pytest.approx([0, 0, 0], abs=1e-9)
    # Shared by area, not by nodes: a finer corner carries no more.
    on_face = body.nodes[:, 0] == 30.0
    assert (loads[~on_face] == 0).all()
    assert loads[on_face, 1].max() < 0


def test_a_pressure_pushes_inwards_by_the_area():
    body = skin()
    force, moment = resultant(
        body.nodes, nodal_loads(body, Pressure(RIGHT, 2.5)), np.array([30.0, 10.0, 5.0])
    )
    assert force == pytest.approx([-500.0, 0.0, 0.0])
    assert moment == pytest.approx([0, 0, 0], abs=1e-9)
    everywhere = nodal_loads(body, Pressure(InBox((-1, -1, -1), (99, 99, 99)), 7.0))
    force, moment = resultant(body.nodes, everywhere, np.zeros(3))
    assert np.abs([*force, *moment]).max() < 1e-9


def test_nodes_on_a_line_get_the_moment_about_it_themselves_if_they_can_turn():
    line = OnLine(np.array([[30.0, 0, 0], [30, 20, 0]]))
    body = lattice(grid())
    loads = nodal_loads(body, Moment(line, (5.0, 60.0, -7.0)))
    force, moment = resultant(body.nodes, loads, np.zeros(3))
    assert force == pytest.approx([0, 0, 0], abs=1e-12)
    assert moment == pytest.approx([5.0, 60.0, -7.0])
    assert loads[:, 3:].sum(axis=0) == pytest.approx([0.0, 60.0, 0.0])
    solid = Body(body.nodes, body.facets, body.reach, np.zeros(len(body.nodes), bool))
    with pytest.raises(VolfrepError, match="nodes on one line only"):
        nodal_loads(solid, Moment(line, (0.0, 60.0, 0.0)))


def test_what_cannot_carry_a_load_is_told():
    with pytest.raises(VolfrepError, match="A pressure needs a surface"):
        nodal_loads(lattice(grid()), Pressure(RIGHT, 1.0))
    mixed = AnyOf((RIGHT, NearPoint((0, 0, 0))))
    with pytest.raises(VolfrepError, match="cannot share a load: give each its own"):
        nodal_loads(skin(), Force(mixed, (1.0, 0, 0)))
    with pytest.raises(VolfrepError, match=r"the plane through \(99, 0, 0\)"):
        nodal_loads(skin(), Force(AnyOf((RIGHT, InPlane((99, 0, 0), (1, 0, 0)))), (1.0, 0, 0)))


# --- a case on a body ----------------------------------------------------------------------------


def test_a_case_holds_what_its_supports_say():
    body = lattice(grid())
    case = LoadCase(
        "pull",
        (
            Support(LEFT, name="wall"),
            Support(RIGHT, (0.25, None, None), (True, True, True), "jaw"),
        ),
        acceleration=(0.0, 0.0, -9810.0),
    )
    laid = nodal_case(body, case)
    left, right = body.nodes[:, 0] == 0.0, body.nodes[:, 0] == 30.0
    assert laid.fixed[left].all()
    assert laid.fixed[right].tolist() == [[True] + 5 * [False]] * 9
    assert laid.prescribed[right, 0].tolist() == [0.25] * 9
    assert not laid.fixed[~left & ~right].any()
    assert not laid.loads.any()
    assert laid.acceleration.tolist() == [0.0, 0.0, -9810.0]


def test_supports_that_contradict_each_other_are_refused_by_their_node():
    case = LoadCase(
        "pull",
        (Support(LEFT), Support(InBox((0, 0, 0), (9, 0, 0)), (None, 0.5, None), name="lever")),
        (Force(RIGHT, (1.0, 0, 0)),),
    )
    with pytest.raises(
        VolfrepError, match=r"'lever' moves the node at \(0, 0, 0\) by 0.5 mm along y, another"
    ):
        nodal_case(lattice(grid()), case)


def test_a_place_that_takes_nothing_is_told_with_case_and_name():
    case = LoadCase("bend", (Support(LEFT),), (Force(NearPoint((0, 0, 80), 2.0), (1.0, 0, 0)),))
    with pytest.raises(VolfrepError) as told:
        nodal_case(skin(), case)
    assert str(told.value) == (
        "Load case 'bend', 'force': Nothing of the part lies in the ball of radius 2 mm about "
        "(0, 0, 80): the nearest node, at (0, 0, 10), is 68 mm off; check the place, in mm, or "
        "enlarge the region."
    )


# --- files ---------------------------------------------------------------------------------------

FILE = """
material = "ti-6al-4v"
yield_stress = 903

[[support]]
name = "bolts"
any = [
  { cylinder = { point = [5, 5, 0], axis = [0, 0, 1], radius = 3 } },
  { face = [30, 10, 5] },
]
fixed = true

[[case]]
name = "vertical"
[[case.load]]
plane = { point = [0, 0, 10], normal = [0, 0, 1] }
box = { low = [0, 0, 0], high = ["1 cm", 20, 10] }
force = [0, 0, "35.6 kN"]

[[case]]
name = "torsion"
acceleration = [0, 0, "-1 g"]
[[case.support]]
sphere = { point = [0, 0, 0], radius = 2 }
x = 0
z = "0.1 mm"
[[case.load]]
face = 1
moment = [0, 0, "565 N m"]
[[case.load]]
point = [1, 2, 3]
force = [1, 0, 0]
at = [0, 0, 50]
[[case.load]]
face = 2
pressure = "2 bar"
"""


def read(text, tmp_path, solid=None):
    file = tmp_path / "loads.toml"
    file.write_text(text, encoding="utf-8")
    return read_load_cases(file, solid)


def test_a_file_says_what_a_program_could(tmp_path):
    cases = read(FILE, tmp_path, box())
    assert (cases.material.name, cases.material.yield_stress) == ("Ti-6Al-4V", 903.0)
    vertical, torsion = cases.cases
    bolts = vertical.supports[0]
    assert bolts.name == "bolts"
    assert bolts.displacement == (0.0, 0.0, 0.0)
    assert bolts.turns == (False, False, False)
    assert bolts.region.regions[0] == InCylinder((5, 5, 0), (0, 0, 1), 3)
    assert set(bolts.region.regions[1].corners[:, :, 0].ravel()) == {30.0}
    (push,) = vertical.loads
    assert push.force == (0.0, 0.0, 35600.0)
    assert push.region == AllOf((InPlane((0, 0, 10), (0, 0, 1)), InBox((0, 0, 0), (10, 20, 10))))
    assert torsion.acceleration == (0.0, 0.0, -9806.65)
    assert torsion.supports == (
        bolts,
        Support(NearPoint((0, 0, 0), 2), (0.0, None, 0.1), (True, True, True), "support 1"),
    )
    moment, arm, push = torsion.loads
    assert moment.moment == (0.0, 0.0, 565_000.0)
    assert (arm.region, arm.at) == (NearPoint((1, 2, 3)), (0.0, 0.0, 50.0))
    assert push.pressure == pytest.approx(0.2)
    # And all of it finds its place.
    for case in cases.cases:
        nodal_case(skin(box(edge=1.0)), case)


def test_a_material_may_stand_in_the_file_itself(tmp_path):
    text = FILE.replace('material = "ti-6al-4v"', "").replace("yield_stress = 903", "")
    own = "[material]\nname = 'Mine'\ndensity = 1.1\nyoung = 2000\npoisson = 0.4\n"
    assert read(own + text, tmp_path, box()).material.young == 2000.0


ONE = """material = "PA12"
[[support]]
{support}
[[case]]
[[case.load]]
{load}
"""
FIX = "face = 1\nfixed = true"
PUSH = "face = 2\nforce = [0, 0, 1]"


@pytest.mark.parametrize(
    ("support", "load", "told"),
    [
        ("fixed = true", PUSH, "support 1: it says nowhere: give one of plane, box"),
        ("face = 1", PUSH, "support 1: give either fixed = true, or displacements"),
        ("face = 1\nfixed = true\nx = 0", PUSH, "support 1: give either fixed = true"),
        ("face = 1\nfixd = true", PUSH, "unknown entry 'fixd': the nearest is 'fixed'"),
        ("face = 1\nx = '1 kg'", PUSH, "support 1, x: 'kg' is no unit of length: use mm, um"),
        ("face = 1\nx = 'wide'", PUSH, "support 1, x: 'wide' is no length such as 10 or"),
        (
            "face = 9\nfixed = true",
            PUSH,
            "9 is no face: give its number, from 1 for the largest to 6",
        ),
        (FIX, "face = 2", "case 'case 1', load 1: it gives none: give one of force, moment"),
        (FIX, PUSH + "\npressure = 1", "load 1: it gives force and pressure: give one of"),
        (FIX, "face = 2\nforce = 5", "load 1, force: 5 is no list of three, such as [0, 0, 10]"),
        (FIX, "face = 2\nforce = [0, nan, 1]", "load 1, force: nan is no force: give a number"),
        (FIX, "face = 2\nmoment = [0, 0, '5 N']", "'N' is no unit of moment: use N mm, N m"),
        (FIX, "face = 2\nmoment = [0, 0, 5]\nat = [0, 0, 0]", "at: only a force acts at a point"),
        (
            FIX,
            "box = { low = [0, 0, 0] }\nforce = [0, 0, 1]",
            "box: it has no 'high': give low and",
        ),
        (FIX, "box = { low = [1, 0, 0], high = [0, 1, 1] }\nforce = [0, 0, 1]", "inside out"),
        (FIX, "plane = 3\nforce = [0, 0, 1]", "plane: 3 is no table such as { point"),
        (FIX, "any = []\nforce = [0, 0, 1]", "any: it is no list of regions such as"),
        (FIX, "any = [{ fase = 1 }]\nforce = [0, 0, 1]", "any 1: it has an unknown entry 'fase'"),
        (
            FIX,
            "cylinder = { point = [0, 0, 0], axis = [0, 0, 0], radius = 3 }\nforce = [0, 0, 1]",
            "cylinder: The axis of a cylinder must not be zero.",
        ),
        (
            FIX,
            "sphere = { point = [0, 0, 0], radius = -3 }\nforce = [0, 0, 1]",
            "must be above 0 mm, not -3",
        ),
    ],
)
def test_a_mistake_is_told_by_its_place(support, load, told, tmp_path):
    with pytest.raises(VolfrepError) as error:
        read(ONE.format(support=support, load=load), tmp_path, box())
    assert told in str(error.value)
    assert str(error.value).startswith(str(tmp_path / "loads.toml"))


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "it needs a material"),
        ("material = 'Cheese'", "material: There is no material 'Cheese'"),
        ("[material]\nyoung = 3", "has no 'density'"),
        ("material = 'PA12'", "it has no load case: begin one with [[case]]"),
        ("material = 'PA12'\n[case]\nname = 'a'", "case: begin each with [[...case]]"),
        ("material = 'PA12'\n[[case]]\nname = 'a'", "case 'a': The load case 'a' has no support"),
        ("material = 'PA12'\n[[case]]\nname = 3", "case 1, name: 3 is no text"),
        ("matreial = 'PA12'", "unknown entry 'matreial': the nearest is 'material'"),
        ("material = ", "is no TOML"),
        (
            "material = 'PA12'\n[[support]]\npoint = [0, 0, 0]\nfixed = true\n[[case]]\nname = 'a'",
            "The load case 'a' has no load",
        ),
        (
            "material = 'PA12'\nsupport = [{ point = [0, 0, 0], fixed = true }]\n"
            + 2 * "[[case]]\nname = 'a'\nacceleration = [0, 0, 1]\n",
            "Two load cases have the name 'a'",
        ),
    ],
)
def test_a_file_without_a_sense_is_refused(text, told, tmp_path):
    with pytest.raises(VolfrepError) as error:
        read(text, tmp_path, box())
    assert told in str(error.value)


def test_a_face_needs_a_part(tmp_path):
    with pytest.raises(VolfrepError, match="no part here to find a face of"):
        read(FILE, tmp_path)


def test_the_example_of_the_documentation_is_read_as_it_stands(tmp_path):
    text = (Path(__file__).resolve().parents[3] / "docs" / "loads.md").read_text("utf-8")
    blocks = [block.split("```")[0] for block in text.split("```toml\n")[1:]]
    assert blocks
    assert read(blocks[0], tmp_path, box((178.0, 62.0, 108.0), 4.0)).cases


@pytest.mark.parametrize(("angle", "count"), [(5.0, 7), (20.0, 7), (35.0, 19), (90.0, 91)])
def test_directions_of_a_cone_bear_all_between_them(angle, count):
    """Any force in the cone is a sum of some of them whose shares make hardly more than one."""
    force = (3.0, -4.0, 12.0)
    held = Support(InPlane((0, 0, 0), (1, 0, 0)))
    other = Pressure(InPlane((0, 0, 0), (0, 0, 1)), 1.0)
    case = LoadCase("rope", (held,), (other, Force(InPlane((1, 0, 0), (1, 0, 0)), force)))
    cases = cone_of(case, 1, angle)
    assert len(cases) == count
    assert cases[0].loads == case.loads
    assert len({one.name for one in cases}) == count
    assert all(one.loads[0] == other for one in cases)
    ways = np.array([one.loads[1].force for one in cases]) / 13.0
    axis = np.array(force) / 13.0
    assert np.linalg.norm(ways, axis=1) == pytest.approx(np.ones(count))
    off = np.degrees(np.arccos(np.clip(ways @ axis, -1.0, 1.0)))
    assert angle - 1e-6 < off.max() < 1.16 * angle
    random = np.random.default_rng(1)
    for _ in range(40):
        aside = np.cross(axis, random.normal(size=3))
        turn = np.radians(angle) * random.random() ** 0.5
        way = np.cos(turn) * axis + np.sin(turn) * aside / np.linalg.norm(aside)
        shares = linprog(np.ones(count), A_eq=ways.T, b_eq=way)
        assert shares.fun < 1.0 + CONE_MISSES


def test_a_cone_in_a_file_is_a_case_for_each_direction(tmp_path):
    text = """
        material = "PA12"
        [[support]]
        plane = { point = [0, 0, 0], normal = [1, 0, 0] }
        fixed = true
        [[case]]
        name = "rope"
        [[case.load]]
        plane = { point = [9, 0, 0], normal = [1, 0, 0] }
    """
    path = tmp_path / "loads.toml"
    path.write_text(text + "force = [0, 0, 10]\ncone = 30\n")
    names = [case.name for case in read_load_cases(path).cases]
    assert (len(names), names[0], names[-1]) == (19, "rope, way 1", "rope, way 19")
    for wrong, told in (
        ("force = [0, 0, 10]\ncone = 100", "up to 90"),
        ("moment = [0, 0, 10]\ncone = 10", "no force"),
        ('force = [0, 0, 10]\ncone = "x"', "no number of degrees"),
    ):
        path.write_text(text + wrong)
        with pytest.raises(VolfrepError, match=told):
            read_load_cases(path)
