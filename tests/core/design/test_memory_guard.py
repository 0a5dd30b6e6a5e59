# SPDX-License-Identifier: LGPL-2.1-or-later
"""A job that does not fit is refused, with settings that do."""

import re

import pytest

from volfrep.design import memory_guard
from volfrep.design.memory_guard import refuse_cells, refuse_expected, refuse_memory
from volfrep.design.spec import LatticeSpec
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


def test_what_fits_is_not_refused():
    refuse_memory(LatticeSpec(), 1e6, 1e5)
