# SPDX-License-Identifier: LGPL-2.1-or-later
"""The examples in the engine's docstrings do what they say."""

from __future__ import annotations

import doctest
from functools import cached_property
from importlib import import_module
from pathlib import Path

import pytest

import volfrep

ENGINE = Path(__file__).resolve().parents[2] / "core"
WITH_EXAMPLES = sorted(
    ".".join(path.relative_to(ENGINE).with_suffix("").parts).removesuffix(".__init__")
    for path in ENGINE.rglob("*.py")
    if ">>> " in path.read_text(encoding="utf-8")
)


@pytest.mark.costly_cases("volfrep.api.calls", "volfrep.api.part")
@pytest.mark.slow_cases(
    "volfrep.studies.sweep",
    "volfrep.jobs.figures.find",
    "volfrep.tpms.widths",
    "volfrep.mechanics.density",
    "volfrep.mechanics.summary",
    "volfrep.reports.largest_ball",
)
@pytest.mark.parametrize("name", WITH_EXAMPLES)
def test_examples_in_docstrings(name: str) -> None:
    result = doctest.testmod(import_module(name))
    assert result.attempted > 0
    assert result.failed == 0


def _documented() -> list[tuple[str, object]]:
    """Public names, and the public methods of what scripts hold in their hands."""
    found = [(name, getattr(volfrep, name)) for name in volfrep.__all__]
    for owner in (volfrep.Part, volfrep.CellProperties):
        for name, member in vars(owner).items():
            if not name.startswith("_") and (
                callable(member) or isinstance(member, (property, cached_property))
            ):
                found.append((f"{owner.__name__}.{name}", member))
    return found


@pytest.mark.parametrize(("name", "what"), _documented(), ids=[one for one, _ in _documented()])
def test_every_public_name_has_an_example(name: str, what: object) -> None:
    assert ">>> " in (what.__doc__ or ""), f"{name} has no example"
