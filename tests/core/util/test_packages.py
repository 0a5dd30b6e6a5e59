# SPDX-License-Identifier: LGPL-2.1-or-later
"""Packages that a single feature needs: one door, one sentence where one is missing."""

import sys

import pytest

from volfrep.util.packages import MissingPackage, package


def test_a_missing_package_is_told_with_what_needs_it_and_what_installs_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(MissingPackage) as caught:
        package("distributed", "A scheduler", then="or leave it out")
    assert str(caught.value) == (
        "A scheduler needs the Python package distributed, which is not installed: install it with "
        "the command  pip install volfrep[dask]  or leave it out."
    )


def test_a_package_that_is_there_but_broken_is_not_called_missing(monkeypatch, tmp_path):
    (tmp_path / "half_there.py").write_text("import what_it_needs_itself\n")
    monkeypatch.syspath_prepend(tmp_path)
    with pytest.raises(MissingPackage, match="cannot be loaded: No module named 'what_it_needs"):
        package("half_there", "This test")
