# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's options for what the lattice fills, and how it ends there.

numpy and the engine are imported inside the functions, as in `cli`.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Any

from ..util.errors import VolfrepError

if TYPE_CHECKING:
    from ..reports.report import Report

#: Fields of the specification that these options give as they are.
FIELDS = ("activation", "boundary", "remove_dangling", "shortest_stub")


def add_options(parser: argparse.ArgumentParser) -> None:
    """The options of the command that fills a part."""
    add = parser.add_argument
    add(
        "--activation",
        metavar="RULE",
        help="cells to fill: 'touching' the domain (default), with their 'centre' inside it, or "
        "wholly 'inside' it",
    )
    add(
        "--boundary",
        metavar="RULE",
        help="'trim' the lattice at the wall (default), or leave cells 'whole'",
    )
    add(
        "--remove-dangling",
        action="store_true",
        help="take away struts with a free end, again and again until there are none",
    )
    add(
        "--shortest-stub",
        type=float,
        metavar="MM",
        help="take away struts with a free end that are shorter than this (default 0: none)",
    )
    add(
        "--open-plane",
        type=_numbers,
        action="append",
        metavar="X,Y,Z,NX,NY,NZ",
        help="leave the faces in this plane, a point and a normal, without a skin; may be repeated",
    )
    add(
        "--drain",
        type=_numbers,
        action="append",
        metavar="X,Y,Z[,NX,NY,NZ]",
        help="a drain hole at this point of the surface, along a direction if one is given; may be "
        "repeated",
    )
    add(
        "--drain-count",
        type=int,
        metavar="N",
        help="drain holes for each closed void, at its lowest places along --build-direction",
    )
    add("--drain-diameter", type=float, metavar="MM", help="diameter of the drain holes")


def openings(options: argparse.Namespace) -> dict[str, Any]:
    """The fields of the specification for what is to be open in the skin.

    Raises:
        VolfrepError: the options do not go together, or make no sense.
    """
    from ..design.openings import DrainHoles, DrainPlace, OpenPlane

    result: dict[str, Any] = {}
    if options.open_plane:
        planes = _of_length(options.open_plane, "--open-plane", 6)
        result["open_faces"] = tuple(
            OpenPlane((x, y, z), (nx, ny, nz)) for x, y, z, nx, ny, nz in planes
        )
    wanted = bool(options.drain) or options.drain_count is not None
    if wanted and options.drain_diameter is None:
        raise VolfrepError("Drain holes need a diameter: give --drain-diameter.")
    if options.drain_diameter is not None:
        if not wanted:
            raise VolfrepError("--drain-diameter needs --drain places or a --drain-count.")
        places = _of_length(options.drain or [], "--drain", 3, 6)
        result["drains"] = DrainHoles(
            options.drain_diameter,
            tuple(
                DrainPlace((x, y, z), (way[0], way[1], way[2]) if way else None)
                for x, y, z, *way in places
            ),
            options.drain_count or 0,
            options.build_direction,
        )
    return result


def _of_length(
    values: list[tuple[float, ...]], option: str, *lengths: int
) -> list[tuple[float, ...]]:
    for value in values:
        if len(value) not in lengths:
            wanted = " or ".join(str(length) for length in lengths)
            raise VolfrepError(f"{option} takes {wanted} numbers with commas, not {len(value)}.")
    return values


def _numbers(text: str) -> tuple[float, ...]:
    """Any numbers between commas."""
    try:
        return tuple(float(number) for number in text.split(","))
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"'{text}' is not numbers between commas") from error


def rows(report: Report) -> list[tuple[str, str]]:
    """What was taken away, and drain holes; nothing where there is nothing."""
    counts = (
        (report.struts_dangling_removed, "dangling struts"),
        (report.stubs_removed, "stubs"),
        (report.pieces_removed, "loose pieces"),
    )
    text = ", ".join(f"{count:,} {what}" for count, what in counts if count)
    result = [("removed", text)] if text else []
    if report.drain_holes:
        places = ", ".join("({:.4g}, {:.4g}, {:.4g})".format(*hole) for hole in report.drain_holes)
        result.append(("drain holes", f"{len(report.drain_holes)} at {places}"))
    return result
