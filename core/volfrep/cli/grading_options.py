# SPDX-License-Identifier: LGPL-2.1-or-later
"""The options of the ``volfrep`` command that make a lattice differ from place to place.

The engine is imported where it is needed only, so that ``--help`` answers at once.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ..util.errors import VolfrepError

if TYPE_CHECKING:
    from ..design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
    from ..design.profile import Profile

PROFILES = ("scalar", "linear", "quadratic", "exponential", "expression")
#: Laws that go from one value to another.
TWO_ENDED = ("linear", "quadratic", "exponential")
RADIUS_BY = ("direction", "skin", "core", "field")
MAPS = ("cylindrical", "spherical")
XYZ = ("X", "Y", "Z")


def add_grading_options(parser: argparse.ArgumentParser) -> None:
    """Add the options; every one is None where the user leaves it out."""
    size = parser.add_argument_group("cells that grow along a direction").add_argument
    size(
        "--size-grading",
        choices=PROFILES,
        metavar="LAW",
        help=f"law of lambda: {', '.join(PROFILES)}",
    )
    size("--lambda-min", type=float, metavar="A", help="lambda at the near end (default 1)")
    size("--lambda-max", type=float, metavar="B", help="lambda at the far end")
    size("--lambda", dest="lambda_formula", metavar="EXPR", help="lambda as a formula of s")
    size("--grading-direction", type=float, nargs=3, metavar=XYZ, help="of growth (default 1 0 0)")

    radius = parser.add_argument_group("struts whose radius varies").add_argument
    radius(
        "--radius-grading",
        choices=RADIUS_BY,
        metavar="BY",
        help="by the place along a 'direction', by the depth (s = 1 at the 'skin', or at the "
        "'core'), or by a 'field' of values",
    )
    radius("--radius-law", choices=PROFILES[1:], metavar="LAW", help=f"{', '.join(PROFILES[1:])}")
    radius("--radius-min", type=float, metavar="MM", help="where s = 0 or the field is least")
    radius("--radius-max", type=float, metavar="MM", help="where s = 1 or it is largest")
    radius("--radius-formula", metavar="EXPR", help="the radius in mm as a formula of s")
    radius("--radius-direction", type=float, nargs=3, metavar=XYZ, help="default 1 0 0")
    radius("--radius-reach", type=float, metavar="MM", help="depth where the law ends (default 5)")
    radius("--radius-field", metavar="FILE", help="points and values (.csv, .txt, .vtu, .vtk)")
    radius("--radius-column", metavar="NAME", help="which of several values of the file")
    radius("--radius-curve", metavar="V:MM,V:MM,...", help="the radius in mm for values V")

    place = parser.add_argument_group("where the cells lie").add_argument
    place("--rotate", type=float, nargs=4, metavar=(*XYZ, "DEGREES"), help="about this axis")
    place("--rotate-origin", type=float, nargs=3, metavar=XYZ, help="default: the middle")
    place("--cell-map", choices=MAPS, metavar="MAP", help=f"cells about an axis: {', '.join(MAPS)}")
    place("--map-centre", type=float, nargs=3, metavar=XYZ, help="default: the middle")
    place("--map-axis", type=float, nargs=3, metavar=XYZ, help="default 0 0 1")
    place("--map-around", type=int, metavar="N", help="cells around the full turn")
    place(
        "--stretch-struts",
        action="store_true",
        default=None,
        help="deform struts with their cells, as published, instead of keeping them round",
    )


def gradings(options: argparse.Namespace) -> dict[str, Any]:
    """What the options say, by the names of `LatticeSpec`.

    Raises:
        VolfrepError: a value that makes no sense, or an option that would have no effect.
    """
    _refuse_idle(options)
    return {
        "size_grading": _size_grading(options),
        "radius_grading": _radius_grading(options),
        "cell_map": _cell_map(options),
        "orientation": _orientation(options),
        "keep_radius": not options.stretch_struts,
    }


def _refuse_idle(options: argparse.Namespace) -> None:
    """Refuse an option that another one, which it needs, leaves without effect."""
    size, radius = options.size_grading, options.radius_grading
    curve, profile = options.radius_curve, options.radius_law
    deformed = size is not None or options.cell_map is not None
    by_law = radius not in (None, "field")
    two_ended = " or ".join((", ".join(TWO_ENDED[:-1]), TWO_ENDED[-1]))
    rules = (
        (
            size not in (None, "expression"),
            f"--size-grading {PROFILES[0]}, {two_ended}",
            "lambda_min",
        ),
        (size in TWO_ENDED, f"--size-grading {two_ended}", "lambda_max"),
        (size == "expression", "--size-grading expression", "lambda_formula"),
        (size is not None, "--size-grading", "grading_direction"),
        (by_law, "--radius-grading direction, skin or core", "radius_law"),
        (radius is not None, "--radius-grading", "radius_min", "radius_max"),
        (profile == "expression", "--radius-law expression", "radius_formula"),
        (profile != "expression", f"--radius-law {two_ended}", "radius_min", "radius_max"),
        (radius == "direction", "--radius-grading direction", "radius_direction"),
        (radius in ("skin", "core"), "--radius-grading skin or core", "radius_reach"),
        (
            radius == "field",
            "--radius-grading field",
            "radius_field", "radius_column", "radius_curve",
        ),
        (options.rotate is not None, "--rotate", "rotate_origin"),
        (options.cell_map is not None, "--cell-map", "map_centre", "map_axis", "map_around"),
        (deformed, "--size-grading or --cell-map", "stretch_struts"),
    )  # fmt: skip
    for holds, needed, *names in rules:
        for name in names:
            if not holds and getattr(options, str(name)) is not None:
                flag = "--lambda" if name == "lambda_formula" else _flag(str(name))
                raise VolfrepError(f"{flag} has no effect without {needed}: add that or leave it.")
    if curve is not None and (options.radius_min, options.radius_max) != (None, None):
        raise VolfrepError(
            "--radius-min and --radius-max have no effect with --radius-curve, which says every "
            "radius: leave them out."
        )


def _flag(name: str) -> str:
    return "--" + name.replace("_", "-")


def _size_grading(options: argparse.Namespace) -> SizeGrading | None:
    from ..design.grading import SizeGrading
    from ..design.profile import Profile

    kind = options.size_grading
    if kind is None:
        return None
    if kind == "expression":
        profile = Profile(kind, expression=_needed(options, "lambda_formula", "--lambda", kind))
    elif kind == "scalar":
        profile = Profile(kind, _needed(options, "lambda_min", "--lambda-min", kind))
    else:
        start = 1.0 if options.lambda_min is None else options.lambda_min
        profile = Profile(kind, start, _needed(options, "lambda_max", "--lambda-max", kind))
    return SizeGrading(profile, **_given(direction=options.grading_direction))


def _needed(options: argparse.Namespace, name: str, flag: str, kind: str) -> Any:
    value = getattr(options, name)
    if value is None:
        raise VolfrepError(f"The size grading {kind} needs {flag}: give it.")
    return value


def _radius_grading(options: argparse.Namespace) -> RadiusGrading | None:
    from ..design.grading import RadiusGrading
    from ..design.profile import Profile
    from ..design.scattered_field import read_curve, read_point_field

    by = options.radius_grading
    if by is None:
        return None
    # Both are read now, so that what is wrong with them is said before the work.
    curve = () if options.radius_curve is None else read_curve(options.radius_curve)
    field = None
    if options.radius_field is not None:
        field = read_point_field(options.radius_field, options.radius_column)
    profile = Profile() if curve else _radius_law(options)  # a curve needs none
    given = _given(direction=options.radius_direction, reach=options.radius_reach)
    return RadiusGrading(
        by, profile, field=field, column=options.radius_column, curve=curve, **given
    )


def _radius_law(options: argparse.Namespace) -> Profile:
    from ..design.profile import Profile

    kind = options.radius_law or "linear"
    if kind == "expression":
        if options.radius_formula is None:
            raise VolfrepError("The radius law expression needs --radius-formula: give it.")
        return Profile(kind, expression=options.radius_formula)
    if options.radius_min is None and options.radius_max is None:
        raise VolfrepError(
            "A radius grading needs --radius-min or --radius-max: without both, every strut has "
            "the strut radius."
        )
    radius = options.strut_radius
    start = radius if options.radius_min is None else options.radius_min
    return Profile(kind, start, radius if options.radius_max is None else options.radius_max)


def _cell_map(options: argparse.Namespace) -> CellMap | None:
    from ..design.grading import CellMap

    if options.cell_map is None:
        return None
    given = _given(centre=options.map_centre, axis=options.map_axis, around=options.map_around)
    return CellMap(options.cell_map, **given)


def _orientation(options: argparse.Namespace) -> Orientation | None:
    from ..design.grading import Orientation

    if options.rotate is None:
        return None
    *axis, angle = options.rotate
    return Orientation(tuple(axis), angle, **_given(origin=options.rotate_origin))


def _given(**values: Any) -> dict[str, Any]:
    """The values that are not None, lists as tuples."""
    plain = {k: tuple(v) if isinstance(v, list) else v for k, v in values.items()}
    return {name: value for name, value in plain.items() if value is not None}
