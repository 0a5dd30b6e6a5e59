# SPDX-License-Identifier: LGPL-2.1-or-later
"""What only a checkout needs: its engine lies in the folder ``core`` beside the workbench.

An archive of the add-on has no such module; there the engine is a package of the workbench.
"""

from __future__ import annotations

import sys
from pathlib import Path

_CORE = str(Path(__file__).resolve().parent.parent / "core")
if _CORE not in sys.path:
    # In front, so that the workbench runs the engine it was shipped with; the folder holds
    # nothing but the package `volfrep`.
    sys.path.insert(0, _CORE)
