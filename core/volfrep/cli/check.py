# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep check``: what a reader sees in a file of triangles."""

from __future__ import annotations

import argparse

from .run_options import add_run_options
from .telling import print_rows


def add_check(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.set_defaults(command=_check)
    parser.add_argument("file", metavar="FILE")
    add_run_options(parser, "check")


def _check(options: argparse.Namespace) -> None:
    from ..io.solid import read_triangles
    from ..reports.mesh_report import mesh_report

    report = mesh_report(read_triangles(options.file, options.unit))
    print_rows(("file", str(options.file)), *report.rows())
