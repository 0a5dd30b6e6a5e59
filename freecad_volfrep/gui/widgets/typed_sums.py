# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lets FreeCAD's fields of quantities take sums with units, such as 2 mm + 1 mm.

FreeCAD's field reads quantities, of which 2 mm + 1 mm is none: when it is left, it goes back to
the last text that was one, without a word, and 2 mm stay. Here such a text is read as an
expression, and what is none either is said.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App

from freecad_volfrep.gui.qt import QtCore
from freecad_volfrep.translation import translate


class TypedSums(QtCore.QObject):
    """Watches one field.

    Args:
        obj: in which expressions are evaluated.
        field: FreeCAD's Gui::QuantitySpinBox.
        line: its editor.
        refused: called with a sentence where what was typed is no value.
    """

    def __init__(
        self, obj: App.DocumentObject, field: Any, line: Any, refused: Callable[[str], None]
    ) -> None:
        super().__init__(field)
        self._obj, self._field, self._line, self._refused = obj, field, line, refused
        field.installEventFilter(self)

    def eventFilter(self, watched: QtCore.QObject, event: QtCore.QEvent) -> bool:  # noqa: N802
        """Read the text before the field does, when it is left or Return is pressed."""
        kind = event.type()
        is_return = kind == QtCore.QEvent.KeyPress and event.key() in (
            QtCore.Qt.Key_Return,
            QtCore.Qt.Key_Enter,
        )
        if (is_return or kind == QtCore.QEvent.FocusOut) and not self._line.hasAcceptableInput():
            self._read(self._line.text())
        return False

    def _read(self, text: str) -> None:
        """Take over the value of an expression, or say that the text is none."""
        point, unit = QtCore.QLocale().decimalPoint(), self._field.property("unit")
        try:
            found = self._obj.evalExpression(text.replace(str(point), "."))
            value = float(found.getValueAs(unit) if hasattr(found, "getValueAs") else found)
        except Exception:  # whatever FreeCAD raises for a text
            value = None
        present = self._field.property("rawValue")
        self._field.setProperty("rawValue", present if value is None else value)
        if value is None:
            self._refused(
                translate(
                    "VolfrepTaskPanel",
                    "'{text}' is no value: type one such as 2 mm, a sum such as 2 mm + 1 mm, or = "
                    "for a formula.",
                ).format(text=text)
            )
