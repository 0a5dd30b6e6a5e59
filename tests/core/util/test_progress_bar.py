# SPDX-License-Identifier: LGPL-2.1-or-later
"""Progress as a bar: drawn over itself in a terminal, and nowhere else."""

import io
import sys

import pytest

from volfrep.util.errors import VolfrepError
from volfrep.util.progress_bar import ProgressBar, drawn, shown


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_terminal_sees_a_bar_that_is_wiped_at_the_end(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with shown(True) as told:
        told(0.5, "lattice")
        told(0.6, "too soon")
    assert "###############...............  50 % lattice" in terminal.getvalue()
    assert "too soon" not in terminal.getvalue()
    assert terminal.getvalue().endswith(" \r")


def test_where_nobody_looks_nothing_is_written(monkeypatch):
    file = io.StringIO()
    monkeypatch.setattr(sys, "stderr", file)
    for progress in (False, None):
        with shown(progress) as told:
            assert told is None
    with shown(True) as told:
        told(0.5, "lattice")
    with drawn(quiet=True) as told:
        told(0.5, "lattice")
    assert file.getvalue() == ""


def test_a_function_is_told_itself_and_anything_else_refused():
    bar = ProgressBar(io.StringIO())
    with shown(bar) as told:
        assert told is bar
    with pytest.raises(VolfrepError, match="'progress' is True for a bar"), shown(5):
        pass
