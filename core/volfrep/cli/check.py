# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep check``: what a reader sees in a file of triangles."""

from __future__ import annotations

import argparse

from .telling import print_rows


def run_check(options: argparse.Namespace) -> None:
    """Run ``volfrep check``."""
    from ..io.solid import read_triangles
    from ..reports.mesh_report import mesh_report

    report = mesh_report(read_triangles(options.file, options.unit))
    print_rows(("file", str(options.file)), *report.rows())
