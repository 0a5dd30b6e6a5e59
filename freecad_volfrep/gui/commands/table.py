# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of the workbench's commands, its toolbar and its menu.

Shortcuts begin with L and a letter that none of FreeCAD's own has after it.
"""

from __future__ import annotations

import FreeCADGui as Gui

from freecad_volfrep.gui.selection import (
    infill_in_view,
    infill_or_solid_in_view,
    infill_with_mesh,
    selected_infill,
    selected_infill_and_faces,
    selected_infill_or_study,
    selected_mesh,
    selected_or_all_infills,
)
from freecad_volfrep.translation import QT_TRANSLATE_NOOP

from .command import Command, CommandGroup
from .export_commands import analyse, export, make_solid_of
from .infill_commands import (
    browse_cells,
    edit_infill,
    fill_solids,
    fillable_selection,
    open_faces,
    preview_only,
    show_example,
    update_infill,
)
from .print_commands import (
    make_specimens,
    orient_part,
    slicer_infill,
    solid_or_slicer_infill,
)
from .result_commands import (
    check_print,
    colour_infill,
    open_help,
    report_mesh,
    show_beside,
    show_section,
    show_statistics,
    show_strut_results,
    size_lattice,
    study_designs,
)


def always() -> tuple[()]:
    """For commands that need no selection."""
    return ()


def _example(name: str, icon: str, text: str, tip: str) -> Command:
    return Command(
        f"VOLFREP_Example{name}", icon, text, tip, "", always, lambda _: show_example(name)
    )


_TABLE = (
    Command(
        "VOLFREP_LatticeInfill",
        "lattice_infill.svg",
        "Lattice Infill",
        "Make the selected solid light: a closed skin and a strut lattice inside",
        "L, F",
        fillable_selection,
        fill_solids,
    ),
    Command(
        "VOLFREP_Edit",
        "edit.svg",
        "Edit Lattice Infill",
        "Change the selected lattice infill in its panel, with a preview",
        "L, D",
        selected_infill,
        edit_infill,
    ),
    Command(
        "VOLFREP_PreviewOnly",
        "preview_only.svg",
        "Preview Only",
        "Show the struts of the selected lattice infill and their figures without making a mesh; "
        "once more takes them away",
        "L, W",
        infill_in_view,
        preview_only,
    ),
    Command(
        "VOLFREP_Update",
        "update.svg",
        "Update Lattice Infill",
        "Compute the selected lattice infill now, also with AutoUpdate off",
        "L, U",
        selected_infill,
        update_infill,
    ),
    Command(
        "VOLFREP_OpenFaces",
        "open_faces.svg",
        "Open Faces",
        "Select a lattice infill and faces of its solid: they get no skin",
        "L, O",
        selected_infill_and_faces,
        open_faces,
    ),
    Command(
        "VOLFREP_CellLibrary",
        "cell_library.svg",
        "Cell Library",
        "Browse the unit cells, load your own, make one of a sketch, and give it to a lattice "
        "infill",
        "L, C",
        always,
        browse_cells,
    ),
    Command(
        "VOLFREP_SlicerInfill",
        "slicer_infill.svg",
        "Slicer Infill",
        "Let a slicer print the selected solid with an infill that is denser where a field says: "
        "bands of density that follow the solid, for PrusaSlicer, OrcaSlicer and Bambu Studio",
        "L, G",
        solid_or_slicer_infill,
        slicer_infill,
    ),
    Command(
        "VOLFREP_Coupons",
        "coupons.svg",
        "Coupons",
        "Make specimens of the selected infill's lattice to print, press, pull and measure, "
        "numbered in relief",
        "L, K",
        selected_infill,
        make_specimens,
    ),
    Command(
        "VOLFREP_Orient",
        "orient.svg",
        "Build Direction",
        "Find how the selected lattice infill, or solid, is built with the least overhang and "
        "support, and turn it so",
        "L, J",
        infill_or_solid_in_view,
        orient_part,
        of_mesh="as it is",
    ),
    Command(
        "VOLFREP_CheckMesh",
        "check_mesh.svg",
        "Check Mesh",
        "Report on the selected mesh: closed, bodies, volume, angles, triangles that cross, and "
        "what a file keeps of it",
        "L, M",
        selected_mesh,
        report_mesh,
        of_mesh="as it is",
    ),
    Command(
        "VOLFREP_PrintCheck",
        "print_check.svg",
        "Print Check",
        "See what hangs over, is too thin or holds powder when the selected lattice infill is "
        "printed",
        "L, P",
        selected_infill,
        check_print,
        of_mesh="fresh",
    ),
    Command(
        "VOLFREP_SectionView",
        "section_view.svg",
        "Section View",
        "Cut the selected lattice open on the screen, along a plane that can be moved; the "
        "lattice itself stays whole",
        "L, N",
        selected_mesh,
        show_section,
    ),
    Command(
        "VOLFREP_SolidBeside",
        "solid_beside.svg",
        "Solid Beside",
        "Show the solid beside the selected lattice infill; once more takes it away",
        "L, Q",
        infill_in_view,
        show_beside,
    ),
    Command(
        "VOLFREP_ColourBy",
        "colour_by.svg",
        "Colour By",
        "Colour the selected lattice infill by radius, cell size, overhang, stress or another "
        "quantity, with a legend, and read off values with the mouse",
        "L, B",
        infill_with_mesh,
        colour_infill,
        of_mesh="fresh",
    ),
    Command(
        "VOLFREP_Statistics",
        "statistics.svg",
        "Statistics",
        "Tables of the selected lattice infills, or of all in the document: cells, struts, "
        "density, mass, times, memory",
        "L, T",
        selected_or_all_infills,
        show_statistics,
        of_mesh="as it is",
    ),
    Command(
        "VOLFREP_Export",
        "export.svg",
        "Export Lattice",
        "Write the selected lattice infill for the printer (STL, 3MF with or without beams, "
        "PLY, OBJ, layers), for CAD (STEP) or for CalculiX",
        "L, X",
        selected_mesh,
        export,
        of_mesh="as it is",
    ),
    Command(
        "VOLFREP_ToSolid",
        "to_solid.svg",
        "Lattice To Solid",
        "Make a Part solid of exact surfaces or of plane faces, links to its joints, or the "
        "struts' axes",
        "L, S",
        selected_mesh,
        make_solid_of,
        of_mesh="as it is",
    ),
    Command(
        "VOLFREP_FemAnalysis",
        "fem_analysis.svg",
        "FEM Analysis",
        "Make an analysis of the selected lattice infill for the FEM workbench, of beams or "
        "of tetrahedra, ready for constraints",
        "L, A",
        selected_infill,
        analyse,
        of_mesh="fresh",
    ),
    Command(
        "VOLFREP_SizeLattice",
        "size_lattice.svg",
        "Loads and Sizing",
        "Pick what holds and loads the selected lattice infill, or solid, and find the radii of "
        "its struts: least mass within limits, or most stiffness at a mass",
        "L, Z",
        infill_or_solid_in_view,
        size_lattice,
    ),
    Command(
        "VOLFREP_StrutResults",
        "strut_results.svg",
        "Strut Results",
        "Colour the struts of the selected lattice infill by radius, stress, buckling or "
        "displacement under the load cases of the FEM workbench",
        "L, R",
        infill_in_view,
        show_strut_results,
    ),
    Command(
        "VOLFREP_DesignStudy",
        "design_study.svg",
        "Design Study",
        "Try many values of the selected lattice infill's properties, see mass against stiffness, "
        "and give it the best",
        "L, Y",
        selected_infill_or_study,
        study_designs,
    ),
    Command(
        "VOLFREP_Help",
        "help.svg",
        "VOLFREP Help",
        "Read about every command, and a tutorial of five minutes",
        "L, H",
        always,
        open_help,
        computes=False,
    ),
    _example(
        "Bracket",
        "example_bracket.svg",
        "Bracket",
        "Open a bracket on four bolts, filled with a lattice, in a new document",
    ),
    _example(
        "PistonRod",
        "example_piston_rod.svg",
        "Piston Rod",
        "Open a piston rod, filled with a lattice, in a new document",
    ),
)
#: By their names.
COMMANDS = {command.name: command for command in _TABLE}
#: What the menu offers, part by part, and the toolbar in drop-downs where a part has a name.
PARTS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("", ("VOLFREP_LatticeInfill", "VOLFREP_Edit", "VOLFREP_Update")),
    (
        QT_TRANSLATE_NOOP("VOLFREP_MakeGroup", "Make"),
        (
            "VOLFREP_CellLibrary",
            "VOLFREP_OpenFaces",
            "VOLFREP_PreviewOnly",
            "VOLFREP_SlicerInfill",
            "VOLFREP_Coupons",
        ),
    ),
    (
        QT_TRANSLATE_NOOP("VOLFREP_LookGroup", "Look"),
        ("VOLFREP_SectionView", "VOLFREP_SolidBeside", "VOLFREP_ColourBy"),
    ),
    (
        QT_TRANSLATE_NOOP("VOLFREP_CheckGroup", "Check"),
        ("VOLFREP_PrintCheck", "VOLFREP_Orient", "VOLFREP_CheckMesh", "VOLFREP_Statistics"),
    ),
    (
        QT_TRANSLATE_NOOP("VOLFREP_LoadsGroup", "Loads"),
        (
            "VOLFREP_SizeLattice",
            "VOLFREP_StrutResults",
            "VOLFREP_FemAnalysis",
            "VOLFREP_DesignStudy",
        ),
    ),
    (QT_TRANSLATE_NOOP("VOLFREP_ExportGroup", "Export"), ("VOLFREP_Export", "VOLFREP_ToSolid")),
)
#: The drop-downs, by their names.
GROUPS = {
    name: CommandGroup(name, title, tuple(COMMANDS[one] for one in names))
    for title, names in PARTS
    if (name := f"VOLFREP_{title}Group") and title
}
#: The one toolbar: commands and drop-downs.
TOOLBAR = [*PARTS[0][1], *GROUPS]
#: The submenu of that name.
EXAMPLES = ["VOLFREP_ExampleBracket", "VOLFREP_ExamplePistonRod"]


def register_commands() -> None:
    """Make the commands known to FreeCAD."""
    for name, command in (COMMANDS | GROUPS).items():
        Gui.addCommand(name, command)


def applicable_commands() -> list[str]:
    """The commands of the toolbar that apply to the selection, for a context menu."""
    names = [name for _, names in PARTS for name in names]
    return [name for name in names if COMMANDS[name].IsActive()]
