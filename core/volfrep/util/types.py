# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names for the arrays, and for the tuples, that the engine passes about."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]
Bools = NDArray[np.bool_]

#: Along which axes a grid closes upon itself; and none of them.
Periodic = tuple[bool, bool, bool]
OPEN: Periodic = (False, False, False)
