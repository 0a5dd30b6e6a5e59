# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice infill as layers for a printer, straight from its struts, joints and walls."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.features.jobs.progress import job_title, run_job
from volfrep.util.errors import VolfrepError

from .exact import infill_made_of, warn

if TYPE_CHECKING:
    from volfrep.jobs.slices import Layers

#: What layers of a new file are proposed to be, mm: usual for resin printers.
LAYER = PIXEL = 0.05


def layers_folder(path: str | os.PathLike[str]) -> Path:
    """The folder of a name that was typed with the extension of one of its layers."""
    return Path(path).with_suffix("")


def estimate_layers(obj: App.DocumentObject, layer: float, pixel: float | None) -> str:
    """How many layers, and of how many pixels, as a sentence without its full stop.

    Args:
        obj: a lattice infill with a mesh.
        layer: height of a layer, mm.
        pixel: edge of a picture's pixel, mm; None where there are no pictures.
    """
    import numpy as np

    from volfrep.slicing.layers import layer_heights
    from volfrep.slicing.raster import pixel_grid

    box = obj.Mesh.BoundBox
    bounds = np.array([[box.XMin, box.YMin, box.ZMin], [box.XMax, box.YMax, box.ZMax]])
    count = f"{len(layer_heights(bounds, layer)):,} layers of {layer:g} mm"
    if pixel is None:
        return count
    rows, columns = pixel_grid(bounds, pixel).shape
    return f"{count}, each a picture of {columns:,} x {rows:,} pixels"


def export_layers(
    obj: App.DocumentObject,
    folder: str | os.PathLike[str],
    layer: float = LAYER,
    pixel: float | None = None,
    form: str = "png",
) -> Layers:
    """Write an infill layer by layer along z, without its mesh; what was written.

    Heights and outlines lie as the infill's base does in its own App::Part: a printer's program
    moves a part onto its plate in any case.

    Args:
        obj: a lattice infill whose mesh fits its properties.
        folder: to make; one that holds layers is replaced, any other must be empty.
        layer: height of a layer, mm.
        pixel: edge of a picture's pixel, mm; None for the height of a layer.
        form: png, svg or cli; see `volfrep.jobs.slices.FORMATS`.

    Raises:
        VolfrepError: that is no lattice infill, it is out of date or turned, or as
            `volfrep.jobs.slices.write_layers`.
        Cancelled: in the window, by the user; what was there before stays.
    """
    from freecad_volfrep.bridge.beams import place_in_document
    from volfrep.jobs.slices import write_layers

    solid, spec, cache = infill_made_of(obj)
    if abs(place_in_document(obj).Rotation.Angle) > 1e-9:
        raise VolfrepError(
            f"'{obj.Label}' is turned by its Placement or its App::Part's, and layers are cut as "
            "its base lies: turn the base instead, so that z points off the build plate."
        )
    made: Layers = run_job(
        job_title("Layers of {label}", obj), write_layers, solid, spec, os.fspath(folder),
        layer=layer, pixel=pixel, form=form, cache=cache,
    )  # fmt: skip
    warn(obj, made.warnings)
    return made
