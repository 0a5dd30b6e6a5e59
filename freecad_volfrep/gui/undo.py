# SPDX-License-Identifier: LGPL-2.1-or-later
"""One step of a document's undo."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import FreeCAD as App


@contextmanager
def undo_step(doc: App.Document, name: str) -> Iterator[None]:
    """What is changed inside is one step of the document's undo; no step where that fails."""
    doc.openTransaction(name)
    try:
        yield
    except BaseException:
        doc.abortTransaction()
        raise
    doc.commitTransaction()
