# SPDX-License-Identifier: LGPL-2.1-or-later
"""The box that asks which coupons there are to be, and makes them."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.export.coupons import add_coupons, coupons_of, write_coupons
from freecad_volfrep.gui.messages import errors_shown, tell_written
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate

_CONTEXT = "VolfrepCoupons"
#: What a line's frame and margins take beside its text, px.
_MARGINS = 20
#: The kinds, and what they are.
KINDS = {
    "cube": QT_TRANSLATE_NOOP("VolfrepCoupons", "Cube between plates, for compression"),
    "tension": QT_TRANSLATE_NOOP("VolfrepCoupons", "Bar with grips, for tension"),
    "bending": QT_TRANSLATE_NOOP("VolfrepCoupons", "Beam, for bending on three points"),
    "ladder": QT_TRANSLATE_NOOP("VolfrepCoupons", "Ladder of struts, whose diameters are measured"),
}


class CouponBox(QtWidgets.QDialog):  # type: ignore[misc]
    """Asks for kinds, the cube's cells, the first number, and a folder for files."""

    def __init__(self) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepCouponBox")
        self.setWindowTitle(translate("VOLFREP_Coupons", "Coupons"))
        column = QtWidgets.QVBoxLayout(self)
        self._ticks = {}
        for kind, text in KINDS.items():
            tick = QtWidgets.QCheckBox(translate(_CONTEXT, text))
            tick.setObjectName(kind)
            tick.setChecked(True)
            tick.toggled.connect(lambda _: self._look())
            column.addWidget(tick)
            self._ticks[kind] = tick
        rows = QtWidgets.QFormLayout()
        self._cells, self._first = QtWidgets.QSpinBox(), QtWidgets.QSpinBox()
        self._cells.setRange(1, 20)
        self._cells.setValue(4)
        self._first.setRange(0, 9999)
        self._first.setValue(1)
        self._folder = QtWidgets.QLineEdit()
        nowhere = translate(_CONTEXT, "none: into the document only")
        self._folder.setPlaceholderText(nowhere)
        room = self._folder.fontMetrics().boundingRect(nowhere).width()
        self._folder.setMinimumWidth(room + _MARGINS)
        look = QtWidgets.QToolButton()
        look.setText("...")
        look.clicked.connect(lambda _=False: self._ask())
        line = QtWidgets.QHBoxLayout()
        line.addWidget(self._folder, 1)
        line.addWidget(look)
        for name, field, text in (
            ("Cells", self._cells, translate(_CONTEXT, "Cells along the cube")),
            ("First", self._first, translate(_CONTEXT, "Number of the first")),
            ("Folder", self._folder, translate(_CONTEXT, "Folder for STL files")),
        ):
            field.setObjectName(name)
            field.setAccessibleName(text)
            rows.addRow(QtWidgets.QLabel(text), line if field is self._folder else field)
        column.addLayout(rows)
        self._buttons = QtWidgets.QDialogButtonBox(
            QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel
        )
        column.addWidget(self._buttons)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)

    def wanted(self) -> dict[str, Any]:
        """What was asked for, by the names of `coupons_of`."""
        return {
            "kinds": [kind for kind, tick in self._ticks.items() if tick.isChecked()],
            "cells": self._cells.value(),
            "first": self._first.value(),
        }

    @property
    def folder(self) -> str:
        """Where files go; empty for nowhere."""
        return str(self._folder.text().strip())

    def _look(self) -> None:
        is_any = any(tick.isChecked() for tick in self._ticks.values())
        self._buttons.button(QtWidgets.QDialogButtonBox.Ok).setEnabled(is_any)

    def _ask(self) -> None:
        path = QtWidgets.QFileDialog.getExistingDirectory(
            self, translate(_CONTEXT, "Folder for STL files"), self.folder
        )
        if path:
            self._folder.setText(path)


def ask_and_make(infill: App.DocumentObject) -> None:
    """Ask which coupons of an infill's lattice there are to be, and make them: one undo step."""
    box = CouponBox()
    done = box.exec_() == QtWidgets.QDialog.Accepted
    wanted, folder = box.wanted(), box.folder
    box.deleteLater()
    if not done:
        return
    doc = infill.Document
    with errors_shown(box=True):
        made = coupons_of(infill, **wanted)
        with undo_step(doc, translate("VOLFREP_Coupons", "Coupons")):
            add_coupons(infill, made)
            doc.recompute()
        Gui.SendMsgToActiveView("ViewFit")
        if folder:
            for path in write_coupons(made, folder):
                tell_written(path)
