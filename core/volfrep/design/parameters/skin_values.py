# SPDX-License-Identifier: LGPL-2.1-or-later
"""Faces that are open or have a skin of their own, and what is kept solid, as values by name."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...util.errors import VolfrepError
from ..openings import OpenFace, OpenPatch, OpenPlane, SmoothFace
from ..skins.kept_bodies import KeptBody, read_body
from ..skins.own_faces import FaceSkin, KeptFace
from ..spec import LatticeSpec
from .values import is_file


def skin_of(used: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a `LatticeSpec` about faces and what is kept solid.

    Args:
        used: values by the names of the table; faces that were picked are those of `LatticeSpec`.

    Raises:
        VolfrepError: a body cannot be read, or a thickness makes no sense.
    """
    planes = tuple(
        OpenPlane((x, y, z), (nx, ny, nz)) for x, y, z, nx, ny, nz in used["open_plane"] or ()
    )
    skins = tuple(FaceSkin(_face(numbers), numbers[-1]) for numbers in used["skin_face"] or ())
    kept = tuple(
        read_body(one) if isinstance(one, str) else KeptFace(_face(one), one[-1])
        for one in used["keep_solid"] or ()
    )
    return {
        "open_faces": (*(used["open_faces"] or ()), *planes),
        "face_skins": (*(used["skin_faces"] or ()), *skins),
        "keep_solid": (*(used["keep_solid_around"] or ()), *kept),
    }


def skin_values(spec: LatticeSpec) -> dict[str, Any]:
    """The values by name that `skin_of` makes the same fields of.

    Raises:
        VolfrepError: a face was picked in FreeCAD, or a body has no file.
    """
    opened = [f for f in spec.open_faces if not isinstance(f, SmoothFace)]
    skins = [FaceSkin(f, 0.0) for f in spec.open_faces if isinstance(f, SmoothFace)]
    planes = [_numbers(face, "open") for face in opened]
    own = [
        (*_numbers(skin.face, "have a skin of their own"), skin.thickness)
        for skin in (*skins, *spec.face_skins)
    ]
    return {
        "open_plane": tuple(planes),
        "skin_face": tuple(own),
        "keep_solid": tuple(_kept(one) for one in spec.keep_solid),
    }


def _kept(one: KeptFace | KeptBody) -> str | tuple[float, ...]:
    if isinstance(one, KeptFace):
        return (*_numbers(one.face, "kept solid"), one.distance)
    if not one.source or not is_file(one.source):
        raise VolfrepError(
            f"'{one.name}' to keep solid has no file that could be named: save it as .stl first."
        )
    return one.source


def _face(numbers: tuple[float, ...]) -> OpenFace:
    """The faces that numbers name, without the length behind them."""
    x, y, z, *normal = numbers[:-1]
    if not normal:
        return SmoothFace((x, y, z))
    nx, ny, nz = normal
    return OpenPlane((x, y, z), (nx, ny, nz))


def _numbers(face: OpenFace, what: str) -> tuple[float, ...]:
    if isinstance(face, OpenPatch):
        to_be = what if what.startswith("have") else f"be {what}"
        raise VolfrepError(
            f"Faces that were picked to {to_be} have no place in a file: leave them out, or give "
            "planes."
        )
    return face.point if isinstance(face, SmoothFace) else (*face.point, *face.normal)
