# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables as frames of pandas, which is optional."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .packages import package

if TYPE_CHECKING:
    import pandas


def make_frame(columns: Mapping[str, Any], index: Sequence[str] | None = None) -> pandas.DataFrame:
    """A frame of columns by name.

    Raises:
        MissingPackage: pandas is missing.
    """
    frame: pandas.DataFrame = package("pandas", "A table as a frame").DataFrame
    return frame(dict(columns), index=index)
