# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a file gives: its bytes within bounds, then triangles, a unit, and what was odd."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...mesh.triangle_mesh import TriangleMesh
from ...util import reading
from ...util.errors import VolfrepError
from ...util.types import Floats

Words = NDArray[np.bytes_]

MAX_FILE_BYTES = 4_000_000_000
#: The longest word that can be a number: more would only be a way to ask for memory.
LONGEST_WORD = 64
_GIT_LFS = b"version https://git-lfs"


@dataclass(frozen=True, eq=False)
class Contents:
    """A file's triangles as they are, nothing repaired.

    Attributes:
        mesh: in the file's own unit.
        unit: the unit that the file names, a key of `units.UNITS`; None where it names none.
        warnings: sentences about what was odd and was passed over.
    """

    mesh: TriangleMesh
    unit: str | None = None
    warnings: tuple[str, ...] = ()


def read_bytes(file: Path) -> bytes:
    """All of a regular file.

    Raises:
        VolfrepError: it cannot be read, is empty, too large, or plainly something else.
    """
    data = reading.read_bytes(file, "part", MAX_FILE_BYTES)
    start = data[:512].lstrip().lower()
    if not start and not data.strip():
        raise VolfrepError(f"'{file.name}' is empty: export the solid again.")
    if start.startswith((b"<!doctype html", b"<html")):
        raise VolfrepError(
            f"'{file.name}' is a web page, not a mesh: download the file itself again."
        )
    if start.startswith(_GIT_LFS):
        raise VolfrepError(
            f"'{file.name}' only points at a file kept by Git LFS: fetch that with 'git lfs pull'."
        )
    return data


def damaged(name: str, what: str) -> VolfrepError:
    """The refusal of a broken file; `what` goes on after 'is damaged:'."""
    return VolfrepError(f"'{name}' is damaged: {what}; export it again.")


def as_words(words: list[bytes], name: str) -> Words:
    """Words as an array, none of them longer than a number can be.

    Raises:
        VolfrepError: one is longer.
    """
    if words and max(map(len, words)) > LONGEST_WORD:
        longest = max(words, key=len)
        raise damaged(name, f"it has a word of {len(longest)} letters where a number belongs")
    return np.array(words, dtype=bytes)


def as_numbers(words: Words, name: str) -> Floats:
    """The numbers that words stand for, in the same shape.

    Raises:
        VolfrepError: one of them is no number.
    """
    try:
        return words.astype(np.float64)
    except ValueError as error:
        # Each word by itself, only to name the one that is wrong.
        wrong = next(word for word in words.ravel().tolist() if not _is_number(word))
        text = wrong.decode("ascii", "replace")
        if _is_number(wrong.replace(b",", b".")):
            raise VolfrepError(
                f"'{name}' has numbers with a decimal comma, as '{text}': export it with "
                "decimal points."
            ) from error
        raise damaged(name, f"'{text}' is not a number") from error


def _is_number(word: bytes) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True


def triangle_soup(corners: Floats) -> TriangleMesh:
    """A mesh of (3 m, 3) corners in which no two triangles share a vertex."""
    return TriangleMesh(corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
