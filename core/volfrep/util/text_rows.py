# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables of numbers as text: STEP files, solver decks."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

#: Values that are put into one piece of text.
VALUES = 1 << 19


def rows(template: str, *columns: NDArray[np.generic]) -> Iterator[bytes]:
    """The template once for every row of the columns, in pieces of about `VALUES` values.

    Each column is (n,) or (n, k) and fills one or k places of the template in their order.
    """
    wide = [column.reshape(len(column), -1) for column in columns]
    width = sum(column.shape[1] for column in wide)
    step = max(1, VALUES // width)
    for start in range(0, len(wide[0]), step):
        parts = [column[start : start + step] for column in wide]
        table = np.empty((len(parts[0]), width), object)
        filled = 0
        for part in parts:
            table[:, filled : filled + part.shape[1]] = part
            filled += part.shape[1]
        yield ((template * len(table)) % tuple(table.ravel())).encode("ascii")
