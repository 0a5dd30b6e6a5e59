# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command's options for what the lattice fills, and how it ends there.

numpy and the engine are imported inside the functions, as in `cli`.
"""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .report import Report

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


def rows(report: Report) -> list[tuple[str, str]]:
    """What was taken away; nothing where nothing was."""
    counts = (
        (report.struts_dangling_removed, "dangling struts"),
        (report.stubs_removed, "stubs"),
        (report.pieces_removed, "loose pieces"),
    )
    text = ", ".join(f"{count:,} {what}" for count, what in counts if count)
    return [("removed", text)] if text else []
