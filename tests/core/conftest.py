# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random searches: the same ones every time in `make test`, new ones in `make test-random`.

What a new search finds becomes an explicit example of its test. No search is timed, and none takes
constants out of the modules that happen to be loaded: Hypothesis would read them all in every
process, Debian's packages as well, and what it tries would depend on them.

Also the folders in which `make setup` puts pyvista, and what studies take, apart from what FreeCAD
sees. The latter come last: what is Debian's stays so.
"""

import sys
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis.internal.conjecture import providers

_CACHE = Path(__file__).resolve().parents[2] / ".cache"
sys.path.insert(0, str(_CACHE / "plot"))
sys.path.append(str(_CACHE / "study"))

settings.register_profile("fixed", derandomize=True, database=None, deadline=None, max_examples=50)
settings.register_profile("random", deadline=None, print_blob=True, max_examples=300)
settings.load_profile("fixed")
if hasattr(providers, "is_local_module_file"):
    providers.is_local_module_file = lambda path: False


@pytest.fixture(scope="session", autouse=True)
def _stages_shared() -> None:
    import shared_stages

    shared_stages.share()


@pytest.fixture(autouse=True)
def _shares_stages(request: pytest.FixtureRequest, _stages_shared: None) -> None:
    import shared_stages

    shared_stages.ON[0] = "monkeypatch" not in request.fixturenames
