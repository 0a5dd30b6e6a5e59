# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications to start from: each makes sense, says what it is, and goes by its name."""

from pathlib import Path

import pytest

from volfrep.design.parameters.recipes import RECIPES, describe_recipe, recipe_or_file
from volfrep.design.parameters.spec_file import read_spec, write_spec
from volfrep.util.errors import VolfrepError


@pytest.mark.parametrize("name", RECIPES)
def test_every_recipe_can_be_read_and_says_what_it_is(name: str, tmp_path: Path) -> None:
    spec = read_spec(name.upper())
    assert len(describe_recipe(RECIPES[name])) > 40
    write_spec(spec, tmp_path / "copy.toml")
    assert read_spec(tmp_path / "copy.toml") == spec


def test_a_file_goes_before_a_recipe_of_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    assert recipe_or_file("cushion") == RECIPES["cushion"]
    Path("cushion").write_text('cell = "Box"')
    assert recipe_or_file("cushion") == Path("cushion")


def test_what_is_neither_is_told_with_the_names() -> None:
    with pytest.raises(VolfrepError, match="no recipe 'pillow': recipes are bone-like, cushion"):
        read_spec("pillow")
    with pytest.raises(VolfrepError, match="Cannot read the specification"):
        read_spec("pillow.toml")
