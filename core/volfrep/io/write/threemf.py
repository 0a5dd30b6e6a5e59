# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF: a part as triangles, as beams for readers of the beam lattice extension, or as both.

Written after the 3MF Core Specification 1.3 and its Beam Lattice Extension 1.2. The file is a zip
with one XML text in it, which needs no library; readers keep single precision, and the numbers
are written to its step.
"""

from __future__ import annotations

import os
import zipfile
from collections.abc import Iterable, Iterator, Mapping
from html import escape
from itertools import chain
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ... import __version__
from ...grid.strut_graph import Wireframe
from ...mesh.precision import BLOCK_ROWS, lines, rounded
from ...mesh.triangle_mesh import TriangleMesh
from ...trim.trimmed_surface import TrimmedSurface
from ...util.errors import VolfrepError
from ...util.files import replacing
from ...util.progress import Monitor
from ...util.types import Floats
from .numbered import Numbered, number_vertices

if TYPE_CHECKING:
    from ...grid.strut_graph import BeamModel

#: What is written as triangles.
Surface = TriangleMesh | TrimmedSurface

#: Beams are written to this part of the thinnest radius.
BEAM_STEP = 1e-4
#: How hard beams are packed: harder (6) takes 2.5 times as long for 1 to 7 % less.
BEAM_LEVEL = 4
#: Written before the names of the clip's elements: the same names to a reader of XML namespaces,
#: as one of the extension must be. Slicers that compare plain names do not see the clip then;
#: PrusaSlicer would refuse a file with a mesh that is not to be printed.
HIDING_PREFIX = "core:"

MODEL = "3D/3dmodel.model"
XML = '<?xml version="1.0" encoding="UTF-8"?>\n'
CORE = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02"
_BEAMS = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02"
_BALLS = "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07"
_EXTENSIONS = (
    f' xmlns:core="{CORE}" xmlns:b="{_BEAMS}" xmlns:b2="{_BALLS}" requiredextensions="b b2"'
)
#: Of metadata that other programs need not understand, and the names they do.
_OWN = "https://volfrep.invalid/2026/figures"
_KNOWN = ("Title", "Description", "Application")
_KEPT = ' preserve="1" type="xs:string"'
#: What is to be said of a file without triangles of its lattice.
BEAMS_ONLY = (
    "Programs that do not know the beam lattice extension show such a file's skin without its "
    "lattice, or refuse it: a 3MF of both, mesh and beams, is the safe choice."
)
NOTHING: Mapping[str, str] = {}
_PACKAGE = "http://schemas.openxmlformats.org/package/2006"
_PART = "application/vnd.ms-package.3dmanufacturing-3dmodel+xml"
CONTENT_TYPES = (
    f'{XML}<Types xmlns="{_PACKAGE}/content-types"><Default Extension="rels" '
    'ContentType="application/vnd.openxmlformats-package.relationships+xml"/>'
    f'<Default Extension="model" ContentType="{_PART}"/></Types>'
)
RELATIONSHIPS = (
    f'{XML}<Relationships xmlns="{_PACKAGE}/relationships"><Relationship Id="model" '
    'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel" '
    f'Target="/{MODEL}"/></Relationships>'
)


def write_3mf(
    surface: Surface,
    path: str | os.PathLike[str],
    monitor: Monitor | None = None,
    figures: Mapping[str, str] = NOTHING,
    *,
    is_open: bool = False,
) -> None:
    """Write triangles as a compressed 3MF file, beside the target and then renamed.

    Args:
        surface: in mm; octants beside its mesh are written as they are placed.
        path: of the file; an old file stays if anything goes wrong.
        monitor: told the progress, asked for a cancel.
        figures: of the run, kept as metadata: `Description`, which readers show, and others, which
            are put under a name of our own.
        is_open: whether it is a surface that closes nothing, which the file says then.

    Raises:
        VolfrepError: the mesh is empty, holds coordinates that float32 cannot, or has triangles
            that lose a corner in float32; or the path cannot be written.
        Cancelled: when the monitor says so; no file is left behind.
    """
    given = number_vertices(surface, path, as_text=True)
    whole = mesh_text(given.decimals(), given.corners(), iter(()))
    parts = [_object(1, "part", whole, kind="surface" if is_open else "model")]
    _write(path, parts, 1, _rows(given), monitor, figures)


def write_3mf_beams(
    model: BeamModel,
    path: str | os.PathLike[str],
    fallback: Surface | None = None,
    monitor: Monitor | None = None,
    figures: Mapping[str, str] = NOTHING,
) -> None:
    """Write a lattice as beams: cones, balls at the joints, clipped, joined to its skin.

    Skin and lattice are one assembly. A slicer that ignores the extension finds an object without
    triangles in it and refuses the file, rather than printing the skin alone. With a fallback,
    the object with the beams also holds the whole part as triangles, in place of the skin. The
    extension defines such an object as the union of the two, so that the part is the same, and
    other readers see the triangles. (The extension's own representation mesh is for display only,
    and readers without the extension do not look for it.)

    Args:
        model: in mm.
        path: of the file; an old file stays if anything goes wrong.
        fallback: the same part as triangles.
        monitor: told the progress, asked for a cancel.
        figures: as for `write_3mf`.

    Raises:
        VolfrepError: the lattice has no struts, or as `write_3mf`.
        Cancelled: when the monitor says so; no file is left behind.
    """
    if not len(model.lattice.struts):
        raise VolfrepError(f"There is nothing to write to '{path}': the lattice has no struts.")
    objects: list[Iterator[bytes]] = []
    clip = skin = None
    rows = len(model.lattice.nodes) + len(model.lattice.struts)
    if model.clip is not None:
        clip = 1
        prefix = "" if fallback is None else HIDING_PREFIX
        given = number_vertices(model.clip, path, as_text=True)
        objects.append(_mesh_object(clip, "clip", given, prefix))
        rows += _rows(given)
    if model.skin is not None and fallback is None:
        skin = len(objects) + 1
        given = number_vertices(model.skin, path, as_text=True)
        objects.append(_mesh_object(skin, "skin", given))
        rows += _rows(given)
    lattice = len(objects) + 1
    more = None if fallback is None else number_vertices(fallback, path, as_text=True)
    rows += 0 if more is None else _rows(more)
    objects.append(_beam_object(lattice, model.lattice, clip, more))
    if skin is not None:
        parts = "".join(f'<component objectid="{part}"/>' for part in (skin, lattice))
        text = f"<components>{parts}</components>".encode()
        objects.append(_object(len(objects) + 1, "part", iter([text])))
    _write(path, objects, len(objects), rows, monitor, figures, _EXTENSIONS, BEAM_LEVEL)


def _rows(given: Numbered) -> int:
    return given.vertices + given.triangles


def _write(
    path: str | os.PathLike[str],
    objects: list[Iterator[bytes]],
    build: int,
    rows: int,
    monitor: Monitor | None,
    figures: Mapping[str, str],
    extensions: str = "",
    level: int = 6,
) -> None:
    """Write the package; `build` is the number of the object to print, `rows` for the progress."""
    title = "".join(letter for letter in Path(path).stem if letter.isprintable())
    head = (
        f'{XML}<model unit="millimeter" xml:lang="en-US" xmlns="{CORE}" xmlns:v="{_OWN}"'
        f"{extensions}>"
        f'<metadata name="Title">{escape(title)}</metadata>'
        f'<metadata name="Application">VOLFREP {__version__}</metadata>'
        f"{_metadata(figures)}<resources>"
    ).encode()
    tail = f'</resources><build><item objectid="{build}"/></build></model>'.encode()
    with (
        replacing(path) as file,
        zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED, compresslevel=level) as package,
    ):
        package.writestr(package_entry("[Content_Types].xml"), CONTENT_TYPES)
        package.writestr(package_entry("_rels/.rels"), RELATIONSHIPS)
        # By its name alone it has the oldest date, too, and can be told how hard to pack.
        with package.open(MODEL, "w", force_zip64=True) as model:
            for count, chunk in enumerate(chain([head], *objects, [tail])):
                model.write(chunk)
                if monitor is not None:
                    monitor.tick(count * BLOCK_ROWS / rows)


def _metadata(figures: Mapping[str, str]) -> str:
    """Names that the core specification does not know belong to a namespace of one's own."""
    names = {name: name if name in _KNOWN else f"v:{name}" for name in figures}
    return "".join(
        f'<metadata name="{names[name]}"{_KEPT * (names[name] != name)}>{escape(text)}</metadata>'
        for name, text in figures.items()
    )


def package_entry(name: str) -> zipfile.ZipInfo:
    """A file's place in a package."""
    entry = zipfile.ZipInfo(name)  # with the oldest date: the same input makes the same file
    entry.compress_type = zipfile.ZIP_DEFLATED
    return entry


def _object(
    number: int, name: str, inside: Iterator[bytes], prefix: str = "", kind: str = "model"
) -> Iterator[bytes]:
    yield f'<{prefix}object id="{number}" type="{kind}" name="{name}">'.encode()
    yield from inside
    yield f"</{prefix}object>".encode()


def _mesh_object(number: int, name: str, given: Numbered, prefix: str = "") -> Iterator[bytes]:
    inside = mesh_text(given.decimals(), given.corners(), iter(()), prefix)
    return _object(number, name, inside, prefix)


def _beam_object(
    number: int, lattice: Wireframe, clip: int | None, more: Numbered | None
) -> Iterator[bytes]:
    """The object of the beams; the vertices of its own triangles follow the nodes."""
    nodes = rounded(lattice.nodes, BEAM_STEP * float(lattice.radii.min()))
    points: Iterable[Floats] = [nodes]
    triangles: Iterable[NDArray[np.int32]] = ()
    if more is not None:
        points = chain(points, more.decimals())
        triangles = (block + np.int32(len(nodes)) for block in more.corners())
    return _object(number, "lattice", mesh_text(points, triangles, _beam_lattice(lattice, clip)))


def mesh_text(
    points: Iterable[Floats],
    triangles: Iterable[NDArray[np.int32]],
    more: Iterator[bytes],
    prefix: str = "",
) -> Iterator[bytes]:
    """A mesh element of (k, 3) points and of triangles by the numbers of these."""
    vertex = f'<{prefix}vertex x="%.9g" y="%.9g" z="%.9g"/>'
    triangle = f'<{prefix}triangle v1="%d" v2="%d" v3="%d"/>'
    yield f"<{prefix}mesh><{prefix}vertices>".encode()
    yield from lines(vertex, points)
    yield f"</{prefix}vertices><{prefix}triangles>".encode()
    yield from lines(triangle, triangles)
    yield f"</{prefix}triangles>".encode()
    yield from more
    yield f"</{prefix}mesh>".encode()


def _beam_lattice(lattice: Wireframe, clip: int | None) -> Iterator[bytes]:
    """Beams, and the balls that are not of the usual radius.

    Where a reader does not know the balls, spheres of the struts' own radius close the joints.
    """
    step = BEAM_STEP * float(lattice.radii.min())
    radii, balls = rounded(lattice.radii, step), rounded(lattice.joint_radii, step)
    radius, ball = _most_common(radii.ravel()), _most_common(balls)
    struts = lattice.struts
    shortest = float(lattice.lengths().min())
    clipping = "" if clip is None else f' clippingmode="inside" clippingmesh="{clip}"'
    yield (
        f'<b:beamlattice minlength="{shortest / 2:.3g}" radius="{radius:.9g}" cap="sphere" '
        f'b2:ballmode="all" b2:ballradius="{ball:.9g}"{clipping}><b:beams>'
    ).encode()
    cone = radii[:, 0] != radii[:, 1]
    usual = ~cone & (radii[:, 0] == radius)
    for template, chosen, columns in (
        ("", usual, 0), (' r1="%.9g"', ~cone & ~usual, 1), (' r1="%.9g" r2="%.9g"', cone, 2),
    ):  # fmt: skip
        where = np.flatnonzero(chosen)
        parts = (where[k : k + BLOCK_ROWS] for k in range(0, len(where), BLOCK_ROWS))
        blocks = (
            np.hstack([struts[some], radii[some, :columns]]) if columns else struts[some]
            for some in parts
        )
        yield from lines(f'<b:beam v1="%d" v2="%d"{template}/>', blocks)
    yield b"</b:beams>"
    special = np.flatnonzero(balls != ball)
    special = special[np.isin(special, struts)] if len(special) else special
    if len(special):
        yield b"<b2:balls>"
        rows = np.stack([special, balls[special]], axis=1)
        yield from lines('<b2:ball vindex="%d" r="%.9g"/>', [rows])
        yield b"</b2:balls>"
    yield b"</b:beamlattice>"


def _most_common(values: Floats) -> float:
    if values.min() == values.max():
        return float(values[0])
    numbers, counts = np.unique(values, return_counts=True)
    return float(numbers[counts.argmax()])
