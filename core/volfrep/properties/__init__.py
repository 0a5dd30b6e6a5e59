# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cell's lattice does: density, stiffness, strength, conductance; materials; a catalogue.

The package is also the function `volfrep.properties(...)`: see `summary.cell_properties`.
"""

from __future__ import annotations

import sys
from types import ModuleType
from typing import Any


class _Callable(ModuleType):
    def __call__(self, *arguments: Any, **named: Any) -> Any:
        from .summary import cell_properties

        return cell_properties(*arguments, **named)


sys.modules[__name__].__class__ = _Callable
