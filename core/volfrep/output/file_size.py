# SPDX-License-Identifier: LGPL-2.1-or-later
"""How large a mesh's file is, found by writing it where nobody sees it."""

from __future__ import annotations

import tempfile
from pathlib import Path

from .form import Form
from .writer import Settings, Source, writer_of


def written_size(source: Source, form: Form) -> float:
    """Size of the file of a form, in millions of bytes.

    Raises:
        VolfrepError: as the form's writer.
    """
    if form.name == "stl":
        return (84 + 50 * source.triangles) / 1e6
    with tempfile.TemporaryDirectory(prefix="volfrep-") as folder:
        path = Path(folder) / f"part{form.suffixes[0]}"
        writer_of(form).write(source, path, Settings())
        return path.stat().st_size / 1e6
