# SPDX-License-Identifier: LGPL-2.1-or-later
"""An object's `Status` in the user's language, in the property editor, below the English one.

`Status` itself stays what scripts and documents know. What is shown is never saved.
"""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

from freecad_volfrep.features.properties.property_table import (
    OUTPUT,
    READ_ONLY,
    add_missing,
    result,
)
from freecad_volfrep.sentences import localise

from .qt import QtCore

if TYPE_CHECKING:
    import FreeCAD as App

#: Flags of addProperty: a change asks for no recompute, and goes into no file.
NO_RECOMPUTE, NO_PERSIST = 16, 32
_ROW = replace(
    result("App::PropertyString", "StatusShown", "The status in your language; not saved"),
    flags=READ_ONLY | OUTPUT | NO_RECOMPUTE | NO_PERSIST,
)
SHOWN = _ROW.name


def show_status(obj: App.DocumentObject) -> None:
    """Once FreeCAD is not in the middle of something, show the status as it is now."""
    QtCore.QTimer.singleShot(0, partial(_show, obj))


def _show(obj: Any) -> None:
    with suppress(ReferenceError):  # deleted, or its document closed
        if obj.Document.Restoring:
            show_status(obj)
            return
        said = localise(obj.Status)
        is_there = SHOWN in obj.PropertiesList
        if said != obj.Status and not is_there:
            group = obj.getGroupOfProperty("Status")
            add_missing(obj, (replace(_ROW, group=group),), {})
            obj.setPropertyStatus(SHOWN, "NoModify")  # nothing of it is to be saved
        elif said == obj.Status and is_there:
            obj.removeProperty(SHOWN)
        if said != obj.Status and getattr(obj, SHOWN) != said:
            setattr(obj, SHOWN, said)
