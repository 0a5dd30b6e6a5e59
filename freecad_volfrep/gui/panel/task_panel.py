# SPDX-License-Identifier: LGPL-2.1-or-later
"""The task panel of a lattice infill: its values, a preview while they change, OK and Cancel."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.infill.expressions import follow_expressions
from freecad_volfrep.features.infill.factory import SHEET
from freecad_volfrep.features.infill.live_preview import (
    TARGETS,
    Shown,
    made_text,
    stiffness_of,
)
from freecad_volfrep.features.properties.quantities import is_driven, number_of, set_value
from freecad_volfrep.gui.jobs.updating import Update, begin_update, show_mesh
from freecad_volfrep.gui.qt import OK_CANCEL, QtCore, QtWidgets
from freecad_volfrep.gui.view.preview_only import end_preview
from freecad_volfrep.gui.view.preview_thread import PreviewThread, ReadyPreview
from freecad_volfrep.gui.view.preview_view import PreviewView
from freecad_volfrep.gui.view.section_view import close_section, open_section
from freecad_volfrep.gui.widgets.controls import Message, push_button
from freecad_volfrep.gui.widgets.panel_manners import (
    PanelForm,
    allow_ok,
    close_panel,
    keep_height,
    keep_space,
    leave_the_wheel,
)
from freecad_volfrep.gui.widgets.sections import (
    CURVES,
    FOLDED,
    GROUPS,
    Rows,
    Section,
    give_accelerators,
)
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.design.cells import measure_of
from volfrep.design.parameters.table import BY_NAME
from volfrep.util.errors import VolfrepError

from .colour_field import colour_field
from .lattice_picker import LatticePicker
from .pick_box import PickBox
from .print_panel import PrintFigures
from .property_fields import (
    LABELS_OF,
    THICKNESS_OF,
    PropertyFields,
    direction_text,
    is_read_only,
    label_of,
    said_property,
)
from .recipe_row import RecipeRow

#: The preview waits until no value has changed for so long, ms: less where the last one was made
#: within `PROMPT`, so that it keeps up with what is typed.
SETTLED, SOON, PROMPT = 120, 20, 60
#: Figures of values that are not the present ones any more are grey from now on, ms.
LATE = 300
#: The switches of what is shown in the view.
PREVIEW = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Preview")
CELLS = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "Cells")
#: Above this group are the figures: what is used most is seen without scrolling.
SECOND = "Boundary"
PRINT = QT_TRANSLATE_NOOP("VolfrepTaskPanel", "To print")
#: Least width of a field, px: the panel must fit beside FreeCAD's tree.
FIELD = 82
#: Lines that the figures take.
FIGURES = 5
_HIDDEN = "Hidden"


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
        self._opens_section = close_section(obj)
        self._obj, self._doc = obj, obj.Document
        if transaction is not None:
            self._doc.openTransaction(transaction)
        self._key = obj.Document.Name, obj.Name
        end_shown(self._key)
        self._view = _shown_views[self._key] = PreviewView(obj)
        self._was_visible = {
            shown: shown.ViewObject.Visibility for shown in (obj, obj.Base) if shown is not None
        }
        self._fields = PropertyFields(obj, self._value_changed, self._refuse)
        #: A sentence on what was typed or chosen, and the property that changed last.
        self._refusal = self._last = ""
        self._cell_size = obj.CellSize.Value
        self._rows: dict[str, tuple[Any, Any]] = {}
        self._boxes: list[tuple[Section, Rows, tuple[str, ...]]] = []
        self._shown: Shown | None = None
        self._seen: Shown | None = None  # the last that there was
        self._update: Update | None = None
        self._is_open, self._is_first = True, True
        self.form = self._build()
        self._previews = PreviewThread(obj, self.form)
        self._pause = SETTLED
        self._timer, self._late = (QtCore.QTimer(self.form) for _ in range(2))
        self._timer.timeout.connect(self.refresh)
        self._late.timeout.connect(self._show_late)
        self._late.setInterval(LATE)
        for timer in (self._timer, self._late):
            timer.setSingleShot(True)
        self._asked = QtCore.QElapsedTimer()
        self._show_rows()
        self.refresh()

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
        self._picking.end()  # as long as the infill is there
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
        self._wait_no_more()
        self._take_the_view()
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
        self._say(
            f"{localise(self._obj.Status)}\n{made_text(self._obj)}"
            if is_there
            else self._obj.Status,
            wrong=not is_there,
        )
        self._tell_radius(self._obj.StrutRadius.Value)
        self._obj.ViewObject.Visibility = is_there
        if is_there:
            self._view.clear()
            self._show_solid(False)
            self._tell_print()

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
        """Have the preview and the figures brought up to the present values."""
        self._asked.start()
        self._late.start()
        try:
            follow_expressions(self._obj)
        except VolfrepError as error:
            self._previews.drop()
            self._show_wrong(error)
            return
        self._previews.ask(self._show_preview, self._show_wrong)

    def _show_late(self) -> None:
        """What is shown is not of the present values any more, and has been for a while."""
        for figures in (self._figures, self._print):
            figures.setEnabled(False)

    def _show_prompt(self) -> None:
        """What is shown is of the present values."""
        self._late.stop()
        for figures in (self._figures, self._print):
            figures.setEnabled(True)
        self._pause = SOON if self._asked.elapsed() < PROMPT else SETTLED

    def _take_the_view(self) -> None:
        """What was shown before makes room, once there is something else."""
        if self._is_first:
            self._is_first = False
            self._obj.ViewObject.Visibility = False

    def _cut_again(self) -> None:
        """Open a section that there was before the panel, or that was asked for too early."""
        if self._opens_section:
            self._opens_section = False
            open_section(self._obj, self._view)

    def _show_wrong(self, error: VolfrepError) -> None:
        self._show_prompt()
        self._shown = None
        if self._is_first:
            self._show_solid(True)
        self._take_the_view()
        self._view.show_solid_only()
        self._cut_again()
        may_be = self._may_be_computed()
        self._say(str(error), wrong=not may_be)
        self._print.show_none()
        self._allow_ok(may_be)

    def _show_preview(self, ready: ReadyPreview) -> None:
        self._show_prompt()
        self._take_the_view()
        self._allow_ok(True)
        shown = self._shown = self._seen = ready.shown
        self._tell_radius(shown.preview.spec.strut_radius)
        if self._preview.isChecked():
            self._show_solid(False)
            ready.show_in(self._view, self._grid.isChecked())
        else:
            self._view.clear()
            self._show_solid(not self._obj.ViewObject.Visibility)
        self._cut_again()
        self._say(self._refusal or shown.text, wrong=bool(self._refusal))
        self._print.tell(self._obj, shown)

    def _show_solid(self, is_shown: bool) -> None:
        """Show the solid itself where nothing else is; or the preview's in its place."""
        if self._obj.Base is not None and not self._picking.is_picking:
            self._obj.Base.ViewObject.Visibility = is_shown

    def _tell_print(self) -> None:
        """Once a mesh has come: what was foretold is measured now."""
        self._previews.ask(
            lambda ready: self._print.tell(self._obj, ready.shown),
            lambda _: None,  # of values that were changed meanwhile
        )

    def _refuse(self, name: str, text: str) -> None:
        """Say why something that was typed or chosen is not taken, until a value changes.

        Args:
            name: of the property, or empty.
            text: the sentence.
        """
        self._refusal, self._last = text, name
        self._say(text, wrong=True)

    def _show_all(self) -> None:
        """Show what was set elsewhere than in the fields: by a recipe."""
        for name, (_, widget) in self._rows.items():
            self._fields.show(name, widget)
        self._picker.show_present()
        self._refusal = self._last = ""
        self._show_rows()
        self._timer.start(0)

    def _allow_ok(self, is_allowed: bool) -> None:
        """Let OK be pressed, or not: once FreeCAD has put the panel up."""
        self._ok_is_allowed = is_allowed
        QtCore.QTimer.singleShot(0, self._show_ok)

    def _show_ok(self) -> None:
        if self._is_open:
            allow_ok(self._ok_is_allowed)

    def _may_be_computed(self) -> bool:
        """Whether values that cannot be shown may be computed all the same."""
        try:
            spec = self._obj.Proxy.read(self._obj)[0]
        except VolfrepError:
            return False
        return not spec.kind.is_judged_by_preview

    def _build(self) -> Any:
        form = PanelForm("VolfrepTaskPanel", self._obj.Label, "lattice_infill")
        column = form.column
        self._recipes = RecipeRow(self._obj, self._show_all, partial(self._refuse, ""))
        column.addWidget(self._recipes)
        self._picker = LatticePicker(self._obj, self._fields.set_value)
        kind = translate("VolfrepTaskPanel", "Kind of lattice")
        sections = [Section("Cell", kind, self._picker)]
        column.addWidget(sections[0])
        for title, names in GROUPS.items():
            if title == SECOND:
                self._add_figures(column)
            section = self._section(title, names)
            sections.append(section)
            column.addWidget(section)
        self._print = PrintFigures()
        sections.append(Section("Print", translate("VolfrepTaskPanel", PRINT), self._print))
        column.addWidget(sections[-1])
        fields = [widget for _, widget in self._rows.values()]
        lists = [
            self._recipes.list,
            *(curve.shapes for curve in self._fields.curves.values()),
            *form.findChildren(QtWidgets.QComboBox, "ColourBy"),
            self._picker.cell,
            *self._picking.lists,
        ]
        titles = [section.title for section in sections]
        leave_the_wheel(form, [*fields, *lists])
        keep_space(
            form, [*fields, *lists, *titles, *self._buttons, self._recipes.save, self._picker]
        )
        give_accelerators([*self._buttons, *titles, self._recipes.save])
        QtCore.QTimer.singleShot(0, self._picker.list.setFocus)
        return form

    def _section(self, title: str, names: tuple[str, ...]) -> Section:
        """The fields of a group."""
        rows = Rows()
        for name in names:
            label, widget = QtWidgets.QLabel(label_of(name)), self._fields.field(name)
            widget.setObjectName(name)
            widget.setMinimumWidth(max(FIELD, widget.minimumWidth()))
            widget.setToolTip(said_property(self._obj.getDocumentationOfProperty(name)))
            widget.setAccessibleName(label_of(name))
            label.setBuddy(widget)
            rows.add(name, label, widget)
            self._rows[name] = label, widget
            if name in CURVES:
                rows.add(name, self._fields.curve_of(name, widget))
        section = Section(title, said_property(title), rows, title in FOLDED)
        self._boxes.append((section, rows, names))
        return section

    def _add_figures(self, column: Any) -> None:
        self._figures = Message("Figures")
        column.addWidget(self._figures)
        line = QtWidgets.QHBoxLayout()
        self._preview = self._check_box(PREVIEW, True, line)
        self._grid = self._check_box(CELLS, False, line)
        tip = translate(
            "VolfrepTaskPanel", "Make the mesh of these values now and stay in this panel"
        )
        text = translate("VolfrepTaskPanel", "Compute")
        button = push_button("Compute", text, self.compute, tip)
        tip = translate(
            "VolfrepTaskPanel",
            "Cut the part open on the screen, along a plane that can be moved; once more "
            "shows it whole",
        )
        text = translate("VolfrepTaskPanel", "Section")
        section = push_button("Section", text, self._toggle_section, tip)
        self._buttons = [button, section, self._preview, self._grid]
        column.addLayout(line)
        column.addWidget(colour_field(self._obj.ViewObject, lambda: self._timer.start(0)))
        self._picking = PickBox(self._obj, self._picked, lambda text: self._say(text, wrong=True))
        column.addWidget(self._picking)
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
        if self._is_first:
            self._opens_section = not self._opens_section
        elif not close_section(self._obj):
            open_section(self._obj, self._view)

    def _picked(self, name: str) -> None:
        """Show what was picked in its field too, if it has one."""
        if name in self._rows:
            self._rows[name][1].setText(direction_text(name, getattr(self._obj, name)))
        self._value_changed(name)

    def _value_changed(self, name: str) -> None:
        """Show what applies now, and a new preview once nothing changes any more."""
        self._last = name
        if name == "RadiusDrivenBy":
            self._begin_target(self._obj.RadiusDrivenBy)
        elif name == "PrintMaterial" and self._obj.RadiusDrivenBy == "Stiffness":
            self._begin_stiffness()
        elif name in ("RadiusGrading", "RadiusProfile"):
            self._begin_grading()
        elif name in ("CellSize", "CellType"):
            self._follow_cell()
        elif name == "CellFile":
            self._picker.draw_own_cell()
        self._refusal = ""
        self._show_rows()
        if name == "Network" and self._obj.Network == "Faces":
            self._picking.begin("NetworkFaces")
        self._picking.show_picked()
        self._timer.start(self._pause)

    def _show_rows(self) -> None:
        """Hide what does not apply, as the property editor does."""
        for box, rows, names in self._boxes:
            shown = [name for name in names if _HIDDEN not in self._obj.getEditorMode(name)]
            rows.show_only(shown)
            box.setVisible(bool(shown))
        self._picking.show_applicable()
        self._rows["StrutRadius"][1].setEnabled(not is_read_only(self._obj, "StrutRadius"))
        self._name_thickness()

    def _name_thickness(self) -> None:
        """Of a TPMS no word of struts: what is graded and driven is a thickness."""
        measure = measure_of(self._obj.CellType)
        for name in (name for labels in LABELS_OF.values() for name in labels):
            label, field = self._rows[name]
            label.setText(label_of(name, measure))
            field.setAccessibleName(label.text())
        thickness = translate("VolfrepTaskPanel", THICKNESS_OF.get(measure, ""))
        choice = self._rows["RadiusDrivenBy"][1]
        choice.setItemText(0, thickness or said_property(choice.itemData(0)))
        for section, _, names in self._boxes:
            if "RadiusGrading" in names:
                section.entitle(thickness or said_property("Strut radius"))

    def _begin_target(self, driver: str) -> None:
        """Begin with what the lattice that is shown comes to: it stays as it is at first."""
        name = TARGETS.get(driver)
        value = None if name is None or self._shown is None else self._shown.figure(driver)
        if value is not None:
            self._begin_with(name, value)

    def _begin_stiffness(self) -> None:
        """Begin a stiffness that had no material with what the lattice shown last has of it."""
        if self._seen is None or number_of(self._obj, "TargetStiffness"):
            return
        with suppress(VolfrepError):  # of the material: the preview says it
            value = stiffness_of(self._obj, self._seen.preview.spec)
            if value is not None:
                self._begin_with("TargetStiffness", value)

    def _begin_with(self, name: str, value: float) -> None:
        set_value(self._obj, name, float(f"{value:.3g}"))
        self._fields.show(name, self._rows[name][1])

    def _begin_grading(self) -> None:
        """Begin with the thickness that there is: 0, which stands for it, says nothing."""
        usual = getattr(self._obj, BY_NAME[measure_of(self._obj.CellType)].property_name)
        for name in ("RadiusStart", "RadiusEnd"):
            if not getattr(self._obj, name).Value and not is_driven(self._obj, name):
                set_value(self._obj, name, usual.Value)
                self._fields.show(name, self._rows[name][1])
        # The table's is of a radius of 1 mm.
        if self._obj.RadiusFormula == BY_NAME["radius_formula"].initial and usual.Value:
            low, more = (float(f"{share * usual.Value:.3g}") for share in (0.8, 0.4))
            self._obj.RadiusFormula = f"{low:g} + {more:g} * s"
            self._fields.show("RadiusFormula", self._rows["RadiusFormula"][1])

    def _follow_cell(self) -> None:
        """Let a sheet whose thickness nobody has changed be as thick as suits the cell."""
        before, self._cell_size = self._cell_size, self._obj.CellSize.Value
        was_suggested = abs(self._obj.WallThickness.Value - SHEET * before) < 1e-9 * before
        if was_suggested and not is_driven(self._obj, "WallThickness"):
            set_value(self._obj, "WallThickness", SHEET * self._cell_size)
            self._fields.show("WallThickness", self._rows["WallThickness"][1])

    def _tell_radius(self, radius: float) -> None:
        """Show the radius that was found where something else drives it."""
        if self._obj.RadiusDrivenBy != "Radius":
            self._rows["StrutRadius"][1].setProperty("rawValue", radius)

    def _say(self, text: str, wrong: bool = False) -> None:
        """A sentence or figures; what is wrong stands below the field that changed last."""
        is_marked, text = False, localise(text)
        for _, rows, _ in self._boxes:
            is_marked = rows.tell(self._last if wrong else "", text) or is_marked
        self._figures.say("" if is_marked else text, wrong)
        keep_height(self._figures, FIGURES)

    def _wait_no_more(self) -> None:
        """Show no preview that is still to come."""
        self._timer.stop()
        self._previews.drop()
        self._show_prompt()

    def _close(self) -> None:
        self._is_open = False
        self._wait_no_more()
        self._picking.end()
        close_panel(self._doc)


def end_shown(key: tuple[str, str]) -> None:
    """Take the preview of a panel out of the view; it stays after OK until the mesh is there."""
    view = _shown_views.pop(key, None)
    if view is not None:
        view.remove()
