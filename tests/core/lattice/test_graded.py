# SPDX-License-Identifier: LGPL-2.1-or-later
"""Graded lattices: the contract of the uniform ones holds, whatever varies."""

import numpy as np
import pytest
from scipy.stats import qmc

import samples
from contract import check_contract
from exact import in_lattice, in_struts
from samples import SKEW
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import LIBRARY, PAPERS, find_cell
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.design.scattered_field import PointField
from volfrep.grid.placement import block_placement
from volfrep.io.write.stl import as_read
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.lattice.padded_grid import narrowest
from volfrep.lattice.strut_binding import crease
from volfrep.mesh import quality
from volfrep.spatial.rays import inside_points
from volfrep.util.progress import Monitor

LINEAR = Profile("linear", 1.0, 2.0)
THICKER = RadiusGrading("direction", Profile("linear", 0.6, 1.4))

#: What is asked for besides cell and resolution, and the block's cells.
GRADINGS = {
    "radius": ({"radius_grading": THICKER}, (3, 2, 2)),
    "radius, oblique": (
        {"radius_grading": RadiusGrading("direction", Profile("quadratic", 0.4, 1.1), (1, 2, 3))},
        (2, 2, 2),
    ),
    "size": ({"size_grading": SizeGrading(LINEAR)}, (3, 2, 2)),
    "size, oblique, and radius": (
        {
            "size_grading": SizeGrading(Profile("exponential", 1.0, 1.6), (1, 1, 0.3)),
            "radius_grading": RadiusGrading("direction", Profile("linear", 0.6, 1.0), (0, 0, 1)),
        },
        (2, 2, 2),
    ),
    "cylindrical": ({"cell_map": CellMap("cylindrical"), "strut_radius": 0.6}, (2, 14, 2)),
    "spherical": ({"cell_map": CellMap("spherical"), "strut_radius": 0.5}, (1, 2, 14)),
    "turned and graded": (
        {
            "orientation": Orientation((1, 1, 0), 30.0),
            "size_grading": SizeGrading(Profile("linear", 1.0, 1.4)),
        },
        (2, 2, 2),
    ),
}


def volume_by_points(member, bounds, power=16):
    """Volume of what `member` says of points, mm3, and its standard deviation (an upper bound)."""
    low, high = bounds
    points = low + (high - low) * qmc.Sobol(3, seed=1).random(2**power)
    share = member(points).mean()
    box = float(np.prod(high - low))
    return box * share, box * np.sqrt(share * (1 - share) / 2**power)


#: A few of the pairs are looked at every time; the thickest radii leave SKEW's struts no room.
BLOCKS = [
    pytest.param(
        cell,
        grading,
        marks=() if cell.name in ("CVC", "Octahedron") or grading == "size" else pytest.mark.slow,
        id=f"{cell.name}, {grading}",
    )
    for cell in (*map(find_cell, PAPERS), SKEW)
    for grading in GRADINGS
    if (cell, grading) != (SKEW, "radius")
]


@pytest.mark.slow_but("CVC, turned and graded")
@pytest.mark.parametrize(("cell", "grading"), BLOCKS)
def test_blocks_hold_the_contract(cell, grading):
    asked, count = GRADINGS[grading]
    result = block(LatticeSpec(cell=cell, resolution=15, **asked), count)
    report, read = result.report, quality.measure(as_read(result.mesh))
    assert report.watertight
    assert read.watertight
    assert (report.bodies, report.voids) == (1, 0)
    assert report.genus == read.genus == result.wireframe.genus
    bounds = result.mesh.bounds
    volume, deviation = volume_by_points(lambda p: in_struts(p, result.wireframe), bounds)
    # Squeezed cells about a pole leave facets few: a cell is down to a third of its width there.
    tolerance = 0.025 if grading == "spherical" else 0.01
    assert report.volume_mm3 == pytest.approx(volume, abs=tolerance * volume + 3 * deviation)


def test_struts_are_deformed_with_their_cells_where_the_radius_is_not_kept():
    spec = LatticeSpec(size_grading=SizeGrading(LINEAR), keep_radius=False, resolution=15)
    plain, graded = block(LatticeSpec(resolution=15), (3, 2, 2)), block(spec, (3, 2, 2))
    _, placement = block_placement(spec.grid, (3, 2, 2))
    assert np.array_equal(graded.mesh.triangles, plain.mesh.triangles)
    assert graded.mesh.vertices == pytest.approx(placement.mapping.to_part(plain.mesh.vertices))
    cell, active = LIBRARY["CVC"], np.ones((3, 2, 2), bool)

    def member(points):
        return in_lattice(placement.mapping.to_lattice(points), cell, 10.0, 1.0, active)

    volume, deviation = volume_by_points(member, graded.mesh.bounds)
    assert graded.report.volume_mm3 == pytest.approx(volume, abs=0.01 * volume + 3 * deviation)


def test_deformed_struts_whose_radius_varies_close_around_the_turn():
    asked = {"radius_grading": RadiusGrading("direction", Profile("linear", 0.5, 0.9), (0, 1, 0))}
    spec = LatticeSpec(cell_map=CellMap("cylindrical"), keep_radius=False, resolution=15, **asked)
    result = block(spec, (2, 14, 1))
    assert result.report.watertight
    assert result.report.genus == result.wireframe.genus
    assert result.report.bodies == 1


def test_a_law_that_does_not_vary_makes_the_uniform_lattice():
    plain = block(LatticeSpec(resolution=15), (2, 2, 2))
    constant = RadiusGrading("direction", Profile("scalar", 1.0))
    graded = block(LatticeSpec(resolution=15, radius_grading=constant), (2, 2, 2))
    assert np.array_equal(graded.mesh.triangles, plain.mesh.triangles)
    assert graded.mesh.vertices == pytest.approx(plain.mesh.vertices, abs=1e-9)


def test_turning_moves_the_lattice_and_nothing_else():
    plain = block(LatticeSpec(resolution=15), (2, 2, 2))
    turned = Orientation((1, 2, 3), 70.0, (1.0, 0.0, 4.0))
    moved = block(LatticeSpec(resolution=15, orientation=turned), (2, 2, 2))
    origin = np.array(turned.origin)
    expected = (plain.mesh.vertices - origin) @ turned.matrix.T + origin
    assert moved.mesh.vertices == pytest.approx(expected, abs=1e-9)


def test_struts_are_cones_between_the_radii_of_their_nodes():
    graph = block(LatticeSpec(resolution=8, radius_grading=THICKER), (3, 2, 2)).wireframe
    low, high = graph.nodes[:, 0].min(), graph.nodes[:, 0].max()
    expected = 0.6 + 0.8 * (graph.nodes[:, 0] - low) / (high - low)
    assert graph.radii == pytest.approx(expected[graph.struts])
    assert graph.joint_radii == pytest.approx(expected * (1 + expected / 10.0))


@pytest.mark.parametrize("radius", [0.4, 1.0])
def test_a_ruling_leaves_its_joint_where_marching_along_it_says(radius):
    random = np.random.default_rng(5)
    directions = random.normal(size=(6, 3))
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    slopes = random.uniform(-0.05, 0.05, 6)
    axis, slope, joint = directions[0], slopes[0], 1.1 * radius
    radial = np.cross(axis, random.normal(size=(40, 3)))
    radial /= np.linalg.norm(radial, axis=1)[:, None]
    found = crease(
        np.tile(axis, (40, 1)), radial, np.full(40, radius), np.full(40, slope),
        np.full(40, joint), np.tile(directions, (40, 1, 1)), np.tile(slopes, (40, 1)),
        np.tile(np.arange(6) > 0, (40, 1)),
    )  # fmt: skip
    of_one_strut = crease(
        axis[None], radial, np.array([radius]), np.array([slope]), np.array([joint]),
        directions[None], slopes[None], (np.arange(6) > 0)[None], np.zeros(40, np.int64),
    )  # fmt: skip
    np.testing.assert_array_equal(of_one_strut, found)
    t = np.arange(0.0, 12.0, 0.001)
    for k in range(40):
        points = t[:, None] * axis + (radius + slope * t)[:, None] * radial[k]
        inside = np.linalg.norm(points, axis=1) <= joint
        for other, growth in zip(directions[1:], slopes[1:], strict=True):
            along = points @ other
            gap = np.linalg.norm(points - along[:, None] * other, axis=1)
            inside |= (along >= 0) & (gap <= radius + growth * along)
        assert found[k] == pytest.approx(t[inside].max(), abs=0.003)


def trimmed_by_points(result, solid, power=16):
    """Volume of the struts inside a solid."""

    def member(points):
        inside = inside_points(solid, points, Monitor())
        inside[inside] = in_struts(points[inside], result.wireframe)
        return inside

    return volume_by_points(member, solid.bounds, power)


SAMPLE_FIELD = PointField(
    np.random.default_rng(0).uniform(-30, 60, (400, 3)), np.random.default_rng(1).random(400)
)
FILLED = {
    "size": {"size_grading": SizeGrading(LINEAR)},
    "size, stretched": {"size_grading": SizeGrading(LINEAR), "keep_radius": False},
    "turned": {"orientation": Orientation((1, 1, 0), 33.0)},
    "skin": {"radius_grading": RadiusGrading("skin", Profile("linear", 0.5, 1.0), reach=8.0)},
    "core": {"radius_grading": RadiusGrading("core", Profile("linear", 0.5, 1.0), reach=8.0)},
    "field": {
        "radius_grading": RadiusGrading("field", Profile("linear", 0.5, 1.0), field=SAMPLE_FIELD)
    },
    "cylindrical": {"cell_map": CellMap("cylindrical"), "strut_radius": 0.5},
    "spherical": {"cell_map": CellMap("spherical", around=16), "strut_radius": 0.4},
    "filleted": {"size_grading": SizeGrading(LINEAR), "fillet": 0.5},
}


@pytest.mark.costly
@pytest.mark.slow_cases(
    "not convex-core",
    "not convex-cylindrical",
    "not convex-field",
    "not convex-filleted",
    "not convex-size, stretched",
    "not convex-size",
    "not convex-skin",
    "not convex-spherical",
)
@pytest.mark.parametrize("grading", FILLED)
@pytest.mark.parametrize(
    "make",
    [
        pytest.param(samples.box, id="convex", marks=pytest.mark.slow),
        pytest.param(samples.bracket, id="not convex"),
    ],
)
def test_parts_hold_the_contract(make, grading):
    solid = make()
    size = 8.0 if make is samples.box else 12.0
    asked = {"strut_radius": 0.08 * size, "cell_size": size} | FILLED[grading]
    part = fill(solid, LatticeSpec(shell=1.5, resolution=12, **asked)).report
    assert part.watertight
    assert part.bodies == 1
    # Without a skin, and all the cells that touch: what lies in the solid is what struts fill.
    result = fill(solid, LatticeSpec(shell=0.0, output="lattice", resolution=12, **asked))
    read = quality.measure(as_read(result.mesh))
    assert read.watertight
    assert read.genus == result.report.genus
    if grading in ("size, stretched", "filleted"):
        return  # not cones and spheres
    volume, deviation = trimmed_by_points(result, solid)
    dropped = 0.01 * volume if result.report.pieces_removed else 0.0
    assert result.report.volume_mm3 == pytest.approx(
        volume, abs=0.01 * volume + 3 * deviation + dropped
    )


@pytest.mark.slow
def test_the_skin_is_where_struts_are_thick_and_the_core_where_they_are_thin():
    solid = samples.box()
    for by, at_skin in (("skin", 1.0), ("core", 0.5)):
        asked = RadiusGrading(by, Profile("linear", 0.5, 1.0), reach=6.0)
        graph = fill(solid, LatticeSpec(cell_size=8.0, radius_grading=asked)).wireframe
        low, high = solid.bounds
        depth = np.minimum(graph.nodes - low, high - graph.nodes).min(axis=1)
        radius = np.zeros(len(graph.nodes))
        radius[graph.struts] = graph.radii
        assert radius[depth <= 0.0] == pytest.approx(at_skin)
        assert radius[depth >= 6.0] == pytest.approx(1.5 - at_skin)


def test_a_field_sets_the_radius_through_its_curve():
    points = np.stack([np.linspace(0.0, 40.0, 200), np.full(200, 15.0), np.full(200, 10.0)], axis=1)
    field = PointField(points, points[:, 0])
    curve = ((0.0, 0.5), (10.0, 0.5), (30.0, 1.0))
    asked = RadiusGrading("field", Profile("linear", 0.5, 1.0), field=field, curve=curve)
    graph = fill(samples.box(), LatticeSpec(cell_size=8.0, radius_grading=asked)).wireframe
    on_line = np.abs(graph.nodes - [0, 15, 10])[:, 1:].max(axis=1) < 6.0
    radius = np.zeros(len(graph.nodes))
    radius[graph.struts] = graph.radii
    expected = np.interp(graph.nodes[:, 0], [10.0, 30.0], [0.5, 1.0])
    assert radius[on_line] == pytest.approx(expected[on_line], abs=0.06)


@pytest.mark.slow
def test_cells_about_an_axis_leave_room_for_their_struts():
    """None is squeezed to less than what its struts need: the lattice is hollow about the axis."""
    spec = LatticeSpec(
        cell_size=10.0, strut_radius=0.8, resolution=8, cell_map=CellMap("cylindrical")
    )
    solid = samples.box((44.0, 44.0, 14.0))
    result = fill(solid, spec)
    middle = solid.bounds.mean(axis=0)
    out = np.linalg.norm((result.wireframe.nodes - middle)[:, :2], axis=1)
    assert out.min() > narrowest(spec.unit_cell(), 10.0, 0.8) * 10.0 / 2
    assert result.report.bodies == 1


@pytest.mark.costly_cases("asked2-grow into each other")
@pytest.mark.parametrize(
    ("asked", "says"),
    [
        ({"size_grading": SizeGrading(Profile("linear", 2.0, 0.5))}, "folds"),
        (
            {"radius_grading": RadiusGrading("direction", Profile("linear", 1.0, 3.0))},
            "too thick|grow",
        ),
        ({"cell_size": 3.0, "strut_radius": 0.5, "cell": "Octet",
          "size_grading": SizeGrading(Profile("linear", 0.4, 1.0))}, "grow into each other"),
    ],
)  # fmt: skip
def test_what_cannot_be_made_is_refused_with_a_sentence(asked, says):
    with pytest.raises(VolfrepError, match=says):
        fill(samples.box(), LatticeSpec(**({"cell_size": 6.0} | asked)))


def test_a_block_has_no_skin_to_grade_by():
    asked = RadiusGrading("skin", Profile("linear", 0.5, 1.0))
    with pytest.raises(VolfrepError, match="no skin"):
        block(LatticeSpec(radius_grading=asked), (2, 2, 2))


def random_grading(random, size):
    asked = {}
    vector = tuple(random.normal(size=3))
    kind = str(random.choice(["scalar", "linear", "quadratic", "exponential"]))
    if random.random() < 0.6:
        asked["size_grading"] = SizeGrading(
            Profile(kind, 1.0, float(random.uniform(0.8, 1.8))), vector
        )
    if random.random() < 0.6:
        by = str(random.choice(["direction", "skin", "core"]))
        profile = Profile(kind, *(size * random.uniform(0.05, 0.1, 2)))
        asked["radius_grading"] = RadiusGrading(by, profile, vector, reach=float(size))
    if random.random() < 0.4:
        asked["orientation"] = Orientation(vector, float(random.uniform(0, 360)))
    if random.random() < 0.3:
        asked["cell_map"] = CellMap(str(random.choice(["cylindrical", "spherical"])), axis=vector)
    asked["keep_radius"] = bool(random.random() < 0.7)
    asked["fillet"] = 0.03 * size * float(random.integers(2))
    return asked


@pytest.mark.slow
@pytest.mark.parametrize(
    "seed", [pytest.param(s, marks=pytest.mark.slow if s >= 5 else ()) for s in range(80)]
)
def test_random_gradings_hold_the_contract(seed):
    random = np.random.default_rng(seed)
    makes = (samples.box, samples.sphere, samples.plate, lambda: samples.bracket(17.0))
    solid = makes[random.integers(len(makes))]()
    extent = np.sort(np.ptp(solid.bounds, axis=0))
    size = float(random.uniform(0.2, 0.5) * extent[1])
    spec = LatticeSpec(
        cell=random.choice([*map(find_cell, PAPERS), SKEW]),
        cell_size=size,
        strut_radius=0.07 * size,
        shell=float(random.choice([0.0, 0.05, 0.1]) * extent[0]),
        output=str(random.choice(["part", "lattice"])),
        activation=str(random.choice(["touching", "centre"])),
        resolution=int(random.integers(8, 16)),
        **random_grading(random, size),
    )
    check_contract(solid, spec, refusals=("reduce", "folds"))
