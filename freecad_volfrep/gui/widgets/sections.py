# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of a panel that fold away, remember it, and are worked by keys as well."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import FreeCADGui as Gui

from freecad_volfrep.gui.messages import WRONG
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.preferences import is_folded, keep_folded
from volfrep.design import parameters

from .panel_manners import fits_any_width

#: What the panel shows, by group: properties of the object. Those that do not apply are hidden.
GROUPS = {
    group: names
    for group in parameters.GROUPS
    if (
        names := tuple(
            row.property_name
            for row in parameters.PARAMETERS
            if row.group == group and row.in_panel and row.in_freecad
        )
    )
}
#: Groups that are folded away until they are wanted, and the formulas that are drawn.
FOLDED = ("Boundary", "Cell size", "Strut radius")
CURVES = ("LambdaFormula", "RadiusFormula")
#: Between rows, pixels; and from a label to its field, which in a dark style sheet has no room to
#: spare for "10.00 mm".
SPACE, LABEL_SPACE = 6, 3


class Section(QtWidgets.QWidget):
    """A title that opens and closes what is below it.

    Args:
        name: under which FreeCAD's parameters remember it; never translated.
        title: to be read.
        body: what folds away.
        is_usually_folded: before the user has said so.
    """

    def __init__(self, name: str, title: str, body: Any, is_usually_folded: bool = False) -> None:
        super().__init__()
        self._name, self._usually, self._body = name, is_usually_folded, body
        self.title = QtWidgets.QToolButton()
        self.title.setObjectName(f"Section {name}")
        self.title.setText(title)
        self.title.setAccessibleName(title)
        self.title.setCheckable(True)
        self.title.setAutoRaise(True)
        self.title.setFocusPolicy(QtCore.Qt.StrongFocus)
        self.title.setToolButtonStyle(QtCore.Qt.ToolButtonTextBesideIcon)
        self.title.setSizePolicy(QtWidgets.QSizePolicy.Expanding, QtWidgets.QSizePolicy.Fixed)
        self.title.toggled.connect(self._open)
        column = QtWidgets.QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self.title)
        column.addWidget(body)
        is_open = not is_folded(name, is_usually_folded)
        self.title.setChecked(is_open)
        self._open(is_open)

    def entitle(self, title: str) -> None:
        """Give it another title, to be read."""
        if self.title.text().replace("&", "") != title:
            self.title.setText(title)
            self.title.setAccessibleName(title)

    def _open(self, is_open: bool) -> None:
        self.title.setArrowType(QtCore.Qt.DownArrow if is_open else QtCore.Qt.RightArrow)
        self._body.setVisible(is_open)
        keep_folded(self._name, not is_open, self._usually)


class Rows(QtWidgets.QWidget):
    """Labels with their fields, of which some are hidden.

    Qt 5 keeps the space between hidden rows: here there is none, and labels are higher by it.
    """

    def __init__(self) -> None:
        super().__init__()
        self._form = QtWidgets.QFormLayout(self)
        self._form.setContentsMargins(6, 4, 6, 4)
        self._form.setVerticalSpacing(0)
        self._form.setHorizontalSpacing(LABEL_SPACE)
        self._form.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
        self._rows: list[tuple[str, tuple[Any, ...]]] = []
        #: Sentences below fields, by the names of their rows.
        self._wrong: dict[str, Any] = {}

    def add(self, name: str, *widgets: Any) -> None:
        """A row, or where there is one widget only a line of its own; more than one to a name."""
        *labels, field = widgets
        for label in labels:
            label.setMinimumHeight(field.sizeHint().height() + SPACE)
            label.setContentsMargins(0, 0, 0, SPACE)
        self._form.addRow(*widgets)
        self._rows.append((name, widgets))

    def tell(self, name: str, text: str) -> bool:
        """Put a sentence below the field that it is about; whether that field is seen."""
        for label in self._wrong.values():
            label.hide()
        rows = [widgets for one, widgets in self._rows if one == name and widgets[-1].isVisible()]
        if not rows:
            return False
        if name not in self._wrong:
            label = self._wrong[name] = QtWidgets.QLabel()
            label.setObjectName("Wrong")
            label.setStyleSheet(WRONG)
            fits_any_width(label)
            row = max(self._form.getWidgetPosition(widgets[-1])[0] for widgets in rows)
            self._form.insertRow(row + 1, label)
        self._wrong[name].setText(text)
        self._wrong[name].show()
        return True

    def show_only(self, names: Iterable[str]) -> None:
        """Show the rows of these names, and hide the others."""
        shown = set(names)
        for name, widgets in self._rows:
            for widget in widgets:
                widget.setVisible(name in shown)


def give_accelerators(buttons: Iterable[Any]) -> None:
    """Underline a letter of each button that Alt works it by, where there is one left.

    The letters of FreeCAD's menus and of the panel's OK and Cancel stay theirs.
    """
    taken = {"o", "c"}
    for action in Gui.getMainWindow().menuBar().actions():
        _, _, after = action.text().replace("&&", "").partition("&")
        taken.add(after[:1].lower())
    for button in buttons:
        text = button.text().replace("&", "")
        place = next((k for k, c in enumerate(text.lower()) if c.isalpha() and c not in taken), -1)
        if place >= 0:
            taken.add(text[place].lower())
            button.setText(f"{text[:place]}&{text[place:]}")
