# SPDX-License-Identifier: LGPL-2.1-or-later
"""Why a command is greyed: its tips say so while it is."""

from __future__ import annotations

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
    if command is None:
        return  # FreeCAD asks before it knows the command by its name
    for action in command.getAction():
        tip, status = action.toolTip(), action.statusTip()
        wanted = tip.partition(IN_TIP)[0] + (f"{IN_TIP}{why}{_END}" if why else "")
        if tip != wanted:
            action.setToolTip(wanted)
        wanted = status.partition(IN_STATUS)[0] + (f"{IN_STATUS}{why}" if why else "")
        if status != wanted:
            action.setStatusTip(wanted)
