# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random searches: the same ones every time in `make test`, new ones in `make test-random`.

What a new search finds becomes an explicit example of its test. No search is timed.

And the folder in which `make setup` puts pyvista, apart from what FreeCAD sees.
"""

import sys
from pathlib import Path

from hypothesis import settings

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / ".cache" / "plot"))

settings.register_profile("fixed", derandomize=True, database=None, deadline=None)
settings.register_profile("random", deadline=None, print_blob=True, max_examples=300)
settings.load_profile("fixed")
