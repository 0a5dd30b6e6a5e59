# SPDX-License-Identifier: LGPL-2.1-or-later
"""A filled part straight to layers on the disk, without a mesh."""

from __future__ import annotations

import math
import os
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..design.spec import LatticeSpec
from ..grid.strut_graph import NO_STRUTS, Wireframe
from ..io.write.layer_files import CLI_END, cli_header, cli_layer, png, svg
from ..io.write.layer_folder import replacing_layers
from ..mesh.triangle_mesh import TriangleMesh, box_of
from ..slicing.layers import Section, SolidParts, each_section, layer_heights, whole
from ..slicing.raster import pixel_grid
from ..trim.beam_model import deformed_struts, joined_boundary
from ..util.cache import StageCache
from ..util.errors import VolfrepError
from ..util.numbers import number
from ..util.progress import ProgressCallback
from .infill import Infill
from .targets import solve_target

#: How layers are written.
FORMATS = ("png", "svg", "cli")
#: Active cells up to which the lattice is held as a whole, so that what hangs on nothing is found.
MOST_WHOLE = 200_000
#: Outlines stray from the true ones by at most this share of a strut's radius.
_ERROR = 0.01
MOST_LAYERS = 1_000_000
#: Pixels that a layer may have.
MOST_PIXELS = 1_000_000_000


@dataclass(frozen=True)
class Layers:
    """What was written.

    Attributes:
        count: of layers.
        area: of all layers together, mm2.
        volume: which they make up, mm3.
        mass: in g.
        pixels: columns and rows of a picture; None where there are none.
        seconds: that it took.
        warnings: sentences for the user.
    """

    count: int
    area: float
    volume: float
    mass: float
    pixels: tuple[int, int] | None
    seconds: float
    warnings: tuple[str, ...]

    def rows(self) -> list[tuple[str, str]]:
        """What a user reads: names and values."""
        rows = [("layers", f"{self.count:,}")]
        if self.pixels is not None:
            rows.append(("pixels", f"{self.pixels[0]:,} x {self.pixels[1]:,}"))
        rows += [("volume", f"{self.volume:,.1f} mm3"), ("mass", f"{self.mass:.4g} g")]
        return [*rows, ("time", f"{self.seconds:.1f} s")]


def write_layers(
    solid: TriangleMesh,
    spec: LatticeSpec,
    folder: str | os.PathLike[str],
    *,
    layer: float,
    pixel: float | None = None,
    form: str = "png",
    progress: ProgressCallback | None = None,
    cache: StageCache | None = None,
) -> Layers:
    """Fill a solid and write it in layers along z, straight from struts, joints and walls.

    A layer is cut at its middle. Memory holds the walls and a few layers, so that lattices that
    no mesh could hold can be printed.

    Args:
        solid: checked closed mesh, mm, as it stands on the build plate.
        spec: what to fill it with.
        folder: to make; of one that holds layers, those of the last run are replaced; any
            other must be empty.
        layer: height of a layer, mm.
        pixel: edge of a picture's pixel, mm; None for the height of a layer.
        form: png (a picture a layer: of each pixel the share of material, 0 to 255), svg (a
            drawing a layer), or cli (one file of the common layer interface).
        progress: called with the fraction done and the stage; returning False cancels.
        cache: keeps the stages between calls.

    Raises:
        VolfrepError: as `fill`; or sizes that make no sense, fillets, or a folder that holds
            something else.
        Cancelled: the callback said so; what was there before stays.
    """
    start = time.perf_counter()
    number("layer height", layer, "mm", positive=True)
    if form not in FORMATS:
        raise VolfrepError(f"There is no format '{form}': choose one of {', '.join(FORMATS)}.")
    if pixel is not None and form != "png":
        raise VolfrepError(f"Only pictures have pixels: leave them out for {form}.")
    pixel = number("pixel", layer if pixel is None else pixel, "mm", positive=True)
    if spec.struts.fillet > 0:
        raise VolfrepError(
            "Layers have no fillets between struts: set the fillet to 0, or write the mesh and "
            "slice it with the printer's own program."
        )
    if deformed_struts(spec.grid, spec.struts):
        raise VolfrepError(
            "Layers have straight and round struts, and these are deformed with their cells: let "
            "them keep their radius, or write the mesh."
        )
    infill = solve_target(solid, spec, progress=progress, cache=cache, meshed=False)
    spec = infill.spec
    part, warnings = _parts(infill)
    wanted = float(np.ptp(part.bounds[:, 2])) / layer
    if wanted > MOST_LAYERS:
        raise VolfrepError(
            f"Layers of {layer:g} mm would be {wanted:.3g}, and the most is {MOST_LAYERS:,}: make "
            "them higher."
        )
    heights = layer_heights(part.bounds, layer)
    grid = pixel_grid(part.bounds, pixel)
    if form == "png" and math.prod(grid.shape) > MOST_PIXELS:
        rows, columns = grid.shape
        raise VolfrepError(
            f"A layer would have {columns:,} x {rows:,} pixels of {pixel:g} mm: make them larger."
        )
    error = _ERROR * spec.struts.extremes[0]
    if form == "png":
        error = max(error, 0.1 * pixel)

    def made(section: Section, z: float) -> tuple[bytes, float]:
        if form == "png":
            found, area = section.pixels(grid)
            return png(found, grid), area
        outline = section.outline()
        if form == "svg":
            return svg(outline, part.bounds), outline.area()
        return cli_layer(outline, z + 0.5 * layer), outline.area()

    with (
        infill.monitor.stage("slice", 0.4, 1.0),
        replacing_layers(folder) as (
            place,
            figures,
        ),
    ):
        sections = each_section(part, heights, error, made, infill.monitor)
        areas, files = _write_layers(sections, place, form, len(heights))
        volume = float(sum(areas) * layer)
        done = Layers(
            len(areas), float(sum(areas)), volume, volume * spec.density * 1e-3,
            (grid.shape[1], grid.shape[0]) if form == "png" else None,
            time.perf_counter() - start, warnings,
        )  # fmt: skip
        figures |= {
            "program": "VOLFREP", "unit": "mm", "format": form, "layer_height": layer,
            "volume_mm3": done.volume, "mass_g": done.mass,
            "bounds": part.bounds.tolist(), "warnings": list(warnings),
            "layers": [
                {"z": round(float(z), 6), "area_mm2": round(area, 6), "file": file}
                for z, area, file in zip(heights, areas, files, strict=True)
            ],
        }  # fmt: skip
        if form == "png":
            corner = (grid.origin[0], grid.origin[1] + grid.shape[0] * pixel)
            figures["pixel"] = {"edge": pixel, "count": done.pixels, "upper_left": corner}
    return done


def _write_layers(
    layers: Iterator[tuple[bytes, float]], place: Path, form: str, count: int
) -> tuple[list[float], list[str]]:
    """Write layers as they come: the area of each, and the file it is in."""
    areas, files = [], []
    if form == "cli":
        with (place / "part.cli").open("xb") as file:
            file.write(cli_header(count))
            for data, area in layers:
                file.write(data)
                areas.append(area)
            file.write(CLI_END)
        return areas, ["part.cli"] * count
    for place_of, (data, area) in enumerate(layers):
        files.append(f"layer_{place_of:06d}.{form}")
        (place / files[-1]).write_bytes(data)
        areas.append(area)
    return areas, files


def _parts(infill: Infill) -> tuple[SolidParts, tuple[str, ...]]:
    """What a filled part consists of, and what is to be told of it."""
    spec, solid = infill.spec, infill.solid
    if spec.output == "domain":
        return SolidParts(whole(NO_STRUTS), None, infill.cavity, solid.bounds), infill.warnings
    mapping = infill.placement.mapping
    is_straight = mapping is None or mapping.is_rigid
    cells = infill.cells
    is_large = cells is not None and int(cells.active.sum()) > MOST_WHOLE
    if cells and is_large and is_straight and spec.drains is None and infill.pruned is None:
        between = infill.filling.slabs()
        if between is not None:
            return _in_slabs(infill, between, int(cells.active.sum()))
    beams = infill.beams
    bounds = solid.bounds
    if beams.clip is None:
        reach = beams.lattice.joint_radii[:, None]
        ends = np.concatenate([beams.lattice.nodes - reach, beams.lattice.nodes + reach])
        bounds = box_of(np.concatenate([ends, bounds] if beams.skin is not None else [ends]))
    return SolidParts(whole(beams.lattice), beams.clip, beams.skin, bounds), beams.warnings


def _in_slabs(
    infill: Infill, between: Callable[[float, float], Wireframe], cells: int
) -> tuple[SolidParts, tuple[str, ...]]:
    """The same of a lattice too large to be held as a whole: its struts come slab by slab."""
    spec, solid = infill.spec, infill.solid
    has_skin = spec.output == "part" and spec.skin is not None
    clip = None
    if has_skin or spec.ending.is_trimmed:
        clip = solid if has_skin or spec.skin is None else infill.cavity
    boundary = joined_boundary(solid, infill.cavity, spec.skin) if has_skin and spec.skin else None
    note = (
        f"The lattice has {cells:,} cells, so its struts were made layer by layer, and none "
        "was left out because it hangs on nothing.",
    )
    return SolidParts(between, clip, boundary, solid.bounds), infill.warnings + note
