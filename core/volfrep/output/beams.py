# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF files whose lattice is beams, alone or beside the part's triangles."""

from __future__ import annotations

import os

from ..io.write.threemf import BEAMS_ONLY, write_3mf_beams
from .writer import Settings, Source, Writer, Written


class BeamsWriter(Writer):
    """Beams and a skin, made without a mesh of the lattice."""

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        model = source.beams
        write_3mf_beams(model, path)
        struts, nodes = len(model.lattice.struts), len(model.lattice.nodes)
        row = ("struts", f"{struts:,} between {nodes:,} nodes, as beams")
        return Written((*model.warnings, *model.loose, BEAMS_ONLY), (row,))


class BothWriter(Writer):
    """Beams, and the part as triangles for readers that do not know beams."""

    def settle(self, source: Source) -> tuple[Writer, tuple[str, ...]]:
        """What beams cannot be is refused before the mesh is made."""
        _ = source.beams
        return self, ()

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        model = source.beams
        write_3mf_beams(model, path, source.surface, figures=source.figures)
        return Written(model.warnings)
