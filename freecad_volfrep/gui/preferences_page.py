# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of VOLFREP in FreeCAD's preferences; keys, words and defaults are in `preferences`.

They are classes and no .ui files: FreeCAD's own widgets would store what is typed without the
limits of `preferences`, and a second list of keys and defaults.
"""

from __future__ import annotations

from typing import Any

import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep import preferences as prefs
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

from .qt import QtCore, QtGui, QtWidgets

#: Of FreeCAD's list of pages; its icon is preferences-volfrep.svg.
PAGE_GROUP = "VOLFREP"
_CONTEXT = "VolfrepPreferences"


class Page:
    """One page: a form of rows in boxes. FreeCAD makes it anew for every opening of the window."""

    TITLE: str
    BOXES: tuple[tuple[str, tuple[prefs.Preference, ...]], ...]

    def __init__(self, parent: Any = None) -> None:
        self.form = QtWidgets.QWidget()
        self.form.setObjectName(type(self).__name__)
        self.form.setWindowTitle(translate(_CONTEXT, self.TITLE))
        self._widgets: dict[prefs.Preference, Any] = {}
        column = QtWidgets.QVBoxLayout(self.form)
        for title, rows in self.BOXES:
            box = QtWidgets.QGroupBox(translate(_CONTEXT, title))
            form = QtWidgets.QFormLayout(box)
            for row in rows:
                label, widget = QtWidgets.QLabel(translate(_CONTEXT, row.label)), _widget(row)
                for part in (label, widget):
                    part.setToolTip(translate(_CONTEXT, row.tip))
                widget.setObjectName(row.key)
                form.addRow(label, widget)
                self._widgets[row] = widget
            column.addWidget(box)
        defaults = QtWidgets.QPushButton(translate(_CONTEXT, "Defaults"))
        defaults.setObjectName("Defaults")
        defaults.setToolTip(translate(_CONTEXT, "Show the values that VOLFREP comes with"))
        defaults.clicked.connect(self.show_defaults)
        column.addWidget(defaults, 0, QtCore.Qt.AlignLeft)
        column.addStretch()

    def loadSettings(self) -> None:  # noqa: N802
        """Show what is stored."""
        for preference, widget in self._widgets.items():
            _show(widget, prefs.read(preference))

    def saveSettings(self) -> None:  # noqa: N802
        """Store what is shown."""
        for preference, widget in self._widgets.items():
            prefs.write(preference, _shown(widget))

    def show_defaults(self) -> None:
        """Show the defaults; nothing is stored before OK or Apply."""
        for preference, widget in self._widgets.items():
            _show(widget, preference.default)


class NewInfillPage(Page):
    """What a new infill starts with."""

    TITLE = QT_TRANSLATE_NOOP("VolfrepPreferences", "New infill")
    BOXES = (
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Lattice"),
            (prefs.CELL_TYPE, prefs.CELL_SIZE, prefs.STRUT_SHARE, prefs.SKIN),
        ),
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Mesh"),
            (prefs.RESOLUTION, prefs.DEVIATION, prefs.AUTO_UPDATE),
        ),
        (QT_TRANSLATE_NOOP("VolfrepPreferences", "Material"), (prefs.DENSITY, prefs.PRICE)),
    )


class DisplayPage(Page):
    """What is shown, how much, and on how many cores."""

    TITLE = QT_TRANSLATE_NOOP("VolfrepPreferences", "Display and limits")
    BOXES = (
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Limits"),
            (prefs.LARGEST_AUTOMATIC, prefs.THREADS),
        ),
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Display"),
            (
                prefs.LARGEST_SHOWN, prefs.MOST_PRISMS, prefs.TRANSPARENCY, prefs.STRUT_COLOUR,
                prefs.SKIN_COLOUR, prefs.CUT_COLOUR, prefs.OVERHANG_COLOUR,
            ),
        ),
    )  # fmt: skip


#: In the order of FreeCAD's list.
PAGES = (NewInfillPage, DisplayPage)


def register_pages() -> None:
    """Make the pages and the icon of their group known to FreeCAD."""
    Gui.addIconPath(str(ICONS))
    for page in PAGES:
        Gui.addPreferencePage(page, PAGE_GROUP)


def _widget(preference: prefs.Preference) -> Any:
    """An editor of the preference's type."""
    if isinstance(preference, prefs.Colour):
        return Gui.UiLoader().createWidget("Gui::ColorButton")
    if preference.choices is not None:
        choice = QtWidgets.QComboBox()
        choice.addItems(preference.choices())
        return choice
    if isinstance(preference.default, bool):
        return QtWidgets.QCheckBox()
    if isinstance(preference.default, int):
        number = QtWidgets.QSpinBox()
    else:
        number = QtWidgets.QDoubleSpinBox()
        number.setDecimals(len(f"{preference.low:f}".rstrip("0").partition(".")[2]))
    number.setRange(0 if preference.automatic else preference.low, preference.high)
    number.setSuffix(preference.unit)
    number.setGroupSeparatorShown(True)
    number.setStepType(QtWidgets.QAbstractSpinBox.AdaptiveDecimalStepType)
    if preference.automatic:
        number.setSpecialValueText(translate(_CONTEXT, "automatic"))
    return number


def _show(widget: Any, value: Any) -> None:
    if isinstance(widget, QtWidgets.QComboBox):
        widget.setCurrentText(value)
    elif isinstance(widget, QtWidgets.QCheckBox):
        widget.setChecked(value)
    elif isinstance(widget, QtWidgets.QAbstractSpinBox):
        widget.setValue(value)
    else:
        widget.setProperty("color", QtGui.QColor.fromRgb(*_channels(value)))


def _shown(widget: Any) -> Any:
    if isinstance(widget, QtWidgets.QComboBox):
        return widget.currentText()
    if isinstance(widget, QtWidgets.QCheckBox):
        return widget.isChecked()
    if isinstance(widget, QtWidgets.QAbstractSpinBox):
        return widget.value()
    chosen = widget.property("color")
    return chosen.red() << 24 | chosen.green() << 16 | chosen.blue() << 8 | 0xFF


def _channels(stored: int) -> list[int]:
    return [(stored >> shift) & 0xFF for shift in (24, 16, 8)]
