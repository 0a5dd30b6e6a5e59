# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tables as frames of pandas, which is optional (``pip install volfrep[study]``)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from .errors import VolfrepError

if TYPE_CHECKING:
    import pandas


def make_frame(columns: Mapping[str, Any], index: Sequence[str] | None = None) -> pandas.DataFrame:
    """A frame of columns by name.

    Raises:
        VolfrepError: pandas is missing.
    """
    try:
        import pandas
    except ImportError as error:
        raise VolfrepError(
            "A table as a frame needs pandas, which is missing: pip install pandas."
        ) from error
    return pandas.DataFrame(dict(columns), index=index)
