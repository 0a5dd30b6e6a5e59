# SPDX-License-Identifier: LGPL-2.1-or-later
"""How our objects show in the tree and in the view.

Our display modes are made when they are first shown and dropped with a new mesh; while a file is
read they wait, since the solid may not be there yet.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep import ICONS, preferences
from freecad_volfrep.features.infill.freshness import NOT_RECOMPUTED, STALE, why_stale
from freecad_volfrep.features.infill.lattice_infill import UP_TO_DATE
from freecad_volfrep.features.infill.skin import is_just_made
from freecad_volfrep.features.reports.statistics import infills_of
from freecad_volfrep.saved_names import SavesNothing, saved_module
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.util.errors import VolfrepError

from .colours.colouring import Colouring, add_properties
from .in_steps import do_in_steps, drop_steps
from .jobs.stale_bar import refresh_bar
from .printing.slicer_view import SlicerInfillView as SlicerInfillView  # saved by this name
from .qt import QtCore, QtGui
from .shown_status import show_status
from .study.study_panel import open_study
from .undo import complete_steps
from .view.filled_view import COARSE, FILLED, FilledPart, show_filled, show_proxy
from .view.simplified_view import SIMPLIFIED, SimplifiedPart

#: The modes beside those of every mesh, and what fills a node for each.
_MODES = {FILLED: show_filled, COARSE: show_proxy, SIMPLIFIED: SimplifiedPart}
#: FreeCAD's mode that was a document's before there was `FILLED`.
_PLAIN = "Shaded"
#: What of a view is in the look of our modes; FreeCAD 1.0 has another name for the colour.
_LOOKS = ("ShapeColor", "ShapeAppearance", "Transparency", "LatticeColor")
#: And what says that it is coloured by a quantity.
_COLOURS = ("ColourBy", "ColourFrom", "ColourTo", "Visibility", "Transparency")
#: Saved with a view, so that one of an older file is known.
_VERSION = 2
#: FreeCAD would otherwise draw all that is selected green, skin and lattice alike.
SELECTION_STYLE = "BoundBox"
LATTICE_COLOUR = QT_TRANSLATE_NOOP("App::Property", "Colour of the lattice inside the skin")


class LatticeInfillView:
    """View provider of a lattice infill: its icon, the commands for it, display modes.

    Beside FreeCAD's own modes for meshes there are Skin and Lattice, which is a new infill's,
    Coarse, a proxy of fewer triangles, and Simplified, the struts without any. Each is made
    when it is shown first and dropped with a new mesh. A mesh of more triangles than the
    preference allows is shown coarsely, unless it is shown simplified already; whoever then
    chooses another mode sees all of it.
    """

    _is_older = False
    _is_stale = False

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.Transparency = preferences.read(preferences.TRANSPARENCY)
        view.ShapeColor = preferences.colour(preferences.SKIN_COLOUR)
        view.SelectionStyle = SELECTION_STYLE
        view.DisplayMode = FILLED

    def attach(self, view: Any) -> None:
        """Called by FreeCAD for a new object and for one from a file."""
        from pivy import coin

        self.object = view.Object
        self._is_cut = False
        self._drawn: dict[str, Any] = {}
        self._coming: list[Iterator[None]] = []
        self._whole: set[str] = set()
        self._redone: set[str] = set()
        if not hasattr(view, "LatticeColor"):
            view.addProperty("App::PropertyColor", "LatticeColor", "Object Style", LATTICE_COLOUR)
            view.LatticeColor = preferences.colour(preferences.STRUT_COLOUR)
        self._colouring = Colouring(self.object)
        show_status(self.object)
        add_properties(view)
        self._modes = {mode: (coin.SoSeparator(), show) for mode, show in _MODES.items()}
        for mode, (node, _) in self._modes.items():
            view.addDisplayMode(node, mode)
        QtCore.QTimer.singleShot(
            0, self._show_solid
        )  # an invalid one of a file has nothing to show
        if self._is_older:
            QtCore.QTimer.singleShot(0, self._modernise)

    def getDisplayModes(self, view: Any) -> list[str]:  # noqa: N802
        """The modes beside those of every mesh."""
        return list(_MODES)

    def getDefaultDisplayMode(self) -> str:  # noqa: N802
        """The mode of a new object."""
        return FILLED

    def setDisplayMode(self, mode: str) -> str:  # noqa: N802
        """Every mode of the list is one of the view's own; ours are made now."""
        self._make(mode)
        return mode

    def onChanged(self, view: Any, name: str) -> None:  # noqa: N802
        """Draw what is drawn already in the new colours."""
        if name == "Visibility" and not self.object.Document.Restoring:
            self._show_state()
        if name in _LOOKS:
            self._set_looks()
        if name in _COLOURS and not self.object.Document.Restoring:
            self._colouring.refresh()
        if name == "DisplayMode":
            self._colour_shown()
        if self._is_cut and name in ("DisplayMode", "Transparency"):
            from .view.section_view import refresh_section

            refresh_section(self.object)

    def updateData(self, obj: Any, name: str) -> None:  # noqa: N802
        """A new mesh: what was made of the old one goes. A new state: it is shown."""
        if getattr(obj.Document, "Transacting", False):
            if not self._redone:
                QtCore.QTimer.singleShot(0, self._judge)  # once all steps are undone
            self._redone.add(name)
        if name == "Status":
            self._show_state()
            show_status(obj)
        if name != "Mesh":
            return
        if not obj.Mesh.CountFacets and not obj.Document.Restoring:
            QtCore.QTimer.singleShot(0, self._show_solid)
        self._drawn.clear()
        self._colouring.follow(None)
        self._whole.clear()
        while self._coming:
            drop_steps(self._coming.pop())
        for node, _ in self._modes.values():
            node.removeAllChildren()
        view = obj.ViewObject
        large = obj.Mesh.CountFacets > preferences.largest_shown()
        if view.DisplayMode == COARSE and not large:
            view.DisplayMode = FILLED
        elif view.DisplayMode not in (COARSE, SIMPLIFIED) and large:
            view.DisplayMode = COARSE
        else:
            self._make(view.DisplayMode)

    def show_cut(self, is_cut: bool) -> bool:
        """Draw for a section, opaque and with cut faces, or as without one.

        Returns whether the present mode has cut faces of its own.
        """
        self._is_cut = is_cut
        self._set_looks()
        return self.object.ViewObject.DisplayMode in _MODES

    @property
    def colouring(self) -> Colouring:
        """What colours it by a quantity."""
        return self._colouring

    @property
    def is_seen_stale(self) -> bool:
        """Whether a mesh is shown that is not of the present values."""
        return self._is_stale and bool(self.object.ViewObject.Visibility)

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon: another one for a mesh that is out of date."""
        return str(ICONS / ("lattice_infill_stale.svg" if self._is_stale else "lattice_infill.svg"))

    def doubleClicked(self, view: Any) -> bool:  # noqa: N802
        """Edit the infill in its task panel."""
        view.Document.setEdit(view.Object.Name)
        return True

    def setEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Open the task panel."""
        from .panel.task_panel import TaskPanel

        Gui.Control.showDialog(
            TaskPanel(view.Object, translate("VOLFREP_Edit", "Edit Lattice Infill"))
        )
        return True

    def unsetEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Leave the panel to its own buttons."""
        return False

    def claimChildren(self) -> list[Any]:  # noqa: N802
        """In the tree the solid lies under the infill, where both lie in the same group."""
        obj, base = self.object, self.object.Base
        if base is None or base.getParentGroup() != obj.getParentGroup():
            return []
        return [base] if base.getParentGeoFeatureGroup() == obj.getParentGeoFeatureGroup() else []

    def onDelete(self, view: Any, names: Any) -> bool:  # noqa: N802
        """Let the infill go, and show its solid again, unless another infill stands for it."""
        self._colouring.end()
        refresh_bar()
        obj, base = view.Object, view.Object.Base
        others = [other for other in infills_of(obj.Document) if other != obj]
        if base is not None and not any(o.Base == base and o.Visibility for o in others):
            base.Visibility = True
        return True

    def setupContextMenu(self, view: Any, menu: Any) -> None:  # noqa: N802
        """Offer the commands that apply, where another workbench than ours is in front."""
        from .commands.table import COMMANDS, applicable_commands

        if Gui.activeWorkbench().name() == "VolfrepWorkbench":
            return  # which offers them itself
        submenu = menu.addMenu("VOLFREP")
        for name in applicable_commands():
            command = COMMANDS[name]
            submenu.addAction(
                QtGui.QIcon(str(ICONS / command.icon)), translate(name, command.text)
            ).triggered.connect(lambda _=False, command=command: command.Activated())

    def _make(self, mode: str, is_settled: bool = False) -> None:
        """Fill the node of a mode of ours that is still empty; nothing for FreeCAD's own modes.

        Args:
            mode: a display mode.
            is_settled: FreeCAD is not in the middle of something.
        """
        node, show = self._modes.get(mode, (None, None))
        if node is None or node.getNumChildren() or not self.object.Mesh.CountFacets:
            return
        # While a file is read the solid may not be there yet, nor while a step is undone.
        is_known = mode == SIMPLIFIED or is_just_made(self.object) or is_settled
        if self.object.Document.Restoring or not is_known:
            QtCore.QTimer.singleShot(0, self._make_shown)
            return
        try:
            drawn = self._drawn[mode] = show(self.object, node)
            self._set_looks()
            if not getattr(drawn, "is_whole", True):
                self._coming.append(self._come(mode, drawn))
                do_in_steps(self._coming[-1])
            elif mode == self.object.ViewObject.DisplayMode:
                self._colour_shown()
        except VolfrepError as error:
            node.removeAllChildren()
            App.Console.PrintError(f"VOLFREP, {self.object.Label}: not shown {mode}. {error}\n")

    def _come(self, mode: str, drawn: FilledPart) -> Iterator[None]:
        """All of what is drawn as a proxy, and then its colours."""
        yield from drawn.add_pieces()
        self._whole.add(mode)
        with suppress(ReferenceError):
            self._colour_shown()

    def _colour_shown(self) -> None:
        """Let what is shown now have the colours, once all of it is there."""
        mode = self.object.ViewObject.DisplayMode
        drawn = self._drawn.get(mode)
        is_whole = isinstance(drawn, FilledPart) and (drawn.is_whole or mode in self._whole)
        self._colouring.follow(drawn if is_whole else None)

    def _set_looks(self) -> None:
        """Give everything that is drawn the view's present colours."""
        for drawn in self._drawn.values():
            drawn.set_look(self.object.ViewObject, self._is_cut)

    def _make_shown(self) -> None:
        """Fill the mode that is shown, once a file is read or a step undone."""
        with suppress(ReferenceError):  # the document was closed meanwhile
            self._make(self.object.ViewObject.DisplayMode, is_settled=True)

    def _judge(self) -> None:
        """After a step was undone: where the mesh does not fit the values, a refresh makes it."""
        with suppress(ReferenceError):
            obj, redone = self.object, self._redone
            self._redone = set()
            complete_steps(obj.Document, is_undone="Fingerprint" in redone)
            why = why_stale(obj)
            if not obj.isValid() and why in ("", NOT_RECOMPUTED):
                # FreeCAD brings a solid back, touched, but not that what needs it is valid.
                obj.touch()
                obj.Document.recompute([obj])
                why = why_stale(obj)
            if "Fingerprint" not in redone:
                return
            if why and obj.Status == UP_TO_DATE:
                obj.Status = STALE
                obj.touch()

    def _show_state(self) -> None:
        """A sign in the tree and over the view while the mesh is not of the present values."""
        obj, was_stale = self.object, self._is_stale
        self._is_stale = bool(obj.Fingerprint) and obj.Status != UP_TO_DATE
        refresh_bar()
        if was_stale != self._is_stale:
            obj.ViewObject.signalChangeIcon()

    def _show_solid(self) -> None:
        """Where there is no mesh, show what it would stand for."""
        with suppress(ReferenceError):
            obj = self.object
            if obj.Document.Restoring:
                QtCore.QTimer.singleShot(0, self._show_solid)
                return
            if obj.Base is not None and not obj.Mesh.CountFacets and not Gui.Control.activeDialog():
                obj.Base.Visibility = True

    def _modernise(self) -> None:
        """Show an infill of an older file as a new one is, unless someone chose how to."""
        with suppress(ReferenceError):
            view = self.object.ViewObject
            view.SelectionStyle = SELECTION_STYLE
            if view.DisplayMode == _PLAIN:
                large = self.object.Mesh.CountFacets > preferences.largest_shown()
                view.DisplayMode = COARSE if large else FILLED

    def dumps(self) -> int:
        """Of all this, only that it knows the mode Skin and Lattice."""
        return _VERSION

    def loads(self, state: Any) -> None:
        """Note whether the file is older than that; `attach` is called with the view."""
        self._is_older = state is None

    __getstate__ = dumps  # FreeCAD 0.20
    __setstate__ = loads


class PrintCheckView(SavesNothing):
    """View provider of a print check: its icon, and its facets in red."""

    def __init__(self, view: Any) -> None:
        view.Proxy = self
        view.ShapeColor = preferences.colour(preferences.OVERHANG_COLOUR)

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "print_check.svg")


class DesignStudyView(SavesNothing):
    """View provider of a design study: its icon, and its panel."""

    def __init__(self, view: Any) -> None:
        view.Proxy = self

    def attach(self, view: Any) -> None:
        """Called by FreeCAD for a new object and for one from a file."""
        self.object = view.Object
        show_status(view.Object)

    def updateData(self, obj: Any, name: str) -> None:  # noqa: N802
        """A new state is shown."""
        if name == "Status":
            show_status(obj)

    def getIcon(self) -> str:  # noqa: N802
        """Path of the tree's icon."""
        return str(ICONS / "design_study.svg")

    def doubleClicked(self, view: Any) -> bool:  # noqa: N802
        """Open the study in its panel."""
        view.Document.setEdit(view.Object.Name)
        return True

    def setEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Open the panel."""
        return open_study(view.Object)

    def unsetEdit(self, view: Any, mode: int = 0) -> bool:  # noqa: N802
        """Leave the panel to its own button."""
        return False


# Saved files find the classes under these names.
DesignStudyView.__module__ = saved_module("gui.view_provider")
PrintCheckView.__module__ = saved_module("gui.view_provider")
LatticeInfillView.__module__ = saved_module("gui.view_provider")
