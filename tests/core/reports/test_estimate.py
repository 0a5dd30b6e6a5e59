# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file will take is said before it is made, and absurd ones are refused with a way out."""

import re
from dataclasses import replace

import numpy as np
import pytest

from volfrep import LatticeSpec
from volfrep.fem.beam_mesh import beam_model
from volfrep.jobs.blocks import block_wireframe
from volfrep.reports.estimate import (
    MOST_BEAMS,
    ExportChoice,
    estimate_axes,
    estimate_beams,
    estimate_exact,
    estimate_faceted,
    estimate_lattice_tetrahedra,
    estimate_tetrahedra,
)
from volfrep.util.errors import VolfrepError

SPEC = LatticeSpec(cell="CVC", cell_size=10, strut_radius=1, resolution=20)


def test_an_estimate_reads_as_a_sentence():
    assert str(estimate_axes(1000)) == (
        "1,000 lines: about 0.1 s, 0.1 MB; FreeCAD reads it in about 0.1 s"
    )
    assert str(estimate_faceted(100_000)).startswith("100,000 plane faces: about 1.5 s, 76 MB")


def test_exact_surfaces_of_a_block_know_its_kinds_of_joints():
    found = estimate_exact(block_wireframe(SPEC, (4, 4, 4)))
    assert found.what == "512 struts, 27 kinds of joints"
    trimmed = estimate_exact(block_wireframe(SPEC, (4, 4, 4)), trimmed=True)
    assert trimmed.seconds > found.seconds


def test_a_coarser_resolution_is_the_nearest_setting_that_fits():
    with pytest.raises(VolfrepError, match=r"4,000,000 plane faces.* resolution of 10, or"):
        estimate_faceted(4_000_000, ExportChoice(SPEC))
    with pytest.raises(VolfrepError, match=r"the limit is 200,000\): choose a resolution of 12"):
        estimate_tetrahedra(400_000, ExportChoice(SPEC))


def test_tetrahedra_of_a_part_take_longer_as_the_needles_of_its_cut_are_mended():
    part, free = (estimate_tetrahedra(50_000, ExportChoice(SPEC, n)) for n in (None, (2, 2, 2)))
    assert (part.seconds, free.seconds) == pytest.approx((50.0, 20.0))
    assert part.what == free.what


def test_what_gmsh_cannot_fill_is_told_anew():
    found = estimate_lattice_tetrahedra(400_000)
    assert "400,000 tetrahedra of a lattice instead, 700,000 nodes" in found.what
    assert 20.0 < found.seconds < 60.0


def test_where_no_resolution_is_coarse_enough_there_must_be_fewer_cells():
    with pytest.raises(VolfrepError, match="cells of 47 mm, or"):
        estimate_faceted(100_000_000, ExportChoice(SPEC))
    with pytest.raises(VolfrepError, match="a block of 10 x 10 x 5 cells"):
        estimate_faceted(64_000_000, ExportChoice(SPEC, (40, 40, 20)))
    with pytest.raises(VolfrepError, match="choose larger cells"):
        estimate_axes(10_000_000)


@pytest.mark.costly
def test_what_is_named_fits():
    frame = block_wireframe(SPEC, (40, 40, 40))
    with pytest.raises(VolfrepError) as error:
        estimate_exact(frame, ExportChoice(SPEC, (40, 40, 40)))
    count = re.search(r"a block of (\d+) x (\d+) x (\d+) cells", str(error.value))
    assert count
    estimate_exact(block_wireframe(SPEC, [int(n) for n in count.groups()]))


def test_beams_have_a_limit():
    model = beam_model(block_wireframe(SPEC, (1, 1, 1)))
    assert "80 beams" in str(estimate_beams(model))
    many = replace(model, elements=np.tile(model.elements, (MOST_BEAMS // 40, 1)))
    with pytest.raises(VolfrepError, match=r"800,000 beam elements .*cells of 13 mm"):
        estimate_beams(many, ExportChoice(SPEC))
