# SPDX-License-Identifier: LGPL-2.1-or-later
"""What struts carry, case by case, in colours, deformed or not: drawn in place of the infill."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import FreeCAD as App
import FreeCADGui as Gui
import numpy as np

from freecad_volfrep import preferences
from freecad_volfrep.bridge.solids import parent_placement
from freecad_volfrep.gui.draw import drawing
from freecad_volfrep.gui.draw.coloured_struts import (
    coloured_struts,
    colours_of,
    legend,
    legend_of_names,
    row_colours,
)
from freecad_volfrep.translation import marked, translate
from volfrep.sizing.strut_state import QUANTITIES, drawn_factor, value_range
from volfrep.spatial.nearest_struts import NearestStrut

if TYPE_CHECKING:
    from volfrep.sizing.strut_state import StrutState

#: Name of what hangs in the view's scene.
NODE = "VolfrepStrutResults"
#: The quantity whose values are rows of names.
GOVERNING = "governing"
#: Colour of the solid's edges.
OUTLINE = (0.75, 0.75, 0.75)
#: What struts may be coloured by, marked for translation: `volfrep.sizing.strut_state.QUANTITIES`.
QUANTITY_NAMES = marked(
    "VolfrepColours",
    "Radius, mm",
    "Stress (von Mises), MPa",
    "Share of the buckling load",
    "Displacement, mm",
    "Governing limit",
)


class StrutColours:
    """The struts of an infill in place of it, until they are removed.

    Args:
        obj: the infill.
        states: its struts in each load case.
        printed: title of the table by which they are as printed; empty for as drawn.
        limits: what governs them; empty where they were not sized.
    """

    is_of_mesh = True
    why = ""

    def __init__(
        self,
        obj: App.DocumentObject,
        states: Sequence[StrutState],
        printed: str = "",
        limits: tuple[str, ...] = (),
    ) -> None:
        from pivy import coin

        self.printed, self._limits = printed, limits
        self._obj, self._states = obj, tuple(states)
        self.cases = tuple(state.name for state in states)
        self.quantities = {
            name: translate("VolfrepColours", text)
            for name, text in QUANTITIES.items()
            if name != GOVERNING or limits
        }
        self.quantity = "stress"
        self._was_visible = {
            shown: shown.ViewObject.Visibility for shown in (obj, obj.Base) if shown is not None
        }
        for shown in self._was_visible:
            shown.ViewObject.Visibility = False
        solid = obj.Proxy.wanted(obj)[0]
        self._outline = drawing.separate(drawing.material(OUTLINE), drawing.edges(solid))
        self._root = coin.SoSeparator()
        self._root.setName(NODE)
        self._scene = Gui.getDocument(obj.Document.Name).activeView().getSceneGraph()
        self._scene.addChild(self._root)
        self._ends: dict[str, tuple[float, float]] = {}
        #: How many times displacements are enlarged so that they are seen.
        self.fitting_factor = drawn_factor(self._states)
        self._shapes: list[Any] = []
        self.show_case(0, 0.0)

    @property
    def title(self) -> str:
        """What the legend says."""
        return str(self.quantities[self.quantity])

    @property
    def names(self) -> tuple[str, ...]:
        """What the values are rows of; empty for a number."""
        return self._limits if self.quantity == GOVERNING else ()

    @property
    def range(self) -> tuple[float, float] | None:
        """Of the scale, one for all load cases; None where there is none."""
        if self.names:
            return None
        return self._ends.get(self.quantity) or value_range(self._states, self.quantity)

    def choose(self, quantity: str) -> None:
        """Show another quantity, on the scale that it had last."""
        self.quantity = quantity
        self._draw()

    def set_range(self, low: float, high: float) -> None:
        """Set the scale, or give it back to the values by two equal ends."""
        self._ends.pop(self.quantity, None)
        if low != high:
            self._ends[self.quantity] = low, high
        self._draw()

    def show_case(self, case: int, factor: float | None) -> None:
        """Show a load case, its displacements enlarged so many times; None for what fits."""
        self._state = self._states[case]
        factor = self.fitting_factor if factor is None else factor
        self._places = self._state.ends + factor * self._state.displacements
        self._nearest = NearestStrut(self._places)
        self._draw()

    def shapes(self) -> list[Any]:
        """What the mouse may point at."""
        return self._shapes

    def value_at(self, place: tuple[float, float, float]) -> float:
        """The value at a point of the nearest strut."""
        strut, share = (found[0] for found in self._nearest.of(np.array([place])))
        one, two = self._state.values(self.quantity)[strut]
        return float((1.0 - share) * one + share * two)

    def remove(self) -> None:
        """Show the infill again."""
        if self._scene is not None:
            self._scene.removeChild(self._root)
            self._scene = None
        for shown, visible in self._was_visible.items():
            shown.ViewObject.Visibility = visible
        self._was_visible.clear()

    def forget(self, document_too: bool) -> None:
        """There is nothing to be shown again; with the document, the scene is gone."""
        self._was_visible.clear()
        if document_too:
            self._scene = None

    def _draw(self) -> None:
        self._root.removeAllChildren()
        values = self._state.values(self.quantity).ravel()
        if self.range is None:
            colours, told = row_colours(values), legend_of_names(self.title, self.names)
        else:
            colours, told = colours_of(values, *self.range), legend(self.title, *self.range)
        turn = drawing.transform(parent_placement(self._obj))
        struts = coloured_struts(
            self._places[:, 0],
            self._places[:, 1],
            self._state.radii,
            colours.reshape(-1, 2, 3),
            preferences.read(preferences.MOST_PRISMS),
        )
        self._shapes = [turn, struts]
        self._root.addChild(drawing.separate(turn, drawing.unpickable(), struts, self._outline))
        self._root.addChild(told)
