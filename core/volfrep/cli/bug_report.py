# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault needs to say of the machine: versions, no names of people or files."""

from __future__ import annotations

import json
import os
import platform
import re
import sys
from argparse import Namespace
from collections.abc import Callable
from typing import Any

from ..util.version import PACKAGES, VERSION, versions

#: Packages of which the version matters beside the needed ones: those of single features.
FEATURES = ("meshio", "pyvista", "gmsh", "networkx", "pandas", "matplotlib", "distributed")

#: Texts and comments of TOML.
_SAID = re.compile(r"""\"(?:[^"\\]|\\.)*"|'[^']*'|#.*""")
#: What begins at a root, or ends as files do; formulas divide, too.
_PATH = re.compile(r"^(/|~|\.\.?[\\/]|\\\\|[A-Za-z]:[\\/])|[\\/].*\.[A-Za-z]\w*$")


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
    """A specification without comments, whose files are named without their folders.

    >>> without_folders('keep_solid = ["/home/ann/boss.stl"]  # of Ann')
    'keep_solid = ["boss.stl"]'
    """
    return "\n".join(_SAID.sub(_kept, line).rstrip() for line in text.splitlines())


def _kept(found: re.Match[str]) -> str:
    """What is kept of a text, or of a comment."""
    said = found[0]
    if said.startswith("#"):
        return ""
    inner = said[1:-1].replace("\\\\", "\\")
    return json.dumps(re.split(r"[\\/]", inner)[-1]) if _PATH.search(inner) else said


def add_command(add: Callable[..., Any]) -> None:
    """Add ``report-bug`` to the command's parser."""
    parser = add("report-bug", _run, "Print what a report of a fault needs: versions, and the job.")
    parser.add_argument("--spec", metavar="FILE", help="the specification of the job that failed")


def _run(options: Namespace) -> None:
    from ..util.reading import read_text

    text = "" if options.spec is None else read_text(options.spec, "specification")
    sys.stdout.write(describe_machine(text) + "\n")
