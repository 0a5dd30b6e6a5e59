# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names that have changed: each works for two minor versions with a warning, then is refused.

The keywords of calls, the keys of specification files and the options of the command are one set
of names (`design/parameters/table`), and so is what happened to them: `PARAMETERS`. `NAMES` is of
the package itself. A change of either is a row here, and nothing else.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import NamedTuple

from .errors import VolfrepError
from .version import VERSION

#: For so many minor versions after its change an old name works.
MINOR_VERSIONS = 2


class Renamed(NamedTuple):
    """What a name is now, and the first version in which it was: "0.3"."""

    now: str
    since: str


#: Parameters, as keywords and files have them: with underscores.
PARAMETERS: dict[str, Renamed] = {}
#: Public names of the package.
NAMES: dict[str, Renamed] = {}


def current_name(
    name: str,
    table: dict[str, Renamed],
    spelled: Callable[[str], str] = str,
    warn: Callable[[str], object] | None = None,
) -> str:
    """What a name is called now: itself, where it did not change.

    Args:
        name: as it was given.
        table: of the changes.
        spelled: how names are written where this one stands.
        warn: told of an old name; None for a `DeprecationWarning` at the caller's caller.

    Raises:
        VolfrepError: an old name, two minor versions later.
    """
    if name not in table:
        return name
    now, since = table[name]
    if minor(VERSION) >= minor(since) + MINOR_VERSIONS:
        raise VolfrepError(f"'{spelled(name)}' is called '{spelled(now)}' now.")
    sentence = (
        f"'{spelled(name)}' is called '{spelled(now)}' since version {since}, and is refused "
        f"{MINOR_VERSIONS} minor versions later."
    )
    if warn is None:
        warnings.warn(sentence, DeprecationWarning, stacklevel=3)
    else:
        warn(sentence)
    return now


def minor(version: str) -> int:
    """The number of a minor version: of 1.2.3 that is 1002."""
    first, second = version.split(".")[:2]
    return 1000 * int(first) + int(second)
