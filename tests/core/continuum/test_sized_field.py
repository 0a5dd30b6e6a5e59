# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields sized for loads against differences, closed forms, and the filled part solved anew."""

import json
from dataclasses import replace

import numpy as np
import pytest
import trimesh

import volfrep
from command import run
from samples import solid_block as block
from volfrep import LatticeSpec, VolfrepError
from volfrep.continuum.thickness_field import FieldLimits, FieldProblem, _Search, evened
from volfrep.design.scattered_field import PointField
from volfrep.design.tpms.sheet import TpmsSheet
from volfrep.jobs.figures.sized_density import sized_densities
from volfrep.jobs.homogenised import homogenise_part
from volfrep.jobs.infill import Infill
from volfrep.jobs.part_bricks import PartBricks, cell_law
from volfrep.jobs.sized_field import FieldGoal, _grading, field_goal, homogenise_sized
from volfrep.jobs.sizing import solve_struts
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.util.progress import Monitor

PA12 = find_material("PA12")


def end(x):
    return InPlane((x, 0, 0), (1, 0, 0))


def bent(length, force=(0.0, 0.0, -100.0), weight=(0.0, 0.0, 0.0)):
    case = LoadCase("bend", (Support(end(0)),), (Force(end(length), force),), weight)
    return LoadCases(PA12, (case,))


OCTET = LatticeSpec("Octet", cell_size=10, strut_radius=0.7, shell=0)


@pytest.mark.costly
def test_changes_are_those_of_differences():
    loads = bent(40, weight=(0.0, 0.0, 1e8))
    spec = LatticeSpec(
        "Octet", cell_size=10, strut_radius=0.7, shell=1, radius_grading=_grading(0.4, 1.2)
    )
    part = PartBricks(Infill(block(40, 20, 20), spec), loads, cell_law(spec), 5.0)
    problem = FieldProblem(
        lambda t: part.model(PointField(part.middles, t)),
        lambda t: 0.0, loads.cases, part.middles, 0.4, 1.2, 10.0, Monitor(),
    )  # fmt: skip
    thickness = np.random.default_rng(0).uniform(0.66, 0.69, len(part.middles))
    way = 1.0 + 0.5 * np.sin(part.middles[:, 0] / 7)  # each its own, none against the others

    def judged(limits):
        search = _Search(problem, limits)
        model = problem.model_of(thickness)
        solved = search.solve(model)
        search.step(model, solved)
        return search, search.changes(thickness, model, solved)

    def at(search, shift):
        model = problem.model_of(thickness + shift * way)
        solved = search.solve(model)
        return search.step(model, solved), solved[0]

    def norm(values):
        return (values**12.0).sum() ** (1 / 12.0)

    even, step = evened(part.middles, 10.0), 1e-3
    search, (cost, work, _, _) = judged(FieldLimits())
    (more, _), (less, _) = at(search, step), at(search, -step)
    found = np.array([cost, work]) @ np.linalg.solve(even.toarray(), way)
    assert found[0] == pytest.approx((more.volume - less.volume) / (2 * step), rel=0.02)
    assert found[1] == pytest.approx((more.work - less.work) / (2 * step), rel=0.02)
    search, (_, _, uses, changes) = judged(FieldLimits(0.5, 1.0))
    (one, above), (_, below) = at(search, step), at(search, -step)
    assert len(uses) == 2 == len(one.uses)
    found = changes.T @ np.linalg.solve(even.toarray(), way)
    model = problem.model_of(thickness)
    here = search.solve(model)[0]
    for k, values in enumerate(
        (lambda s: s.use, lambda s: np.linalg.norm(s.displacements, axis=1))
    ):
        scale = uses[k] / norm(values(here))
        slope = (norm(values(above)) - norm(values(below))) / (2 * step) * scale
        assert found[k] == pytest.approx(slope, rel=0.05)


@pytest.mark.slow
def test_a_sized_beam_is_stiffer_at_its_mass_and_its_beams_say_so():
    solid, loads = block(80, 20, 40), bent(80)
    spec = LatticeSpec("Octet", cell_size=10, strut_radius=0.7, shell=0)
    made = homogenise_sized(solid, spec, loads, FieldGoal(), most_steps=10, element=5)
    even = homogenise_part(solid, spec, loads, element=5)
    assert made.report["mass_g"] == pytest.approx(even.report["mass_g"], rel=0.005)
    gain = even.report["cases"][0]["work_nmm"] / made.report["cases"][0]["work_nmm"]
    assert gain > 1.2
    beams = []
    for one in (spec, made.spec):
        model, found = solve_struts(solid, one, loads)
        beams.append((float(found.compliance[0]), found.volume, model))
    assert beams[1][1] == pytest.approx(beams[0][1], rel=0.03)
    assert beams[0][0] / beams[1][0] == pytest.approx(gain, rel=0.1)
    # Thick where it is bent most: at the held end, far from the middle.
    field = made.spec.radius_grading.field
    assert field([[5, 10, 38]])[0] > 1.2 * field([[5, 10, 20]])[0]
    assert field([[5, 10, 38]])[0] > 1.2 * field([[75, 10, 38]])[0]


@pytest.mark.costly
def test_the_lightest_beam_holds_its_limits_anew_and_uses_them():
    solid, loads = block(60, 20, 20), bent(60)
    case = homogenise_part(solid, OCTET, loads, element=5).report["cases"][0]
    limits = FieldLimits(0.65 * case["lattice_use"], case["displacement_mm"])
    goal = FieldGoal(limits, 0.35, 1.4)
    made = homogenise_sized(solid, OCTET, loads, goal, element=5, most_steps=20)
    told = made.report["field"]
    assert told["holds"]
    assert all(0.95 < use <= 1.001 for use in told["uses"].values())
    # One radius that holds the limit of stress.
    even = homogenise_part(solid, replace(OCTET, strut_radius=0.84), loads, element=5).report
    assert even["cases"][0]["lattice_use"] > limits.use
    assert made.report["mass_g"] < 0.7 * even["mass_g"]


@pytest.mark.costly
def test_under_a_skin_that_governs_the_best_design_is_kept_and_a_thicker_skin_holds():
    solid, loads, skinned = block(60, 20, 20), bent(60), replace(OCTET, shell=1)
    case = homogenise_part(solid, skinned, loads, element=5).report["cases"][0]
    goal = FieldGoal(FieldLimits(0.65 * case["lattice_use"]))
    made = homogenise_sized(solid, skinned, loads, goal, element=5)
    told = made.report["field"]
    uses = [step["uses"]["stress"] for step in told["steps"]]
    assert min(uses) > 1.2
    assert not told["holds"]
    assert told["uses"]["stress"] == pytest.approx(min(uses), rel=5e-4)
    assert "make the skin thicker." in made.report["notes"][-1]
    # One thickness all over, the thickest, is no better; a thicker skin is what holds.
    thick = replace(skinned, strut_radius=1.4)
    most = homogenise_part(solid, thick, loads, element=5).report["cases"][0]["lattice_use"]
    assert most > min(uses) * goal.limits.use
    made = homogenise_sized(solid, replace(skinned, shell=2), loads, goal, element=5)
    assert made.report["field"]["holds"]


@pytest.mark.costly
def test_densities_of_sized_walls_are_what_slicers_bands_follow():
    """Closed form: area of the gyroid, 3.0915 in a cell of 1, times the thickness, less folds."""
    ends = np.array([[0.0, 0, 0], [10, 0, 0]])
    field = PointField(ends, np.array([0.4, 1.2]))
    spec = LatticeSpec(
        "Gyroid", cell_size=10, wall=TpmsSheet("sheet", thickness=0.8), shell=0,
        radius_grading=_grading(0.4, 1.2, field),
    )  # fmt: skip
    found, curve = sized_densities(spec)
    assert found(ends) == pytest.approx([100 * 0.04 * 3.0915, 100 * 0.12 * 3.0915], rel=0.02)
    assert curve


def test_what_makes_no_sense_is_refused():
    loads = bent(40)
    assert field_goal(loads, {}) is None
    with pytest.raises(VolfrepError, match="give stiffest"):
        field_goal(loads, {"thinnest": 1.0})
    with pytest.raises(VolfrepError, match="keeps the mass"):
        field_goal(loads, {"safety": 2.0}, stiffest=True)
    with pytest.raises(VolfrepError, match="lies outside"):
        homogenise_sized(block(40, 20, 20), OCTET, loads, FieldGoal(thinnest=0.8))
    with pytest.raises(VolfrepError, match="not below"):
        homogenise_sized(block(40, 20, 20), OCTET, loads, FieldGoal(thinnest=0.8, thickest=0.8))


@pytest.mark.costly
def test_the_command_writes_a_specification_that_fill_and_infill_read(tmp_path, capsys):
    solid = block(40, 20, 20)
    part, loads = tmp_path / "part.stl", tmp_path / "loads.toml"
    trimesh.Trimesh(solid.vertices, solid.triangles).export(part)
    loads.write_text(
        'material = "PA12"\n[[support]]\nplane = {point = [0, 0, 0], normal = [1, 0, 0]}\n'
        "fixed = true\n[[case]]\n[[case.load]]\nforce = [0, 0, -50]\n"
        "plane = {point = [40, 0, 0], normal = [1, 0, 0]}\n"
    )
    given = ["--cell", "Octet", "--cell-size", "10", "--strut-radius", "0.7", "--shell", "0"]
    call = ["homogenise", part, "--loads", loads, *given, "--element", "10", "--stiffest"]
    spec, told = tmp_path / "light.toml", tmp_path / "told.json"
    call += ["--steps", "4", "-o", tmp_path / "part.vtu"]
    assert run(*call, "--write-spec", spec, "--report", told) == 0
    assert "radii or thicknesses" in capsys.readouterr().out
    report = json.loads(told.read_text())
    assert report["field"]["work_over_first"] < 0.95
    assert b"radius or thickness mm" in (tmp_path / "part.vtu").read_bytes()
    again = volfrep.homogenise(part, loads, volfrep.read_spec(spec), element=10)
    assert again.report["cases"][0]["work_nmm"] == pytest.approx(
        report["cases"][0]["work_nmm"], rel=1e-4
    )
    assert run("infill", part, "--sized", spec, "-o", tmp_path / "bands.3mf") == 0
    # A limit that cannot be held is said, and written all the same.
    call = ["homogenise", part, "--loads", loads, *given, "--element", "10", "--steps", "2"]
    assert run(*call, "--max-displacement", "1e-3") == 3
    assert "is not held" in capsys.readouterr().err
    assert run(*call, "--radii", tmp_path / "radii.csv") == 2
