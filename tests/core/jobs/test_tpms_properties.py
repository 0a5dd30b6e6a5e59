# SPDX-License-Identifier: LGPL-2.1-or-later
"""What walls do: against what is known of minimal surfaces, and against the solid itself."""

import json
from pathlib import Path

import numpy as np
import pytest

import command
import volfrep
from tools.lines_to_compare import hashin_shtrikman
from volfrep import LatticeSpec, VolfrepError
from volfrep.design.target import read_stiffness
from volfrep.design.tpms import SURFACES, PeriodicSurface, TpmsSheet, find_surface
from volfrep.jobs.tpms import stiffness
from volfrep.jobs.tpms.symmetry import is_cubic, is_mirror_symmetric
from volfrep.jobs.tpms.voxels import cut_into_voxels, of_density, tpms_density
from volfrep.mechanics.assembly import nodes_of
from volfrep.mechanics.conductance import conductance
from volfrep.mechanics.homogenise import CUBIC_STRAINS, Grid, solve_grid
from volfrep.spatial.even_points import even_points
from volfrep.tpms.solid import TpmsSolid


def sheet(name, thickness):
    return TpmsSolid.of(find_surface(name), TpmsSheet("sheet", thickness), 1.0)


def test_which_walls_equal_their_mirror_images_and_which_are_cubic():
    mirrored = {name for name in SURFACES if is_mirror_symmetric(sheet(name, 0.1))}
    assert mirrored == {"Schwarz P", "IWP", "Neovius"}
    assert all(is_cubic(sheet(name, 0.1)) for name in ("Gyroid", "Schwarz D", "Schwarz P", "IWP"))
    longer = PeriodicSurface("F", "cos(x) + cos(y) + 0.5 * cos(z)")
    assert not is_cubic(TpmsSolid.of(longer, TpmsSheet("sheet", 0.1), 1.0))
    half = TpmsSolid.of(find_surface("Schwarz D"), TpmsSheet("skeleton"), 1.0)
    assert is_cubic(half), "its sides need not be exchanged"


@pytest.mark.slow
def test_the_density_is_that_of_counted_points():
    for name, kind in (("Gyroid", "sheet"), ("IWP", "skeleton"), ("Schwarz D", "complement")):
        solid = TpmsSolid.of(find_surface(name), TpmsSheet(kind, 0.08, 0.02), 1.0)
        found, error = tpms_density(solid, octant=is_mirror_symmetric(solid))
        counted = np.mean(solid.levels(even_points(3, 14)) < solid.level)
        assert found == pytest.approx(counted, rel=0.01)
        assert error < 2e-3 * found


def test_a_density_is_met():
    solid = of_density(sheet("Schwarz P", 0.1), 0.2, octant=True)
    finer = cut_into_voxels(solid, 72, octant=True)
    assert finer.relative_density == pytest.approx(0.2, rel=1e-3)


def test_a_thin_wall_along_a_minimal_surface_conducts_two_thirds_of_its_density():
    """Coordinates are harmonic on minimal surfaces: no heat is led astray in them.

    Of one that is not quite so thin a little more, by its thickness squared.
    """
    solid = sheet("Schwarz P", 0.05)
    voxels = cut_into_voxels(solid, 48, octant=True)
    grid = Grid(voxels, nodes_of(voxels), None, CUBIC_STRAINS, np.zeros(0), np.zeros(0))
    assert conductance(grid)[0, 0] / voxels.relative_density == pytest.approx(2 / 3, rel=0.03)


@pytest.mark.slow
def test_an_octant_has_the_stiffness_of_the_whole_cell():
    solid = sheet("Schwarz P", 0.12)
    ways = ((False, False), (True, True))
    whole, part = (
        solve_grid(cut_into_voxels(solid, 24, octant=octant, density=0.28), 0.3, cubic=cubic).tensor
        for octant, cubic in ways
    )
    assert part == pytest.approx(whole, rel=1e-3, abs=1e-4)


@pytest.mark.slow
def test_a_wall_is_below_the_upper_bounds_and_a_sheet_near_that_of_the_bulk_modulus():
    found = volfrep.properties("gyroid", 10, wall_thickness=0.8, along=18)
    density = found.relative_density
    shear_solid, bulk_solid = 1 / 2.6, 1 / 1.2
    void = 1 - density
    bound = bulk_solid + void / (-1 / bulk_solid + 3 * density / (3 * bulk_solid + 4 * shear_solid))
    assert 0.8 * bound < found.values["bulk"] < bound
    assert found.values["E100"] < hashin_shtrikman(np.array([density]))[0][0]
    assert found.values["nu"] == pytest.approx(0.32, abs=0.02)
    for name in ("E100", "G", "bulk", "strength", "conductivity", "relative_density"):
        assert found.errors[name] > 0
    assert found.rows()[0] == ("cell", "Gyroid, L = 10 mm, sheet 0.8 mm thick")
    assert found.as_dict()["wall_thickness_mm"] == 0.8


@pytest.mark.costly
def test_the_command_tells_what_walls_do(tmp_path: Path, capsys):
    path = tmp_path / "p.json"
    arguments = ("--cell-size", 5, "--wall-kind", "skeleton", "--relative-density", 0.3)
    material = ("--material", "PA12", "--voxels", 24, "--json", path)
    assert command.run("properties", "schwarz p", *arguments, *material) == 0
    assert "Schwarz P, L = 5 mm, skeleton, offset" in capsys.readouterr().out
    data = json.loads(path.read_text())
    assert data["relative_density"] == pytest.approx(0.3, rel=1e-3)
    assert data["unit"] == "MPa"
    assert 20 < data["E100"] < 300
    assert "strut_radius_mm" not in data
    formula = ("--wall-formula", "cos(x) + cos(y) + cos(z)", "--wall-thickness", 1)
    assert command.run("properties", "Formula", "--cell-size", 10, *formula, "--voxels", 16) == 0
    assert "Formula, L = 10 mm, sheet 1 mm thick" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("Gyroid", "--strut-radius", 1), "give the wall thickness or the relative density"),
        (("Gyroid", "--wall-offset", 1), "give the wall thickness or the relative density"),
        (("Gyroid", "--wall-thickness", -1), "above 0"),
        (("Gyroid", "--relative-density", 0.001), "from 0.02 to 0.98"),
        (("Formula", "--wall-thickness", 1), "needs a formula"),
        (("Octet", "--wall-thickness", 1), "Of struts give either"),
        (("Octet", "--strut-radius", 1, "--wall-kind", "sheet"), "Of struts give either"),
    ],
)
def test_what_makes_no_sense_is_refused(arguments, said, capsys):
    assert command.run("properties", *arguments, "--cell-size", 10) == 2
    assert said in capsys.readouterr().err


@pytest.mark.slow
def test_a_wall_is_made_as_stiff_as_it_is_asked_for(monkeypatch):
    # Coarse grids, of which the fine ones here are as coarse as the usual coarse ones.
    monkeypatch.setattr(stiffness, "_COARSE", 0.25)
    monkeypatch.setattr(stiffness, "_FINE", 0.4)
    target = read_stiffness("0.05:111")
    spec = LatticeSpec("Schwarz P", 10.0, shell=0, target=target)
    found = stiffness.solve_tpms_stiffness(spec, target)
    # Another homogenisation, as exact as the table in docs/tpms.md.
    wall = found.wall
    made = volfrep.properties("Schwarz P", 10.0, wall_thickness=wall.thickness, along=48)
    assert made.values["E111"] == pytest.approx(0.05, rel=0.02)
    assert 0.4 < wall.thickness < 0.6
    assert stiffness.tpms_modulus(found, target) == pytest.approx(0.05, rel=0.01)


@pytest.mark.slow
def test_a_stiffness_that_no_wall_has_is_refused_with_what_can_be_had(monkeypatch):
    monkeypatch.setattr(stiffness, "_COARSE", 0.25)
    spec = LatticeSpec("Schwarz P", 10.0, shell=0)
    for wanted in ("0.9:100", "1e-5:100"):
        with pytest.raises(VolfrepError, match=r"choose one from .* of the solid's"):
            stiffness.solve_tpms_stiffness(spec, read_stiffness(wanted))
