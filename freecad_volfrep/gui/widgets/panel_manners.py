# SPDX-License-Identifier: LGPL-2.1-or-later
"""How our task panels behave beside FreeCAD's: the wheel, titles, what OK and Enter may do."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets

#: The longest title: FreeCAD widens a panel until its title has room.
LONGEST_TITLE = 28
#: What is left of a label says something from so many letters on.
LEAST_LABEL = 6
#: What a field shows at least, and what its frame, FreeCAD's sign for expressions and arrows take,
#: px.
LONGEST_NUMBER, SIGNS = "100.00 mm", 46


class PanelForm(QtWidgets.QWidget):
    """The frame of a panel, which Enter in one of its fields does not close, as FreeCAD's would.

    Args:
        name: that it is found by.
        title: a label, or a command and the label that it is for, which is shortened in its middle
            where it is long, or left out: the tree has it.
        icon: of its title: a file's name in `resources/icons`, without its suffix.
    """

    def __init__(self, name: str, title: str, icon: str = "") -> None:
        super().__init__()
        self.setObjectName(name)
        # A theme's style sheet fills a plain QWidget, but none of its subclasses unasked.
        self.setAttribute(QtCore.Qt.WA_StyledBackground)
        self.setWindowTitle(short_title(title))
        if icon:
            self.setWindowIcon(QtGui.QIcon(str(ICONS / f"{icon}.svg")))
        #: What the panel shows, from above.
        self.column = QtWidgets.QVBoxLayout(self)
        self.column.setContentsMargins(0, 0, 0, 0)

    def keyPressEvent(self, event: Any) -> None:  # noqa: N802
        """Called by Qt with the keys that no field has taken."""
        if event.key() in (QtCore.Qt.Key_Return, QtCore.Qt.Key_Enter):
            event.accept()
        else:
            super().keyPressEvent(event)


def short_title(title: str) -> str:
    """A title of a panel of at most `LONGEST_TITLE` letters, where its command has no more."""
    command, colon, label = title.rpartition(": ")
    room = LONGEST_TITLE - len(command) - len(colon)
    if len(label) <= room:
        return title
    if room < LEAST_LABEL:
        return command
    ends = (room - 1) // 2
    return f"{command}{colon}{label[: room - 1 - ends]}\u2026{label[len(label) - ends :]}"


class _LeaveTheWheel(QtCore.QObject):
    """Leaves the wheel to what a field is in, unless the field was clicked into before."""

    def eventFilter(self, field: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        if event.type() != QtCore.QEvent.Wheel or field.hasFocus():
            return False
        event.ignore()  # so that it goes on to the parent
        return True


def leave_the_wheel(form: Any, fields: Iterable[Any]) -> None:
    """Let the wheel scroll a panel, and not change the fields that it comes over.

    The fields are given: to look for FreeCAD's own spoils Qt's wrappers of them.
    """
    leaves = _LeaveTheWheel(form)
    for field in fields:
        field.setFocusPolicy(QtCore.Qt.StrongFocus)
        field.installEventFilter(leaves)


class _KeepSpace(QtCore.QObject):
    """Leaves Space to the button or list in focus: FreeCAD hides what is selected by it."""

    def eventFilter(self, widget: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        is_space = event.type() == QtCore.QEvent.ShortcutOverride and (
            event.key() == QtCore.Qt.Key_Space
        )
        if is_space:
            event.accept()
        return bool(is_space)


def keep_space(form: Any, widgets: Iterable[Any]) -> None:
    """Let Space press the buttons of a panel, and open its lists."""
    keeps = _KeepSpace(form)
    for widget in widgets:
        widget.installEventFilter(keeps)


def narrow(choice: Any) -> None:
    """Let a list be narrower than its entries: the panel must fit beside FreeCAD's tree."""
    choice.setMinimumContentsLength(4)
    choice.setSizeAdjustPolicy(type(choice).AdjustToMinimumContentsLengthWithIcon)


def number_width(field: Any) -> int:
    """Least width of FreeCAD's field that shows a length of hundreds beside its own signs, px."""
    return int(field.fontMetrics().boundingRect(LONGEST_NUMBER).width()) + SIGNS


def close_panel(doc: App.Document) -> None:
    """Close the open task panel, and end the editing of an object of `doc` that it was for."""
    Gui.Control.closeDialog()
    gui = Gui.getDocument(doc.Name)
    if gui is not None and gui.getInEdit() is not None:
        gui.resetEdit()


def fits_any_width(label: Any) -> None:
    """Let a label of sentences be as narrow as its panel, whatever long word is in them."""
    label.setWordWrap(True)
    label.setSizePolicy(QtWidgets.QSizePolicy.Ignored, QtWidgets.QSizePolicy.Preferred)


def keep_height(label: Any, lines: int) -> None:
    """Let a label be no lower than so many lines, nor than it was before.

    What is below it in a panel then stays where it is while the sentences in it change.
    """
    least = lines * label.fontMetrics().lineSpacing()
    label.setAlignment(QtCore.Qt.AlignTop)
    label.setMinimumHeight(max(least, label.minimumHeight(), label.heightForWidth(label.width())))


def bring_into_sight(widget: Any) -> None:
    """Scroll what a widget of a panel is in, so that it is seen."""
    for area in Gui.getMainWindow().findChildren(QtWidgets.QScrollArea):
        if area.isAncestorOf(widget):
            area.ensureWidgetVisible(widget)


def allow_ok(is_allowed: bool) -> None:
    """Let the open task panel's OK be pressed, or not.

    To ask a panel for its parents would spoil Qt's wrappers of FreeCAD's own fields in it.
    """
    for box in Gui.getMainWindow().findChildren(QtWidgets.QDialogButtonBox):
        button = box.button(QtWidgets.QDialogButtonBox.Ok)
        if button is not None and box.isVisible():
            button.setEnabled(is_allowed)
