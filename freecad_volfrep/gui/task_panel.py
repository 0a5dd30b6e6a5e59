# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a lattice infill: its values, a preview while they change, OK and Cancel."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.expressions import follow_expressions
from freecad_volfrep.features.live_preview import TARGETS, LivePreview, Shown
from freecad_volfrep.features.quantities import number_of, set_value
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, marked, spaced, translate
from volfrep.design import parameters
from volfrep.design.cells import LIBRARY, load_cell
from volfrep.design.field_files import TABLE_SUFFIXES, VTK_SUFFIXES
from volfrep.design.parameters.table import CUSTOM_CELL
from volfrep.design.target import read_direction
from volfrep.util.errors import VolfrepError

from .cell_library import cell_files
from .cell_picture import cell_icon
from .file_field import FileField
from .messages import WRONG
from .panel_manners import allow_ok, entitle, fits_any_width, leave_the_wheel
from .preview_only import end_preview
from .preview_view import PreviewView
from .qt import OK_CANCEL, QtCore, QtWidgets
from .section_view import close_section, open_section
from .updating import Update, begin_update, show_mesh

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


#: Previews that panels show, or have left, by names of document and infill.
_shown_views: dict[tuple[str, str], PreviewView] = {}


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
        self._key = obj.Document.Name, obj.Name
        end_shown(self._key)
        self._view = _shown_views[self._key] = PreviewView(obj)
        self._was_visible = {
            shown: shown.ViewObject.Visibility for shown in (obj, obj.Base) if shown is not None
        }
        for shown in self._was_visible:
            shown.ViewObject.Visibility = False
        self._bindings: list[Any] = []
        self._rows: dict[str, tuple[Any, Any]] = {}
        self._boxes: list[tuple[Any, tuple[str, ...]]] = []
        self._shown: Shown | None = None
        self._update: Update | None = None
        self._is_open = True
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
        """Keep the values and close; the mesh comes while the user goes on.

        Stays open where the values make no sense.
        """
        if not self._begin(is_in_panel=False, ended=self._show_result) and self._is_wrong():
            return False
        is_coming = self._update is not None
        self._doc.commitTransaction()
        self._close()
        Gui.Selection.clearSelection()
        if not is_coming:
            self._show_result(True)
        return True

    def reject(self) -> bool:
        """Close and take back every change; an infill that was made for this panel is gone."""
        if self._update is not None:
            self._update.drop()
        self._show_again()
        self._doc.abortTransaction()  # to end the editing would commit it
        self._close()
        end_shown(self._key)
        self._doc.recompute()
        return True

    def compute(self) -> None:
        """Make the mesh of the present values, and stay; says what is wrong with them."""
        if not self._begin(is_in_panel=True, ended=self._show_computed) and not self._is_wrong():
            self._show_computed(True)

    def _begin(self, is_in_panel: bool, ended: Callable[[bool | None], None]) -> bool:
        """Have the mesh of the present values made; whether there is anything to make.

        One that is being made for the same values already is left to come.
        """
        self._timer.stop()
        made = self._update
        if made is not None and made.is_as_wanted():
            made.is_in_panel, made.ended = is_in_panel, ended
            return True
        self._update = begin_update(self._obj, is_in_panel=is_in_panel, ended=ended)
        self._say(self._obj.Status, wrong=self._is_wrong())
        return self._update is not None

    def _is_wrong(self) -> bool:
        """Whether the values make no sense."""
        return not self._obj.isValid()

    def _show_computed(self, is_there: bool | None) -> None:
        """In the panel: the mesh that has come, or why there is none."""
        if is_there is None:
            return
        self._update = None
        self._say(self._obj.Status, wrong=not is_there)
        self._tell_radius(self._obj.StrutRadius.Value)
        self._obj.ViewObject.Visibility = is_there
        if is_there:
            self._view.clear()

    def _show_result(self, is_there: bool | None) -> None:
        """After the panel: the mesh in place of the preview, or what was shown before."""
        end_shown(self._key)
        if is_there is None:
            return
        self._show_again()
        if is_there:
            show_mesh(self._obj)

    def _show_again(self) -> None:
        """Show what was shown before the panel was opened."""
        for shown, visible in self._was_visible.items():
            with suppress(ReferenceError):  # deleted while the mesh was made
                shown.ViewObject.Visibility = visible

    def refresh(self) -> None:
        """Bring the preview and the figures up to the present values."""
        try:
            follow_expressions(self._obj)
            shown = self._live.show()
        except VolfrepError as error:
            self._shown = None
            self._view.show_solid_only()
            self._say(str(error), wrong=True)
            self._allow_ok(self._has_no_preview())
            return
        self._allow_ok(True)
        self._shown = shown
        self._tell_radius(shown.preview.spec.strut_radius)
        if self._preview.isChecked():
            self._view.show(shown, self._grid.isChecked())
        else:
            self._view.clear()
        self._say(shown.text)

    def _allow_ok(self, is_allowed: bool) -> None:
        """Let OK be pressed, or not: once FreeCAD has put the panel up."""
        self._ok_is_allowed = is_allowed
        QtCore.QTimer.singleShot(0, self._show_ok)

    def _show_ok(self) -> None:
        if self._is_open:
            allow_ok(self._ok_is_allowed)

    def _has_no_preview(self) -> bool:
        """Whether the values may be computed though they cannot be shown, as those of a network."""
        try:
            return self._obj.Proxy.read(self._obj)[0].network is not None
        except VolfrepError:
            return False

    def _build(self) -> Any:
        form = QtWidgets.QWidget()
        form.setObjectName("VolfrepTaskPanel")
        entitle(form, self._obj.Label)
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
        leave_the_wheel(form, [widget for _, widget in self._rows.values()])
        return form

    def _add_figures(self, column: Any) -> None:
        self._figures = QtWidgets.QLabel()
        self._figures.setObjectName("Figures")
        fits_any_width(self._figures)
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
        button.clicked.connect(lambda _=False: self.compute())
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
                item.setIcon(cell_icon(LIBRARY[name], PICTURE))
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
            if self._is_driven(name):
                self._timer.start(SETTLED)
                return
            if _READ_ONLY in self._obj.getEditorMode(name):
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
        self._is_open = False
        self._timer.stop()
        Gui.Control.closeDialog()
        if Gui.ActiveDocument is not None:
            Gui.ActiveDocument.resetEdit()


def end_shown(key: tuple[str, str]) -> None:
    """Take the preview of a panel out of the view; it stays after OK until the mesh is there."""
    view = _shown_views.pop(key, None)
    if view is not None:
        view.remove()


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
