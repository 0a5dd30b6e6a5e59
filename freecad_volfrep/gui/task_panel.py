# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a lattice infill: its values, a preview while they change, OK and Cancel."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.live_preview import TARGETS, LivePreview, Shown
from freecad_volfrep.features.quantities import number_of, set_value
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, spaced, translate
from volfrep.design import parameters
from volfrep.design.cells import LIBRARY, load_cell
from volfrep.design.field_files import TABLE_SUFFIXES, VTK_SUFFIXES
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.design.parameters.wall_rows import WALLS
from volfrep.design.target import read_direction
from volfrep.util.errors import VolfrepError

from .cell_library import cell_files
from .cell_picture import cell_icon, wall_icon
from .file_field import FileField
from .messages import WRONG
from .preview_only import end_preview
from .preview_view import PreviewView
from .qt import OK_CANCEL, QtCore, QtGui, QtWidgets
from .section_view import close_section, open_section

#: The preview waits until no value has changed for so long, ms.
SETTLED = 120
PICTURE = 48
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
#: The switches of what is shown in the view.
PREVIEW = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Preview")
CELLS = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Cells")
#: What the files of a field hold.
POINTS = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Points and values")
MATERIAL = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Material")
#: What the list of materials holds beside their names.
ENTRIES = marked("App::Property", "None", "Custom", "Of the solid")
#: Above this group are the figures: what is used most is seen without scrolling.
SECOND = "Boundary"
#: Least width of a field, px: the panel must fit beside FreeCAD's tree.
FIELD = 82
_HIDDEN, _READ_ONLY = "Hidden", "ReadOnly"
#: Fields of plain numbers with a unit. FreeCAD's own take no "M" of MPa, and 0.20 has no masses.
UNITS = {"TargetMass": "g", "TargetStiffness": "MPa"}
_LARGEST = 1e9


class TaskPanel:
    """Edits an infill inside one transaction, which Cancel takes back as a whole.

    Args:
        obj: the infill.
        transaction: name of the undo step; opened by whoever made the object, or here.
    """

    def __init__(self, obj: App.DocumentObject, transaction: str | None = None) -> None:
        end_preview(obj)  # the panel shows one of its own
        was_cut = close_section(obj)
        self._obj, self._doc = obj, obj.Document
        if transaction is not None:
            self._doc.openTransaction(transaction)
        self._live = LivePreview(obj)
        self._view = PreviewView(obj)
        self._was_visible = {
            shown: shown.ViewObject.Visibility for shown in (obj, obj.Base) if shown is not None
        }
        for shown in self._was_visible:
            shown.ViewObject.Visibility = False
        self._bindings: list[Any] = []
        self._rows: dict[str, tuple[Any, Any]] = {}
        self._boxes: list[tuple[Any, tuple[str, ...]]] = []
        self._shown: Shown | None = None
        self.form = self._build()
        self._timer = QtCore.QTimer(self.form)
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self.refresh)
        self._show_rows()
        self.refresh()
        if was_cut:
            open_section(obj, self._view)

    def getStandardButtons(self) -> int:  # noqa: N802
        """OK and Cancel."""
        return OK_CANCEL

    def accept(self) -> bool:
        """Compute and close; stays open where that fails or is cancelled."""
        if not self.compute():
            return False
        self._doc.commitTransaction()
        self._close()
        self._obj.ViewObject.Visibility = True
        if self._obj.Base is not None:
            self._obj.Base.ViewObject.Visibility = False
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(self._obj)
        return True

    def reject(self) -> bool:
        """Close and take back every change; an infill that was made for this panel is gone."""
        for shown, visible in self._was_visible.items():
            shown.ViewObject.Visibility = visible
        self._doc.abortTransaction()  # to end the editing would commit it
        self._close()
        self._doc.recompute()
        return True

    def compute(self) -> bool:
        """Make the mesh of the present values; says in the panel what is wrong with them."""
        self._timer.stop()
        if not self._obj.Proxy.update(self._obj):
            self._say(self._obj.Status, wrong=True)
            return False
        self._say(self._obj.Status)
        self._tell_radius(self._obj.StrutRadius.Value)
        return True

    def refresh(self) -> None:
        """Bring the preview and the figures up to the present values."""
        try:
            shown = self._live.show()
        except VolfrepError as error:
            self._shown = None
            self._view.show_solid_only()
            self._say(str(error), wrong=True)
            return
        self._shown = shown
        self._tell_radius(shown.preview.spec.strut_radius)
        if self._preview.isChecked():
            self._view.show(shown, self._grid.isChecked())
        else:
            self._view.clear()
        self._say(shown.text)

    def _build(self) -> Any:
        form = QtWidgets.QWidget()
        form.setObjectName("VolfrepTaskPanel")
        form.setWindowTitle(self._obj.Label)
        column = QtWidgets.QVBoxLayout(form)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self._cell_picker())
        for title, names in GROUPS.items():
            if title == SECOND:
                self._add_figures(column)
            box = QtWidgets.QGroupBox(_property(title))
            rows = QtWidgets.QFormLayout(box)
            rows.setContentsMargins(6, 4, 6, 4)
            rows.setRowWrapPolicy(QtWidgets.QFormLayout.WrapLongRows)
            for name in names:
                label, widget = QtWidgets.QLabel(_label(name)), self._editor(name)
                widget.setObjectName(name)
                widget.setMinimumWidth(FIELD)
                widget.setToolTip(_property(self._obj.getDocumentationOfProperty(name)))
                rows.addRow(label, widget)
                self._rows[name] = label, widget
            column.addWidget(box)
            self._boxes.append((box, names))
        return form

    def _add_figures(self, column: Any) -> None:
        self._figures = QtWidgets.QLabel()
        self._figures.setObjectName("Figures")
        self._figures.setWordWrap(True)
        column.addWidget(self._figures)
        line = QtWidgets.QHBoxLayout()
        self._preview = self._check_box(PREVIEW, True, line)
        self._grid = self._check_box(CELLS, False, line)
        button = QtWidgets.QPushButton(translate("VolfrepTaskPanel", "Compute"))
        button.setObjectName("Compute")
        button.setToolTip(
            translate(
                "VolfrepTaskPanel", "Make the mesh of these values now and stay in this panel"
            )
        )
        button.clicked.connect(self._compute_and_show)
        section = QtWidgets.QPushButton(translate("VolfrepTaskPanel", "Section"))
        section.setObjectName("Section")
        section.setToolTip(
            translate(
                "VolfrepTaskPanel",
                "Cut the part open on the screen, along a plane that can be moved; once more "
                "shows it whole",
            )
        )
        section.clicked.connect(self._toggle_section)
        column.addLayout(line)
        line = QtWidgets.QHBoxLayout()
        line.addWidget(section)
        line.addWidget(button)
        column.addLayout(line)

    def _check_box(self, text: str, checked: bool, line: Any) -> Any:
        box = QtWidgets.QCheckBox(translate("VolfrepTaskPanel", text))
        box.setObjectName(text)
        box.setChecked(checked)
        box.toggled.connect(lambda _: self._timer.start(0))
        line.addWidget(box)
        return box

    def _compute_and_show(self) -> None:
        self._obj.ViewObject.Visibility = self.compute()
        self._view.clear()

    def _toggle_section(self) -> None:
        if not close_section(self._obj):
            open_section(self._obj, self._view)

    def _cell_picker(self) -> Any:
        picker = QtWidgets.QListWidget()
        picker.setObjectName("CellType")
        picker.setViewMode(QtWidgets.QListView.IconMode)
        picker.setIconSize(QtCore.QSize(PICTURE, PICTURE))
        picker.setMovement(QtWidgets.QListView.Static)
        picker.setResizeMode(QtWidgets.QListView.Adjust)
        picker.setFixedHeight(2 * PICTURE + 60)
        picker.setMinimumWidth(4 * PICTURE)
        for name in self._obj.getEnumerationsOfProperty("CellType"):
            item = QtWidgets.QListWidgetItem(name, picker)
            if name == CUSTOM_CELL:
                self._own = item
                self._draw_own_cell()
            else:
                item.setIcon(_icon(name))
            if name == self._obj.CellType:
                picker.setCurrentItem(item)
        picker.currentTextChanged.connect(self._setter("CellType"))
        return picker

    def _draw_own_cell(self) -> None:
        """Show the cell of the object's file, or an empty cube; the figures say what is wrong."""
        try:
            cell = load_cell(self._obj.CellFile) if self._obj.CellFile else None
        except VolfrepError:
            cell = None
        self._own.setIcon(cell_icon(cell, PICTURE))

    def _editor(self, name: str) -> Any:
        """A widget for a property, by the property's type."""
        kind = self._obj.getTypeIdOfProperty(name)
        if kind == "App::PropertyEnumeration":
            choice = QtWidgets.QComboBox()
            choice.setMinimumContentsLength(4)
            choice.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
            for value in self._obj.getEnumerationsOfProperty(name):
                choice.addItem(_property(value), value)
            choice.setCurrentIndex(choice.findData(getattr(self._obj, name)))
            choice.currentIndexChanged.connect(lambda row: self._setter(name)(choice.itemData(row)))
            return choice
        if kind == "App::PropertyBool":
            box = QtWidgets.QCheckBox()
            box.setChecked(getattr(self._obj, name))
            box.toggled.connect(self._setter(name))
            return box
        if kind == "App::PropertyString":
            line = QtWidgets.QLineEdit(getattr(self._obj, name))
            line.editingFinished.connect(lambda: self._setter(name)(line.text()))
            return line
        if kind == "App::PropertyFile":
            return FileField(getattr(self._obj, name), _files(name), self._setter(name))
        if name in UNITS:
            return self._number_field(name)
        if kind == "App::PropertyVector":
            way = QtWidgets.QLineEdit(_direction_text(getattr(self._obj, name)))
            way.editingFinished.connect(lambda: self._set_direction(name, way.text()))
            return way
        spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
        spin.setProperty("unit", "mm" if kind == "App::PropertyLength" else "")
        spin.setProperty("minimum", 0.0)
        present = getattr(self._obj, name)
        spin.setProperty("rawValue", getattr(present, "Value", present))
        # Its own signal has a type that Python's Qt does not know.
        spin.findChild(QtWidgets.QLineEdit).textChanged.connect(
            lambda _: self._setter(name)(spin.property("rawValue"))
        )
        binding = Gui.ExpressionBinding(spin)
        binding.bind(self._obj, name)
        self._bindings.append(binding)
        return spin

    def _number_field(self, name: str) -> Any:
        """A number of the unit that `quantities` have for the property."""
        field = _PlainNumber()
        field.setRange(0.0, _LARGEST)
        field.setDecimals(3)
        field.setStepType(QtWidgets.QAbstractSpinBox.AdaptiveDecimalStepType)
        field.setSuffix(f" {UNITS[name]}")
        field.setValue(number_of(self._obj, name))
        field.setEnabled(not self._is_driven(name))

        def changed(value: float) -> None:
            if not self._is_driven(name) and value != number_of(self._obj, name):
                set_value(self._obj, name, value)
                self._timer.start(SETTLED)

        field.valueChanged.connect(changed)
        return field

    def _is_driven(self, name: str) -> bool:
        """Whether an expression says what the property is."""
        return any(path.strip(".") == name for path, _ in self._obj.ExpressionEngine)

    def _setter(self, name: str) -> Callable[[Any], None]:
        """Sets a property that the user has changed, and asks for a new preview."""

        def set_value(value: Any) -> None:
            present = getattr(self._obj, name)
            if self._is_driven(name) or _READ_ONLY in self._obj.getEditorMode(name):
                return
            if value == getattr(present, "Value", present):
                return
            setattr(self._obj, name, value)
            if name == "RadiusDrivenBy":
                self._begin_target(value)
            if name == "CellFile":
                self._draw_own_cell()
            self._show_rows()
            self._timer.start(SETTLED)

        return set_value

    def _show_rows(self) -> None:
        """Hide what does not apply, as the property editor does."""
        for name, row in self._rows.items():
            for widget in row:
                widget.setVisible(_HIDDEN not in self._obj.getEditorMode(name))
        for box, names in self._boxes:
            box.setVisible(any(_HIDDEN not in self._obj.getEditorMode(name) for name in names))
        self._rows["StrutRadius"][1].setEnabled(
            _READ_ONLY not in self._obj.getEditorMode("StrutRadius")
        )

    def _begin_target(self, driver: str) -> None:
        """Begin with what the lattice that is shown comes to: it stays as it is at first."""
        name = TARGETS.get(driver)
        value = None if name is None or self._shown is None else self._shown.figure(driver)
        if value is None:
            return
        set_value(self._obj, name, float(f"{value:.3g}"))
        field = self._rows[name][1]
        field.setProperty("value" if name in UNITS else "rawValue", number_of(self._obj, name))

    def _set_direction(self, name: str, text: str) -> None:
        """Take a direction over; what is none is said, and the last one shown again."""
        try:
            self._setter(name)(App.Vector(*read_direction(text)))
        except ValueError:
            self._say(
                translate(
                    "VolfrepTaskPanel",
                    "'{text}' is no direction: write 100, 110, 111 or three numbers such as 1,2,0.",
                ).format(text=text),
                wrong=True,
            )

    def _tell_radius(self, radius: float) -> None:
        """Show the radius that was found where something else drives it."""
        if self._obj.RadiusDrivenBy != "Radius":
            self._rows["StrutRadius"][1].setProperty("rawValue", radius)

    def _say(self, text: str, wrong: bool = False) -> None:
        self._figures.setStyleSheet(WRONG if wrong else "")
        self._figures.setText(text)

    def _close(self) -> None:
        self._timer.stop()
        self._view.remove()
        Gui.Control.closeDialog()
        if Gui.ActiveDocument is not None:
            Gui.ActiveDocument.resetEdit()


def _icon(name: str) -> QtGui.QIcon:
    """The picture of a cell of the library, of struts or of walls."""
    return wall_icon(name, PICTURE) if name in WALLS else cell_icon(LIBRARY[name], PICTURE)


class _PlainNumber(QtWidgets.QDoubleSpinBox):
    """A number without zeros at its end, which would push the unit out of a narrow panel."""

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


def _direction_text(way: App.Vector) -> str:
    """A direction as the panel's field shows and takes it."""
    numbers = tuple(way)
    for short in ("100", "110", "111"):
        if numbers == read_direction(short):
            return short
    return ", ".join(f"{number:g}" for number in numbers)


def _label(name: str) -> str:
    """A property's name in the user's words; in English only its first letter is a capital."""
    text = spaced(name)
    said = _property(text)
    return text.capitalize() if said == text else said


def _property(text: str) -> str:
    """A property's name, description or value, in the context that FreeCAD has for them."""
    return str(translate("App::Property", text))
