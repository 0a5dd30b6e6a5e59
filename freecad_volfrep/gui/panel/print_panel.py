# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panel's figures of what a printer will mind: a table, red where a limit is not kept."""

from __future__ import annotations

import html
from typing import TYPE_CHECKING

import FreeCAD as App

from freecad_volfrep.features.infill.materials import process_of
from freecad_volfrep.features.reports.print_figures import Row, print_rows
from freecad_volfrep.gui.messages import WRONG
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.widgets.panel_manners import fits_any_width
from freecad_volfrep.sentences import localise
from freecad_volfrep.translation import translate
from volfrep.util.errors import VolfrepError

if TYPE_CHECKING:
    from freecad_volfrep.features.infill.live_preview import Shown


class PrintFigures(QtWidgets.QLabel):
    """Rows of names and values."""

    def __init__(self) -> None:
        super().__init__()
        self.setObjectName("PrintFigures")
        self.setContentsMargins(6, 2, 6, 4)
        fits_any_width(self)

    def tell(self, obj: App.DocumentObject, shown: Shown) -> None:
        """Show the figures of a preview, and what to choose where no process gives limits."""
        try:
            lines = [_line(row) for row in print_rows(obj, shown)]
            has_limits = process_of(obj) is not None
        except VolfrepError as error:
            self.setText(html.escape(localise(str(error))))
            return
        if not has_limits:
            hint = translate("VolfrepFigures", "Choose a process to see its limits.")
            lines.append(f"<i>{html.escape(hint)}</i>")
        self.setText("<br>".join(lines))

    def show_none(self) -> None:
        """Where nothing is known."""
        self.setText(translate("VolfrepFigures", "Told by Print Check, once computed."))


def _line(row: Row) -> str:
    value = html.escape(row.value)
    if not row.is_kept:
        value = f'<span style="{WRONG}"><b>\u26a0 {value}</b></span>'
    return f"{html.escape(row.name)}: {value}"
