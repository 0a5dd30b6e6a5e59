# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whether the text of a STEP file is whole.

A CAD kernel passes over what it cannot resolve: of a file with a line missing it may read a
solid with some of its faces. So the text is looked through first (ISO 10303-21): every statement
defines an instance once, and every instance that is named is defined.
"""

from __future__ import annotations

import re

from ...util.errors import VolfrepError
from .contents import damaged

_ASIDE = re.compile(rb"'(?:[^']|'')*'|/\*.*?\*/", re.DOTALL)
_END = b"END-ISO-10303-21"
_DEFINED = re.compile(rb";\s*#(\d+)\s*=")
_NAMED = re.compile(rb"#(\d+)")
_OTHER = re.compile(rb";(?!\s*(?:#\d+\s*=\s*[A-Z(]|ENDSEC\s*;|DATA\s*[;(]|SIGNATURE|$))")


def refuse_damaged_step(data: bytes, name: str) -> None:
    """Look through a STEP file before it is given to a CAD kernel.

    Raises:
        VolfrepError: it is no STEP file, is cut short, or names what is not there.
    """
    if not data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"ISO-10303-21"):
        raise VolfrepError(f"'{name}' is not a STEP file: its header is missing; export it again.")
    text = _ASIDE.sub(b"''", data)
    start = re.search(rb"\bDATA\s*[;(]", text)
    end = text.rfind(_END)
    if start is None or end < start.start():
        raise VolfrepError(
            f"'{name}' is cut short: it has no '{_END.decode()}' at its end; export or download it "
            "again."
        )
    body = b";" + text[start.start() : end].rstrip()
    other = _OTHER.search(body)
    if other is not None:
        said = body[other.end() : other.end() + 60].decode("ascii", "replace")
        shown = " ".join("".join(c if c.isprintable() else " " for c in said).split())
        raise damaged(name, f"it has no statement where it says '{shown}'")
    defined = _DEFINED.findall(body)
    known = set(defined)
    missing = set(_NAMED.findall(body)) - known
    if missing:
        number = min(missing, key=lambda word: (len(word), word)).decode()[:20]
        raise damaged(name, f"it names an instance #{number} that is not there")
    if len(known) < len(defined):
        raise damaged(name, f"{len(defined) - len(known)} of its instances are there twice")
