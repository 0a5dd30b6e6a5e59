# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of a scale of colours: where it begins and ends, and a button for what the values say."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.translation import translate

from .controls import push_button

_MOST = 1e12


class ColourRange(QtWidgets.QWidget):
    """Two numbers and a button.

    Args:
        changed: called with the ends that a user has set, or with (0, 0) for those of the values.
    """

    def __init__(self, changed: Callable[[float, float], None]) -> None:
        super().__init__()
        self._changed = changed
        self._low, self._high = (_number(name) for name in ("From", "To"))
        tip = translate("VolfrepColours", "From the smallest to the largest of the values")
        text = translate("VolfrepColours", "Automatic")
        button = push_button("Automatic", text, lambda: changed(0.0, 0.0), tip)
        line = QtWidgets.QHBoxLayout(self)
        line.setContentsMargins(0, 0, 0, 0)
        for widget in (
            QtWidgets.QLabel(translate("VolfrepColours", "from")), self._low,
            QtWidgets.QLabel(translate("VolfrepColours", "to")), self._high, button,
        ):  # fmt: skip
            line.addWidget(widget)
        for field in (self._low, self._high):
            field.valueChanged.connect(lambda _: self._tell())

    def show_ends(self, low: float, high: float) -> None:
        """Show a scale that was not set here."""
        for field, value in ((self._low, low), (self._high, high)):
            field.blockSignals(True)
            field.setSingleStep(max(abs(high - low) / 20.0, 1e-9))
            field.setValue(value)
            field.blockSignals(False)

    def _tell(self) -> None:
        self._changed(self._low.value(), self._high.value())


class _Number(QtWidgets.QDoubleSpinBox):
    """A number in as many digits as it needs."""

    def textFromValue(self, value: float) -> str:  # noqa: N802
        """As Qt asks for it."""
        return str(self.locale().toString(float(value), "g", 5))


def _number(name: str) -> Any:
    field = _Number()
    field.setObjectName(name)
    field.setDecimals(9)
    field.setRange(-_MOST, _MOST)
    field.setKeyboardTracking(False)
    field.setMinimumWidth(80)
    return field
