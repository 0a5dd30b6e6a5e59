# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill coloured by a quantity, with a legend: what its view's properties say, drawn."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from freecad_volfrep.features.jobs.job import Job
from freecad_volfrep.features.jobs.progress import job_title
from freecad_volfrep.features.sizing.sized_states import limit_names
from freecad_volfrep.gui.draw.coloured_struts import colours_of, row_colours
from freecad_volfrep.gui.draw.legend import Legend
from freecad_volfrep.gui.in_steps import do_in_steps, drop_steps
from freecad_volfrep.gui.jobs.background import begin
from freecad_volfrep.gui.messages import tell_error
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, translate
from volfrep.util.errors import Cancelled, VolfrepError

if TYPE_CHECKING:
    from freecad_volfrep.gui.view.filled_view import FilledPart
    from volfrep.jobs.figures.point_values import PointValues

#: Nothing to colour by.
NOTHING = "None"
#: What there is to choose from, marked for translation: `QUANTITIES` of
#: `volfrep.jobs.figures.point_values`.
QUANTITY_NAMES = marked(
    "VolfrepColours",
    "None",
    "Radius",
    "Skin",
    "Cell size",
    "Overhang",
    "Stress",
    "Buckling",
    "Displacement",
    "Governing limit",
    "Governing limit of the skin",
    "Field",
    "Temperature",
)
#: What a legend says, marked for translation.
TITLES = marked(
    "VolfrepColours",
    "Strut radius, mm",
    "Skin thickness, mm",
    "Cell size, mm",
    "Overhang, degrees",
    "Stress (von Mises), MPa",
    "Share of the buckling load",
    "Displacement, mm",
    "Field of the radius",
    "Temperature, \u00b0C",
)
#: What is the skin's own.
OF_SKIN = ("Skin", "Governing limit of the skin")
#: Triangles that show it have no longer sides than this part of the part's size.
SKIN_SIDES = 80.0
BY = QT_TRANSLATE_NOOP("App::Property", "What the lattice is coloured by")
FROM = QT_TRANSLATE_NOOP(
    "App::Property", "Where the scale of colours begins; as its end: from the values themselves"
)
TO = QT_TRANSLATE_NOOP("App::Property", "Where the scale of colours ends")


def add_properties(view: Any) -> None:
    """Give a view what it says of its colours."""
    from volfrep.jobs.figures.point_values import QUANTITIES

    known = [NOTHING, *QUANTITIES]
    if hasattr(view, "ColourBy"):
        if view.getEnumerationsOfProperty("ColourBy") != known:  # of an earlier release
            chosen = view.ColourBy
            view.ColourBy = known
            view.ColourBy = chosen
    else:
        view.addProperty("App::PropertyEnumeration", "ColourBy", "Object Style", BY)
        view.ColourBy = known
        view.addProperty("App::PropertyFloat", "ColourFrom", "Object Style", FROM)
        view.addProperty("App::PropertyFloat", "ColourTo", "Object Style", TO)


class Colouring:
    """The colours of one infill, in whatever is drawn of it.

    Args:
        obj: the infill.
    """

    def __init__(self, obj: Any) -> None:
        self._obj = obj
        self._part: FilledPart | None = None
        self._known: dict[tuple[str, tuple[int, ...]], PointValues] = {}
        self._asked: tuple[str, tuple[int, ...]] | None = None
        self._steps: Iterator[None] | None = None
        self._legend = Legend()
        #: Why there are no colours; empty where there are, or none are wanted.
        self.why = ""

    def follow(self, part: FilledPart | None) -> None:
        """Colour this from now on, which is drawn whole; or nothing."""
        if part is not self._part:
            self._part, self._asked = part, None
            self._known.clear()
        self.refresh()

    def refresh(self) -> None:
        """Bring the colours, and the legend, up to what the view says."""
        view = self._obj.ViewObject
        quantity = view.ColourBy
        drop_steps(self._steps)
        self.why = ""
        if self._part is None or quantity == NOTHING:
            self._asked = None
            self._legend.remove()
            if self._part is not None:
                self._part.uncolour()
            return
        if self._key not in self._known:
            self._ask(quantity)
            return
        known = self._known[self._key]
        low, high = self.range_of(known)
        kinds = self._kinds()
        names = self.names
        rows = row_colours(known.values) if names else colours_of(known.values, low, high)
        self._part.uncolour()
        self._steps = self._part.coloured(kinds, rows)
        do_in_steps(self._steps)
        if view.Visibility:
            self._legend.show(self._obj, quantity, low, high, names)
        else:
            self._legend.remove()

    def renew(self, quantity: str) -> None:
        """Ask for a quantity anew: what it depends on beside the lattice is another."""
        self._known = {key: known for key, known in self._known.items() if key[0] != quantity}
        self.refresh()

    def range_of(self, known: PointValues) -> tuple[float, float]:
        """Where the scale begins and ends."""
        view = self._obj.ViewObject
        if view.ColourFrom != view.ColourTo:
            return view.ColourFrom, view.ColourTo
        return known.low, known.high

    @property
    def range(self) -> tuple[float, float] | None:
        """Of the scale that is shown; None while there is none."""
        known = self._known.get(self._key)
        return None if known is None or self.names else self.range_of(known)

    @property
    def names(self) -> tuple[str, ...]:
        """What the values are rows of; empty for a number."""
        return limit_names(self._obj, self._obj.ViewObject.ColourBy)

    def value_at(self, place: Any) -> float | None:
        """The value at a point of what is drawn, in its own coordinates; None while there is none.

        Args:
            place: (3,) mm.
        """
        if self._part is None or self._key not in self._known:
            return None
        points = self._part.points(self._kinds())
        away = ((points - np.asarray(place, np.float32)) ** 2).sum(axis=1)
        return float(self._known[self._key].values[away.argmin()])

    def shapes(self) -> list[Any]:
        """The groups that are coloured, to be picked."""
        return [] if self._part is None else self._part.shapes(self._kinds())

    def _kinds(self) -> tuple[int, ...]:
        """The kinds that have the quantity: all hang over and are warm, only struts have a radius.

        A skin that is seen through stays so, but where its own thickness is shown.
        """
        from volfrep.reports.facet_roles import LATTICE, OUTSIDE, WALL

        view = self._obj.ViewObject
        if view.ColourBy not in ("Overhang", "Temperature"):
            return (OUTSIDE,) if view.ColourBy in OF_SKIN else (LATTICE,)
        return (WALL, LATTICE) if view.Transparency else (OUTSIDE, WALL, LATTICE)

    @property
    def _key(self) -> tuple[str, tuple[int, ...]]:
        return self._obj.ViewObject.ColourBy, self._kinds()

    def end(self) -> None:
        """Leave nothing in the view's scene."""
        self._legend.remove()
        drop_steps(self._steps)
        self._asked = None

    def _ask(self, quantity: str) -> None:
        """Have the values made beside the window."""
        from freecad_volfrep.features.sizing.sizing import carried_by
        from volfrep.jobs.figures.point_values import GOVERNING, OF_HEAT, OF_LOADS, point_values
        from volfrep.process.worker import Call

        key = self._key
        if self._asked == key:
            return
        obj, part = self._obj, self._part
        assert part is not None
        self._asked = key
        self._legend.remove()
        part.uncolour()
        try:
            # Overhangs are of the mesh itself, whatever the values are by now.
            is_of_mesh = quantity == "Overhang"
            solid, spec, cache = (obj.Proxy.wanted if is_of_mesh else obj.Proxy.inputs)(obj)
            options: dict[str, Any] = {"cache": cache, "up": tuple(obj.BuildDirection)}
            if quantity in (*OF_LOADS, *GOVERNING, OF_HEAT):
                options.update(carried_by(obj, quantity))
        except VolfrepError as error:
            self.why, self._asked = localise(translate("VolfrepColours", str(error))), None
            tell_error(self.why)
            return
        kinds = self._kinds()
        if quantity in (*OF_SKIN, OF_HEAT):  # flat faces have corners only
            part.refine(kinds, float(np.linalg.norm(np.ptp(solid.bounds, axis=0))) / SKIN_SIDES)
        arrays = part.points(kinds), part.normals(kinds)

        def then(found: PointValues | None, error: BaseException | None) -> None:
            self._asked = None
            if found is not None:
                self._known[key] = found
                self.refresh()
            elif isinstance(error, (VolfrepError, Cancelled)):
                tell_error(str(error))
                obj.ViewObject.ColourBy = NOTHING
            elif error is not None:
                raise error

        begin(
            Job(
                job_title("Colours of {label}", obj),
                Call(point_values, (solid, spec, quantity, *arrays), options),
            ),
            then,
            is_wanted=lambda: self._asked == key and self._part is part,
        )
