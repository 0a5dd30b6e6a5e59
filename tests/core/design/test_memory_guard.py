# SPDX-License-Identifier: LGPL-2.1-or-later
"""A job that does not fit is refused, with settings that do."""

import re
from functools import partial

import numpy as np
import pytest

from volfrep.design import memory_guard
from volfrep.design.memory_guard import (
    refuse_block,
    refuse_cells,
    refuse_expected,
    refuse_memory,
)
from volfrep.design.spec import LatticeSpec
from volfrep.jobs.blocks import block, block_wireframe, write_block_stl
from volfrep.util.errors import VolfrepError


@pytest.fixture(autouse=True)
def one_gigabyte(monkeypatch):
    monkeypatch.setattr(memory_guard, "free_memory", lambda: 1e9)


def refusal(spec: LatticeSpec, volume: float) -> str:
    with pytest.raises(VolfrepError) as error:
        refuse_expected(spec, volume)
    return str(error.value)


def bcc(**changes) -> LatticeSpec:
    return LatticeSpec(**{"cell": "BCC", "cell_size": 5.0, "strut_radius": 0.5, **changes})


def test_the_deviation_and_the_cell_that_it_names_fit():
    volume = 1e5
    text = refusal(bcc(deviation=0.001), volume)
    assert "of the 1 GB of free memory" in text
    deviation = float(re.search(r"deviation of ([\d.]+) mm", text).group(1))
    cell = float(re.search(r"cells of ([\d.]+) mm", text).group(1))
    refuse_expected(bcc(deviation=deviation), volume)
    refuse_expected(bcc(deviation=0.001, cell_size=cell), volume)
    # And they are not needlessly coarse.
    assert refusal(bcc(deviation=deviation / 2), volume)
    assert refusal(bcc(deviation=0.001, cell_size=cell / 1.5), volume)


def test_a_resolution_is_answered_with_a_resolution():
    facets = int(re.search(r"resolution of (\d+)", refusal(bcc(resolution=60), 3e5)).group(1))
    refuse_expected(bcc(resolution=facets), 3e5)


def test_where_no_facets_are_coarse_enough_larger_cells_are_proposed():
    text = refusal(bcc(cell_size=1.0, strut_radius=0.1), 1e9)
    assert "deviation" not in text
    assert "cells of" in text


def test_too_many_cells_are_answered_with_larger_ones():
    with pytest.raises(VolfrepError, match=r"take 8 GB .* cells of 2\.2 mm would fit"):
        refuse_cells(16_000_000, 1.0)


@pytest.mark.parametrize("count", [(1000, 1000, 1000), (4000, 4000, 2), (10**6, 1, 1)])
def test_a_block_is_answered_with_a_smaller_block_that_fits(count):
    with pytest.raises(VolfrepError, match="would fit") as error:
        refuse_block(count, 4000)
    sides = re.search(r"block of (\d+) x (\d+) x (\d+)", str(error.value)).groups()
    fits = [int(n) for n in sides]
    refuse_block(fits, 4000)
    assert all(0 < n <= m for n, m in zip(fits, count, strict=True))
    assert np.prod(fits) > 0.4 * 1e9 / 4000  # and it is not needlessly small
    with pytest.raises(VolfrepError, match="a block of"):
        refuse_expected(bcc(), np.prod(count) * 125.0, count)


@pytest.mark.parametrize("made", [block_wireframe, block, partial(write_block_stl, path="x.stl")])
def test_no_form_of_a_block_begins_what_does_not_fit(made):
    """A thousand million cells: refused before the first of them is made."""
    with pytest.raises(VolfrepError, match=r"of the 1 GB of free memory.*a block of"):
        made(LatticeSpec("Box"), (1000, 1000, 1000))


def test_what_fits_is_not_refused():
    refuse_memory(LatticeSpec(), 1e6, 1e5)
