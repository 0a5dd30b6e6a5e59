# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is to be open in the skin of a lattice infill, from its properties."""

from __future__ import annotations

from typing import Any

import FreeCAD as App


def openings_of(obj: App.DocumentObject) -> dict[str, Any]:
    """The values of the parameters for open faces and drain holes.

    Raises:
        VolfrepError: a property makes no sense, or a face is no more.
    """
    from freecad_volfrep.bridge.solids import face_facets, face_middle, parent_placement
    from volfrep.design.openings import OpenPatch

    frame = parent_placement(obj)
    result: dict[str, Any] = {}
    if obj.OpenFaces:
        result["open_faces"] = tuple(
            OpenPatch(face_facets(owner, name, frame)) for owner, name in _each(obj.OpenFaces)
        )
    if obj.DrainDiameter.Value > 0:
        points = [tuple(point) for point in obj.DrainPoints]
        points += [face_middle(owner, name, frame) for owner, name in _each(obj.DrainFaces)]
        result["drain_points"] = tuple(points)
    return result


def open_faces(
    infill: App.DocumentObject, picked: list[tuple[App.DocumentObject, tuple[str, ...]]]
) -> None:
    """Leave faces without a skin, beside those that are open already.

    Args:
        infill: a lattice infill; it is recomputed with the document.
        picked: objects and the names of their faces.
    """
    faces = {owner: list(names) for owner, names in infill.OpenFaces}
    for owner, names in picked:
        known = faces.setdefault(owner, [])
        known += [name for name in names if name not in known]
    infill.OpenFaces = [(owner, tuple(names)) for owner, names in faces.items()]


def _each(links: list[Any]) -> list[tuple[App.DocumentObject, str]]:
    """The objects and their elements of a property that links to elements of several objects."""
    return [(owner, name) for owner, names in links for name in names]
