# SPDX-License-Identifier: LGPL-2.1-or-later
"""OFF and GLB by trimesh: what is promised is held against the file's size before it reads.

OBJ, PLY and 3MF have readers of our own: trimesh 5.2 refuses an OBJ whose vertices carry colours
or whose faces go on in the next line, and a PLY of mixed polygons; it loses the unit of a 3MF, the
paths of its Production Extension and the kinds of its objects; and it takes some damaged files of
all three for whole.
"""

from __future__ import annotations

import io
import json
import struct
from typing import Any

import numpy as np

from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.linalg import times
from .contents import Contents, damaged

#: glTF is in metres and has y up; we have z up.
TO_Z_UP = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]])
#: Nodes of a scene, each an instance of a mesh, and triangles of all of them together.
MAX_NODES = 10_000
MAX_TRIANGLES = 20_000_000
#: Extensions that only tell of colours and lights.
_HARMLESS = ("KHR_materials_", "KHR_texture_", "KHR_lights_")
_GLB_HEADER = struct.Struct("<4sIIII")


def read_off(data: bytes, name: str) -> Contents:
    """The triangles of an OFF file.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is damaged, or holds polygons of more than three corners.
    """
    lines = (line.split(b"#")[0] for line in data[:100_000].splitlines())
    words = [word for line in lines for word in line.split()][:4]
    try:
        if words[0] not in (b"OFF", b"COFF"):
            raise VolfrepError(f"'{name}' is not an OFF file: its header is missing.")
        vertices, faces = int(words[1]), int(words[2])
    except VolfrepError:
        raise
    except (IndexError, ValueError) as error:
        raise damaged(name, "its header does not count vertices and faces") from error
    # Three digits and three blanks at least for each.
    if min(vertices, faces) < 0 or 6 * (vertices + faces) > len(data):
        raise damaged(name, f"{vertices} vertices and {faces} faces do not fit into it")
    mesh = _load(data, "off", name)
    if len(mesh.triangles) != faces:
        raise VolfrepError(f"'{name}' holds other faces than triangles: export triangles.")
    return Contents(mesh)


def read_glb(data: bytes, name: str) -> Contents:
    """The triangles of all meshes in a GLB file's scene, where the scene puts them.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is damaged, needs what is not in it, or holds no triangles.
    """
    try:
        magic, version, length, size, kind = _GLB_HEADER.unpack_from(data)
    except struct.error as error:
        raise damaged(name, "it is cut short") from error
    if magic != b"glTF" or version != 2 or kind != 0x4E4F534A:
        raise VolfrepError(f"'{name}' is not a GLB file of glTF 2: export it again.")
    if length > len(data) or size > len(data) - _GLB_HEADER.size:
        raise damaged(name, "it is cut short")
    try:
        tree = json.loads(data[_GLB_HEADER.size : _GLB_HEADER.size + size])
        _refuse_unbounded(tree, len(data), name)
    except VolfrepError:
        raise
    except (ValueError, TypeError, LookupError, AttributeError, RecursionError) as error:
        raise damaged(name, "its description makes no sense") from error
    mesh = _load(data, "glb", name)
    return Contents(TriangleMesh(times(mesh.vertices, TO_Z_UP), mesh.triangles), "m")


def _refuse_unbounded(tree: dict[str, Any], size: int, name: str) -> None:
    """Refuse a scene that asks for more than the file holds, or for other files."""
    needed = [e for e in tree.get("extensionsRequired", []) if not e.startswith(_HARMLESS)]
    if needed:
        raise VolfrepError(
            f"'{name}' is packed by the extension {needed[0][:40]}, which is not read: export it "
            "without compression."
        )
    if any("uri" in buffer for buffer in tree.get("buffers", [])):
        raise VolfrepError(f"'{name}' keeps its mesh in another file: export one .glb file.")
    accessors = tree.get("accessors", [])
    for accessor in accessors:
        if not 0 <= int(accessor["count"]) <= size or "sparse" in accessor:
            raise damaged(name, f"it promises {accessor['count']} values")
        if "bufferView" not in accessor:
            raise damaged(name, "values are nowhere in it")
    nodes = tree.get("nodes", [])
    if len(nodes) > MAX_NODES:
        raise VolfrepError(f"'{name}' holds {len(nodes)} nodes: the limit is {MAX_NODES}.")
    children = [int(child) for node in nodes for child in node.get("children", [])]
    if len(set(children)) < len(children) or any(not 0 <= c < len(nodes) for c in children):
        raise damaged(name, "a node is in two places of its scene")
    triangles = 0
    for node in nodes:
        if "mesh" in node:
            for part in tree["meshes"][node["mesh"]]["primitives"]:
                used = part.get("indices", part["attributes"]["POSITION"])
                triangles += int(accessors[used]["count"]) // 3
    if triangles > MAX_TRIANGLES:
        raise VolfrepError(
            f"'{name}' shows {triangles / 1e6:.3g} million triangles: the limit is "
            f"{MAX_TRIANGLES / 1e6:.0f} million."
        )


def _load(data: bytes, kind: str, name: str) -> TriangleMesh:
    """What trimesh makes of a file, all its meshes together, no vertex merged."""
    import trimesh  # slow to import

    try:
        # Whatever is wrong with a file, trimesh raises what its parsing happens to meet.
        scene = trimesh.load_scene(io.BytesIO(data), file_type=kind, process=False)
        geometry = scene.to_mesh()
    except Exception as error:
        raise damaged(name, f"it cannot be read ({type(error).__name__})") from error
    triangles = np.asarray(geometry.faces, np.int64)
    vertices = np.asarray(geometry.vertices, np.float64)
    if len(triangles) and (triangles.min() < 0 or triangles.max() >= len(vertices)):
        raise damaged(name, "a triangle names a vertex that is not there")
    return TriangleMesh(vertices, triangles.astype(np.int32))
