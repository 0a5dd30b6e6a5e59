# SPDX-License-Identifier: LGPL-2.1-or-later
"""VTK files read by meshio, within bounds: what they promise, hold and are inflated to.

Its readers are called by name: `meshio.read` exits the program on damaged files.
"""

from __future__ import annotations

import lzma
import math
import os
import re
import struct
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from lzma import LZMADecompressor
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from urllib.parse import unquote
from xml.etree.ElementTree import ParseError

import numpy as np
from numpy.typing import NDArray

from ..util.errors import VolfrepError
from ..util.packages import package
from ..util.types import Floats

#: Numbers of a compressed file, all its arrays together.
MAX_INFLATED_BYTES = 500_000_000
MAX_POINTS = 20_000_000
TOO_MANY = f"'{{}}' holds more than {MAX_POINTS} points: give fewer."
#: What meshio's readers raise at damaged files, besides its own errors: they check little.
DAMAGE = (
    ValueError,
    LookupError,
    TypeError,
    AttributeError,
    AssertionError,
    ArithmeticError,
    EOFError,
    MemoryError,
    NameError,
    RuntimeError,
    ParseError,
    struct.error,
    zlib.error,
    lzma.LZMAError,
)


def load_vtk(file: Path) -> tuple[Floats, dict[str, NDArray[Any]], list[str]]:
    """Points (n, 3), the arrays at the points, and the names of those in the cells.

    Raises:
        VolfrepError: meshio is missing, or the file is damaged, or too large inside.
    """
    mesh, points = mesh_of(file, "save the field as CSV", "an unstructured grid (.vtu) or as CSV")
    # Legacy files write a blank in a name as %20.
    legacy = file.suffix.lower() == ".vtk"
    data = {unquote(k) if legacy else k: np.asarray(v) for k, v in mesh.point_data.items()}
    return points, data, list(mesh.cell_data)


def mesh_of(file: Path, without: str, better: str) -> tuple[Any, Floats]:
    """What meshio reads of a .vtk, .vtu, .inp, .msh or .obj file, and its points (n, 3).

    Args:
        file: which.
        without: what to do without meshio, for the error.
        better: what to save it as if it cannot be read, for the error.

    Raises:
        VolfrepError: meshio is missing, or the file is damaged, or too large inside.
    """
    meshio = package("meshio", f"Reading '{file.name}'", then=f"or {without}")
    kind = file.suffix.lower()
    if kind == ".vtk":
        _refuse_empty_promises(file)
    elif kind == ".vtu":
        _refuse_document_type(file)
    inflated = _Inflated()
    # Not meshio.read: it ends the program when a file is damaged.
    read = {
        ".vtk": meshio.vtk.read, ".vtu": meshio.vtu.read, ".inp": meshio.abaqus.read,
        ".msh": meshio.gmsh.read, ".obj": meshio.obj.read,
    }[kind]  # fmt: skip
    try:
        with inflated.bounding(meshio):
            mesh: Any = read(os.fspath(file))
        points = np.asarray(mesh.points, dtype=np.float64)
    except (meshio.ReadError, meshio._exceptions.CorruptionError, *DAMAGE) as error:
        if inflated.total > MAX_INFLATED_BYTES:
            raise VolfrepError(
                f"'{file.name}' holds more than {MAX_INFLATED_BYTES / 1e6:.0f} MB of numbers once "
                "it is decompressed: give fewer points or arrays."
            ) from error
        raise VolfrepError(
            f"'{file.name}' is damaged, or of a kind that meshio does not read: save it as "
            f"{better}, for instance with ParaView."
        ) from error
    if points.shape[1:] != (3,) or not len(points):
        raise VolfrepError(f"'{file.name}' holds no points in space.")
    return mesh, points


class _Inflated:
    """How much meshio's reader of .vtu files decompresses, and the end of it where it is too much.

    Attributes:
        total: bytes so far.
    """

    def __init__(self) -> None:
        self.total = 0

    @contextmanager
    def bounding(self, meshio: Any) -> Iterator[None]:
        """In place of the two compressors while it reads: blocks say nothing of their size."""
        reader = meshio.vtu._vtu
        kept = reader.zlib, reader.lzma
        reader.zlib = SimpleNamespace(decompress=lambda data: self._all(zlib.decompressobj(), data))
        reader.lzma = SimpleNamespace(decompress=lambda data: self._all(LZMADecompressor(), data))
        try:
            yield
        finally:
            reader.zlib, reader.lzma = kept

    def _all(self, stream: Any, data: bytes) -> bytes:
        """What the data is decompressed to.

        Raises:
            MemoryError: the file is more than `MAX_INFLATED_BYTES`.
        """
        result: bytes = stream.decompress(data, MAX_INFLATED_BYTES - self.total + 1)
        self.total += len(result)
        if self.total > MAX_INFLATED_BYTES:
            raise MemoryError
        return result


def _refuse_document_type(file: Path) -> None:
    """Refuse an XML file that could define entities, which may grow without bound."""
    if re.search(rb"<!(DOCTYPE|ENTITY)", file.read_bytes(), re.IGNORECASE):
        raise VolfrepError(
            f"'{file.name}' declares an XML document type, which VTK files do not have: save it "
            "again, for instance with ParaView."
        )


def _refuse_empty_promises(file: Path) -> None:
    """Refuse a legacy VTK file whose counts its bytes cannot hold, before memory is asked for."""
    data = file.read_bytes()
    counts = (
        rb"(?mi)^[ \t]*(DIMENSIONS|POINTS|CELLS|CELL_TYPES|POINT_DATA|CELL_DATA)((?:[ \t]+\d+)+)"
    )
    for match in re.finditer(counts, data):
        numbers = [int(word[:20]) for word in match[2].split()]
        promised = math.prod(numbers) if match[1].upper() == b"DIMENSIONS" else max(numbers)
        if promised > len(data):
            raise VolfrepError(
                f"'{file.name}' is cut short or damaged: it promises {promised} numbers and has "
                f"{len(data)} bytes."
            )
        if promised > MAX_POINTS and match[1].upper() in (b"DIMENSIONS", b"POINTS"):
            raise VolfrepError(TOO_MANY.format(file.name))
