# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field of the infill's panel: what its preview is coloured by."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_volfrep.features.sizing.sized_states import why_no_states
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.panel_manners import narrow
from freecad_volfrep.translation import translate

#: What is known of a preview's struts.
PREVIEWED = ("None", "Radius", "Cell size", "Overhang", "Field")


class ColourChoice(QtWidgets.QComboBox):
    """A list that sets the property ColourBy of an infill's view.

    What struts carry is known of the lattice that was sized only: else those entries are greyed,
    and their tips, and that of the list where one of them is chosen, say why.

    Args:
        view: of the infill.
        changed: called afterwards.
    """

    def __init__(self, view: Any, changed: Callable[[], None]) -> None:
        from volfrep.jobs.figures.point_values import GOVERNING, OF_LOADS

        super().__init__()
        self._view, self._changed, self._of_loads = view, changed, (*OF_LOADS, GOVERNING[0])
        self.setObjectName("ColourBy")
        self.setAccessibleName(translate("VolfrepColours", "Colour by"))
        narrow(self)
        for name in view.getEnumerationsOfProperty("ColourBy"):
            if name in (*PREVIEWED, *self._of_loads) or name == view.ColourBy:
                self.addItem(translate("VolfrepColours", name), name)
        self.setCurrentIndex(self.findData(view.ColourBy))
        self.look()
        self.currentIndexChanged.connect(self._choose)

    def look(self) -> None:
        """Bring what can be chosen up to the infill's present values."""
        why = translate("VolfrepColours", why_no_states(self._view.Object))
        for name in self._of_loads:
            item = self.model().item(self.findData(name))
            item.setEnabled(not why)
            item.setToolTip(why)
        self.setToolTip(why if self.currentData() in self._of_loads else "")

    def showPopup(self) -> None:  # noqa: N802
        """Called by Qt before the list opens."""
        self.look()
        super().showPopup()

    def focusInEvent(self, event: QtCore.QEvent) -> None:  # noqa: N802
        """Called by Qt before keys can choose."""
        self.look()
        super().focusInEvent(event)

    def _choose(self, row: int) -> None:
        self._view.ColourBy = self.itemData(row)
        self.look()
        self._changed()


def colour_field(view: Any, changed: Callable[[], None]) -> Any:
    """A label and a `ColourChoice`."""
    holder = QtWidgets.QWidget()
    line = QtWidgets.QHBoxLayout(holder)
    line.setContentsMargins(0, 0, 0, 0)
    line.addWidget(QtWidgets.QLabel(translate("VolfrepColours", "Colour by")))
    line.addWidget(ColourChoice(view, changed), 1)
    return holder
