# SPDX-License-Identifier: LGPL-2.1-or-later
"""The few modelling steps that both example parts are made of.

Every size is an expression on the part's spreadsheet, so that nothing here is a fixed number
after the part is built.

No edge is named that a size could rename: FreeCAD 1.1 loses a fillet's edges that come from a
union, so such arcs are drawn in the sketches.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
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


def add_rounded_taper(
    doc: Any,
    label: str,
    placement: Any | None,
    start: tuple[float, str, float, str],
    eye: tuple[float, str, float, str],
    corner: float,
) -> Any:
    """As `add_tangent_taper`, with the base line's corners rounded off in the sketch.

    The half width is that of the sharp corner. Upright edges of an extrusion come from points of
    its sketch, whose names FreeCAD 1.1 loses when a size changes: no fillet should refer to them.

    Args:
        doc: the document.
        label: the sketch's name.
        placement: of the sketch, or None.
        start: the base line's y and its expression, its half width and its expression.
        eye: the arc centre's y and its expression, its radius and its expression.
        corner: radius of the two corners, mm.
    """
    y0, y0_expression, half, half_expression = start
    height, height_expression, radius, radius_expression = eye
    rise = height - y0
    tilt = math.acos(radius / math.hypot(half, rise)) - math.atan2(rise, half)
    # A corner's centre is its radius above the base and inside the side.
    reach = half - corner * (1.0 + math.sin(tilt)) / math.cos(tilt)
    centre = App.Vector(reach, y0 + corner, 0)
    normal = App.Vector(math.cos(tilt), math.sin(tilt), 0)
    turned, touch = centre + normal * corner, App.Vector(0, height, 0) + normal * radius

    sketch = add_sketch(doc, label, placement)
    base, right_corner, right, arc, left, left_corner = sketch.addGeometry(
        [
            Part.LineSegment(App.Vector(-reach, y0, 0), App.Vector(reach, y0, 0)),
            _arc(centre, corner, -math.pi / 2, tilt),
            Part.LineSegment(turned, touch),
            _arc(App.Vector(0, height, 0), radius, tilt, math.pi - tilt),
            Part.LineSegment(_mirrored(touch), _mirrored(turned)),
            _arc(_mirrored(centre), corner, math.pi - tilt, 1.5 * math.pi),
        ],
        False,
    )
    sharp, other = sketch.addGeometry(
        [Part.Point(App.Vector(half, y0, 0)), Part.Point(App.Vector(-half, y0, 0))], True
    )
    origin, y_axis = (-1, START), -2
    rules = Sketcher.Constraint
    ring = (base, right_corner, right, arc, left, left_corner, base)
    sketch.addConstraint(
        [
            *(rules("Tangent", one, END, two, START) for one, two in pairwise(ring)),
            rules("Horizontal", base),
            rules("PointOnObject", arc, CENTRE, y_axis),
            rules("PointOnObject", sharp, START, base),
            rules("Symmetric", sharp, START, other, START, y_axis),
            rules("PointOnObject", sharp, START, right),
            rules("PointOnObject", other, START, left),
            rules("Radius", right_corner, corner),
            rules("Radius", left_corner, corner),
        ]
    )
    constrain(sketch, half_expression, "DistanceX", *origin, sharp, START, value=half)
    constrain(sketch, radius_expression, "Radius", arc, value=radius)
    constrain(sketch, height_expression, "DistanceY", *origin, arc, CENTRE, value=height)
    constrain(sketch, y0_expression, "DistanceY", *origin, base, START, value=y0)
    return sketch


def _mirrored(point: Any) -> Any:
    """On the other side of the sketch's Y axis."""
    return App.Vector(-point.x, point.y, 0)


def _arc(centre: Any, radius: float, first: float, last: float) -> Any:
    """An arc in the sketch's plane between two angles, anticlockwise."""
    return Part.ArcOfCircle(Part.Circle(centre, App.Vector(0, 0, 1), radius), first, last)


def add_rod_outline(
    doc: Any,
    label: str,
    placement: Any | None,
    foot_end: tuple[float, str],
    tip_end: tuple[float, str, float, str],
    shank: tuple[float, str, float, str],
    neck: tuple[float, str],
) -> Any:
    """A sketch of two round ends joined by a tapered shank, with arcs where the shank enters them.

    The arcs are drawn here and not made by a fillet later: a fillet refers to the edges of a
    union by their numbers, which FreeCAD loses when a size changes.

    Args:
        doc: the document.
        label: the sketch's name.
        placement: of the sketch, or None.
        foot_end: the radius of the end about the origin, and its expression.
        tip_end: the other end's y and its expression, its radius and its expression.
        shank: half the shank's width at the origin and its expression, the radius about the
            other end's centre that its sides are tangent to and its expression.
        neck: the radius of the arcs between shank and ends, and its expression.
    """
    big, big_expression = foot_end
    pitch, pitch_expression, small, small_expression = tip_end
    half, half_expression, tip, tip_expression = shank
    bend, bend_expression = neck
    # The right side's outward normal and its direction towards the tip; its distance from the
    # origin. A neck's centre is as far outside it as outside the round end.
    tilt = math.acos(tip / math.hypot(half, pitch)) - math.atan2(pitch, half)
    normal = App.Vector(math.cos(tilt), math.sin(tilt), 0)
    along = App.Vector(-math.sin(tilt), math.cos(tilt), 0)
    from_foot, from_tip = half * math.cos(tilt) + bend, tip + bend
    foot_neck = normal * from_foot + along * math.sqrt((big + bend) ** 2 - from_foot**2)
    tip_reach = along * math.sqrt((small + bend) ** 2 - from_tip**2)
    tip_neck = App.Vector(0, pitch, 0) + normal * from_tip - tip_reach

    turn = math.atan2
    foot_angle = turn(foot_neck.y, foot_neck.x)
    tip_angle = turn(tip_neck.y - pitch, tip_neck.x)
    side_start, side_end = foot_neck - normal * bend, tip_neck - normal * bend

    pi = math.pi
    sketch = add_sketch(doc, label, placement)
    # Anticlockwise from the foot's end; FreeCAD's arcs turn to the left, the necks' to the right.
    foot, right_foot, right, right_tip, tip_arc, left_tip, left, left_foot = sketch.addGeometry(
        [
            _arc(App.Vector(), big, pi - foot_angle, 2 * pi + foot_angle),
            _arc(foot_neck, bend, tilt + pi, foot_angle + pi),
            Part.LineSegment(side_start, side_end),
            _arc(tip_neck, bend, tip_angle + pi, tilt + pi),
            _arc(App.Vector(0, pitch, 0), small, tip_angle, pi - tip_angle),
            _arc(_mirrored(tip_neck), bend, -tilt, -tip_angle),
            Part.LineSegment(_mirrored(side_end), _mirrored(side_start)),
            _arc(_mirrored(foot_neck), bend, -foot_angle, -tilt),
        ],
        False,
    )
    touched = Part.Circle(App.Vector(0, pitch, 0), App.Vector(0, 0, 1), tip)
    guide, right_point, left_point = sketch.addGeometry(
        [touched, Part.Point(App.Vector(half, 0, 0)), Part.Point(App.Vector(-half, 0, 0))], True
    )
    origin, x_axis, y_axis = (-1, START), -1, -2
    rules = Sketcher.Constraint
    joints = [
        (foot, END, right_foot, END),
        (right_foot, START, right, START),
        (right, END, right_tip, END),
        (right_tip, START, tip_arc, START),
        (tip_arc, END, left_tip, END),
        (left_tip, START, left, START),
        (left, END, left_foot, END),
        (left_foot, START, foot, START),
    ]
    sketch.addConstraint(
        [
            *(rules("Tangent", *joint) for joint in joints),
            rules("Coincident", foot, CENTRE, *origin),
            rules("PointOnObject", tip_arc, CENTRE, y_axis),
            rules("Coincident", guide, CENTRE, tip_arc, CENTRE),
            rules("PointOnObject", right_point, START, x_axis),
            rules("Symmetric", right_point, START, left_point, START, y_axis),
            rules("PointOnObject", right_point, START, right),
            rules("PointOnObject", left_point, START, left),
            rules("Tangent", right, guide),
            rules("Tangent", left, guide),
        ]
    )
    constrain(sketch, big_expression, "Radius", foot, value=big)
    constrain(sketch, small_expression, "Radius", tip_arc, value=small)
    constrain(sketch, tip_expression, "Radius", guide, value=tip)
    constrain(sketch, pitch_expression, "DistanceY", *origin, tip_arc, CENTRE, value=pitch)
    constrain(sketch, half_expression, "DistanceX", *origin, right_point, START, value=half)
    for curve in (right_foot, right_tip, left_tip, left_foot):
        constrain(sketch, bend_expression, "Radius", curve, value=bend)
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
