# SPDX-License-Identifier: LGPL-2.1-or-later
"""Telling the user what happened: in the status bar and the report view, seldom in a box.

A box asks for a decision, or says what would be missed otherwise: that packages are missing, or
that a file that was asked for is not there. Everything else is told without stopping the work.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import translate
from volfrep.util.errors import Cancelled, VolfrepError

from .qt import QtWidgets

#: Style of a sentence about what is wrong: a red that light and dark themes leave readable.
WRONG = "color: #e04838"
#: Lengths that a box asks for are no shorter, mm.
SHORTEST = 1e-3


def tell(sentence: str) -> None:
    """Say what was done; FreeCAD shows it in the status bar and the report view."""
    App.Console.PrintMessage(f"VOLFREP: {sentence}\n")


def tell_written(path: str) -> None:
    """Say that a file is there."""
    tell(translate("VolfrepMessages", "{path} written").format(path=path))


def tell_error(sentence: str) -> None:
    """Say what is wrong; FreeCAD shows it in the status bar and the report view."""
    App.Console.PrintError(f"VOLFREP: {localise(sentence)}\n")


def show_error(sentence: str) -> None:
    """Show one sentence in a box and wait until it is acknowledged."""
    App.Console.PrintError(f"VOLFREP: {localise(sentence)}\n")
    QtWidgets.QMessageBox.warning(Gui.getMainWindow(), "VOLFREP", localise(sentence))


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


class LengthsBox(QtWidgets.QDialog):  # type: ignore[misc]
    """Asks for lengths, and says what those that stand there come to."""


def ask_lengths(
    title: str, wanted: dict[str, float], estimate: Callable[[list[float]], str]
) -> list[float] | None:
    """Lengths in mm that the user types in a box; None where she leaves it.

    Args:
        title: of the box.
        wanted: what each length is, and what it begins with.
        estimate: a sentence on what the lengths that stand there come to.
    """
    box = LengthsBox(Gui.getMainWindow())
    box.setWindowTitle(title)
    rows = QtWidgets.QFormLayout(box)
    fields = []
    for text, length in wanted.items():
        spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
        spin.setProperty("unit", "mm")
        spin.setProperty("minimum", SHORTEST)
        spin.setProperty("rawValue", length)
        spin.setAccessibleName(text)
        rows.addRow(QtWidgets.QLabel(text), spin)
        fields.append(spin)
    note = QtWidgets.QLabel()
    rows.addRow(note)
    buttons = QtWidgets.QDialogButtonBox(
        QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel
    )
    rows.addRow(buttons)
    buttons.accepted.connect(box.accept)
    buttons.rejected.connect(box.reject)

    def typed() -> list[float]:
        return [float(field.property("rawValue")) for field in fields]

    def check() -> None:
        is_sound = min(typed()) >= SHORTEST
        buttons.button(QtWidgets.QDialogButtonBox.Ok).setEnabled(is_sound)
        note.setText(estimate(typed()) if is_sound else "")

    for field in fields:
        # Its own signal has a type that Python's Qt does not know.
        field.findChild(QtWidgets.QLineEdit).textChanged.connect(check)
    check()
    done = box.exec_() == QtWidgets.QDialog.Accepted
    lengths = typed()
    box.deleteLater()
    return lengths if done else None


def file_name(label: str) -> str:
    """A name to propose for a file, of what a user has called an object."""
    return "".join("_" if letter in '/\\:*?"<>|' else letter for letter in label)


@contextmanager
def errors_shown(box: bool = False) -> Iterator[None]:
    """Run a block whose bad-input errors are told to the user, in a box or without."""
    try:
        yield
    except VolfrepError as error:
        (show_error if box else tell_error)(str(error))
    except (Cancelled, App.Base.FreeCADAbort):  # ours, or where FreeCAD has asked
        tell(translate("VolfrepMessages", "Cancelled."))
