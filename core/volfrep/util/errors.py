# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can go wrong, as exceptions whose text is one sentence meant for a user."""

from collections.abc import Iterable


def brief(value: object) -> str:
    """A value in one short line, for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


def listed(names: Iterable[str], last: str = "or") -> str:
    """Names with commas, and `last` before the last."""
    *before, end = list(names) or [""]
    return f" {last} ".join(filter(None, (", ".join(before), end)))


class VolfrepError(ValueError):
    """Bad input: the text names what is wrong, where, and what to do about it.

    >>> import volfrep
    >>> try:
    ...     part = volfrep.block((1, 1, 1), cel="BCC")
    ... except volfrep.VolfrepError as error:
    ...     print(error)
    A lattice has no parameter 'cel': did you mean 'cell'?
    """


class Cancelled(Exception):
    """The progress callback asked to stop; nothing was written.

    >>> import volfrep
    >>> def refuse(fraction, stage):
    ...     return False
    >>> try:
    ...     part = volfrep.block((1, 1, 1), cell="BCC", progress=refuse)
    ... except volfrep.Cancelled:
    ...     print("nothing was made")
    nothing was made
    """
