# SPDX-License-Identifier: LGPL-2.1-or-later
"""A file that a process writes which may be ended at any moment."""

import pytest

from volfrep.util.errors import VolfrepError
from volfrep.util.files import staged


def test_what_was_written_beside_takes_the_targets_place(tmp_path):
    target = tmp_path / "part.stl"
    target.write_text("old")
    target.chmod(0o640)
    mode = target.stat().st_mode  # Windows has no groups
    with staged(target) as unfinished:
        assert unfinished.name == target.name
        unfinished.write_text("new")
        assert target.read_text() == "old"
    assert target.read_text() == "new"
    assert target.stat().st_mode == mode
    assert [path.name for path in tmp_path.iterdir()] == ["part.stl"]


def test_an_error_names_the_target_and_leaves_it(tmp_path):
    target = tmp_path / "part.stl"
    target.write_text("old")

    def fail():
        with staged(target) as unfinished:
            unfinished.write_text("half")
            raise VolfrepError(f"Cannot write '{unfinished}': the disk is full.")

    with pytest.raises(VolfrepError) as raised:
        fail()
    assert str(raised.value) == f"Cannot write '{target}': the disk is full."
    assert target.read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["part.stl"]


def test_no_folder_is_told_before_anything_is_done(tmp_path):
    with pytest.raises(VolfrepError, match="there is no folder"), staged(tmp_path / "a" / "b.stl"):
        pytest.fail("the block runs")
