# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF projects for slicers: a part, and modifiers within which another infill holds.

There are two layouts. PrusaSlicer reads all volumes of an object from one mesh, as ranges of its
triangles that ``Metadata/Slic3r_PE_model.config`` names (its source, ``Format/3mf.cpp``, 2.9.4).
OrcaSlicer and Bambu Studio read an object of components, each a mesh, which
``Metadata/model_settings.config`` names (``Format/bbs_3mf.cpp``). Both take any of their settings
for an object or a volume. One file cannot be both.

Of another program's file the latter moves the first mesh only to where the item lies, so that the
components say where they lie and the item does not.

A file does not claim to be saved by either program, so that none takes the settings of its
printer or filament from it.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import chain
from pathlib import Path

import numpy as np

from ... import __version__
from ...design.banded_infill import HOOKED, JOINED, BandedInfill
from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError, listed
from ...util.files import replacing
from ...util.types import Floats
from .numbered import Numbered, number_vertices
from .threemf import CONTENT_TYPES, CORE, MODEL, RELATIONSHIPS, XML, mesh_text, package_entry

_OF_OBJECT, _OF_VOLUME = ' type="object"', ' type="volume"'
_PRUSA_SPACE = "http://schemas.slic3r.org/3mf/2017/06"


@dataclass(frozen=True)
class _Slicer:
    """What a program calls things.

    Attributes:
        config: file of the settings.
        middle: of a usual build plate, mm.
        density: key of the sparse infill's density.
        pattern: of its pattern.
        walls: of the number of walls.
        top: of the number of solid layers below faces that look up.
        bottom: the same above those that look down.
        small: of the area below which sparse infill becomes solid.
        hook: of the length of hooks at ends of lines.
    """

    config: str
    middle: tuple[float, float]
    density: str
    pattern: str
    walls: str
    top: str
    bottom: str
    small: str
    hook: str


_SLICERS = {
    "prusa": _Slicer(
        "Metadata/Slic3r_PE_model.config", (125.0, 105.0), "fill_density", "fill_pattern",
        "perimeters", "top_solid_layers", "bottom_solid_layers", "solid_infill_below_area",
        "infill_anchor",
    ),
    "orca": _Slicer(
        "Metadata/model_settings.config", (128.0, 128.0), "sparse_infill_density",
        "sparse_infill_pattern", "wall_loops", "top_shell_layers", "bottom_shell_layers",
        "minimum_sparse_infill_area", "infill_anchor",
    ),
}  # fmt: skip

#: Their words, and what they are called.
SLICERS = {"prusa": "PrusaSlicer", "orca": "OrcaSlicer and Bambu Studio"}


def write_project(
    path: str | os.PathLike[str],
    slicer: str,
    solid: TriangleMesh,
    density: float,
    bands: Sequence[tuple[float, TriangleMesh]],
    wanted: BandedInfill,
) -> None:
    """Write a part and its bands as a compressed 3MF project, beside the target and then renamed.

    Args:
        path: of the file; an old file stays if anything goes wrong.
        slicer: of `SLICERS`.
        solid: the part, mm; it is put in the middle of the plate.
        density: of its sparse infill, %.
        bands: densities, and closed meshes within which they count in place of those before.
        wanted: pattern, walls, layers.

    Raises:
        VolfrepError: there is no such slicer; or a mesh is empty or holds what float32 cannot; or
            the path cannot be written.
    """
    if slicer not in _SLICERS:
        raise VolfrepError(f"There is no slicer '{slicer}': choose {listed(_SLICERS)}.")
    keys = _SLICERS[slicer]
    name = "".join(letter for letter in Path(path).stem if letter.isprintable())
    meshes = [number_vertices(mesh, path, as_text=True) for mesh in (solid, *(m for _, m in bands))]
    titles = [name, *(f"infill {share:.1f} %" for share, _ in bands)]
    whole = {
        keys.density: f"{density:.1f}%",
        keys.pattern: wanted.pattern,
        keys.walls: str(wanted.walls),
        keys.top: str(wanted.top_layers),
        keys.bottom: str(wanted.bottom_layers),
        keys.small: "0",
        keys.hook: f"{HOOKED:g}",
        f"{keys.hook}_max": f"{JOINED:g}",
    }
    if slicer == "prusa":  # the default of its profiles, and of the other's program
        whole["ensure_vertical_shell_thickness"] = "1"
    own: list[dict[str, str]] = [{}] + [
        {keys.density: f"{share:.1f}%", keys.pattern: wanted.pattern} for share, _ in bands
    ]
    low, high = solid.bounds
    at = np.array([*keys.middle, 0.0]) - [*(low + high)[:2] / 2.0, low[2]]
    if slicer == "prusa":
        built, objects = 1, _one_mesh(name, meshes)
        config = _prusa_config(name, whole, titles, own, [mesh.triangles for mesh in meshes])
    else:
        built, objects = len(meshes) + 1, _components(name, titles, meshes, _place(at))
        at = np.zeros(3)
        config = _orca_config(name, whole, titles, own)
    head = (
        f'{XML}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}" '
        f'xmlns:slic3rpe="{_PRUSA_SPACE}"><metadata name="Title">{escape(name)}</metadata>'
        f'<metadata name="Application">VOLFREP {__version__}</metadata>'
    )
    if slicer == "prusa":  # or the reader takes each instance for an object without modifiers
        head += '<metadata name="slic3rpe:Version3mf">1</metadata>'
    tail = f'</resources><build><item objectid="{built}" transform="{_place(at)}"/></build></model>'
    with replacing(path) as file, zipfile.ZipFile(file, "w") as package:
        package.writestr(package_entry("[Content_Types].xml"), CONTENT_TYPES)
        package.writestr(package_entry("_rels/.rels"), RELATIONSHIPS)
        with package.open(package_entry(MODEL), "w", force_zip64=True) as model:
            for chunk in chain([f"{head}<resources>".encode()], objects, [tail.encode()]):
                model.write(chunk)
        package.writestr(package_entry(keys.config), f"{XML}{config}")


def _place(at: Floats) -> str:
    """What 3MF calls a transform, that only moves."""
    return " ".join(["1 0 0 0 1 0 0 0 1", *(f"{number:.9g}" for number in at + 0.0)])


def _one_mesh(name: str, meshes: Sequence[Numbered]) -> Iterator[bytes]:
    """One object whose mesh is all of them, one after the other."""
    first = np.cumsum([0, *(mesh.vertices for mesh in meshes)])
    points = chain.from_iterable(mesh.decimals() for mesh in meshes)
    corners = (
        rows + np.int32(begin)
        for mesh, begin in zip(meshes, first, strict=False)
        for rows in mesh.corners()
    )
    yield f'<object id="1" type="model" name="{escape(name)}">'.encode()
    yield from mesh_text(points, corners, iter(()))
    yield b"</object>"


def _components(
    name: str, titles: Sequence[str], meshes: Sequence[Numbered], place: str
) -> Iterator[bytes]:
    """An object for each mesh, and one that is made of them."""
    for number, (title, mesh) in enumerate(zip(titles, meshes, strict=True), 1):
        yield f'<object id="{number}" type="model" name="{escape(title)}">'.encode()
        yield from mesh_text(mesh.decimals(), mesh.corners(), iter(()))
        yield b"</object>"
    parts = "".join(
        f'<component objectid="{number + 1}" transform="{place}"/>' for number in range(len(meshes))
    )
    yield (
        f'<object id="{len(meshes) + 1}" type="model" name="{escape(name)}">'
        f"<components>{parts}</components></object>"
    ).encode()


def _prusa_config(
    name: str,
    whole: Mapping[str, str],
    titles: Sequence[str],
    own: Sequence[Mapping[str, str]],
    triangles: Sequence[int],
) -> str:
    last = np.cumsum(triangles) - 1
    volumes = []
    for number, (title, values) in enumerate(zip(titles, own, strict=True)):
        kind = {"volume_type": "ParameterModifier", "modifier": "1"}
        said = {"name": title} | (kind if number else {"volume_type": "ModelPart"}) | dict(values)
        first = last[number] - triangles[number] + 1
        volumes.append(
            f'<volume firstid="{first}" lastid="{last[number]}">'
            f"{_metadata(said, _OF_VOLUME)}</volume>"
        )
    said = {"name": name} | dict(whole)
    return (
        f'<config><object id="1" instances_count="1">{_metadata(said, _OF_OBJECT)}'
        f"{''.join(volumes)}</object></config>"
    )


def _orca_config(
    name: str,
    whole: Mapping[str, str],
    titles: Sequence[str],
    own: Sequence[Mapping[str, str]],
) -> str:
    parts = []
    for number, (title, values) in enumerate(zip(titles, own, strict=True), 1):
        kind = "normal_part" if number == 1 else "modifier_part"
        said = {"name": title} | dict(values)
        parts.append(f'<part id="{number}" subtype="{kind}">{_metadata(said)}</part>')
    said = {"name": name} | dict(whole)
    return (
        f'<config><object id="{len(titles) + 1}">{_metadata(said)}{"".join(parts)}</object>'
        "</config>"
    )


def _metadata(values: Mapping[str, str], of: str = "") -> str:
    return "".join(
        f'<metadata{of} key="{key}" value="{escape(value)}"/>' for key, value in values.items()
    )
