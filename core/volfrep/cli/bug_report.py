# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a report of a fault needs to say: versions, the job and what was printed, without names.

Names of people and customers stand in folders and in comments. A specification is read as TOML, and
its values are written anew; of what the command printed, the folders of paths are taken out.
"""

from __future__ import annotations

import json
import os
import platform
import re
import sys
from argparse import Namespace
from collections.abc import Mapping
from typing import Any

from ..util.version import PACKAGES, VERSION, versions

#: Packages of which the version matters beside the needed ones: those of single features.
FEATURES = ("meshio", "pyvista", "gmsh", "networkx", "pandas", "matplotlib", "distributed")
#: Of what was printed, so many lines at the end are told.
LAST_LINES = 200

#: A text that begins at a root, or ends as files do; formulas divide, too.
_PATH = re.compile(r"^(/|~|\.\.?[\\/]|\\\\|[A-Za-z]:[\\/])|[\\/].*\.[A-Za-z]\w*$", re.DOTALL)
#: A user's own folder, whose last name is that of a person.
_HOME = re.compile(
    r"(/home|/Users|[A-Za-z]:[\\/]+Users)[\\/]+"
    r"([^\s\\/'\":,;()]+( [^\s\\/'\":,;()]+)?(?=[\\/])|[^\s\\/'\":,;()]+)"
)
#: In what was printed: a quoted text with a separator, and the folders before a word: from a root,
#: or before a name that ends as files do.
_QUOTED = re.compile(r"""(?P<mark>['"])(?P<path>[^'"\n]*[\\/][^'"\n]*)(?P=mark)""")
_WORD = re.compile(
    r"(?<![\w.'\"])(?:~|\.\.?|[A-Za-z]:)?[\\/](?:[^\s'\":,;()]+[\\/])*(?=[^\s'\":,;()])"
    r"|(?<![\w.'\"\\/])[^\s'\":,;()]+[\\/](?=[^\s'\":,;()\\/]+\.[A-Za-z])"
)
#: What tells which line of a program it was, from the package on.
_SOURCE = re.compile(r".*[\\/](?=(?:freecad[\\/])?(?:freecad_)?volfrep[\\/].*\.py$)")


def describe_machine(specification: str = "", log: str = "") -> str:
    """Text for a report of a fault.

    Args:
        specification: of the job that failed, as `without_folders` gives it.
        log: what was printed, as `log_without_folders` gives it.
    """
    rows = {
        "volfrep": VERSION,
        "Python": platform.python_version(),
        "system": f"{platform.system()} {platform.release()}, {platform.machine()}",
        "processors": str(os.cpu_count()),
        **versions((*PACKAGES, *FEATURES)),
    }
    text = "\n".join(f"- {name}: {value}" for name, value in rows.items())
    for kind, part in (("toml", specification), ("text", log)):
        if part:
            text += f"\n\n```{kind}\n{part.rstrip()}\n```"
    return text


def without_folders(entries: Mapping[str, Any]) -> str:
    """What a TOML file holds, written anew: no comments, and files without their folders.

    >>> print(without_folders({"cell": "CVC", "keep_solid": ["/home/ann/boss.stl"]}))
    cell = "CVC"
    keep_solid = ["boss.stl"]
    """
    return "\n".join(f"{_key(name)} = {_toml(value)}" for name, value in entries.items())


def _toml(value: Any) -> str:
    """A value in TOML's notation, tables in line; texts that are paths lose their folders."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(name)} = {_toml(one)}" for name, one in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, str):
        return json.dumps(_last(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    return str(value)


def _key(name: str) -> str:
    return name if re.fullmatch(r"[\w-]+", name, re.ASCII) else json.dumps(_last(name))


def _last(text: str) -> str:
    """A path's last name; any other text as it is."""
    path = _HOME.sub("~", text.strip())
    return re.split(r"[\\/]", path.rstrip("\\/"))[-1] if _PATH.search(path) else text


def log_without_folders(text: str) -> str:
    """The end of what was printed, without the folders of the paths in it.

    >>> log_without_folders("Cannot read the mesh '/home/ann/her part/rod.stl': it is empty.")
    "Cannot read the mesh 'rod.stl': it is empty."
    """
    lines = _HOME.sub("~", text).splitlines()[-LAST_LINES:]
    return "\n".join(_WORD.sub("", _QUOTED.sub(_quoted, line)) for line in lines)


def _quoted(found: re.Match[str]) -> str:
    path = found["path"]
    source = _SOURCE.sub("", path)
    return f"{found['mark']}{source if source != path else _last(path)}{found['mark']}"


def run_report_bug(options: Namespace) -> None:
    """Run ``volfrep report-bug``."""
    from ..util.reading import read_text, read_toml

    specification = log = ""
    if options.spec is not None:
        specification = without_folders(read_toml(options.spec, "specification"))
    if options.log is not None:
        log = log_without_folders(read_text(options.log, "log"))
    sys.stdout.write(describe_machine(specification, log) + "\n")
