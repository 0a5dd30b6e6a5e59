# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steady heat in the panel of Loads and Sizing: conductivity, solving, temperatures in colours."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import FreeCAD as App

from freecad_volfrep.bridge.fem_loads import has_heat
from freecad_volfrep.features.sizing.heat import HeatOutcome, solve_heat
from freecad_volfrep.gui.colours.colour_dock import open_colours
from freecad_volfrep.gui.colours.colouring import NOTHING
from freecad_volfrep.gui.panel.property_fields import PlainNumber
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import Message, push_button
from freecad_volfrep.gui.widgets.panel_manners import bring_into_sight, fits_any_width
from freecad_volfrep.translation import translate
from volfrep.jobs.figures.point_values import OF_HEAT
from volfrep.util.errors import Cancelled, VolfrepError

#: W/(m K): no solid has more.
MOST = 1e4


class HeatBox(QtWidgets.QGroupBox):
    """Shown where a chosen load case has heat.

    Attributes:
        outcome: what was found of the present heat; None where nothing was.

    Args:
        obj: the infill.
        chosen: gives the load cases that are ticked.
        begin: called before temperatures are found.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        chosen: Callable[[], Sequence[App.DocumentObject]],
        begin: Callable[[], None],
    ) -> None:
        super().__init__(translate("VolfrepSizePanel", "Steady heat"))
        self._obj, self._chosen, self._begin = obj, chosen, begin
        self.outcome: HeatOutcome | None = None
        self.conductivity = PlainNumber()
        self.conductivity.setObjectName("Conductivity")
        self.conductivity.setRange(0.0, MOST)
        self.conductivity.setDecimals(4)
        self.conductivity.setSuffix(" W/(m K)")
        self.conductivity.setValue(obj.Conductivity)
        text = translate("VolfrepSizePanel", "Conductivity")
        self.conductivity.setAccessibleName(text)
        self.conductivity.setToolTip(
            translate("VolfrepSizePanel", "Of the solid material, as its data sheet says")
        )
        rows = QtWidgets.QFormLayout(self)
        rows.setContentsMargins(6, 4, 6, 4)
        rows.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
        rows.addRow(QtWidgets.QLabel(text), self.conductivity)
        limits = QtWidgets.QLabel(
            translate(
                "VolfrepSizePanel",
                "Heat enters and leaves through these faces alone: none is lost to air.",
            )
        )
        fits_any_width(limits)
        rows.addRow(limits)
        tip = translate(
            "VolfrepSizePanel", "Find the temperatures of the lattice as it is, and colour it"
        )
        text = translate("VolfrepSizePanel", "Find temperatures")
        self.start = push_button("SolveHeat", text, self.solve, tip)
        rows.addRow(self.start)
        self._said = Message("HeatSaid")
        rows.addRow(self._said)
        self.conductivity.valueChanged.connect(self._take_conductivity)
        self.look()

    def look(self) -> None:
        """Something of the loads has changed: what was found is not of them any more."""
        self._forget()
        self.setVisible(any(has_heat(case) for case in self._chosen()))

    def solve(self) -> bool:
        """Solve the heat now, and show the temperatures. Says what is wrong."""
        self._begin()
        self._forget()
        try:
            self.outcome = solve_heat(self._obj, self._chosen())
        except VolfrepError as error:
            self._said.say(str(error), wrong=True)
            # Where OK was pressed, far above.
            QtCore.QTimer.singleShot(0, lambda: bring_into_sight(self._said))
            return False
        except Cancelled:
            return False
        self._said.say(self.outcome.summary())
        view = self._obj.ViewObject
        view.ColourFrom = view.ColourTo = 0.0
        view.Proxy.colouring.renew(OF_HEAT)
        view.ColourBy = OF_HEAT
        open_colours(self._obj)
        return True

    def _take_conductivity(self, value: float) -> None:
        self._obj.Conductivity = value
        self._forget()

    def _forget(self) -> None:
        """What was found is said and shown no more."""
        self._said.say("")
        if self.outcome is not None:
            self.outcome = None
            self._obj.ViewObject.ColourBy = NOTHING
