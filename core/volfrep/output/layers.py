# SPDX-License-Identifier: LGPL-2.1-or-later
"""Folders of layers along z, cut straight from struts, joints and the skin."""

from __future__ import annotations

import os

from ..util.errors import VolfrepError
from .writer import Settings, Source, Writer, Written


class LayersWriter(Writer):
    """Pictures, drawings, or one file of the common layer interface."""

    def write(self, source: Source, path: str | os.PathLike[str], settings: Settings) -> Written:
        """As of `Writer`.

        Raises:
            VolfrepError: no height of a layer is given, or as `jobs.slices.write_layers`.
        """
        if settings.layer is None:
            raise VolfrepError("Layers need a height: give layer=0.05, in mm, or another one.")
        made = source.layers(path, self.form.word, settings.layer, settings.pixel)
        return Written(made.warnings, tuple(made.rows()), made)
