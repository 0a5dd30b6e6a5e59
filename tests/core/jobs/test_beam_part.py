# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part as beams: what is in it, what cuts it, what it hangs on."""

from dataclasses import replace

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec, StageCache, VolfrepError
from volfrep.design.grading import CellMap, RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.grid.placement import NUDGE
from volfrep.jobs.beam_part import beam_model, block_beams
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality

SPEC = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1, shell=2)


def test_a_block_is_its_wireframe():
    model = block_beams(LatticeSpec(cell="Box", cell_size=5, strut_radius=0.5), (2, 1, 1))
    assert len(model.lattice.nodes) == 3 * 2 * 2
    assert len(model.lattice.struts) == 2 * 4 + 3 * 4
    assert (model.lattice.radii == 0.5).all()
    assert model.clip is None
    assert model.skin is None


def test_a_part_has_a_skin_and_is_cut_at_its_outside():
    solid = samples.box((40, 30, 20))
    model = beam_model(solid, SPEC)
    assert model.clip is solid
    skin = quality.measure(model.skin)
    assert (skin.bodies, skin.voids) == (1, 1)
    assert skin.volume == pytest.approx(40 * 30 * 20 - 36 * 26 * 16, rel=1e-3)


def test_the_lattice_alone_is_cut_at_the_inner_wall():
    solid = samples.box((40, 30, 20))
    model = beam_model(solid, LatticeSpec(**{**vars(SPEC), "output": "lattice"}))
    assert model.skin is None
    np.testing.assert_allclose(model.clip.bounds, [[2, 2, 2], [38, 28, 18]], atol=0.01)


def test_without_a_shell_there_is_no_skin():
    model = beam_model(samples.box((40, 30, 20)), LatticeSpec(**{**vars(SPEC), "shell": 0}))
    assert model.skin is None
    np.testing.assert_allclose(model.clip.bounds, [[0, 0, 0], [40, 30, 20]])


def test_struts_outside_are_left_out_and_no_others():
    solid = samples.sphere(25.0, 3)
    model = beam_model(solid, LatticeSpec(**{**vars(SPEC), "shell": 0}))
    bare = LatticeSpec(**{**vars(SPEC), "shell": 0, "output": "domain"})
    whole = fill(solid, bare).wireframe
    kept = {tuple(row) for row in model.lattice.nodes[model.lattice.struts].reshape(-1, 6)}
    ends = whole.nodes[whole.struts]
    share = np.linspace(0, 1, 201)[:, None, None]
    along = (1 - share) * ends[:, 0] + share * ends[:, 1]
    # The struts' own surface, against a ball instead of the solid's facets.
    nearest = np.linalg.norm(along, axis=2).min(axis=0) - 1.0
    for strut, gap in zip(ends.reshape(-1, 6), nearest, strict=True):
        if gap < 25.0 - 0.3:  # the facets lie inside the ball by less than that
            assert tuple(strut) in kept
    assert len(kept) < len(whole.struts)
    assert set(model.lattice.struts.ravel()) == set(range(len(model.lattice.nodes)))


def test_graded_struts_are_cones_of_the_radii_of_the_law():
    thicker = RadiusGrading("direction", Profile("linear", 0.5, 1.5))
    lattice = block_beams(LatticeSpec(cell="Box", radius_grading=thicker), (4, 1, 1)).lattice
    expected = 0.5 + lattice.nodes[lattice.struts][:, :, 0] / 40.0
    np.testing.assert_allclose(lattice.radii, expected)
    solid = samples.box((40, 30, 20))
    filled = beam_model(solid, LatticeSpec(cell="Box", shell=0, radius_grading=thicker)).lattice
    along = (filled.nodes - NUDGE * 10.0)[filled.struts][:, :, 0]  # where the radius was told
    expected = 0.5 + np.clip(along / 40.0, 0.0, 1.0)
    np.testing.assert_allclose(filled.radii, expected)


def test_cells_about_an_axis_have_their_nodes_on_rings():
    rings = CellMap("cylindrical", around=12)
    lattice = block_beams(LatticeSpec(cell="Box", cell_map=rings), (1, 12, 2)).lattice
    assert len(lattice.nodes) == 2 * 12 * 3  # closed upon itself
    middle = 10.0 * 12 / (2 * np.pi)
    radius = np.linalg.norm(lattice.nodes[:, :2], axis=1)
    np.testing.assert_allclose(np.unique(radius.round(6)), [middle - 5, middle + 5], atol=1e-5)


def test_struts_deformed_with_their_cells_are_warned_of():
    growing = SizeGrading(Profile("linear", 1.0, 2.0))
    spec = LatticeSpec(size_grading=growing)
    assert block_beams(spec, (2, 1, 1)).warnings == ()
    deformed = block_beams(replace(spec, keep_radius=False), (2, 1, 1))
    assert "straight and round" in deformed.warnings[0]


def test_the_cache_of_a_fill_is_used(monkeypatch):
    cache = StageCache()
    solid = samples.box((40, 30, 20))
    fill(solid, SPEC, cache=cache)
    monkeypatch.setattr("volfrep.shell.domain.find_cavity", None)
    assert len(beam_model(solid, SPEC, cache=cache).lattice.struts)


def test_what_beams_cannot_hold_is_refused():
    solid = samples.box((40, 30, 20))
    with pytest.raises(VolfrepError, match="no fillets"):
        beam_model(solid, LatticeSpec(**{**vars(SPEC), "fillet": 0.2}))
    with pytest.raises(VolfrepError, match="no fillets"):
        block_beams(LatticeSpec(fillet=0.2), (1, 1, 1))
    with pytest.raises(VolfrepError, match="holds no lattice"):
        beam_model(solid, LatticeSpec(**{**vars(SPEC), "output": "domain"}))
    with pytest.raises(VolfrepError, match="must be a whole number"):
        block_beams(SPEC, (1, 0, 1))
