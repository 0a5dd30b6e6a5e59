# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the table of parameters that are about skins which are not alike everywhere."""

from __future__ import annotations

from .parameter import Parameter

SKIN = (
    Parameter(
        "skin_faces", "faces", "Openings",
        "Faces of the solid whose skin has a thickness of its own, each with its number in "
        "SkinThicknesses",
        in_command=False,
    ),
    Parameter(
        "skin_thicknesses", "lengths", "Openings",
        "Thickness of the skin below each of the SkinFaces, in mm; 0 leaves the face open",
        default=(), in_command=False,
    ),
    Parameter(
        "skin_face", "thick_faces", "Openings",
        "A skin of its own thickness below the smooth face at a point, or below the faces in a "
        "plane by a point and a normal; the last number is the thickness, and 0 leaves them open; "
        "may be repeated",
        in_freecad=False, of_block=False,
    ),
    Parameter(
        "keep_solid_around", "faces", "Openings",
        "Faces round which the part stays solid, up to KeepDistance, and solids whose room in it "
        "does",
        in_command=False,
    ),
    Parameter(
        "keep_distance", "length", "Openings",
        "Distance from the faces of KeepSolidAround up to which the part stays solid",
        default=5.0, in_command=False,
    ),
    Parameter(
        "keep_solid", "solids", "Openings",
        "What stays solid: the room of a closed body in a file (STL, PLY, OBJ, OFF, GLB), or what "
        "is nearer than a distance, the last number, to the smooth face at a point or to the faces "
        "in a plane; may be repeated",
        in_freecad=False, of_block=False,
    ),
)  # fmt: skip
