# SPDX-License-Identifier: LGPL-2.1-or-later
"""OBJ: vertices and polygons; groups, materials, normals and textures are passed over."""

from __future__ import annotations

import re

import numpy as np

from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.types import Floats, Ints
from ..repair.polygons import cut_polygons
from .contents import Contents, as_numbers, as_words, damaged
from .units import unit_hint


def read_obj(data: bytes, name: str) -> Contents:
    """The polygons of an OBJ file, cut into triangles; all its objects together.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is damaged, or holds no faces.
    """
    if b"\0" in data:
        raise VolfrepError(f"'{name}' is not an OBJ file: it is no text; export it again.")
    # Lines that go on, then blanks in front: after this a line's first letters name its kind.
    text = data.replace(b"\r", b"\n").replace(b"\\\n", b" ")
    text = re.sub(rb"(?m)^[ \t]+", b"", text).replace(b"\t", b" ") + b"\n"
    letters = np.frombuffer(text, np.uint8)
    ends = np.flatnonzero(letters == ord("\n"))
    starts = np.concatenate([[0], ends[:-1] + 1])
    second = letters[np.minimum(starts + 1, len(letters) - 1)] == ord(" ")
    is_vertex = second & (letters[starts] == ord("v"))
    is_face = second & (letters[starts] == ord("f"))
    if not is_face.any():
        raise VolfrepError(f"'{name}' is not an OBJ file with faces: export the solid again.")
    lengths = ends + 1 - starts
    vertices = _vertices(letters[np.repeat(is_vertex, lengths)].tobytes(), name)
    # Negative numbers count back from the last vertex above the face.
    above = np.cumsum(is_vertex)[is_face]
    corners, counts = _faces(letters[np.repeat(is_face, lengths)].tobytes(), above, name)
    bad = np.flatnonzero((corners < 0) | (corners >= len(vertices)))
    if len(bad):
        raise damaged(
            name, f"a face names vertex {corners[bad[0]] + 1}, and there are {len(vertices)}"
        )
    triangles = cut_polygons(vertices, corners, counts, name)
    comments = b"\n".join(re.findall(rb"^#[^\n]*", text[:4096], re.MULTILINE))
    return Contents(TriangleMesh(vertices, triangles.astype(np.int32)), unit_hint(comments))


def _vertices(lines: bytes, name: str) -> Floats:
    """(n, 3) coordinates; colours and weights behind them are passed over."""
    words = as_words(lines.split(), name)
    starts = np.flatnonzero(words == b"v")
    if (np.diff(starts, append=len(words)) < 4).any():
        raise damaged(name, "a vertex has fewer than three coordinates")
    return as_numbers(words[starts[:, None] + np.arange(1, 4)], name)


def _faces(lines: bytes, above: Ints, name: str) -> tuple[Ints, Ints]:
    """Vertex indices from 0, face after face, and how many each face has."""
    words = as_words(re.sub(rb"/[^ \n]*", b"", lines).split(), name)
    starts = np.flatnonzero(words == b"f")
    counts = np.diff(starts, append=len(words)) - 1
    if (counts < 3).any():
        raise damaged(name, "a face has fewer than three corners")
    try:
        numbers = np.delete(words, starts).astype(np.int64)
    except (ValueError, OverflowError) as error:
        raise damaged(name, "a face names a vertex by something that is no whole number") from error
    corners = np.where(numbers > 0, numbers - 1, numbers + np.repeat(above, counts))
    corners[numbers == 0] = -1
    return corners, counts
