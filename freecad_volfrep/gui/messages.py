# SPDX-License-Identifier: LGPL-2.1-or-later
"""Telling the user in a window what went wrong."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import FreeCADGui as Gui

from volfrep.errors import VolfrepError

from .qt import QtWidgets


def show_error(sentence: str) -> None:
    """Show one sentence and wait until it is acknowledged."""
    QtWidgets.QMessageBox.warning(Gui.getMainWindow(), "VOLFREP", sentence)


def ask(sentence: str) -> bool:
    """Whether the user answers the question with Yes."""
    box = QtWidgets.QMessageBox
    answer = box.question(Gui.getMainWindow(), "VOLFREP", sentence, box.Yes | box.No, box.Yes)
    return bool(answer == box.Yes)


def choose(label: str, items: list[str], refused: list[str]) -> str | None:
    """The item that the user picks from a list; None if she does not.

    `refused` are sentences about what is not in the list.
    """
    text = "\n".join([label, *refused])
    item, taken = QtWidgets.QInputDialog.getItem(
        Gui.getMainWindow(), "VOLFREP", text, items, 0, False
    )
    return str(item) if taken else None


@contextmanager
def errors_shown() -> Iterator[None]:
    """Run a block whose bad-input errors are shown in a window."""
    try:
        yield
    except VolfrepError as error:
        show_error(str(error))
