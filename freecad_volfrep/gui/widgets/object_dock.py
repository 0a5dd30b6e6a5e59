# SPDX-License-Identifier: LGPL-2.1-or-later
"""A dock that shows something of one object until it is closed, or the object is gone."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any, TypeVar

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.translation import translate

from .controls import push_button

_Dock = TypeVar("_Dock", bound="ObjectDock")


class ObjectDock(QtWidgets.QDockWidget):
    """What docks of one object have in common; those of a kind have its `NAME`.

    Args:
        obj: the object.
        title: of the dock, with the object's ``{label}``.
    """

    NAME = ""

    def __init__(self, obj: App.DocumentObject, title: str) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName(self.NAME)
        self.setAttribute(QtCore.Qt.WA_DeleteOnClose)
        self._obj, self._doc, self._title = obj, obj.Document, title
        self._entitle()
        #: From `put_up` on, which is before Qt shows it.
        self.is_up = False

    def _entitle(self) -> None:
        self.setWindowTitle(self._title.format(label=self._obj.Label))

    def set_line(self, widgets: Iterable[Any]) -> Any:
        """Fill it with a line of widgets and a button that closes; returns the column of both.

        The cross of Qt's own titles is a picture that some systems cannot draw.
        """
        panel = QtWidgets.QWidget()
        column = QtWidgets.QVBoxLayout(panel)
        line = QtWidgets.QHBoxLayout()
        for widget in widgets:
            line.addWidget(widget)
        line.addStretch()
        close = push_button("CloseDock", translate("VolfrepCells", "Close"), self.close)
        line.addWidget(close)
        column.addLayout(line)
        self.setWidget(panel)
        return column

    def keyPressEvent(self, event: Any) -> None:  # noqa: N802
        """Escape closes it, where no field of it means something else by that."""
        if event.key() == QtCore.Qt.Key_Escape:
            self.close()
        else:
            super().keyPressEvent(event)

    def put_up(self) -> None:
        """Show it below the view, and follow the object from now on."""
        self.is_up = True
        App.addDocumentObserver(self)
        Gui.getMainWindow().addDockWidget(QtCore.Qt.BottomDockWidgetArea, self)

    def shows(self, obj: App.DocumentObject) -> bool:
        """Whether this is the dock of the object."""
        return bool(self._obj == obj)

    def closeEvent(self, event: Any) -> None:  # noqa: N802
        """Take away what was shown."""
        self.is_up = False
        App.removeDocumentObserver(self)
        self.take_away()
        super().closeEvent(event)

    def slotChangedObject(self, obj: App.DocumentObject, name: str) -> None:  # noqa: N802
        """Called by FreeCAD: its title follows the object's."""
        if obj == self._obj and name == "Label":
            self._entitle()

    def slotActivateDocument(self, doc: App.Document) -> None:  # noqa: N802
        """Called by FreeCAD: beside another document's view it would speak of that one."""
        self.setVisible(doc == self._doc)

    def slotDeletedObject(self, obj: App.DocumentObject) -> None:  # noqa: N802
        """Called by FreeCAD: there is nothing to show any more."""
        if obj == self._obj:
            self.forget(document_too=False)
            self.close_later()

    def slotDeletedDocument(self, doc: App.Document) -> None:  # noqa: N802
        """Called by FreeCAD as well."""
        if doc == self._doc:
            self.forget(document_too=True)
            self.close_later()

    def close_later(self) -> None:
        """Closing takes the observer away that FreeCAD is calling just now."""
        QtCore.QTimer.singleShot(0, self.close)

    def take_away(self) -> None:
        """Undo what the dock has done to the view; for each kind to say."""
        raise NotImplementedError

    def forget(self, document_too: bool) -> None:
        """Leave alone what is gone with the object, or with its document; for each kind to say."""
        raise NotImplementedError


def docks_of(kind: type[_Dock]) -> list[_Dock]:
    """Those of a kind that are open."""
    found = Gui.getMainWindow().findChildren(QtWidgets.QDockWidget, kind.NAME)
    return [dock for dock in found if isinstance(dock, kind) and dock.is_up]


def close_docks(kind: type[_Dock], obj: App.DocumentObject | None = None) -> bool:
    """Close those of a kind, or those of an object only; returns whether there were any."""
    shown = [dock for dock in docks_of(kind) if obj is None or dock.shows(obj)]
    for dock in shown:
        dock.close()
    return bool(shown)
