# SPDX-License-Identifier: LGPL-2.1-or-later
"""Which properties of an infill apply: the others are hidden."""

from __future__ import annotations

import FreeCAD as App

from .grading import CARTESIAN, CHOICES, OFF

#: The entry of `CellType` that stands for a cell of the user's own, read from `CellFile`.
CUSTOM_CELL = "Custom"
#: Properties on which it hangs whether others apply.
CONTROLS = (
    "CellType", *CHOICES, "RadiusCurve", "UseMapCentre", "RotationAngle", "UseRotationOrigin",
)  # fmt: skip
_SHOWN, _HIDDEN = 0, 2


def show_applicable(obj: App.DocumentObject) -> None:
    """Hide the properties that have no effect; does nothing while some are still missing."""
    if not set(CONTROLS).issubset(obj.PropertiesList):
        return
    for name, applies in _applicable(obj).items():
        if name in obj.PropertiesList:
            obj.setEditorMode(name, _SHOWN if applies else _HIDDEN)


def _applicable(obj: App.DocumentObject) -> dict[str, bool]:
    size, radius, mapped = obj.SizeGrading, obj.RadiusGrading, obj.CellMap != CARTESIAN
    by_law = radius in ("Direction", "Skin", "Core")
    by_field = radius == "Field"
    ends = (by_law and obj.RadiusLaw != "Formula") or (by_field and not obj.RadiusCurve.strip())
    turned = obj.RotationAngle.Value != 0
    return {
        "CellFile": obj.CellType == CUSTOM_CELL,
        "LambdaMin": size not in (OFF, "Formula"),
        "LambdaMax": size not in (OFF, "Formula", "Scalar"),
        "LambdaFormula": size == "Formula",
        "GradingDirection": size != OFF,
        "KeepRadius": size != OFF or mapped,
        "RadiusLaw": by_law,
        "RadiusMin": ends,
        "RadiusMax": ends,
        "RadiusFormula": by_law and obj.RadiusLaw == "Formula",
        "RadiusDirection": radius == "Direction",
        "RadiusReach": radius in ("Skin", "Core"),
        "RadiusField": by_field,
        "RadiusResult": by_field,
        "RadiusColumn": by_field,
        "RadiusCurve": by_field,
        "MapAxis": mapped,
        "MapAround": mapped,
        "UseMapCentre": mapped,
        "MapCentre": mapped and obj.UseMapCentre,
        "RotationAxis": turned,
        "UseRotationOrigin": turned,
        "RotationOrigin": turned and obj.UseRotationOrigin,
    }
