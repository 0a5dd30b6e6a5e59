# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields for the properties of an infill, by their types, as its task panel shows them."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.properties.quantities import (
    is_driven,
    number_of,
    set_expression,
    set_value,
)
from freecad_volfrep.gui.cells.cell_library import cell_files
from freecad_volfrep.gui.qt import QtCore, QtGui, QtWidgets
from freecad_volfrep.gui.widgets.file_field import FileField
from freecad_volfrep.gui.widgets.panel_manners import number_width
from freecad_volfrep.gui.widgets.typed_sums import TypedSums
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, spaced, translate
from volfrep.design.field_files import TABLE_SUFFIXES, VTK_SUFFIXES
from volfrep.design.target import read_direction

from .curve_editor import CurveEditor

#: What the files of a field hold.
POINTS = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Points and values")
MATERIAL = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Material")
#: A direction of the cell.
OF_CELL = "StiffnessDirection"
#: What the list of materials holds beside their names.
ENTRIES = marked("App::Property", "None", "Custom", "Of the solid")
#: What a panel calls properties whose names, which documents keep, say it less well.
LABELS = {
    "PrintMaterial": MATERIAL,
    "PrintProcess": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Process"),
    "DrainPoints": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Drain holes"),
    "DrainFaces": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Drain holes in faces"),
    "ShellThickness": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Skin thickness"),
    "Activation": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Cells kept"),
    "TargetDensity": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Target relative density"),
    "WallKind": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Sheet or skeleton"),
    "WallThickness": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Sheet thickness"),
    "NetworkFaces": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Faces to follow"),
    "NetworkFile": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "File"),
    "NetworkThickness": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Height of layers"),
    "NetworkLayers": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Layers"),
    "NetworkReversed": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "On the other side"),
    "NetworkPoints": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Points"),
    "NetworkSeed": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Seed"),
    "NetworkRelax": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Evened out, times"),
    "NetworkOnWall": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Along the skin"),
    "NetworkShortest": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Shortest strut"),
}
#: The same where another parameter than the strut radius says how thick the lattice is.
LABELS_OF = {
    "wall_thickness": {
        "RadiusDrivenBy": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Driven by"),
        "RadiusGrading": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness grading"),
        "RadiusProfile": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness profile"),
        "RadiusStart": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness at the start"),
        "RadiusEnd": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness at the end"),
        "RadiusFormula": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness formula"),
        "RadiusCurve": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness curve"),
        "RadiusField": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness field"),
        "RadiusColumn": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Column of the field"),
        "RadiusReach": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness reach"),
    },
}
#: And what it says, where that is not the radius.
THICKNESS_OF = {"wall_thickness": QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Thickness")}
#: Whole numbers whose 0 leaves it to us.
AUTOMATIC = ("NetworkPoints", "NetworkLayers")
#: Fields of plain numbers with a unit. FreeCAD's own take no "M" of MPa, and 0.20 has no masses.
UNITS = {"TargetDensity": "%", "TargetMass": "g", "TargetStiffness": "MPa"}
#: And what they show of a property's 1.
SHOWN = {"TargetDensity": 100.0}
_LARGEST, _MOST = 1e9, 10**9


class PropertyFields:
    """Fields that hold the properties of an infill and set them when the user changes them.

    Args:
        obj: the infill.
        changed: called with the name of a property that the user has changed.
        refused: called with a property's name and a sentence where what was typed is no value.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        changed: Callable[[str], None],
        refused: Callable[[str, str], None],
    ) -> None:
        self._obj, self._changed, self._refused = obj, changed, refused
        self._bindings: list[Any] = []
        self._sums: list[TypedSums] = []
        #: What draws a formula, by the name of its property.
        self.curves: dict[str, CurveEditor] = {}

    def set_value(self, name: str, value: Any) -> None:
        """Set a property that the user has chosen elsewhere, and tell of it."""
        self._setter(name)(value)

    def field(self, name: str) -> Any:
        """A widget for a property, by the property's type."""
        kind = self._obj.getTypeIdOfProperty(name)
        if kind == "App::PropertyEnumeration":
            choice = QtWidgets.QComboBox()
            choice.setMinimumContentsLength(4)
            choice.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
            for value in self._obj.getEnumerationsOfProperty(name):
                choice.addItem(said_property(value), value)
            choice.setCurrentIndex(choice.findData(getattr(self._obj, name)))
            choice.currentIndexChanged.connect(lambda row: self._setter(name)(choice.itemData(row)))
            return choice
        if kind == "App::PropertyBool":
            box = QtWidgets.QCheckBox()
            box.setChecked(getattr(self._obj, name))
            box.toggled.connect(self._setter(name))
            return box
        if kind == "App::PropertyInteger":
            count = QtWidgets.QSpinBox()
            count.setRange(0, _MOST)
            if name in AUTOMATIC:
                count.setSpecialValueText(translate("VolfrepTaskPanel", "automatic"))
            count.setValue(getattr(self._obj, name))
            count.valueChanged.connect(self._setter(name))
            return count
        if kind == "App::PropertyString":
            line = QtWidgets.QLineEdit(getattr(self._obj, name))
            line.editingFinished.connect(lambda: self._type_text(name, line.text()))
            return line
        if kind == "App::PropertyFile":
            return FileField(getattr(self._obj, name), _files(name), self._setter(name))
        if name in UNITS:
            return self._number_field(name)
        if kind == "App::PropertyVector":
            way = QtWidgets.QLineEdit(direction_text(name, getattr(self._obj, name)))
            way.editingFinished.connect(lambda: self._set_direction(name, way.text()))
            return way
        spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
        spin.setProperty("unit", "mm" if kind == "App::PropertyLength" else "")
        spin.setProperty("minimum", 0.0)
        spin.setMinimumWidth(number_width(spin))
        present = getattr(self._obj, name)
        spin.setProperty("rawValue", getattr(present, "Value", present))
        line = spin.findChild(QtWidgets.QLineEdit)
        # Its own signal has a type that Python's Qt does not know.
        line.textChanged.connect(lambda _: self._setter(name)(spin.property("rawValue")))
        self._sums.append(TypedSums(self._obj, spin, line, partial(self._refused, name)))
        binding = Gui.ExpressionBinding(spin)
        binding.bind(self._obj, name)
        self._bindings.append(binding)
        return spin

    def _number_field(self, name: str) -> Any:
        """A number of the unit that `quantities` have for the property."""
        field, shown = PlainNumber(), SHOWN.get(name, 1.0)
        field.setRange(0.0, _LARGEST)
        field.setDecimals(3)
        field.setStepType(QtWidgets.QAbstractSpinBox.AdaptiveDecimalStepType)
        field.setSuffix(f" {UNITS[name]}")
        field.setValue(shown * number_of(self._obj, name))

        def changed(value: float) -> None:
            if not is_driven(self._obj, name) and value != shown * number_of(self._obj, name):
                set_value(self._obj, name, value / shown)
                self._changed(name)

        def finished() -> None:
            formula = field.take_formula()
            if formula is not None:
                try:
                    set_expression(self._obj, name, formula)
                except Exception as error:  # whatever FreeCAD raises for an expression
                    self._refused(name, f"{formula}: {error}")
                else:
                    self._changed(name)
            if is_driven(self._obj, name):
                field.setValue(shown * number_of(self._obj, name))

        field.valueChanged.connect(changed)
        field.editingFinished.connect(finished)
        return field

    def curve_of(self, name: str, field: Any) -> CurveEditor:
        """A drawing of a formula beside its field."""

        def drawn(formula: str) -> None:
            field.setText(formula)
            self._setter(name)(formula)

        title = translate("VolfrepCurve", "Curve: {name}").format(name=label_of(name))
        self.curves[name] = CurveEditor(getattr(self._obj, name), title, drawn)
        return self.curves[name]

    def show(self, name: str, field: Any) -> None:
        """Show a property's value in its field that was not set there."""
        value = getattr(self._obj, name)
        if isinstance(field, QtWidgets.QComboBox):
            field.setCurrentIndex(field.findData(value))
        elif isinstance(field, QtWidgets.QCheckBox):
            field.setChecked(value)
        elif isinstance(field, FileField):
            field.show_path(value)
        elif isinstance(field, QtWidgets.QLineEdit):
            is_way = self._obj.getTypeIdOfProperty(name) == "App::PropertyVector"
            field.setText(direction_text(name, value) if is_way else value)
        else:
            is_plain = name in UNITS or isinstance(field, QtWidgets.QSpinBox)
            value = SHOWN.get(name, 1.0) * number_of(self._obj, name)
            field.setProperty("value" if is_plain else "rawValue", value)
        if name in self.curves:
            self.curves[name].show_formula(value)

    def _setter(self, name: str) -> Callable[[Any], None]:
        """Sets a property that the user has changed, and tells of it."""

        def set_value(value: Any) -> None:
            present = getattr(self._obj, name)
            if is_driven(self._obj, name):
                self._changed(name)
                return
            if is_read_only(self._obj, name):
                return
            if value == getattr(present, "Value", present):
                return
            setattr(self._obj, name, value)
            self._changed(name)

        return set_value

    def _type_text(self, name: str, text: str) -> None:
        """Take a text over, and draw it where there is a drawing of it."""
        self._setter(name)(text)
        if name in self.curves:
            self.curves[name].show_formula(text)

    def _set_direction(self, name: str, text: str) -> None:
        """Take a direction over; what is none is said, and the last one shown again."""
        try:
            way = App.Vector(*read_direction(text))
            if not way.Length:
                raise ValueError
            self._setter(name)(way)
        except ValueError:
            self._refused(
                name,
                translate(
                    "VolfrepTaskPanel",
                    "'{text}' is no direction: write 100, 110, 111 or three numbers such as 1,2,0.",
                ).format(text=text),
            )


class PlainNumber(QtWidgets.QDoubleSpinBox):
    """A number without zeros at its end, which would push the unit out of a narrow panel.

    FreeCAD's expressions cannot be bound to it, so one is typed behind a "=", as its own boxes
    begin one; "=" alone ends it. `take_formula` gives it when the editing is finished.
    """

    def __init__(self) -> None:
        super().__init__()
        self._formula: str | None = None
        self.findChild(QtWidgets.QLineEdit).textEdited.connect(self._typed)

    def take_formula(self) -> str | None:
        """What was typed behind a "=" since it was last asked; None: a number, or nothing."""
        formula, self._formula = self._formula, None
        return formula

    def _typed(self, text: str) -> None:
        plain = text.strip()
        self._formula = self._without_unit(plain[1:]) if plain.startswith("=") else None

    def _without_unit(self, text: str) -> str:
        return text.removesuffix(self.suffix()).strip()

    def validate(self, text: str, place: int) -> Any:
        """As Qt asks for it."""
        if text.strip().startswith("="):
            return QtGui.QValidator.Acceptable, text, place
        return super().validate(text, place)

    def valueFromText(self, text: str) -> float:  # noqa: N802
        """As Qt asks for it."""
        return self.value() if text.strip().startswith("=") else super().valueFromText(text)

    def textFromValue(self, value: float) -> str:  # noqa: N802
        """As Qt asks for it."""
        locale = self.locale()
        locale.setNumberOptions(QtCore.QLocale.OmitGroupSeparator)
        return str(locale.toString(float(value), "g", 7))


def _files(name: str) -> str:
    """The kinds of files for a property, as Qt's file dialog takes them."""
    if name == "MaterialFile":
        return f"{translate('VolfrepTaskPanel', MATERIAL)} (*.toml *.json)"
    if name == "CellFile":
        return cell_files()
    suffixes = " ".join(f"*{suffix}" for suffix in TABLE_SUFFIXES + VTK_SUFFIXES)
    return f"{translate('VolfrepTaskPanel', POINTS)} ({suffixes})"


def direction_text(name: str, way: App.Vector) -> str:
    """A direction as the panel's field shows and takes it; of a cell as crystals have them."""
    numbers = tuple(way)
    for short in ("100", "110", "111"):
        if name == OF_CELL and numbers == read_direction(short):
            return short
    return ", ".join(f"{number:g}" for number in numbers)


def is_read_only(obj: App.DocumentObject, name: str) -> bool:
    """Whether the property editor shows a property that something else decides."""
    return "ReadOnly" in obj.getEditorMode(name)


def label_of(name: str, measure: str = "strut_radius") -> str:
    """A property's name in the user's words; in English only its first letter is a capital.

    Args:
        name: of the property.
        measure: the parameter that says how thick the lattice is.
    """
    own = {**LABELS, **LABELS_OF.get(measure, {})}.get(name)
    if own is not None:
        return str(translate("VolfrepTaskPanel", own))
    text = spaced(name)
    said = said_property(text)
    return text.capitalize() if said == text else said


def said_property(text: str) -> str:
    """A property's name, description or value, in the context that FreeCAD has for them."""
    return str(translate("App::Property", text))
