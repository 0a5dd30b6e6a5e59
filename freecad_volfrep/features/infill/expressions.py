# SPDX-License-Identifier: LGPL-2.1-or-later
"""What expressions make of an infill's properties before FreeCAD recomputes it."""

from __future__ import annotations

import FreeCAD as App

from volfrep.util.errors import VolfrepError

from .properties import INPUTS


def follow_expressions(obj: App.DocumentObject) -> None:
    """Give the properties that expressions drive the values that these have now.

    Raises:
        VolfrepError: an expression cannot be evaluated.
    """
    for path, expression in obj.ExpressionEngine:
        name = path.lstrip(".")
        if name not in INPUTS:
            continue  # a part of a property, such as a placement's angle
        try:
            value = obj.evalExpression(expression)
            if value != getattr(obj, name):
                setattr(obj, name, value)
        except Exception as error:  # of any of FreeCAD's kinds
            reason = str(error).strip().rstrip(".")
            raise VolfrepError(
                f"The expression '{expression}' of {name} has no value ({reason}): correct it."
            ) from error
