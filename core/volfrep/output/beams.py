# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF files whose lattice is beams, alone or beside the part's triangles."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping

from ..design.spec import LatticeSpec
from ..grid.strut_graph import BeamModel
from ..io.write.threemf import BEAMS_ONLY, write_3mf_beams
from .writer import Settings, Source, Writer, Written


class BeamsWriter(Writer):
    """Beams and a skin, made without a mesh of the lattice."""

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`."""
        model = source.beams
        write_3mf_beams(model, path, figures=_figures_of(source, model))
        struts, nodes = len(model.lattice.struts), len(model.lattice.nodes)
        row = ("struts", f"{struts:,} between {nodes:,} nodes, as beams")
        return Written((*model.warnings, *model.loose, BEAMS_ONLY), (row,))


def _figures_of(source: Source, model: BeamModel) -> Mapping[str, str]:
    """What is known without a mesh: counts, and what was asked for.

    A document hands over the beams alone, without a specification, and its own figures.
    """
    asked: LatticeSpec | None = source.spec
    if asked is None:
        return source.figures
    spec = asked.as_dict()
    struts, nodes = len(model.lattice.struts), len(model.lattice.nodes)
    what = spec["cell"] if asked.kind.has_grid else "Strut graph"
    return {
        "Description": f"{what}: {struts:,} struts as beams between {nodes:,} nodes",
        "Struts": str(struts),
        "Nodes": str(nodes),
        "Specification": json.dumps(spec, sort_keys=True),
    }


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
