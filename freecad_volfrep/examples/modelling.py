# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few modelling steps that both example parts are made of.

Every size is an expression on the part's spreadsheet, so that nothing here is a fixed number
after the part is built.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import FreeCAD as App
import Part
import Sketcher

#: Sketch geometry's own numbering of points.
START, END, CENTRE = 1, 2, 3

Point = tuple[float, float]
Expressions = Mapping[str, str]


def make_sizes(doc: Any, name: str, sizes: Mapping[str, tuple[float, str]]) -> Any:
    """A spreadsheet of sizes in mm, a row each: meaning, value; the value's cell has an alias.

    Args:
        doc: the document.
        name: of the spreadsheet object, by which expressions refer to it.
        sizes: alias to (value in mm, what it means).
    """
    sheet = doc.addObject("Spreadsheet::Sheet", name)
    sheet.setColumnWidth("A", 260)
    for row, (alias, (value, meaning)) in enumerate(sizes.items(), start=1):
        sheet.set(f"A{row}", meaning)
        sheet.set(f"B{row}", f"{value:g} mm")
        sheet.setAlias(f"B{row}", alias)
    doc.recompute([sheet])
    return sheet


def add(doc: Any, kind: str, label: str, expressions: Expressions, **values: Any) -> Any:
    """An object of a FreeCAD type, its properties from values first and expressions second."""
    obj = doc.addObject(kind, label)
    for name, value in values.items():
        setattr(obj, name, value)
    for path, expression in expressions.items():
        obj.setExpression(path, expression)
    return obj


def add_sketch(doc: Any, label: str, placement: Any | None = None) -> Any:
    """An empty sketch; it lies in the XY plane where no placement is given."""
    sketch = doc.addObject("Sketcher::SketchObject", label)
    if placement is not None:
        sketch.Placement = placement
    return sketch


def constrain(sketch: Any, expression: str, kind: str, *where: int, value: float) -> None:
    """A dimension that follows a spreadsheet expression; `value` is what it starts from."""
    index = sketch.addConstraint(Sketcher.Constraint(kind, *where, value))
    sketch.setExpression(f"Constraints[{index}]", expression)


def add_tangent_taper(
    doc: Any,
    label: str,
    placement: Any | None,
    start: tuple[float, str, float, str],
    eye: tuple[float, str, float, str],
) -> Any:
    """A sketch of a straight edge that tapers into a round end, symmetric about its Y axis.

    The profile of a lug or of a rod's shank: a base line of a given half width, and two sides
    tangent to the arc that ends it.

    Args:
        doc: the document.
        label: the sketch's name.
        placement: of the sketch, or None.
        start: the base line's y and its expression, its half width and its expression.
        eye: the arc centre's y and its expression, its radius and its expression.
    """
    y0, y0_expression, half, half_expression = start
    height, height_expression, radius, radius_expression = eye
    rise = height - y0
    # The sides touch the arc where its normal stands upright on them.
    tilt = math.acos(radius / math.hypot(half, rise)) - math.atan2(rise, half)
    touch = App.Vector(radius * math.cos(tilt), height + radius * math.sin(tilt), 0)
    left_touch = App.Vector(-touch.x, touch.y, 0)
    right, left = App.Vector(half, y0, 0), App.Vector(-half, y0, 0)
    circle = Part.Circle(App.Vector(0, height, 0), App.Vector(0, 0, 1), radius)

    sketch = add_sketch(doc, label, placement)
    base, side, arc, other = sketch.addGeometry(
        [
            Part.LineSegment(left, right),
            Part.LineSegment(right, touch),
            Part.ArcOfCircle(circle, tilt, math.pi - tilt),
            Part.LineSegment(left_touch, left),
        ],
        False,
    )
    origin, y_axis = (-1, START), -2
    rules = Sketcher.Constraint
    sketch.addConstraint(
        [
            rules("Coincident", base, END, side, START),
            rules("Tangent", side, END, arc, START),
            rules("Tangent", arc, END, other, START),
            rules("Coincident", other, END, base, START),
            rules("Symmetric", base, START, base, END, y_axis),
            rules("PointOnObject", arc, CENTRE, y_axis),
        ]
    )
    constrain(sketch, f"2 * {half_expression}", "Distance", base, value=2 * half)
    constrain(sketch, radius_expression, "Radius", arc, value=radius)
    constrain(sketch, height_expression, "DistanceY", *origin, arc, CENTRE, value=height)
    constrain(sketch, y0_expression, "DistanceY", *origin, base, START, value=y0)
    return sketch


def extrude(
    doc: Any, label: str, sketch: Any, direction: Point | Sequence[float], length: str
) -> Any:
    """A solid extrusion of a sketch along a direction, symmetric about the sketch's plane."""
    return add(
        doc,
        "Part::Extrusion",
        label,
        {"LengthFwd": length},
        Base=sketch,
        DirMode="Custom",
        Dir=App.Vector(*direction),
        Solid=True,
        Symmetric=True,
    )


def fillet(doc: Any, label: str, base: Any, radius_of: Callable[[Any], float]) -> Any:
    """A fillet on the edges of `base` for which `radius_of` gives a radius above 0, in mm.

    Raises:
        RuntimeError: no edge gets a radius.
    """
    doc.recompute()
    radii = [(k, radius_of(edge)) for k, edge in enumerate(base.Shape.Edges, start=1)]
    edges = [(k, radius, radius) for k, radius in radii if radius > 0]
    if not edges:
        raise RuntimeError(f"The fillet '{label}' found no edge on '{base.Label}'.")
    return add(doc, "Part::Fillet", label, {}, Base=base, Edges=edges)


def hide(objects: Sequence[Any]) -> None:
    """Leave only the finished part to be seen, where there is a screen."""
    for obj in objects:
        if getattr(obj, "ViewObject", None) is not None:
            obj.ViewObject.Visibility = False
