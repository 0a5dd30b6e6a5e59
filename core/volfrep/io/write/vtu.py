# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bricks with values at nodes and in elements as a VTK file of unstructured cells, for ParaView."""

from __future__ import annotations

import os
import struct
from collections.abc import Mapping
from xml.sax.saxutils import quoteattr

import numpy as np
from numpy.typing import NDArray

from ...util.files import replacing
from ...util.types import Floats

#: VTK's number of a hexahedron; and its corners, of ours with z fastest.
_HEXAHEDRON = 12
_CORNERS = [0, 4, 6, 2, 1, 5, 7, 3]
_KINDS = {"f4": "Float32", "i4": "Int32", "u1": "UInt8"}


def write_vtu(
    path: str | os.PathLike[str],
    nodes: Floats,
    bricks: NDArray[np.int32],
    points: Mapping[str, Floats],
    cells: Mapping[str, Floats],
) -> None:
    """Write bricks.

    Args:
        path: of the file, .vtu.
        nodes: (n, 3) mm.
        bricks: (e, 8) rows of `nodes`, z fastest, then y.
        points: (n,) or (n, 3) values by their names.
        cells: (e,) values by their names.

    Raises:
        VolfrepError: it cannot be written.
    """
    count = len(bricks)
    parts: list[NDArray[np.generic]] = []
    begin = 0

    def array(name: str, values: NDArray[np.generic], kind: str) -> str:
        nonlocal begin
        values = np.ascontiguousarray(values, f"<{kind}")
        wide = values.shape[1] if values.ndim == 2 else 1
        text = (
            f'<DataArray type="{_KINDS[kind]}" Name={quoteattr(name)} NumberOfComponents="{wide}" '
            f'format="appended" offset="{begin}"/>\n'
        )
        begin += 8 + values.nbytes
        parts.append(values)
        return text

    def floats(values: Mapping[str, Floats]) -> str:
        return "".join(array(name, value, "f4") for name, value in values.items())

    text = (
        '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" '
        'byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
        f'<Piece NumberOfPoints="{len(nodes)}" NumberOfCells="{count}">\n'
        f"<PointData>\n{floats(points)}</PointData>\n<CellData>\n{floats(cells)}</CellData>\n"
        f"<Points>\n{array('Points', nodes, 'f4')}</Points>\n<Cells>\n"
        f"{array('connectivity', bricks[:, _CORNERS].ravel(), 'i4')}"
        f"{array('offsets', 8 * np.arange(1, count + 1), 'i4')}"
        f"{array('types', np.full(count, _HEXAHEDRON), 'u1')}"
        '</Cells>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_'
    )
    with replacing(path) as file:
        file.write(text.encode())
        for values in parts:
            file.write(struct.pack("<Q", values.nbytes))
            file.write(values.tobytes())
        file.write(b"\n</AppendedData>\n</VTKFile>\n")
