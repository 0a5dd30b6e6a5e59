# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pages of VOLFREP in FreeCAD's preferences; keys and defaults are in `preferences`.

They are classes and no .ui files: FreeCAD's own widgets would store what is typed without the
limits of `preferences`, and a second list of keys and defaults.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import FreeCADGui as Gui

from freecad_volfrep import ICONS
from freecad_volfrep import preferences as prefs
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

from .qt import QtCore, QtGui, QtWidgets

#: Of FreeCAD's list of pages; its icon is preferences-volfrep.svg.
PAGE_GROUP = "VOLFREP"
_CONTEXT = "VolfrepPreferences"


@dataclass(frozen=True)
class Row:
    """A preference and the words for it: a label, a tip, and the unit behind a number."""

    preference: prefs.Preference
    label: str
    tip: str
    unit: str = ""


class Page:
    """One page: a form of rows in boxes. FreeCAD makes it anew for every opening of the window."""

    TITLE: str
    BOXES: tuple[tuple[str, tuple[Row, ...]], ...]

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
                widget.setObjectName(row.preference.key)
                form.addRow(label, widget)
                self._widgets[row.preference] = widget
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
            (
                Row(
                    prefs.CELL_TYPE,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Cell type"),
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "The unit cell of a new infill"),
                ),
                Row(
                    prefs.CELL_SIZE,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Cell size"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Edge length L of a cell; automatic: about four cells across the "
                        "thinnest side of the part",
                    ),
                    " mm",
                ),
                Row(
                    prefs.STRUT_SHARE,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Strut radius"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences", "Radius of the struts as a share of the cell size L"
                    ),
                    " L",
                ),
                Row(
                    prefs.SKIN,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Skin thickness"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Thickness of the closed skin; automatic: a fifth of the cell size",
                    ),
                    " mm",
                ),
            ),
        ),
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Mesh"),
            (
                Row(
                    prefs.RESOLUTION,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Resolution"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Facets along the edge of a cell; automatic: chosen by the deviation",
                    ),
                ),
                Row(
                    prefs.DEVIATION,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Deviation"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Distance between a facet and the exact strut, where the "
                        "resolution is automatic; automatic: by the strut radius",
                    ),
                    " mm",
                ),
                Row(
                    prefs.AUTO_UPDATE,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Update at every change"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "The property AutoUpdate of a new infill; without it, use Update Lattice "
                        "Infill",
                    ),
                ),
            ),
        ),
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Material"),
            (
                Row(
                    prefs.DENSITY,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Density"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences", "Density of the material, from which the mass comes"
                    ),
                    " g/cm³",
                ),
                Row(
                    prefs.PRICE,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Price of a kilogram"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Of the material, in your currency, from which the panel tells the cost; "
                        "0: no cost is told",
                    ),
                ),
            ),
        ),
    )


class DisplayPage(Page):
    """What is shown, how much, and on how many cores."""

    TITLE = QT_TRANSLATE_NOOP("VolfrepPreferences", "Display and limits")
    BOXES = (
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Limits"),
            (
                Row(
                    prefs.LARGEST_AUTOMATIC,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Triangles to wait at"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "A change that comes to more triangles waits for Update Lattice Infill",
                    ),
                ),
                Row(
                    prefs.THREADS,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Threads"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "For searching nearest points, measuring meshes and writing STL files; "
                        "automatic: one on each core",
                    ),
                ),
            ),
        ),
        (
            QT_TRANSLATE_NOOP("VolfrepPreferences", "Display"),
            (
                Row(
                    prefs.LARGEST_SHOWN,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Triangles to show"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "A mesh of more triangles is shown by a coarse likeness; files stay full",
                    ),
                ),
                Row(
                    prefs.MOST_PRISMS,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Struts to show as solids"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "More struts than these are drawn as lines, in the preview and in the "
                        "display mode Simplified",
                    ),
                ),
                Row(
                    prefs.TRANSPARENCY,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Transparency"),
                    QT_TRANSLATE_NOOP(
                        "VolfrepPreferences",
                        "Of a new infill, so that the lattice is seen through the skin",
                    ),
                    " %",
                ),
                Row(
                    prefs.STRUT_COLOUR,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Colour of the lattice"),
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Of a new infill"),
                ),
                Row(
                    prefs.SKIN_COLOUR,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Colour of the skin"),
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Of a new infill"),
                ),
                Row(
                    prefs.CUT_COLOUR,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Colour of cut faces"),
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "In Section View"),
                ),
                Row(
                    prefs.OVERHANG_COLOUR,
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Colour of overhangs"),
                    QT_TRANSLATE_NOOP("VolfrepPreferences", "Of a new print check"),
                ),
            ),
        ),
    )


#: In the order of FreeCAD's list.
PAGES = (NewInfillPage, DisplayPage)


def register_pages() -> None:
    """Make the pages and the icon of their group known to FreeCAD."""
    Gui.addIconPath(str(ICONS))
    for page in PAGES:
        Gui.addPreferencePage(page, PAGE_GROUP)


def _widget(row: Row) -> Any:
    """An editor of the preference's type."""
    preference = row.preference
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
    return _bounded(number, preference, row.unit)


def _bounded(number: Any, preference: prefs.Preference, unit: str) -> Any:
    number.setRange(0 if preference.automatic else preference.low, preference.high)
    number.setSuffix(unit)
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
