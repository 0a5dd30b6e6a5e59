# SPDX-License-Identifier: LGPL-2.1-or-later
"""Specifications to start from, by names: files that lie in ``recipes`` beside the parameters."""

from __future__ import annotations

import os
from pathlib import Path

from ...util.errors import VolfrepError

FOLDER = Path(__file__).resolve().parent.parent / "recipes"
#: The files by their names, as a user writes them.
RECIPES = {file.stem: file for file in sorted(FOLDER.glob("*.toml"))}


def recipe_or_file(text: str | os.PathLike[str]) -> Path:
    """The file of that path, or else of the recipe of that name; case does not matter.

    Raises:
        VolfrepError: a plain name is neither.

    >>> recipe_or_file("Bone-Like").name
    'bone-like.toml'
    """
    path = Path(text)
    if path.exists() or path.suffix or len(path.parts) != 1:
        return path
    known = RECIPES.get(str(text).lower())
    if known is None:
        raise VolfrepError(
            f"There is no file and no recipe '{text}': recipes are {', '.join(RECIPES)}."
        )
    return known


def describe_recipe(path: str | os.PathLike[str]) -> str:
    """What a recipe's file says of itself: its comments before the first entry."""
    lines = []
    for line in Path(path).read_text(encoding="utf-8").splitlines():
        if not line.startswith("#"):
            break
        lines.append(line.lstrip("# ").rstrip())
    return " ".join(lines)
