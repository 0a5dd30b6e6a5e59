# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault needs to say of the machine: versions, no names of people or files."""

from __future__ import annotations

import os
import platform
import sys
from argparse import Namespace
from collections.abc import Callable
from typing import Any

from ..util.version import PACKAGES, VERSION, versions

#: Packages of which the version matters beside the needed ones: those of single features.
FEATURES = ("meshio", "pyvista", "gmsh", "networkx", "pandas", "matplotlib", "distributed")


def describe_machine(specification: str = "") -> str:
    """Text for a report of a fault.

    Args:
        specification: of the job that failed, as `--write-spec` writes it; paths in it lose their
            folders.
    """
    rows = {
        "volfrep": VERSION,
        "Python": platform.python_version(),
        "system": f"{platform.system()} {platform.release()}, {platform.machine()}",
        "processors": str(os.cpu_count()),
        **versions((*PACKAGES, *FEATURES)),
    }
    text = "\n".join(f"- {name}: {value}" for name, value in rows.items())
    if specification:
        text += f"\n\n```toml\n{without_folders(specification).rstrip()}\n```"
    return text


def without_folders(text: str) -> str:
    """A specification whose files are named without the folders that they lie in."""
    lines = []
    for line in text.splitlines():
        key, mark, value = line.partition(" = ")
        quoted = value.strip()
        if mark and quoted[:1] in ("'", '"') and ("/" in quoted or "\\" in quoted):
            name = quoted.strip("'\"").replace("\\\\", "/").replace("\\", "/").rpartition("/")[2]
            line = f'{key} = "{name}"'
        lines.append(line)
    return "\n".join(lines)


def add_command(add: Callable[..., Any]) -> None:
    """Add ``report-bug`` to the command's parser."""
    parser = add("report-bug", _run, "Print what a report of a fault needs: versions, and the job.")
    parser.add_argument("--spec", metavar="FILE", help="the specification of the job that failed")


def _run(options: Namespace) -> None:
    from ..util.reading import read_text

    text = "" if options.spec is None else read_text(options.spec, "specification")
    sys.stdout.write(describe_machine(text) + "\n")
