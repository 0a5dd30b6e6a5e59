# SPDX-License-Identifier: LGPL-2.1-or-later
"""A form of output as somebody would add it: one class, and one row for the table."""

from __future__ import annotations

import os
from pathlib import Path

from volfrep.output.form import MESH, Form
from volfrep.output.writer import Settings, Source, Writer, Written

ROW = Form("xyz", "Points", (".xyz",), "dummy_form:PointsWriter", (MESH,))


class PointsWriter(Writer):
    """The vertices, a line each."""

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        lines = [" ".join(f"{x:.6g}" for x in point) for point in source.mesh.vertices.tolist()]
        Path(path).write_text("\n".join(lines) + "\n", encoding="utf-8")
        return Written(("Points have no triangles.",))
