# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a slicer infill: what its density follows, its bands and what they take."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.export.slicer_infill import (
    FOLLOWS,
    MATERIALS,
    SLICERS,
    source_of,
)
from freecad_volfrep.features.properties.quantities import mass_of
from freecad_volfrep.gui.qt import OK_CANCEL, QtWidgets
from freecad_volfrep.gui.widgets.controls import Message, push_button
from freecad_volfrep.gui.widgets.file_field import FileField
from freecad_volfrep.gui.widgets.panel_manners import (
    PanelForm,
    close_panel,
    fits_any_width,
    leave_the_wheel,
    narrow,
)
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, figure, translate
from volfrep.design.banded_infill import FEWEST_BANDS, MOST, MOST_BANDS
from volfrep.design.banded_words import PATTERNS

from .band_colours import colours_of

#: Fields that say something for some choices only.
_FOR = {
    "Reach": ("skin", "core"),
    "Direction": ("direction",),
    "Formula": ("formula",),
    "FieldFile": ("field",),
    "FieldObject": ("result", "sized"),
    "FieldColumn": ("field", "result"),
    "Curve": ("field", "result"),
    "DensityStart": ("skin", "core", "direction", "field", "result"),
    "DensityEnd": ("skin", "core", "direction", "field", "result"),
}
_WHOLE = {"Bands": (FEWEST_BANDS, MOST_BANDS), "Walls": (0, 20), "TopLayers": (0, 100),
          "BottomLayers": (0, 100)}  # fmt: skip
#: The least width of a field, px: the panel must fit beside FreeCAD's tree.
LEAST = 60
_LENGTHS = ("Reach", "LineWidth", "LayerHeight")
_AXES = {"X": (1, 0, 0), "Y": (0, 1, 0), "Z": (0, 0, 1)}
#: What the fields are called.
_LABELS = {
    "Follows": QT_TRANSLATE_NOOP("VolfrepSlicer", "Follows"),
    "DensityStart": QT_TRANSLATE_NOOP("VolfrepSlicer", "From"),
    "DensityEnd": QT_TRANSLATE_NOOP("VolfrepSlicer", "To"),
    "Reach": QT_TRANSLATE_NOOP("VolfrepSlicer", "Down to depth"),
    "Direction": QT_TRANSLATE_NOOP("VolfrepSlicer", "Along"),
    "Formula": QT_TRANSLATE_NOOP("VolfrepSlicer", "Percent of x, y, z"),
    "FieldFile": QT_TRANSLATE_NOOP("VolfrepSlicer", "File"),
    "FieldObject": QT_TRANSLATE_NOOP("VolfrepSlicer", "Object"),
    "FieldColumn": QT_TRANSLATE_NOOP("VolfrepSlicer", "Quantity"),
    "Curve": QT_TRANSLATE_NOOP("VolfrepSlicer", "value:percent"),
    "Bands": QT_TRANSLATE_NOOP("VolfrepSlicer", "Bands"),
    "Slicer": QT_TRANSLATE_NOOP("VolfrepSlicer", "Slicer"),
    "Pattern": QT_TRANSLATE_NOOP("VolfrepSlicer", "Pattern"),
    "Walls": QT_TRANSLATE_NOOP("VolfrepSlicer", "Walls"),
    "TopLayers": QT_TRANSLATE_NOOP("VolfrepSlicer", "Top layers"),
    "BottomLayers": QT_TRANSLATE_NOOP("VolfrepSlicer", "Bottom layers"),
    "LineWidth": QT_TRANSLATE_NOOP("VolfrepSlicer", "Line width"),
    "LayerHeight": QT_TRANSLATE_NOOP("VolfrepSlicer", "Layer height"),
    "Filament": QT_TRANSLATE_NOOP("VolfrepSlicer", "Filament"),
}
#: What the empty lines show; the others find their value themselves.
_EXAMPLES = {"Formula": "10 + z", "Curve": "0:10, 80:60"}
_PANEL = "VolfrepTaskPanel"
_KINDS = QT_TRANSLATE_NOOP("VolfrepSlicer", "Fields (*.csv *.txt *.vtu *.vtk)")


class SlicerPanel:
    """Sets a slicer infill inside one transaction, which Cancel takes back as a whole.

    Args:
        obj: the slicer infill.
        is_new: whether it was made for this panel, in a transaction that is open.
    """

    def __init__(self, obj: App.DocumentObject, is_new: bool = False) -> None:
        self._obj, self._doc, self._is_new = obj, obj.Document, is_new
        if not is_new:
            self._doc.openTransaction(translate("VOLFREP_SlicerInfill", "Slicer Infill"))
        base = obj.Base
        self._was_visible = base is not None and base.Visibility
        self._fields: dict[str, Any] = {}
        self.form = self._build()
        self._read()
        self._show_fields()
        self._show_bands()
        Gui.Selection.addObserver(self)

    def addSelection(self, doc: str, name: str, sub: str, place: Any) -> None:  # noqa: N802
        """Called by FreeCAD: a click in the tree at what the density can follow chooses it."""
        del sub, place
        source = self._doc.getObject(name) if doc == self._doc.Name else None
        follows = "" if source is None else source_of(source)
        if follows:
            self._fields["Follows"].setCurrentIndex(self._fields["Follows"].findData(follows))
            box = self._fields["FieldObject"]
            box.setCurrentIndex(box.findData(name))

    def getStandardButtons(self) -> int:  # noqa: N802
        """OK and Cancel."""
        return OK_CANCEL

    def accept(self) -> bool:
        """Cut the bands of these values, and close; stays open where that cannot be."""
        if not self.cut():
            return False
        self._obj.Visibility = True
        if self._obj.Base is not None:
            self._obj.Base.Visibility = False
        self._doc.commitTransaction()
        self._close()
        Gui.Selection.clearSelection()
        Gui.Selection.addSelection(self._obj)
        return True

    def reject(self) -> bool:
        """Close and leave everything as it was."""
        base = self._obj.Base
        self._doc.abortTransaction()  # to end the editing would commit it
        self._close()
        if self._is_new and base is not None:
            base.Visibility = self._was_visible
        self._doc.recompute()
        return True

    def cut(self) -> bool:
        """Cut the bands of the values that the panel shows; says here what is wrong."""
        self._write()
        holds = self._obj.Proxy.update(self._obj)
        self._text.say("" if holds else self._obj.Status, wrong=not holds)
        if holds and self._obj.Base is not None:
            self._obj.Base.Visibility = False
        self._show_bands()
        return bool(holds)

    def _close(self) -> None:
        Gui.Selection.removeObserver(self)
        close_panel(self._doc)

    def _build(self) -> Any:
        form = PanelForm("VolfrepSlicerPanel", self._obj.Label, "slicer_infill")
        self._rows: dict[str, Any] = {}
        words = [translate("VolfrepSlicer", text) for text in _LABELS.values()]
        self._width = 4 + max(form.fontMetrics().boundingRect(word).width() for word in words)
        for title, names in (
            (
                translate("VolfrepSlicer", "Density follows"),
                ("Follows", "DensityStart", "DensityEnd", "Reach", "Direction", "Formula",
                 "FieldFile", "FieldObject", "FieldColumn", "Curve", "Bands"),
            ),
            (
                translate("VolfrepSlicer", "Print"),
                ("Slicer", "Pattern", "Walls", "TopLayers", "BottomLayers", "LineWidth",
                 "LayerHeight", "Filament"),
            ),
        ):  # fmt: skip
            box = QtWidgets.QGroupBox(title)
            rows = QtWidgets.QVBoxLayout(box)
            rows.setContentsMargins(6, 4, 6, 4)
            rows.setSpacing(2)
            for name in names:
                self._add(rows, name)
            form.column.addWidget(box)
        show = push_button("ShowBands", translate("VolfrepSlicer", "Show Bands"), self.cut)
        form.column.addWidget(show)
        self._table = QtWidgets.QLabel()
        self._table.setObjectName("BandTable")
        self._table.setContentsMargins(6, 2, 6, 2)
        self._table.setToolTip(
            translate(
                "VolfrepSlicer",
                "Of each band: the density that is wanted, what the slicer is told so that it lays "
                "as much, and the volume of its sparse infill",
            )
        )
        fits_any_width(self._table)
        form.column.addWidget(self._table)
        self._text = Message("Said")
        form.column.addWidget(self._text)
        form.column.addStretch()
        leave_the_wheel(form, (self._fields[name] for name in self._fields if name != "FieldFile"))
        return form

    def _add(self, rows: Any, name: str) -> None:
        field = self._field(name)
        field.setObjectName(name)
        text = translate("VolfrepSlicer", _LABELS[name])
        field.setAccessibleName(text)
        field.setToolTip(translate("App::Property", self._obj.getDocumentationOfProperty(name)))
        field.setMinimumWidth(LEAST)
        label = QtWidgets.QLabel(text)
        label.setFixedWidth(self._width)
        label.setVisible(name != "Follows")  # the box says so, and its words are long
        row = QtWidgets.QWidget()  # which takes no room while it is hidden, other than a form's
        line = QtWidgets.QHBoxLayout(row)
        line.setContentsMargins(0, 0, 0, 0)
        line.addWidget(label)
        line.addWidget(field, 1)
        rows.addWidget(row)
        self._fields[name], self._rows[name] = field, row

    def _field(self, name: str) -> Any:
        if name in _WHOLE:
            spin = QtWidgets.QSpinBox()
            spin.setRange(*_WHOLE[name])
            return spin
        if name in ("DensityStart", "DensityEnd"):
            spin = QtWidgets.QDoubleSpinBox()
            spin.setRange(0.0, MOST)
            spin.setDecimals(1)
            spin.setSuffix(" %")
            return spin
        if name in _LENGTHS:
            spin = Gui.UiLoader().createWidget("Gui::QuantitySpinBox")
            spin.setProperty("unit", "mm")
            spin.setProperty("minimum", 1e-3)
            return spin
        if name == "FieldFile":
            return FileField("", translate("VolfrepSlicer", _KINDS), lambda _: None)
        choices: dict[str, Any] = {
            "Follows": {translate("VolfrepSlicer", word): word for word in FOLLOWS},
            "Slicer": {word: word for word in SLICERS},
            "Pattern": {word: word for word in PATTERNS},
            "Filament": {word: word for word in MATERIALS},
            "Direction": _AXES,
            "FieldObject": {},
        }
        if name not in choices:
            line = QtWidgets.QLineEdit()
            line.setPlaceholderText(_EXAMPLES.get(name) or translate(_PANEL, "automatic"))
            return line
        box = QtWidgets.QComboBox()
        narrow(box)
        for text, value in choices[name].items():
            box.addItem(text, value)
        if name == "Follows":
            box.currentIndexChanged.connect(lambda _: self._show_fields())
        return box

    def _offer_sources(self) -> None:
        """The objects that the density can follow by the present choice."""
        box, follows = self._fields["FieldObject"], self._fields["Follows"].currentData()
        chosen = box.currentData()
        box.clear()
        for one in self._doc.Objects:
            if source_of(one) == follows:
                box.addItem(one.Label, one.Name)
        box.setCurrentIndex(max(box.findData(chosen), 0))

    def _read(self) -> None:
        """What the object has, into the fields."""
        for name, field in self._fields.items():
            value = getattr(self._obj, name)
            if isinstance(field, QtWidgets.QLineEdit):
                field.setText(value)
            elif isinstance(field, FileField):
                field.show_path(value)
            elif name in _LENGTHS:
                field.setProperty("rawValue", value.Value)
            elif isinstance(field, QtWidgets.QComboBox):
                if name == "Direction":
                    field.setCurrentIndex(_nearest_axis(value))
                    continue
                wanted = value.Name if name == "FieldObject" and value is not None else value
                field.setCurrentIndex(max(0, field.findData(wanted)))
            else:
                field.setValue(value)

    def _write(self) -> None:
        """What the fields say, into the object: what has no effect stays as it is."""
        for name, field in self._fields.items():
            if not self._applies(name):
                continue
            if isinstance(field, QtWidgets.QLineEdit):
                value: Any = field.text().strip()
            elif isinstance(field, FileField):
                value = field.path
            elif name in _LENGTHS:
                value = float(field.property("rawValue"))
            elif name == "Direction":
                if _nearest_axis(self._obj.Direction) == field.currentIndex():
                    continue  # an oblique one of the property editor's stays
                value = App.Vector(*_AXES[field.currentText()])
            elif isinstance(field, QtWidgets.QComboBox):
                value = field.currentData()
                if name == "FieldObject":
                    value = self._doc.getObject(value) if value else None
            else:
                value = field.value()
            setattr(self._obj, name, value)

    def _applies(self, name: str) -> bool:
        follows = FOLLOWS[self._fields["Follows"].currentData()]
        return name not in _FOR or follows in _FOR[name]

    def _show_fields(self) -> None:
        """Only those that have an effect."""
        if "Filament" not in self._fields:
            return  # not all are there
        self._offer_sources()
        for name, row in self._rows.items():
            row.setVisible(self._applies(name))

    def _show_bands(self) -> None:
        """The bands and what they take, as the last recompute has found them."""
        obj = self._obj
        if not obj.BandDensities:
            self._table.setText("")
            return
        head = (
            translate("VolfrepSlicer", "band"),
            translate("VolfrepSlicer", "density"),
            translate("VolfrepSlicer", "Slicer"),
            "cm\u00b3",
        )
        lines = ["".join(f"<th align='right'>{word}&nbsp;</th>" for word in head)]
        rows = zip(obj.BandDensities, obj.ToldDensities, obj.BandVolumes, strict=True)
        for number, ((mean, slicer_density, volume), colour) in enumerate(
            zip(rows, colours_of(len(obj.BandDensities)), strict=True), 1
        ):
            red, green, blue = (round(255 * part) for part in colour)
            swatch = f"<span style='color: rgb({red},{green},{blue})'>&#9632;</span> {number}"
            percents = (f"{figure(percent, 3)}\u00a0%" for percent in (mean, slicer_density))
            cells = (swatch, *percents, figure(volume / 1000.0, 3))
            lines.append("".join(f"<td align='right'>{cell}&nbsp;</td>" for cell in cells))
        table = "".join(f"<tr>{line}</tr>" for line in lines)
        note = translate(
            "VolfrepSlicer",
            "Filament: {volume} cm\u00b3, {mass} g, of which {solid} cm\u00b3 are walls and solid "
            "layers. Everywhere {even} % would take the same.",
        ).format(
            volume=figure(obj.FilamentVolume.Value / 1000.0, 4), mass=figure(mass_of(obj), 4),
            solid=figure(obj.SolidVolume.Value / 1000.0, 4), even=figure(obj.EvenDensity, 3),
        )  # fmt: skip
        self._table.setText(f"<table>{table}</table><p>{note}</p>")


def _nearest_axis(vector: App.Vector) -> int:
    sizes = [abs(part) for part in vector]
    return sizes.index(max(sizes))
