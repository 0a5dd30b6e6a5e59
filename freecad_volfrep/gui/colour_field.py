# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field of the infill's panel: what its preview is coloured by."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_volfrep.translation import translate

from .panel_manners import narrow
from .qt import QtWidgets

#: What is known of a preview's struts.
PREVIEWED = ("None", "Radius", "Cell size", "Overhang", "Field")


def colour_field(view: Any, changed: Callable[[], None]) -> Any:
    """A label and a list that set the property ColourBy of an infill's view.

    Args:
        view: of the infill.
        changed: called afterwards.
    """
    holder, choice = QtWidgets.QWidget(), QtWidgets.QComboBox()
    choice.setObjectName("ColourBy")
    choice.setAccessibleName(translate("VolfrepColours", "Colour by"))
    narrow(choice)
    for name in view.getEnumerationsOfProperty("ColourBy"):
        if name in PREVIEWED or name == view.ColourBy:
            choice.addItem(translate("VolfrepColours", name), name)
    choice.setCurrentIndex(choice.findData(view.ColourBy))

    def choose(row: int) -> None:
        view.ColourBy = choice.itemData(row)
        changed()

    choice.currentIndexChanged.connect(choose)
    line = QtWidgets.QHBoxLayout(holder)
    line.setContentsMargins(0, 0, 0, 0)
    line.addWidget(QtWidgets.QLabel(translate("VolfrepColours", "Colour by")))
    line.addWidget(choice, 1)
    return holder
