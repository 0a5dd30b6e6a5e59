# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces whose skin has a thickness of its own, and faces round which the part stays solid.

Both say the same to the skin: what lies nearer to these faces than a length is solid.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...mesh.triangle_mesh import TriangleMesh
from ...util.errors import VolfrepError
from ...util.numbers import number
from ...util.types import Bools
from ..openings import OpenFace, open_triangles


@dataclass(frozen=True)
class FaceSkin:
    """Faces with a skin thickness of their own.

    Attributes:
        face: which.
        thickness: of the skin below them, mm; 0 leaves them open.
    """

    face: OpenFace
    thickness: float

    def __post_init__(self) -> None:
        number("thickness of a face's skin", self.thickness, "mm", positive=False)


@dataclass(frozen=True)
class KeptFace:
    """Faces round which the part stays solid, such as those of a bolt's hole.

    Attributes:
        face: which.
        distance: what lies nearer to them is solid, mm.
    """

    face: OpenFace
    distance: float

    def __post_init__(self) -> None:
        number("distance to keep solid round a face", self.distance, "mm", positive=True)


@dataclass(frozen=True, eq=False)
class Thicknesses:
    """How thick a skin is below the triangles of a solid.

    Attributes:
        usual: (m,) those that have the skin's own thickness.
        is_open: (m,) those that have none; None where no face is open.
        others: triangles (m,) with what lies nearer to them than a length in mm, each length once
            for faces with a skin, and once for those that are kept.
    """

    usual: Bools
    is_open: Bools | None
    others: tuple[tuple[Bools, float], ...]


def thicknesses(
    solid: TriangleMesh,
    open_faces: tuple[OpenFace, ...],
    face_skins: tuple[FaceSkin, ...],
    kept: tuple[KeptFace, ...],
) -> Thicknesses:
    """How thick a skin is below the triangles of a solid.

    Where faces are named several times, the last one holds; what is open has no skin.

    Raises:
        VolfrepError: a face is not found, or all of them are open.
    """
    own = np.full(len(solid.triangles), np.nan)
    for skin in face_skins:
        own[_find_facets(solid, skin.face, "have a skin of its own")] = skin.thickness
    is_open = None
    if open_faces:
        is_open = open_triangles(solid, open_faces)
        own[is_open] = 0.0
    others = [(own == value, float(value)) for value in np.unique(own[own > 0.0])]
    around: dict[float, Bools] = {}
    for one in kept:
        found = _find_facets(solid, one.face, "be kept solid")
        around[one.distance] = around.get(one.distance, np.zeros(len(own), bool)) | found
    others += [(faces, distance) for distance, faces in sorted(around.items())]
    return Thicknesses(np.isnan(own), is_open, tuple(others))


def _find_facets(solid: TriangleMesh, face: OpenFace, what: str) -> Bools:
    found = face.contains(solid)
    if not found.any():
        raise VolfrepError(
            f"No face of the part lies at {face}: give a point on a face that is to {what}."
        )
    return found
