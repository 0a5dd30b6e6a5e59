# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that look at what a lattice infill has come to: checks, figures, views, studies."""

from __future__ import annotations

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.features.jobs.job import State
from freecad_volfrep.features.reports.mesh_check import check_mesh
from freecad_volfrep.features.reports.print_check import make_print_check
from freecad_volfrep.features.reports.statistics import statistics
from freecad_volfrep.features.study.design_study import DesignStudy, make_design_study
from freecad_volfrep.gui.messages import errors_shown
from freecad_volfrep.gui.study.study_panel import open_study
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.gui.windows.help_window import show_help
from freecad_volfrep.gui.windows.report_window import show_report
from freecad_volfrep.sentences import localise_rows
from freecad_volfrep.translation import translate

from .infill_commands import make_suitable_infill


def check_print(infill: App.DocumentObject) -> None:
    """Show the overhanging facets in red on the infill, and what else a printer would mind."""
    doc = infill.Document
    with undo_step(doc, translate("VOLFREP_PrintCheck", "Print Check")):
        check = make_print_check(doc, infill)
        doc.recompute()
        cancelled = check.Proxy.state is State.CANCELLED
        if cancelled:
            doc.removeObject(check.Name)
    if cancelled:
        return
    if check.isValid():
        Gui.Selection.clearSelection()
        App.Console.PrintMessage(f"VOLFREP, {check.Label}:\n{localise_rows(check.Text)}\n")


def study_designs(obj: App.DocumentObject) -> None:
    """Open a design study; of an infill, make one first."""
    doc = obj.Document
    if not isinstance(obj.Proxy, DesignStudy):
        with undo_step(doc, translate("VOLFREP_DesignStudy", "Design Study")):
            obj = make_design_study(doc, obj)
            obj.recompute()
    open_study(obj)


def show_section(obj: App.DocumentObject) -> None:
    """Cut the object open on the screen."""
    from freecad_volfrep.gui.view.section_view import open_section

    open_section(obj)


def show_beside(infill: App.DocumentObject) -> None:
    """Show the solid beside its lattice, or take it away."""
    from freecad_volfrep.gui.view.solid_beside import toggle_beside

    with errors_shown():
        toggle_beside(infill)


def colour_infill(obj: App.DocumentObject) -> None:
    """Choose what an infill is coloured by."""
    from freecad_volfrep.gui.colours.colour_dock import open_colours

    open_colours(obj)


def report_mesh(obj: App.DocumentObject) -> None:
    """Look at a mesh and show what was found in a window."""
    with errors_shown():
        tables = check_mesh(obj)
        title = translate("VolfrepCommands", "Check Mesh: {label}").format(label=obj.Label)
        show_report(title, f"{obj.Label} check", tables)


def show_statistics(infills: list[App.DocumentObject]) -> None:
    """Show the figures of infills in a window."""
    name = infills[0].Label if len(infills) == 1 else infills[0].Document.Label
    with errors_shown():
        title = translate("VOLFREP_Statistics", "Statistics")
        show_report(title, f"{name} statistics", statistics(infills))


def size_lattice(obj: App.DocumentObject) -> None:
    """Open the panel in which an infill's struts are sized for the document's load cases.

    Args:
        obj: the infill, or a solid, which is given one with sizes that suit it.
    """
    from freecad_volfrep.features.infill.lattice_infill import is_infill
    from freecad_volfrep.gui.sizing.size_panel import SizePanel

    if is_infill(obj):
        with errors_shown():
            Gui.Control.showDialog(SizePanel(obj))
        return
    doc = App.ActiveDocument
    doc.openTransaction(translate("VOLFREP_SizeLattice", "Loads and Sizing"))
    with errors_shown():
        Gui.Control.showDialog(SizePanel(make_suitable_infill(doc, obj), is_new=True))
        return
    doc.abortTransaction()


def show_strut_results(infill: App.DocumentObject) -> None:
    """Solve an infill's struts for the document's load cases, and show them in colours."""
    from freecad_volfrep.features.sizing.as_built import printing_of
    from freecad_volfrep.features.sizing.sizing import solve_struts
    from freecad_volfrep.gui.colours.colour_dock import open_struts

    with errors_shown():
        printing = printing_of(infill)
        printed = "" if printing is None else printing.table.title
        open_struts(infill, solve_struts(infill), printed)


def open_help(_: object) -> None:
    """Open the window of help pages."""
    show_help()
