# SPDX-License-Identifier: LGPL-2.1-or-later
"""The shipped catalogue: it is what the engine computes, and its fits run through it."""

import dataclasses
import json
import shutil
from pathlib import Path

import numpy as np
import pytest

import plates
from tools import catalogue_cells
from volfrep import VolfrepError
from volfrep.design.cells import LIBRARY, PAPERS, make_cell
from volfrep.fem.beam_mesh import fitted_beams
from volfrep.jobs.blocks import block_wireframe
from volfrep.mechanics import catalogue as shipped
from volfrep.mechanics.catalogue import (
    NAMES,
    SECTIONS,
    catalogue,
    joint_law,
    known_cell,
    known_properties,
)
from volfrep.mechanics.density import relative_density
from volfrep.mechanics.frame import Ends, frame_tensor
from volfrep.mechanics.homogenise import homogenise
from volfrep.mechanics.joint_fit import LONGEST_END, periodic_frame
from volfrep.mechanics.materials import find_material
from volfrep.mechanics.summary import cell_properties
from volfrep.mechanics.tensor import moduli

needs = [
    pytest.mark.skipif(shutil.which(name) is None, reason=f"{name} is not installed")
    for name in ("ccx", "gmsh")
]


def test_every_cell_of_the_library_that_is_a_cube_is_there():
    assert set(catalogue()) == {name for name, cell in LIBRARY.items() if cell.is_uniform_cube}
    for cell in catalogue().values():
        assert (np.diff(cell.ratios) > 0).all()
        assert (np.diff(cell.values[:, 0]) > 0).all()
        carried = cell.values > 1e-9
        assert (cell.errors[carried] > 0).all()
        # Stiffness is good to a few percent everywhere.
        assert (cell.errors[:, 1] < 0.06 * cell.values[:, 1]).all()
        assert (cell.errors[:, 3] < 0.06 * cell.values[:, 3] + 1e-9).all()


UNEVEN = [name for name, cell in catalogue().items() if len(cell.tensors)]


@pytest.mark.parametrize("name", UNEVEN)
def test_cells_that_are_not_alike_along_x_y_and_z_keep_all_of_their_tensor(name):
    """Four of them are alike along x and y, so that C11 = C22, C13 = C23 and C44 = C55."""
    known = catalogue()[name]
    for ratio, tensor, error in zip(
        known.ratios.tolist(), known.tensors, known.tensor_errors, strict=True
    ):
        assert known.tensor(ratio) == pytest.approx(tensor, abs=1e-6 * tensor.max())
        assert known.error_of_tensor(ratio) == pytest.approx(error, rel=1e-6, abs=1e-12)
        for one, two in (((0, 0), (1, 1)), ((0, 2), (1, 2)), ((3, 3), (4, 4))):
            assert tensor[one] == pytest.approx(tensor[two], abs=error[one] + error[two] + 1e-9)
    between = known.tensor(float(np.sqrt(known.ratios[1] * known.ratios[2])))
    assert np.linalg.eigvalsh(between)[0] > 0.0
    assert known.tensors[1][2, 2] < between[2, 2] < known.tensors[2][2, 2]
    found = known_properties(LIBRARY[name], 10.0, 0.5)
    assert found.stiffness.shape == found.errors["stiffness"].shape == (6, 6)
    rows = [row for row, _ in found.rows()]
    assert rows[-1] == "conductivity"
    assert "E along z" in rows
    assert "Zener anisotropy" not in rows
    assert "least strength along x, y, z" in rows


@pytest.mark.slow
def test_columns_carry_along_themselves_only_and_a_point_computed_again_is_that_shipped():
    known = catalogue()["Columns"]
    found = known_properties(LIBRARY["Columns"], 10.0, 0.5)
    assert found.young((0, 0, 1)) == pytest.approx(2 * np.pi * 0.05**2, rel=0.02)
    assert found.values["strength"] == pytest.approx(0.0, abs=1e-12)
    assert found.young((1, 0, 0)) < 1e-6 * found.young((0, 0, 1))
    again = homogenise(LIBRARY["Columns"], 0.1).tensor
    assert again[2, 2] == pytest.approx(known.tensor(0.1)[2, 2], rel=2e-3)


def test_the_command_computes_what_is_missing_only(monkeypatch, tmp_path):
    """Two cells were taken out; one of them carries nothing."""
    cells = dict(catalogue())
    file = tmp_path / "catalogue.json"
    data = json.loads(shipped.FILE.read_text())
    del data["cells"]["Columns"], data["cells"]["CVC"]
    file.write_text(json.dumps(data))
    asked = []

    def stand_in(name, say):
        asked.append(name)
        return cells[name]

    monkeypatch.setattr(catalogue_cells, "FILE", file)
    monkeypatch.setattr(catalogue_cells, "compute", stand_in)
    monkeypatch.setattr(catalogue_cells, "is_listed", lambda cell: cell.name != "CVC")
    catalogue_cells.main([])
    assert asked == ["Columns"]
    written = json.loads(file.read_text())["cells"]
    whole = json.loads(shipped.FILE.read_text())["cells"]
    assert list(written) == [name for name in whole if name != "CVC"]
    assert written["Columns"] == whole["Columns"]


def test_a_cell_whose_beams_miss_its_stiffness_says_so():
    thick = block_wireframe(plates.spec_of("Re-entrant", 0.1, 0.9), (2, 2, 2))
    said = fitted_beams(thick, None, LIBRARY["Re-entrant"], plates.SIZE)[1]
    assert len(said) == 1
    assert "No ends make beams of Re-entrant at r/L = 0.1" in said[0]
    slender = block_wireframe(plates.spec_of("Re-entrant", 0.05, 0.9), (2, 2, 2))
    assert fitted_beams(slender, None, LIBRARY["Re-entrant"], plates.SIZE)[1] == ()


@pytest.mark.costly
@pytest.mark.slow_but("Box-5")
@pytest.mark.parametrize(("name", "row"), [("Box", 5), ("CVC", 6), ("Octahedron", 5)])
def test_points_computed_again_are_those_shipped(name, row):
    known = catalogue()[name]
    ratio = float(known.ratios[row])
    found = homogenise(LIBRARY[name], ratio).tensor
    values = dict(zip(NAMES, known.values[row], strict=True))
    errors = dict(zip(NAMES, known.errors[row], strict=True))
    density = relative_density(LIBRARY[name], ratio)
    assert abs(density.value - values["relative_density"]) <= density.error
    for key, place in (("C11", (0, 0)), ("C12", (0, 1)), ("C44", (3, 3))):
        assert abs(found[place] - values[key]) <= errors[key]


@pytest.mark.parametrize("name", ["Octet", "CVC"])
def test_fits_run_through_the_points_and_between_them(name):
    known = catalogue()[name]
    for row, ratio in enumerate(known.ratios.tolist()):
        found = known.at(ratio)
        assert [found[key] for key in NAMES] == pytest.approx(known.values[row].tolist(), rel=1e-6)
    left = shipped.CatalogueCell(
        name, np.delete(known.ratios, 4), np.delete(known.values, 4, axis=0),
        np.delete(known.errors, 4, axis=0), np.delete(known.doubts, 4, axis=0), known.ends,
        known.misfit,
    )  # fmt: skip
    ratio = float(known.ratios[4])
    again, whole = moduli(left.tensor(ratio)), moduli(known.tensor(ratio))
    stiffness = again.E100, again.G
    assert stiffness == pytest.approx((whole.E100, whole.G), rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize("material", [None, "AlSi10Mg"])
def test_what_a_lattice_does_is_read_off_at_once_within_its_errors(material):
    """At a radius between those of the catalogue, beside the homogenised cell."""
    solid = None if material is None else dataclasses.replace(find_material(material), poisson=0.3)
    read = known_properties(LIBRARY["Octet"], 8.0, 0.9, solid)
    computed = cell_properties("Octet", 8.0, 0.9, material=solid)
    assert read.along == 0
    assert [name for name, _ in read.rows()] == [name for name, _ in computed.rows()]
    for name in ("E100", "E110", "E111", "G", "nu", "strength", "conductivity"):
        near = 2.0 * (read.errors[name] + computed.errors[name])
        assert read.values[name] == pytest.approx(computed.values[name], abs=near, rel=0.01), name
    assert read.relative_density == pytest.approx(computed.relative_density, rel=1e-3)


def test_the_modulus_in_any_direction():
    found = known_properties(LIBRARY["CVC"], 10.0, 1.0, find_material("PA12"))
    for name, way in (("E100", (0, 2, 0)), ("E110", (1, 0, -1)), ("E111", (-1, 1, 1))):
        assert found.young(way) == pytest.approx(found.values[name], rel=1e-6)
    assert found.values["E100"] < found.young((1, 2, 0)) < found.values["E110"]
    for none in ((0, 0, 0), (1, 0), (1, np.inf, 0)):
        with pytest.raises(VolfrepError, match="direction is three numbers"):
            found.young(none)


def test_what_the_catalogue_does_not_know_is_not_guessed():
    assert known_properties(LIBRARY["Octet"], 10.0, 4.0) is None
    own = dataclasses.replace(LIBRARY["Octet"], name="mine")
    assert known_properties(own, 10.0, 1.0) is None


def test_errors_of_moduli_are_stored_and_below_their_bounds():
    for known in catalogue().values():
        assert known.doubts.shape == (len(known.ratios), len(shipped.FIGURES))
        if len(known.tensors):
            continue  # the bounds are of three constants
        bounds = shipped._bounds(known.values.tolist(), known.errors.tolist())
        assert (known.doubts > 0.0).all()
        assert (known.doubts <= np.array(bounds) + 2e-3).all()


def test_the_ratio_of_a_density():
    known = catalogue()["Octet"]
    ratio = known.ratio_of_density(0.2)
    assert relative_density(LIBRARY["Octet"], ratio).value == pytest.approx(0.2, rel=2e-3)
    with pytest.raises(VolfrepError, match="knows Octet at relative densities"):
        known.ratio_of_density(0.99)
    with pytest.raises(VolfrepError, match="knows Octet from r / L"):
        known.tensor(0.5)


@pytest.mark.parametrize("name", PAPERS)
def test_the_shipped_ends_give_frames_the_moduli_of_the_solid(name):
    """Up to r / L = 0.1; round ones cannot be wider at their ends and meet G less well."""
    known = catalogue()[name]
    for row in np.flatnonzero((known.ratios >= 0.04) & (known.ratios <= 0.1)):
        ratio = float(known.ratios[row])
        wanted = moduli(known.tensor(ratio))
        for key, section in SECTIONS.items():
            ends = Ends(*known.ends[key][row])
            found = moduli(
                frame_tensor(
                    periodic_frame(LIBRARY[name]), ratio, ends, section=section,
                    longest=LONGEST_END,
                )
            )  # fmt: skip
            along, shear = found.E100, found.G
            assert along == pytest.approx(wanted.E100, rel=0.02 if key == "square" else 0.05)
            assert shear == pytest.approx(wanted.G, rel=0.09 if key == "square" else 0.25)


@pytest.mark.parametrize(
    ("name", "shear"),
    [("Box", 0.01), ("CVC", 0.05), ("BCC", 0.09), ("FCC", 0.16), ("Octet", 0.16),
     ("Octahedron", 0.29)],
)  # fmt: skip
def test_thick_struts_keep_e_and_what_a_beam_can_of_g(name, shear):
    """A beam's stiffness across is at most a third of that along it: G is left too high."""
    known, ratio = catalogue()[name], 0.15
    frame = periodic_frame(LIBRARY[name])
    ends = known.joint(ratio, "square")
    wanted = moduli(known.tensor(ratio))
    found = moduli(
        frame_tensor(frame, ratio, ends, section=SECTIONS["square"], longest=LONGEST_END)
    )
    along = found.E100
    assert along == pytest.approx(wanted.E100, rel=0.025)
    assert -0.01 < found.G / wanted.G - 1.0 < shear
    assert 0.75 < found.bulk / wanted.bulk < 0.9


def test_only_the_librarys_own_cells_are_known():
    octet = LIBRARY["Octet"]
    assert known_cell(octet) is catalogue()["Octet"]
    assert known_cell(make_cell("Octet", octet.nodes, octet.struts[:-1])) is None
    profile = joint_law(octet, 10.0, "square")
    assert profile(1.0) == catalogue()["Octet"].joint(0.1, "square")
    assert profile(0.01) == profile(0.1)


def test_an_own_cell_is_fitted_when_it_is_first_used(monkeypatch):
    cell = make_cell("Mine", LIBRARY["CVC"].nodes, LIBRARY["CVC"].struts)
    count = []
    exact = shipped.homogenise

    def coarse(*arguments, **named):
        count.append(arguments[1])
        return exact(*arguments, along=32, **named)

    monkeypatch.setattr(shipped, "homogenise", coarse)
    monkeypatch.setattr(shipped, "_FITTED", {})
    profile = joint_law(cell, 10.0)
    first = profile(1.0)
    assert len(count) == 2
    assert profile(1.0) == first
    assert len(count) == 2
    assert first.bending > 1.0


def test_a_cell_that_carries_nothing_has_rigid_ends_and_says_so():
    lonely = make_cell("L", [[0.3, 0.5, 0.5], [0.7, 0.5, 0.5]], [[0, 1]])
    frame = block_wireframe(plates.spec_of(lonely, 0.1), (2, 2, 2))
    model, said = fitted_beams(frame, None, lonely, plates.SIZE)
    assert "carries no load" in said[0]
    assert model.ends[0].axial == 1000.0


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.05, 0.1, 0.15])
@pytest.mark.parametrize("name", PAPERS)
class TestBlocksBetweenPlates:
    pytestmark = needs

    def test_beams_with_fitted_ends_are_as_stiff_as_the_solid(self, name, ratio, tmp_path: Path):
        solid, _ = plates.solid_force(name, ratio, tmp_path)
        profile = joint_law(LIBRARY[name], plates.SIZE, "square")
        beams = plates.beam_force(plates.beams_of(name, ratio, joint_law=profile), tmp_path)
        assert beams == pytest.approx(solid, rel=0.05)
