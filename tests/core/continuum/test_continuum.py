# SPDX-License-Identifier: LGPL-2.1-or-later
"""Homogenised parts against closed forms, beams with a shell skin, and CalculiX on their deck."""

import json
import shutil
import subprocess
from dataclasses import replace

import numpy as np
import pytest
import trimesh

import volfrep
from command import run
from tools.validation.homogenised import WHOLE, block, compared, end, loaded, moved
from volfrep import LatticeSpec, VolfrepError
from volfrep.continuum.bricks import Bricks, Shares, constants
from volfrep.continuum.cell_law import split, stretched_tensors, turned
from volfrep.continuum.cut_cells import cut_cells, near_free_faces
from volfrep.continuum.eigen import lumped_mass
from volfrep.design.cells import LIBRARY, PAPERS
from volfrep.design.grading import Orientation, RadiusGrading, SizeGrading
from volfrep.design.parameters.spec_file import read_spec
from volfrep.design.profile import Profile
from volfrep.design.tpms.sheet import TpmsSheet
from volfrep.jobs.heat import solve_heat
from volfrep.jobs.homogenised import homogenise_part
from volfrep.jobs.part_bricks import cell_law
from volfrep.jobs.pipeline import fill
from volfrep.jobs.sized_field import FieldGoal, size_field
from volfrep.jobs.sizing import solve_struts
from volfrep.loads.load_cases import Heat, LoadCase, LoadCases, Support
from volfrep.loads.load_file import load_cases_of
from volfrep.loads.regions import InPlane, NearPoint
from volfrep.mechanics.catalogue import catalogue
from volfrep.mechanics.elements import solid_stiffness
from volfrep.mechanics.materials import find_material
from volfrep.mechanics.tensor import young
from volfrep.util.cache import StageCache
from volfrep.util.linalg import rotation

PA12 = find_material("PA12")
FREE = (True, True, True)


def test_bricks_of_any_stiffness_pass_the_patch_test_filled_or_half_filled():
    rng = np.random.default_rng(0)
    root = rng.standard_normal((6, 6))
    stiffness = root @ root.T
    edge = np.array([2.0, 1.5, 1.0])
    bricks = Bricks(edge)
    shares = np.zeros((2, 64), np.float32)
    shares[0], shares[1, :32] = 1.0, 1.0  # all of it, and half of it along x
    rest = Shares(shares, np.zeros_like(shares))
    matrices = bricks.matrices(rest, constants(stiffness)[None], np.zeros(21))
    gradient = rng.standard_normal((3, 3))
    corners = np.array([[k >> 2 & 1, k >> 1 & 1, k & 1] for k in range(8)]) * edge
    nodes = (corners @ gradient.T).ravel()
    e = 0.5 * (gradient + gradient.T)
    strain = np.array([e[0, 0], e[1, 1], e[2, 2], 2 * e[1, 2], 2 * e[0, 2], 2 * e[0, 1]])
    energy = strain @ stiffness @ strain * edge.prod()
    assert nodes @ matrices[0] @ nodes == pytest.approx(energy, rel=1e-5)
    assert nodes @ matrices[1] @ nodes == pytest.approx(energy / 2, rel=1e-5)


@pytest.mark.parametrize("parts", [4, 2, 1])
def test_a_wall_in_a_brick_bends_as_a_beam_whatever_lies_beside_it(parts):
    """Closed form: E I for each length, of a wall one, a half and a quarter of a brick thick."""
    edge, poisson, curve = np.array([2.0, 1.0, 1.0]), 0.3, 0.01
    bricks = Bricks(edge)
    solid = np.zeros((4, 4, 4), np.float32)
    solid[:, :, :parts] = 1.0
    shares = Shares(1.0 - solid.reshape(1, -1), solid.reshape(1, -1))
    nothing = constants(1e-7 * solid_stiffness(1.0, poisson))[None]
    law = constants(solid_stiffness(1000.0, poisson))
    corners = np.array([[k >> 2 & 1, k >> 1 & 1, k & 1] for k in range(8)]) * edge
    thick = parts / 4
    nodes = np.zeros((8, 3))
    nodes[:, 0] = curve * (corners[:, 0] - 1.0) * (corners[:, 2] - 0.5 * thick)
    # Free to turn up at its sides, as a strip is.
    nodes[:, 1] = -poisson * curve * (corners[:, 1] - 0.5) * (corners[:, 2] - 0.5 * thick)
    energy = nodes.ravel() @ bricks.matrices(shares, nothing, law)[0] @ nodes.ravel()
    assert energy == pytest.approx(1000.0 * thick**3 / 12 * curve**2 * 2.0, rel=1e-3)


def test_a_wall_takes_the_struts_of_the_face_that_lies_in_it_and_no_more():
    """FCC has struts in its faces only: xz is sheared by those in the two faces across y."""

    def beyond(depth):
        return lambda points: (points[:, 1] > depth).astype(float)

    places = np.array([[0, 0, 0], [0, 1, 0]])
    whole, cut = cut_cells(LIBRARY["FCC"], 0.05, places, beyond(-0.1)), 0.25
    assert whole.stiffness == pytest.approx(np.tile(np.eye(6), (2, 1, 1)))
    found = cut_cells(LIBRARY["FCC"], 0.05, places, beyond(cut))
    sheared = np.diag(found.stiffness[0])[[3, 4, 5]]
    assert sheared == pytest.approx([1, 0.5 / (1 - cut), 1], abs=0.01)
    assert found.stiffness[1] == pytest.approx(np.eye(6))
    # Of six faces and twelve edges, shared by two and by four cells, one and four are gone.
    diagonals = np.sqrt(2) * (1 + 4 * (1 - cut))
    edges = 1 + (1 - cut)
    left = (diagonals + edges) / (6 * np.sqrt(2) + 3) / (1 - cut)
    assert found.mass == pytest.approx([left, 1], abs=0.01)
    # CVC's run from corner to corner: all of them are cut as the cell is.
    corners = cut_cells(LIBRARY["CVC"], 0.05, places, beyond(cut))
    assert corners.stiffness[0] == pytest.approx(np.eye(6))
    assert corners.mass[0] == pytest.approx(1)


@pytest.mark.costly
def test_a_skin_that_takes_the_faces_of_cells_has_fewer_struts_within():
    """All over the cells, its struts would make the part 4 % stiffer than it is."""
    spec = LatticeSpec("FCC", cell_size=10, strut_radius=0.8, shell=2)
    assert compared(block(80, 40, 40), spec, loaded(80)) == pytest.approx(1, abs=0.02)


def test_a_tpms_is_softer_behind_free_faces_and_not_behind_a_skin():
    """A ball of lattice in a skin that is open at one side."""
    lattice, solid = np.zeros((2, 12, 12, 12))
    lattice[1:11, 1:11, 1:11] = 1.0
    solid[:10, 1:11, 1:11] = 1.0
    lattice[:10, 3:9, 3:9], solid[:10, 3:9, 3:9] = 1.0, 0.0
    lattice, solid = lattice * (solid == 0.0), solid
    step = np.ones(3)
    found = near_free_faces(lattice, solid, step, 3.0)
    assert found[:, 5, 5].tolist() == [1.0] * 3 + [0.0] * 5 + [1.0] * 3 + [0.0]
    everywhere = np.ones((6, 6, 6))
    assert near_free_faces(everywhere, 0 * everywhere, step, 1.0).sum() == 6**3 - 4**3
    thin = np.pad(0.9 * np.ones((4, 4, 4)), 1, constant_values=0.1)  # a skin thinner than parts
    assert not near_free_faces(1.0 - thin, thin, step, 1.0).any()


@pytest.mark.costly
def test_a_bare_gyroid_of_six_cells_moves_as_its_mesh_on_voxels_does():
    """Voxels of 0.6 and 0.9 mm, extrapolated: 0.752 and 4.96 N mm; endless cells 0.696 and 4.59."""
    spec = LatticeSpec("Gyroid", cell_size=10, wall=TpmsSheet("sheet", 1.2), shell=0)
    cases = tuple(loaded(60, force) for force in ((100.0, 0.0, 0.0), (0.0, 0.0, 100.0)))
    cases = (cases[0], replace(cases[1], name="sideways"))
    made = homogenise_part(block(60, 60, 60), spec, LoadCases(PA12, cases))
    works = [case["work_nmm"] for case in made.report["cases"]]
    assert works == pytest.approx([0.752, 4.96], rel=0.05)


def test_turned_and_stretched_cells_are_what_they_were_where_nothing_is_done():
    turn = rotation(np.array([1.0, 2.0, 3.0]), 0.7)
    tensor = catalogue()["FCC"].tensor(0.08)
    after = turned(tensor[None], turn[None])[0]
    for way in np.eye(3):
        assert young(after, turn @ way) == pytest.approx(young(tensor, way))
    assert turned(after[None], turn.T[None])[0] == pytest.approx(tensor)
    frames, stretches = split((turn @ np.diag([1.0, 1.2, 0.9]))[None])
    assert frames[0] == pytest.approx(turn)
    assert stretches[0] == pytest.approx(np.diag([1.0, 1.2, 0.9]))
    law = cell_law(LatticeSpec("Octet", strut_radius=0.8, cell_size=10))
    same = stretched_tensors(LIBRARY["Octet"], 10.0, np.array([0.8]), np.eye(3)[None], law)
    assert same[0] == pytest.approx(law.tensors[0], rel=0.12, abs=1e-5)
    longer = stretched_tensors(
        LIBRARY["Octet"], 10.0, np.array([0.8]), np.diag([1.5, 1.0, 1.0])[None], law
    )
    assert longer[0, 0, 0] > longer[0, 1, 1]  # struts lean towards x


def test_whole_cells_have_all_struts_of_their_free_faces():
    """Closed form: a block of Box pulled along x is its (n + 1)^2 struts, side by side."""
    loads = LoadCases(PA12, (moved(60, (0.06, None, None)),))
    spec = LatticeSpec("Box", strut_radius=0.5, **WHOLE)
    made = homogenise_part(block(60, 30, 30), spec, loads, element=5)
    closed = PA12.young * 16 * np.pi * 0.25 / 60 * 0.06**2
    # Joints stiffen them by some percent.
    assert closed < made.report["cases"][0]["work_nmm"] < 1.08 * closed
    assert "3 cells" in made.report["notes"][0]


@pytest.mark.costly
def test_a_skinned_part_moves_as_beams_and_shells_do():
    spec = LatticeSpec("Octet", cell_size=10, strut_radius=0.8, shell=2)
    assert compared(block(80, 40, 40), spec, loaded(80)) == pytest.approx(1, abs=0.05)


@pytest.mark.slow
@pytest.mark.parametrize("cell", PAPERS)
def test_skinned_parts_of_six_cells_move_as_beams_and_shells_do(cell):
    spec = LatticeSpec(cell, cell_size=10, strut_radius=0.8, shell=2)
    assert compared(block(120, 60, 60), spec, loaded(120)) == pytest.approx(1, abs=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("cell", PAPERS)
def test_whole_blocks_of_six_cells_are_pulled_as_beams_are(cell):
    spec = LatticeSpec(cell, strut_radius=0.8, **WHOLE)
    found = compared(block(120, 60, 60), spec, moved(120, (0.1, None, None)))
    assert found == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize("count", [3, pytest.param(6, marks=pytest.mark.slow)])
def test_whole_blocks_of_box_are_pushed_sideways_as_their_beams_are(count):
    """Its bricks are cells: in smaller ones faces shear by layers that no strut can follow."""
    spec = LatticeSpec("Box", strut_radius=0.8, **WHOLE)
    solid = block(20 * count, 10 * count, 10 * count)
    found = compared(solid, spec, moved(20 * count, (0.0, 0.0, 0.1)))
    assert found == pytest.approx(1, abs=0.03)


@pytest.mark.costly
def test_gradings_turns_and_maps_are_followed():
    solid, case = block(60, 20, 20), loaded(60, (100.0, 0, 0))
    loads = LoadCases(PA12, (case,))

    def work(cell="Octet", **more):
        given = {"cell_size": 5, "strut_radius": 0.4, "shell": 0, **more}
        made = homogenise_part(solid, LatticeSpec(cell, **given), loads, element=2.5)
        return made.report["cases"][0]["work_nmm"]

    even = work()
    graded = work(radius_grading=RadiusGrading("direction", Profile("linear", 0.3, 0.5)))
    assert work(strut_radius=0.5) < graded < work(strut_radius=0.3)
    # Struts of cells that grow along the pull lean towards it.
    assert work(size_grading=SizeGrading(Profile("linear", 1.0, 1.6))) < 0.9 * even
    assert work("Box", orientation=Orientation(angle=45)) > 3 * work("Box")


@pytest.mark.slow
def test_growing_cells_are_pulled_as_their_beams_are():
    grown = SizeGrading(Profile("linear", 1.0, 1.5))
    spec = LatticeSpec("Octet", cell_size=10, strut_radius=0.8, shell=2, size_grading=grown)
    assert compared(block(120, 60, 60), spec, loaded(120)) == pytest.approx(1, abs=0.08)


def test_what_does_not_repeat_is_refused():
    loads = LoadCases(PA12, (loaded(40),))
    spec = LatticeSpec(
        "Gyroid", cell_size=5, shell=0, size_grading=SizeGrading(Profile("linear", 1.0, 1.5))
    )
    with pytest.raises(VolfrepError, match="cannot be homogenised"):
        homogenise_part(block(40, 20, 20), spec, loads)


@pytest.mark.costly
def test_heat_runs_along_a_bar_as_its_conductivity_says():
    loads = LoadCases(PA12, (loaded(60),))
    spec = LatticeSpec("Octet", strut_radius=0.8, cell_size=10, shell=0)
    made = homogenise_part(block(60, 30, 30), spec, loads)
    values, flow = made.conduct([(end(0), 100.0), (end(60), 20.0)], 0.25)
    share = cell_law(spec).conductivity[0]
    expected = 0.25e-3 * share * 900 / 60 * 80
    assert flow == pytest.approx([expected, -expected], rel=1e-4)
    middle = np.abs(made.model.nodes[:, 0] - 30) < 1e-6
    assert values[middle] == pytest.approx(60.0)


def test_heat_that_flows_in_at_an_end_warms_lattice_and_skin():
    """Closed form: between skin and lattice side by side, and one after the other."""
    out, into = Heat(end(60), temperature=20.0), Heat(end(0), power=1.0, name="chip")
    loads = LoadCases(PA12, (loaded(60),), heat=(out, into), conductivity=0.25)
    spec = LatticeSpec("Octet", strut_radius=0.8, cell_size=10, shell=2)
    made = homogenise_part(block(60, 30, 30), spec, loads, element=5)
    share, whole, core = cell_law(spec).conductivity[0], 30**2, 26**2
    beside = share * core + whole - core
    caps = 4 / whole + 56 / beside  # sections at one temperature: least resistance
    apart = 1 / ((whole - core) / 60 + core / (4 + 56 / share))  # no heat goes across: most
    chip = made.report["heat"][1]
    # Bricks of 5 mm see caps of 2 mm a little too thick.
    assert 0.98 * caps / 0.25e-3 < chip["temperature"] - 20.0 < apart / 0.25e-3
    assert made.report["heat"][0]["power_w"] == pytest.approx(-1.0)
    assert made.report["resistance_k_w"] == pytest.approx(chip["temperature"] - 20.0)
    assert ("heat chip", f"{chip['temperature']:.5g} degrees, gives 1 W") in made.rows()
    with pytest.raises(VolfrepError, match="volfrep homogenise"):
        solve_struts(block(60, 30, 30), spec, loads)


def test_heat_alone_needs_no_load_case_and_is_known_between_nodes():
    """Closed form: linear along a bar; and as Fourier says through it."""
    tables = [
        {"plane": {"point": (x, 0, 0), "normal": (1, 0, 0)}, "temperature": warm}
        for x, warm in ((0, 80), (60, 20))
    ]
    loads = load_cases_of({"material": "PA12", "conductivity": 7.0, "heat": tables})
    spec = LatticeSpec("Octet", strut_radius=0.8, cell_size=10, shell=0)
    solid, cache = block(60, 20, 20), StageCache()
    found = solve_heat(solid, spec, loads, cache=cache)
    share = cell_law(spec).conductivity[0]
    assert found.faces[0]["power_w"] == pytest.approx(7e-3 * share * 400, rel=1e-4)
    assert found.ends == (20.0, 80.0)
    points = np.random.default_rng(0).uniform((0, 0, 0), (60, 20, 20), (50, 3))
    assert found.at(points) == pytest.approx(80.0 - points[:, 0], abs=1e-3)
    assert found.at(np.array([[-5.0, 10.0, 10.0]])) == pytest.approx([80.0])
    assert solve_heat(solid, spec, loads, cache=cache) is found
    made = homogenise_part(solid, spec, loads, element=5)
    assert ("temperatures", "20 to 80 degrees") in made.rows()
    with pytest.raises(VolfrepError, match="heat alone"):
        homogenise_part(solid, spec, loads, element=5, frequencies=1)
    with pytest.raises(VolfrepError, match="heat alone"):
        size_field(solid, spec, loads, FieldGoal())
    with pytest.raises(VolfrepError, match="no load case"):
        load_cases_of({"material": "PA12"})


def led_by_struts(cell, count, radius, length):
    """W through a block of struts, k = 1 W/(mm K), 1 K from end to end: each a resistor."""
    unit = LIBRARY[cell]
    nodes, struts = np.asarray(unit.nodes), np.asarray(unit.struts)
    places = np.array(list(np.ndindex(*count)))
    ends = np.round((nodes[struts][None] + places[:, None, None]) * length, 6).reshape(-1, 2, 3)
    ends = np.array([sorted(map(tuple, one)) for one in ends.tolist()])
    points, rows = np.unique(np.unique(ends, axis=0).reshape(-1, 3), axis=0, return_inverse=True)
    own = np.pi * radius**2 / np.linalg.norm(np.diff(points[rows.reshape(-1, 2)], axis=1), axis=2)
    matrix = np.zeros((len(points), len(points)))
    for (i, j), size in zip(rows.reshape(-1, 2).tolist(), own[:, 0].tolist(), strict=True):
        matrix[[i, j], [i, j]] += size
        matrix[[i, j], [j, i]] -= size
    warm = (points[:, 0] < 1e-6).astype(float)
    free = (points[:, 0] > 1e-6) & (points[:, 0] < count[0] * length - 1e-6)
    warm[free] = np.linalg.solve(matrix[np.ix_(free, free)], -(matrix @ warm)[free])
    return float(warm @ matrix @ warm)


@pytest.mark.parametrize(("cell", "more"), [("Box", 1.01), ("BCC", 1.03), ("Octet", 1.04)])
def test_whole_cells_lead_heat_as_their_struts_do_those_in_free_faces_too(cell, more):
    """Explicit struts; joints, which the cells have and resistors have not, lead it somewhat."""
    warm = (Heat(end(0), temperature=1.0), Heat(end(40), temperature=0.0, name="cold"))
    loads = LoadCases(PA12, (loaded(40),), heat=warm, conductivity=1000.0)
    made = homogenise_part(
        block(40, 20, 20), LatticeSpec(cell, strut_radius=0.3, **WHOLE), loads, element=5
    )
    led = led_by_struts(cell, (4, 2, 2), 0.3, 10.0)
    assert made.report["heat"][0]["power_w"] / led == pytest.approx(more, abs=0.01)
    assert made.report["resistance_k_w"] == pytest.approx(1 / (more * led), rel=0.01)
    assert "thermal resistance" in dict(made.rows())


def test_a_film_takes_heat_as_its_resistance_behind_the_bar_says():
    """Closed form: bar and film one after the other; a slender fin between lattice and air."""
    spec = LatticeSpec("Octet", strut_radius=0.8, cell_size=10, shell=0)
    share = cell_law(spec).conductivity[0]
    chip, air = Heat(end(0), power=1.0), Heat(end(60), temperature=20.0, film=50.0, name="air")
    loads = LoadCases(PA12, (loaded(60),), heat=(chip, air), conductivity=20.0)
    made = homogenise_part(block(60, 30, 30), spec, loads, element=5)
    warm, cool = made.report["heat"]
    outside = 20.0 + 1.0 / (50e-6 * 900)
    assert cool["power_w"] == pytest.approx(-1.0, rel=1e-4)
    assert cool["temperature"] == pytest.approx(outside, rel=1e-3)
    inside = outside + 60 / (20e-3 * share * 900)
    assert warm["temperature"] == pytest.approx(inside, rel=5e-3)
    assert made.report["resistance_k_w"] == pytest.approx(inside - 20.0, rel=5e-3)
    sides = [InPlane((0, y, 0), (0, 1, 0)) for y in (0, 10)]
    sides += [InPlane((0, 0, z), (0, 0, 1)) for z in (0, 10)]
    films = [(side, 20.0, 5.0) for side in sides]
    fin = homogenise_part(block(120, 10, 10), spec, LoadCases(PA12, (loaded(120),)), element=5)
    values, gives = fin.conduct([(end(0), 100.0)], 20.0, (), films)
    along = np.sqrt(5e-6 * 40 / (20e-3 * share * 100))
    expected = 80 * np.sqrt(5e-6 * 40 * 20e-3 * share * 100) * np.tanh(along * 120)
    assert gives[0] == pytest.approx(expected, rel=0.01)
    assert gives.sum() == pytest.approx(0.0, abs=1e-4 * expected)
    tip = np.abs(fin.model.nodes[:, 0] - 120) < 1e-6
    assert values[tip].mean() - 20 == pytest.approx(80 / np.cosh(along * 120), rel=0.02)
    with pytest.raises(VolfrepError, match="give the fluid's temperature"):
        Heat(end(0), power=1.0, film=5.0)


def test_a_bar_that_is_warm_at_one_end_grows_without_stress_and_presses_where_it_is_held():
    """Closed form: by the mean of its temperature; held, by E times that strain at most."""
    warm = (Heat(end(0), temperature=20.0), Heat(end(60), temperature=120.0))
    points = (
        Support(NearPoint((0, 0, 0), 1)),
        Support(NearPoint((0, 30, 0), 1), (0.0, None, 0.0)),
        Support(NearPoint((0, 0, 30), 1), (0.0, None, None)),
    )
    free = LoadCase("free", points, heated=(1e-4, 20.0))
    ends = (Support(end(0), turns=FREE), Support(end(60), (0.0, None, None), FREE))
    held = LoadCase("held", ends, heated=(1e-4, 20.0))
    loads = LoadCases(PA12, (free, held), heat=warm, conductivity=0.25)
    spec = LatticeSpec("Octet", strut_radius=0.8, cell_size=10, shell=0)
    made = homogenise_part(block(60, 30, 30), spec, loads, element=5)
    along = [made.states[0].displacements[np.abs(made.model.nodes[:, 0] - x) < 1e-6, 0].mean()
             for x in (0, 60)]  # fmt: skip
    assert along[1] - along[0] == pytest.approx(1e-4 * 50 * 60, rel=0.01)
    stretched = moved(60, (-0.3, None, None))
    same = homogenise_part(block(60, 30, 30), spec, LoadCases(PA12, (stretched,)), element=5)
    most = float(np.median(same.states[0].use))
    # What bricks of 5 mm cannot follow of how its sections bow.
    assert made.states[0].use.max() < 0.12 * most
    assert np.median(made.states[1].use) == pytest.approx(most, rel=0.1)


@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX is not installed")
@pytest.mark.parametrize(("shell", "kind", "within"), [(2, "ANISO", 0.25), (0, "ORTHO", 1e-3)])
def test_calculix_solves_the_deck_alike(tmp_path, shell, kind, within):
    """A brick's mean of skin and lattice bends less stiffly than a skin at its place."""
    turn = {"orientation": Orientation(angle=30)} if shell else {}
    spec = LatticeSpec("FCC", cell_size=10, strut_radius=0.8, shell=shell, **turn)
    # Without a skin its walls cut cells in halves.
    size = (80, 40, 40) if shell else (40, 25, 25)
    made = homogenise_part(block(*size), spec, LoadCases(PA12, (loaded(size[0]),)), element=5)
    made.save(tmp_path / "part.inp")
    text = (tmp_path / "part.inp").read_text()
    assert f"*ELASTIC,TYPE={kind}" in text
    assert "*ORIENTATION" in text
    subprocess.run(["ccx", "part"], cwd=tmp_path, check=True, capture_output=True, timeout=300)
    rows = [line.split() for line in (tmp_path / "part.dat").read_text().splitlines()]
    found = np.array([row for row in rows if len(row) == 4 and row[0].isdigit()], float)
    moved_nodes = made.states[0].displacements
    assert len(found) == len(moved_nodes)
    far = np.abs(moved_nodes[:, 2]).max()
    assert np.abs(found[:, 3]).max() == pytest.approx(far, rel=within)


def test_a_part_weighs_what_its_file_does_where_a_skin_takes_struts():
    solid, spec = block(20, 20, 20), LatticeSpec("Box", cell_size=10, strut_radius=0.8, shell=2)
    made = homogenise_part(solid, spec, LoadCases(PA12, (loaded(20),)), element=4)
    volume = made.report["mass_g"] / PA12.density * 1000
    assert volume == pytest.approx(fill(solid, spec).mesh.volume, rel=0.004)
    assert lumped_mass(made.model).sum() == pytest.approx(made.report["mass_g"] * 1e-6)


@pytest.mark.costly
def test_the_command_and_the_call_say_the_same(tmp_path, capsys):
    solid = block(40, 20, 20)
    part, loads = tmp_path / "part.stl", tmp_path / "loads.toml"
    trimesh.Trimesh(solid.vertices, solid.triangles).export(part)
    loads.write_text(
        'material = "PA12"\nconductivity = 0.25\nexpansion = 1e-4\n[[support]]\n'
        "plane = {point = [0, 0, 0], normal = [1, 0, 0]}\n"
        "fixed = true\n[[case]]\n[[case.load]]\nforce = [-100, 0, 0]\n"
        "plane = {point = [40, 0, 0], normal = [1, 0, 0]}\n"
    )
    with loads.open("a") as file:
        file.write(
            '[[case]]\nname = "warm"\ntemperature = "heat"\n'
            "[[heat]]\nplane = {point = [0, 0, 0], normal = [1, 0, 0]}\ntemperature = 20\n"
            '[[heat]]\nname = "chip"\npower = 2\n'
            "plane = {point = [40, 0, 0], normal = [1, 0, 0]}\n"
        )
    told = tmp_path / "told.json"
    given = ["--cell", "Octet", "--cell-size", "5", "--strut-radius", "0.4", "--shell", "1"]
    call = ["homogenise", str(part), "--loads", str(loads), *given, "--report", str(told)]
    call += ["--frequencies", "1", "--load-factors", "1", "--element", "5"]
    assert run(*call, "-o", tmp_path / "part.vtu") == 0
    shown = capsys.readouterr().out
    for text in ("cells across", "natural frequencies", "buckles as a whole", "heat chip"):
        assert text in shown
    case, warm = json.loads(told.read_text())["cases"]
    assert warm["displacement_mm"] > 0.0
    same = {"cell": "Octet", "cell_size": 5, "strut_radius": 0.4, "shell": 1, "element": 5}
    made = volfrep.homogenise(part, loads, **same)
    assert made.report["cases"][0]["displacement_mm"] == pytest.approx(case["displacement_mm"])
    assert (tmp_path / "part.vtu").stat().st_size > 10_000
    assert run(*call, "-o", tmp_path / "part.obj") == 2


@pytest.mark.costly
def test_a_heat_sink_by_its_recipe_tells_its_thermal_resistance(tmp_path, capsys):
    """Closed form: a bar of its walls between a chip and a face in a stream."""
    solid, spec = block(32, 16, 16), read_spec("heat-sink")
    part, loads = tmp_path / "part.stl", tmp_path / "loads.toml"
    trimesh.Trimesh(solid.vertices, solid.triangles).export(part)
    loads.write_text(
        'material = "AlSi10Mg"\nconductivity = 130\n[[support]]\nfixed = true\n'
        "plane = {point = [0, 0, 0], normal = [1, 0, 0]}\n[[case]]\n[[case.load]]\n"
        "force = [0, 0, -1]\nplane = {point = [32, 0, 0], normal = [1, 0, 0]}\n"
        '[[heat]]\nname = "chip"\npower = 5\n'
        "plane = {point = [0, 0, 0], normal = [1, 0, 0]}\n"
        '[[heat]]\nname = "air"\ntemperature = 20\nfilm = 100\n'
        "plane = {point = [32, 0, 0], normal = [1, 0, 0]}\n"
    )
    told = tmp_path / "told.json"
    call = ["homogenise", str(part), "--loads", str(loads), "--spec", "heat-sink"]
    assert run(*call, "--report", told) == 0
    assert "thermal resistance" in capsys.readouterr().out
    share = cell_law(spec).conductivity[0]
    closed = 32 / (130e-3 * share * 256) + 1 / (100e-6 * 256)
    found = json.loads(told.read_text())["resistance_k_w"]
    assert found == pytest.approx(closed, rel=5e-3)
