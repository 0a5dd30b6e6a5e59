# SPDX-License-Identifier: LGPL-2.1-or-later
"""The door to every command that uses an infill's mesh: what to do where that is out of date."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.infill.freshness import why_stale
from freecad_volfrep.gui.messages import tell_error
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import translate

from .updating import begin_update

#: Whether a mesh that is waited for has come is looked at so often, ms.
TICK = 100


def when_fresh(selected: Any, act: Callable[[Any], None], can_be_stale: bool) -> None:
    """Do something with infills; where a mesh is out of date, ask before.

    A mesh that is being made is waited for. It, and one that is to be recomputed first, comes
    while the user goes on, and then it is done.

    Args:
        selected: an object, or several; those that are no lattice infills count as they are.
        act: what is to be done with it.
        can_be_stale: whether that can be done with the mesh as it is.
    """
    objects = selected if isinstance(selected, list) else [selected]
    stale = [(obj, why) for obj in objects if (why := why_stale(obj))]
    if not stale:
        act(selected)
        return
    if all(_is_coming(obj) for obj, _ in stale):
        _wait_for([obj for obj, _ in stale], lambda: act(selected))
        return
    answer = _ask([obj.Label for obj, _ in stale], stale[0][1], can_be_stale)
    if answer == "as it is":
        act(selected)
    elif answer == "recompute":
        _recompute([obj for obj, _ in stale], lambda: act(selected))


def _is_coming(obj: App.DocumentObject) -> bool:
    """Whether the mesh of an infill's present values is being made."""
    job = obj.Proxy.job
    return job.is_under_way and not obj.Proxy.differs(obj, job)


def _wait_for(infills: list[App.DocumentObject], then: Callable[[], None]) -> None:
    """Go on once the meshes that are being made are there; a cancel ends the wait."""

    def look() -> None:
        with suppress(ReferenceError):  # deleted meanwhile
            if any(obj.Proxy.job.is_under_way for obj in infills):
                QtCore.QTimer.singleShot(TICK, look)
            elif not any(why_stale(obj) for obj in infills):
                then()

    text = translate("VolfrepFreshness", "Comes once the mesh is there")
    Gui.getMainWindow().statusBar().showMessage(text)
    QtCore.QTimer.singleShot(TICK, look)


def _ask(labels: list[str], why: str, can_be_stale: bool) -> str:
    """What the user wants: ``recompute``, ``as it is``, or nothing."""
    role = QtWidgets.QMessageBox
    text = translate("VolfrepFreshness", "The mesh of {labels} is out of date: {why}.").format(
        labels=", ".join(f"'{label}'" for label in labels),
        why=translate("VolfrepFreshness", why),
    )
    box = role(role.Warning, "VOLFREP", text, role.NoButton, Gui.getMainWindow())
    buttons = {
        box.addButton(translate("VolfrepFreshness", "Recompute first"), role.AcceptRole):
            "recompute"
    }  # fmt: skip
    if can_be_stale:
        as_it_is = translate("VolfrepFreshness", "Use it as it is")
        buttons[box.addButton(as_it_is, role.DestructiveRole)] = "as it is"
    box.addButton(role.Cancel)
    box.setDefaultButton(next(iter(buttons)))
    box.exec_()
    chosen = box.clickedButton()
    answer = next((name for button, name in buttons.items() if button == chosen), "")
    box.deleteLater()
    return answer


def _recompute(infills: list[App.DocumentObject], then: Callable[[], None]) -> None:
    """Make the meshes of infills, one after the other, and go on where all are there."""
    if not infills:
        QtCore.QTimer.singleShot(0, then)  # not inside what brings the mesh
        return
    obj, *others = infills

    def ended(is_there: bool | None) -> None:
        if is_there:
            _recompute(others, then)

    if begin_update(obj, ended=ended) is not None:
        return
    why = why_stale(obj)
    if why:
        tell_error(f"{obj.Label}: {localise(obj.Status)}")
    else:
        _recompute(others, then)
