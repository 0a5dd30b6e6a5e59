# SPDX-License-Identifier: LGPL-2.1-or-later
"""Every broken, odd and real file gets what its README asks: the table of `make torture`."""

import shutil

import pytest

import torture
from bench.parts import NO_TORTURE

pytestmark = pytest.mark.skipif(not torture.jobs(), reason=NO_TORTURE)


def jobs():
    """Each file as a test; those that FreeCAD reads, or solid angles judge, take seconds."""
    for path, name, expected in torture.jobs():
        judged = expected is not None and expected.told and path.stat().st_size > 100_000
        marks = [pytest.mark.slow] * bool(judged or torture.is_cad(path))
        yield pytest.param((path, name, expected), id=name, marks=marks)


@pytest.mark.slow_cases("parts/odri_electronics_box_base.STL")
@pytest.mark.parametrize("job", list(jobs()))
def test_every_file_gets_what_its_readme_asks(job):
    path, name, expected = job
    if torture.is_cad(path) and shutil.which("freecadcmd") is None:
        pytest.skip("freecadcmd, which reads STEP, is not on the PATH")
    assert expected is not None, "nobody said what it must get"
    assert torture.try_file(path, name, expected).fails == ""
