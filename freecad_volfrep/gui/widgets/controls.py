# SPDX-License-Identifier: LGPL-2.1-or-later
"""Controls that panels, docks and windows share: a button, a message, a table that is read."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

from freecad_volfrep.gui.messages import WRONG
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.sentences import localise

from .panel_manners import fits_any_width


def push_button(name: str, text: str, act: Callable[[], Any], tip: str = "") -> Any:
    """A button that calls `act`, and that Enter in another field does not press."""
    button = QtWidgets.QPushButton(text)
    button.setObjectName(name)
    button.setToolTip(tip)
    button.setAutoDefault(False)
    button.clicked.connect(lambda _=False: act())
    return button


class Message(QtWidgets.QLabel):
    """Sentences in the user's language, as narrow as where they stand; red for what is wrong."""

    def __init__(self, name: str) -> None:
        super().__init__()
        self.setObjectName(name)
        fits_any_width(self)

    def say(self, text: str, wrong: bool = False) -> None:
        """Show a sentence in place of the one before."""
        self.setStyleSheet(WRONG if wrong else "")
        self.setText(localise(text))


def table_of_rows(name: str, heads: Iterable[str]) -> Any:
    """A table without rows yet: they are picked whole, one at a time, and not edited."""
    heads = list(heads)
    table = QtWidgets.QTableWidget(0, len(heads))
    table.setObjectName(name)
    table.setHorizontalHeaderLabels(heads)
    table.setSelectionBehavior(QtWidgets.QAbstractItemView.SelectRows)
    table.setSelectionMode(QtWidgets.QAbstractItemView.SingleSelection)
    table.setEditTriggers(QtWidgets.QAbstractItemView.NoEditTriggers)
    table.horizontalHeader().setStretchLastSection(True)
    return table
