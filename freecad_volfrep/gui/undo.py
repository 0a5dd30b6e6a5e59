# SPDX-License-Identifier: LGPL-2.1-or-later
"""One step of a document's undo, also where its mesh comes later than what it is of."""

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


#: At the end of a step's name, where nobody sees it: undone and redone with the one before it.
FOLLOWS = "\u200b"


def complete_steps(doc: App.Document, is_undone: bool) -> None:
    """Undo or redo the other step of a change whose mesh came later than its values.

    Args:
        doc: in which steps were undone or redone.
        is_undone: the mesh, rather than the values redone.
    """
    if doc.RedoNames and doc.RedoNames[0].endswith(FOLLOWS):
        (doc.undo if is_undone else doc.redo)()
