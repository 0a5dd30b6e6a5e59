# SPDX-License-Identifier: LGPL-2.1-or-later
"""Options of a run are rows of one table: each stands once in a command, and does what it says."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

from volfrep.cli.run_options import RUN_OPTIONS, add_run_options, refuse_extensions
from volfrep.util.errors import VolfrepError

COMMANDS = sorted({name for row in RUN_OPTIONS for name in row.commands})


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_has_an_option_once(command: str) -> None:
    names = [row.option for row in RUN_OPTIONS if command in row.commands]
    assert len(names) == len(set(names))


def test_a_name_stands_for_the_same_file_in_every_command() -> None:
    for stored in {row.stored for row in RUN_OPTIONS if row.commands != ("sweep",)}:
        rows = [row for row in RUN_OPTIONS if row.stored == stored]
        assert len({row.reads for row in rows}) == 1
        assert len({row.writes for row in rows if row.commands != ("sweep",)}) == 1


def parsed(command: str, *arguments: str) -> argparse.Namespace:
    parser = argparse.ArgumentParser()
    add_run_options(parser, command)
    return parser.parse_args(arguments)


def test_values_are_read_as_the_table_says() -> None:
    found = parsed("slice", "-o", "layers", "--layer", "0.05")
    assert (found.output, found.layer, found.pixel, found.format) == ("layers", 0.05, None, "png")
    found = parsed("sweep", "--output", "runs", "--shard", "2/4", "--dry-run")
    assert (found.shard, found.dry_run, found.quiet) == ((2, 4), True, False)
    assert parsed("block", "-o", "a.stl", "--count", "1,2,3").count == (1, 2, 3)


@pytest.mark.parametrize(
    ("option", "word", "good"),
    [("--3mf", "both", ".3mf"), ("--step", "exact", ".stp"), ("--inp", "tetrahedra", ".INP")],
)
def test_a_form_goes_with_its_own_files_only(option: str, word: str, good: str) -> None:
    found = parsed("fill", "-o", "out", option, word)
    refuse_extensions(found, "fill", Path(f"out{good}"))
    with pytest.raises(VolfrepError, match=rf"'out.stl' cannot hold what {option} asks for"):
        refuse_extensions(found, "fill", Path("out.stl"))
