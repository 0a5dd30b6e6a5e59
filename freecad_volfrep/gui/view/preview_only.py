# SPDX-License-Identifier: LGPL-2.1-or-later
"""Previews of infills that nobody edits: shown and taken away by a command, no mesh is made."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.infill.properties import INPUTS
from freecad_volfrep.gui.messages import tell, tell_error
from freecad_volfrep.gui.qt import QtCore
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

from .preview_thread import PreviewThread
from .preview_view import PreviewView

if TYPE_CHECKING:
    from .preview_thread import ReadyPreview

#: The preview waits until no value has changed for so long, ms.
SETTLED = 200

_previews: dict[tuple[str, str], _Preview] = {}
_observer: _Observer | None = None


def toggle_preview(obj: App.DocumentObject) -> bool:
    """Show the preview of an infill, or take it away; returns whether one is on its way now.

    While it is shown it follows the values; a new mesh ends it. Where values make no sense, or do
    not fit the solid, that is told and nothing is shown.
    """
    global _observer
    if end_preview(obj):
        return False
    preview = _Preview(obj)
    _previews[_key(obj)] = preview
    if _observer is None:
        _observer = _Observer()
        App.addDocumentObserver(_observer)
    return True


def end_preview(obj: App.DocumentObject) -> bool:
    """Take away the preview of an infill; returns whether there was one."""
    preview = _previews.pop(_key(obj), None)
    if preview is None:
        return False
    preview.end()
    return True


def _key(obj: App.DocumentObject) -> tuple[str, str]:
    return obj.Document.Name, obj.Name


class _Preview:
    """One infill's struts in the 3D view, in the place of the infill and its solid."""

    def __init__(self, obj: App.DocumentObject) -> None:
        self.obj = obj
        self._previews = PreviewThread(obj)
        self._view = PreviewView(obj)
        self._doc = obj.Document
        self._was_visible: dict[str, bool] = {}
        self._timer = QtCore.QTimer()
        self._timer.setSingleShot(True)
        self._timer.timeout.connect(self._refresh)
        self._timer.start(0)

    def changed(self) -> None:
        """Show the new values once no other has changed for a moment."""
        self._timer.start(SETTLED)

    def end(self, but: str = "") -> None:
        """Show again what was shown before, but for an object that is being deleted."""
        self.forget()
        for name, visible in self._was_visible.items():
            part = self._doc.getObject(name)
            if part is not None and name != but:
                part.Visibility = visible

    def forget(self) -> None:
        """Take the struts away; the document may be gone."""
        self._timer.stop()
        self._previews.drop()
        self._view.remove()

    def _refresh(self) -> None:
        self._previews.ask(self._show, self._refuse)

    def _show(self, ready: ReadyPreview) -> None:
        """In the place of the infill and its solid."""
        is_first = not self._was_visible
        if is_first:
            parts = [part for part in (self.obj, self.obj.Base) if part is not None]
            self._was_visible = {part.Name: part.Visibility for part in parts}
            for part in parts:
                part.Visibility = False
        ready.show_in(self._view)
        App.Console.PrintMessage(f"VOLFREP, {self.obj.Label}, preview only:\n{ready.shown.text}\n")
        if is_first:
            said = translate(
                "VolfrepCommands", "{label}: preview shown, figures in the report view"
            )
            tell(said.format(label=self.obj.Label))

    def _refuse(self, error: VolfrepError) -> None:
        tell_error(str(error))
        self._view.show_solid_only()
        if not self._was_visible:
            end_preview(self.obj)


class _Observer:
    """Hears from FreeCAD what changes while previews are shown."""

    def slotChangedObject(self, obj: Any, name: str) -> None:  # noqa: N802
        """New values, a new solid: followed. A new mesh: the preview has served."""
        for preview in list(_previews.values()):
            if preview.obj is obj and name == "Mesh":
                # Not inside the recompute that makes it.
                QtCore.QTimer.singleShot(0, lambda obj=obj: end_preview(obj))
            elif (preview.obj is obj and name in INPUTS) or (
                obj is preview.obj.Base and name in ("Shape", "Mesh", "Placement")
            ):
                preview.changed()

    def slotDeletedObject(self, obj: Any) -> None:  # noqa: N802
        """The infill goes, and so does its preview."""
        preview = _previews.pop(_key(obj), None)
        if preview is not None:
            preview.end(but=obj.Name)

    def slotDeletedDocument(self, doc: Any) -> None:  # noqa: N802
        """The 3D view goes, and its previews with it."""
        for key in [key for key in _previews if key[0] == doc.Name]:
            _previews.pop(key).forget()
