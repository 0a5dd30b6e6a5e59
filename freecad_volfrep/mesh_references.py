# SPDX-License-Identifier: LGPL-2.1-or-later
"""A mesh that Python has read outlives its object, so that FreeCAD 1.1 can be quit.

A mesh object keeps the Python object that it gave out for its mesh, and lets go of it when it is
destroyed. FreeCAD 1.1 does not hold the interpreter's lock then if a window's event destroys it:
quitting, or an old step of the undo stack. Python 3.14 ends with a segmentation fault where that is
the last reference (docs/upstream/freecad_mesh_quit.md). So another one is held from before the
object goes until after, when it is let go of with the lock held. That holds whoever has read the
mesh: we, an expression, another workbench or the Python console.

Registered at FreeCAD's start: nothing here costs time before an object or a document goes.
"""

from __future__ import annotations

import sys
from typing import Any

import FreeCAD as App

_KIND = "Mesh::Feature"

_keeper: Keeper | None = None


class Keeper:
    """Holds the meshes of what FreeCAD is about to destroy.

    A deleted object lives on in the undo stack, so the end of a mesh is not told: it has come when
    nobody but us refers to it.
    """

    def __init__(self) -> None:
        self.held: list[Any] = []
        alone = [object()]
        self._alone = next(sys.getrefcount(one) for one in alone)

    def slotDeletedObject(self, obj: Any) -> None:  # noqa: N802
        """An object is about to go, or to become a step that can be undone."""
        self.release()
        if obj.isDerivedFrom(_KIND):
            self.held.append(obj.Mesh)
            self._release_later()

    def slotDeletedDocument(self, doc: Any) -> None:  # noqa: N802
        """A document with all its objects is about to go."""
        self.release()
        self.held += [obj.Mesh for obj in doc.findObjects(_KIND)]
        if self.held:
            self._release_later()

    def release(self) -> None:
        """Let go of the meshes whose objects are gone."""
        self.held = [mesh for mesh in self.held if sys.getrefcount(mesh) > self._alone]

    def _release_later(self) -> None:
        """Once FreeCAD is through; after its window's end that never comes, nor has it to."""
        if App.GuiUp:
            from PySide import QtCore

            QtCore.QTimer.singleShot(0, self.release)


def hold_meshes() -> None:
    """Hold every mesh that goes from now on until its object is gone."""
    global _keeper
    if _keeper is None:
        _keeper = Keeper()
        App.addDocumentObserver(_keeper)
