# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies whose room in a part stays solid.

They are taken off the cavity by an exact Boolean; cavities that are left too small for a
lattice are filled.
"""

from __future__ import annotations

import hashlib
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ...mesh.booleans import as_manifold
from ...mesh.quality import measure
from ...mesh.triangle_mesh import TriangleMesh
from ...util.content import content_of, freeze, rough
from ...util.errors import VolfrepError
from ...util.types import Floats, Ints

#: Files of a body, and how large one may be.
SUFFIXES = (".stl", ".ply", ".obj", ".off", ".glb")
MAX_BYTES = 200_000_000


@dataclass(frozen=True)
class KeptBody:
    """A body whose room stays solid, where that lies in the part.

    Attributes:
        vertices: (n, 3) float64 of its closed surface, mm.
        triangles: (m, 3) int32, counter-clockwise from outside.
        source: the file that it is from, or empty.
        name: for messages.

    Raises:
        VolfrepError: the surface is not closed, or encloses nothing.
    """

    vertices: Floats = field(compare=False)
    triangles: Ints = field(compare=False)
    source: str = field(default="", compare=False)
    name: str = field(default="body", compare=False)
    _content: bytes = field(init=False, repr=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "vertices", freeze(self.vertices, np.float64))
        object.__setattr__(self, "triangles", freeze(self.triangles, np.int32))
        if not len(self.triangles) or not np.isfinite(self.vertices).all():
            raise VolfrepError(f"'{self.name}' to keep solid holds no body: export it again.")
        if not measure(self.mesh).watertight or self.mesh.volume <= 0.0:
            raise VolfrepError(
                f"'{self.name}' to keep solid is not closed: give a closed body whose facets face "
                "outward."
            )
        try:
            as_manifold(self.mesh)
        except VolfrepError as error:
            raise VolfrepError(
                f"'{self.name}' to keep solid cannot be cut with: repair its mesh."
            ) from error
        content = content_of(self.vertices, self.triangles)
        object.__setattr__(self, "_content", content)

    @property
    def mesh(self) -> TriangleMesh:
        """A copy of its surface, which a library may take that asks for arrays it could change."""
        return TriangleMesh(self.vertices.copy(), np.array(self.triangles, np.int32))

    def identity(self) -> tuple[Floats, int, str]:
        """What counts of it for `util.content.digest_of`: corners, number of facets, and volume.

        As of an `OpenPatch`, the order of facets and their diagonals do not count.
        """
        points = np.unique(np.round(self.vertices, 6) + 0.0, axis=0)
        return points, len(self.triangles), rough(self.mesh.volume)

    def as_json(self) -> dict[str, Any]:
        """What tells one body from another, as plain JSON values."""
        digest = hashlib.blake2b(np.round(self.vertices, 6).tobytes(), digest_size=8)
        digest.update(self.triangles.tobytes())
        return {"body": self.name, "facets": len(self.triangles), "digest": digest.hexdigest()}


def read_body(path: str | os.PathLike[str]) -> KeptBody:
    """The body of a file (STL, PLY, OBJ, OFF, GLB), mm.

    Raises:
        VolfrepError: it cannot be read, or holds no closed body.
    """
    file = Path(path)
    if file.suffix.lower() not in SUFFIXES:
        raise VolfrepError(
            f"'{file.name}' is no file of a body to keep solid: give one of {', '.join(SUFFIXES)}."
        )
    if not file.is_file():
        raise VolfrepError(f"There is no file '{path}' of a body to keep solid.")
    if file.stat().st_size > MAX_BYTES:
        raise VolfrepError(f"'{file.name}' is larger than {MAX_BYTES / 1e6:g} MB: simplify it.")
    import trimesh  # slow to import

    try:
        mesh: Any = trimesh.load(file, force="mesh")
        mesh.merge_vertices(merge_tex=True, merge_norm=True)
    except Exception as error:  # whatever a reader of damaged files raises
        raise VolfrepError(f"'{file.name}' cannot be read: export it again.") from error
    corners, rows = np.asarray(mesh.vertices), np.asarray(mesh.faces)
    if len(rows) and mesh.volume < 0.0:
        rows = rows[:, ::-1]
    return KeptBody(corners, rows, str(path), file.name)
