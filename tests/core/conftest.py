# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random searches: the same ones every time in `make test`, new ones in `make test-random`.

What a new search finds becomes an explicit example of its test. No search is timed.

Also which cases are slow: those that a mark stands beside, and those of slow_cases.txt.

And the folders in which `make setup` puts pyvista, and what studies take, apart from what FreeCAD
sees. The latter come last: what is Debian's stays so.
"""

import sys
from pathlib import Path

import pytest
from hypothesis import settings

_CACHE = Path(__file__).resolve().parents[2] / ".cache"
sys.path.insert(0, str(_CACHE / "plot"))
sys.path.append(str(_CACHE / "study"))

settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.register_profile("random", deadline=None, print_blob=True, max_examples=300)
settings.load_profile("fixed")

_HERE = Path(__file__).resolve().parent
_SLOW = {
    line
    for line in (_HERE / "slow_cases.txt").read_text(encoding="utf-8").splitlines()
    if not line.startswith("#")
}


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark the cases of slow_cases.txt, before pytest looks at marks.

    Raises:
        pytest.UsageError: a line names a case that is none any more, of a file that was collected.
    """
    names = {item.nodeid.rpartition("tests/core/")[2]: item for item in items}
    for name in _SLOW & names.keys():
        names[name].add_marker("slow")
    if not any("::" in argument for argument in config.invocation_params.args):
        files = {name.partition("::")[0] for name in names}
        gone = [line for line in sorted(_SLOW - names.keys()) if line.partition("::")[0] in files]
        if gone:
            raise pytest.UsageError(f"slow_cases.txt names {gone[0]}, which is no case any more.")
