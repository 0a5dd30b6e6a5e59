# SPDX-License-Identifier: LGPL-2.1-or-later
"""What can go wrong, as exceptions whose text is one sentence meant for a user."""


def brief(value: object) -> str:
    """A value in one short line, for a sentence."""
    text = " ".join(repr(value).split())
    return text if len(text) <= 60 else f"{text[:57]}..."


class VolfrepError(ValueError):
    """Bad input: the text names what is wrong, where, and what to do about it."""


class Cancelled(Exception):
    """The progress callback asked to stop; nothing was written."""
