# SPDX-License-Identifier: LGPL-2.1-or-later
"""The box that asks for a file's limits, and for the printer that its struts are drawn for."""

from __future__ import annotations

from typing import Any

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.widgets.printed_table import PrintedTableFields
from freecad_volfrep.translation import figure, grouped, translate
from volfrep.design.file_limits import SERVICES, FileLimits

#: The most that the fields take.
_MOST_TRIANGLES, _MOST_MEGABYTES = 1_000_000_000, 100_000.0
_WIDTH = 460
_CONTEXT = "VolfrepPrinterFile"


class PrinterBox(QtWidgets.QDialog):  # type: ignore[misc]
    """Asks for limits and a printer; its OK is off while neither is given.

    Args:
        obj: the infill that is written.
    """

    def __init__(self, obj: App.DocumentObject) -> None:
        super().__init__(Gui.getMainWindow())
        self.setObjectName("VolfrepPrinterBox")
        self.setWindowTitle(translate("VOLFREP_Export", "Export Lattice"))
        rows = QtWidgets.QFormLayout(self)
        present = translate(_CONTEXT, "The mesh has {triangles} triangles, {size} MB as STL.")
        count = obj.Mesh.CountFacets
        rows.addRow(
            QtWidgets.QLabel(
                present.format(triangles=grouped(count), size=figure((84 + 50 * count) / 1e6, 3))
            )
        )
        self._service = QtWidgets.QComboBox()
        self._service.addItem(translate(_CONTEXT, "My own limits"), "")
        for name, row in SERVICES.items():
            self._service.addItem(f"{row.name}: {_said(row.limits)}", name)
        self._triangles = QtWidgets.QSpinBox()
        self._triangles.setRange(0, _MOST_TRIANGLES)
        self._triangles.setSingleStep(100_000)
        self._triangles.setGroupSeparatorShown(True)
        self._megabytes = QtWidgets.QDoubleSpinBox()
        self._megabytes.setRange(0.0, _MOST_MEGABYTES)
        self._megabytes.setDecimals(1)
        self._megabytes.setSuffix(" MB")
        for spin in (self._triangles, self._megabytes):
            spin.setSpecialValueText(translate(_CONTEXT, "no limit"))
        self._printed = PrintedTableFields(self._look)
        for name, field, text in (
            ("Service", self._service, translate(_CONTEXT, "Service")),
            ("Triangles", self._triangles, translate(_CONTEXT, "Most triangles")),
            ("Megabytes", self._megabytes, translate(_CONTEXT, "Largest file")),
            ("Printer", self._printed.choice, translate(_CONTEXT, "Drawn for the printer")),
            ("Table", self._printed.file, translate(_CONTEXT, "Table")),
        ):
            field.setObjectName(name)
            field.setAccessibleName(text)
            rows.addRow(QtWidgets.QLabel(text), field)
        self._note = QtWidgets.QLabel()
        self._note.setObjectName("Note")
        self._note.setWordWrap(True)
        self._note.setMinimumSize(_WIDTH, 4 * self._note.fontMetrics().lineSpacing())
        rows.addRow(self._note)
        self._buttons = QtWidgets.QDialogButtonBox(
            QtWidgets.QDialogButtonBox.Ok | QtWidgets.QDialogButtonBox.Cancel
        )
        rows.addRow(self._buttons)
        self._buttons.accepted.connect(self.accept)
        self._buttons.rejected.connect(self.reject)
        self._service.currentIndexChanged.connect(lambda _: self._take_limits())
        for spin in (self._triangles, self._megabytes):
            spin.valueChanged.connect(lambda _: self._look())
        self._look()

    def wanted(self) -> dict[str, Any]:
        """What was asked for, by the names of `printer_file.export_for_printer`."""
        return {
            "max_triangles": self._triangles.value() or None,
            "max_size": self._megabytes.value() or None,
            "compensate": self._printed.wanted or None,
        }

    def _take_limits(self) -> None:
        """Those of the service, which the user may still change."""
        name = self._service.currentData()
        if name:
            limits = SERVICES[name].limits
            self._triangles.setValue(limits.triangles or 0)
            self._megabytes.setValue(limits.megabytes or 0.0)
        self._look()

    def _look(self) -> None:
        """Say where the limits and the diameters come from; OK where there are any."""
        service, table = self._service.currentData(), self._printed.published
        said = []
        if service:
            row = SERVICES[service]
            said.append(
                translate(_CONTEXT, "Limits: {source}, read {date}; they may have changed.").format(
                    source=row.source, date=row.read
                )
            )
        if table is not None:
            sources = {row.source.split("; ", 1)[-1] for row in table.rows}
            said.append(
                translate(_CONTEXT, "Diameters: {source}. Yours may differ: print coupons.").format(
                    source="; ".join(sorted(sources))
                )
            )
        self._note.setText("\n".join(said))
        self._printed.file.setEnabled(self._printed.is_own)
        has_any = any(self.wanted().values())
        self._buttons.button(QtWidgets.QDialogButtonBox.Ok).setEnabled(has_any)


def _said(limits: FileLimits) -> str:
    """Limits in the user's words."""
    said = []
    if limits.triangles is not None:
        text = translate(_CONTEXT, "{count} triangles")
        said.append(text.format(count=grouped(limits.triangles)))
    if limits.megabytes is not None:
        said.append(f"{figure(limits.megabytes, 4)} MB")
    return ", ".join(said)


def ask_for_printer(obj: App.DocumentObject) -> dict[str, Any] | None:
    """Limits and printer that the user picks, as `export_for_printer` takes them; None for none."""
    box = PrinterBox(obj)
    done = box.exec_() == QtWidgets.QDialog.Accepted
    wanted = box.wanted()
    box.deleteLater()
    return wanted if done else None
