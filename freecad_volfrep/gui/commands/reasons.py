# SPDX-License-Identifier: LGPL-2.1-or-later
"""Why a command is greyed: its tips say so while it is."""

from __future__ import annotations

from typing import Any

import FreeCADGui as Gui

#: What stands before the reason in the tip of a button, and in that of the status bar.
IN_TIP, IN_STATUS = "<br><b>\u2192 ", " \u2192 "
_END = "</b>"


def tell_why(name: str, why: str) -> None:
    """Put a reason behind what a command's tips say, or take it away again.

    FreeCAD sets both tips anew when the language or a shortcut changes, so what they say now is
    looked at every time.

    Args:
        name: of the command.
        why: it cannot be used now; empty where it can.
    """
    command = Gui.Command.get(name)
    if command is not None:  # FreeCAD asks before it knows the command by its name
        for action in command.getAction():
            _tell(action, why)


def tell_in_group(name: str, reasons: list[str]) -> None:
    """Grey the entries of a drop-down that cannot be used now, and put the reasons behind its tips.

    Args:
        name: of the group.
        reasons: why its commands cannot be used, in its order; empty where they can.
    """
    command = Gui.Command.get(name)
    if command is None:
        return
    for action, why in zip(command.getAction(), reasons, strict=False):
        if action.isEnabled() == bool(why):
            action.setEnabled(not why)
        _tell(action, why)


def _tell(action: Any, why: str) -> None:
    tip, status = action.toolTip(), action.statusTip()
    wanted = tip.partition(IN_TIP)[0] + (f"{IN_TIP}{why}{_END}" if why else "")
    if tip != wanted:
        action.setToolTip(wanted)
    wanted = status.partition(IN_STATUS)[0] + (f"{IN_STATUS}{why}" if why else "")
    if status != wanted:
        action.setStatusTip(wanted)
