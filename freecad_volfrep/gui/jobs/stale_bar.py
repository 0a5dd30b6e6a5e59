# SPDX-License-Identifier: LGPL-2.1-or-later
"""A bar over the 3D view while a lattice in it is out of date: it says so, and one click updates.

It lies in the window of the view in front and follows whichever is there.
"""

from __future__ import annotations

from contextlib import suppress
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.reports.statistics import infills_of
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import translate

from .updating import begin_update

NAME = "VolfrepStaleBar"
#: From the view's upper left corner, px.
PLACE = 12
LOOK = (
    "QFrame#VolfrepStaleBar { background: #fff3d6; border: 1px solid #d08000; border-radius: 4px }"
    "QFrame#VolfrepStaleBar QLabel { color: #5a3600; background: transparent }"
)
_is_asked = _is_followed = False


def refresh_bar() -> None:
    """Show the bar, or take it away, once what happens now is over."""
    global _is_asked
    if not _is_asked:
        _is_asked = True
        QtCore.QTimer.singleShot(0, _refresh)


def _refresh() -> None:
    global _is_asked, _is_followed
    _is_asked = False
    area = Gui.getMainWindow().findChild(QtWidgets.QMdiArea)
    if area is None:
        return
    if not _is_followed:
        _is_followed = True
        area.subWindowActivated.connect(lambda _: refresh_bar())
    window = area.activeSubWindow()
    view = None if window is None else window.widget()
    doc = App.ActiveDocument
    if view is None or doc is None or not hasattr(Gui.activeView(), "getSceneGraph"):
        return
    stale = [obj for obj in infills_of(doc) if _is_waiting(obj)]
    bar = view.findChild(QtWidgets.QFrame, NAME)
    if bar is None and stale:
        bar = _Bar(view)
    if bar is not None:
        bar.show_infills(stale)


def _is_waiting(obj: App.DocumentObject) -> bool:
    """Whether an infill's old mesh is seen, and no new one is being made."""
    with suppress(AttributeError):  # without its proxies it is nobody's
        return bool(obj.ViewObject.Proxy.is_seen_stale and not obj.Proxy.job.is_under_way)
    return False


class _Bar(QtWidgets.QFrame):
    """What is out of date, and the button."""

    def __init__(self, view: Any) -> None:
        super().__init__(view)
        self.setObjectName(NAME)
        self.setStyleSheet(LOOK)
        line = QtWidgets.QHBoxLayout(self)
        line.setContentsMargins(10, 4, 6, 4)
        self._said = QtWidgets.QLabel()
        line.addWidget(self._said)
        self._button = QtWidgets.QPushButton(translate("VolfrepFreshness", "Update"))
        self._button.setObjectName("Update")
        self._button.setFocusPolicy(QtCore.Qt.NoFocus)
        self._button.clicked.connect(lambda _=False: self._update())
        line.addWidget(self._button)
        self._infills: list[Any] = []

    def show_infills(self, infills: list[Any]) -> None:
        """Say which are out of date; nothing is said of none."""
        self._infills = infills
        self.setVisible(bool(infills))
        if not infills:
            return
        if len(infills) == 1:
            text = translate("VolfrepFreshness", "{label} is out of date")
        else:
            text = translate("VolfrepFreshness", "{count} lattices are out of date")
        self._said.setText(text.format(label=infills[0].Label, count=len(infills)))
        self.setToolTip("\n".join(f"{obj.Label}: {localise(obj.Status)}" for obj in infills))
        self.adjustSize()
        self.move(PLACE, PLACE)
        self.raise_()

    def _update(self) -> None:
        for obj in self._infills:
            begin_update(obj)
        refresh_bar()
