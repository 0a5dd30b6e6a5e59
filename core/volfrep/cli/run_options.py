# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of what is said to a run beside the lattice: files, forms, limits. A new one is a row.

Commands, what they read and write, and docs/reference.md follow from it, as the lattice's options
do from `design.parameters`. Read without numpy, so that ``--help`` answers at once. It is long
because every option of every command is a row of one table.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..design.banded_words import GRADINGS, PATTERNS, SLICERS
from ..design.file_limits import SERVICES
from ..design.parameters.recipes import RECIPES
from ..output.form import suffixes, suffixes_of, words
from ..util.errors import VolfrepError, listed
from .parser import numbers, shard, three_numbers, three_whole_numbers

MESHED = ("fill", "block", "network")
FITTED = ("fill", "block")
LIMITED = (*MESHED, "size")
LATTICE = (*MESHED, "slice", "size")
SPEC_GROUP = "a whole specification"
MATERIAL_GROUP = "what it is printed of, and how"
LIMITS_GROUP = "limits of the file"
FORM_GROUP = "files for CAD and for a solver"
GOAL_GROUP = "what is wanted: limits for the least mass, or the most stiffness at a mass"
DENSITY_GROUP = "density of the infill"
PRINT_GROUP = "how the slicer is to print; its own settings count for all else"
SIZED_PICTURE_GROUP = "a picture of it"


@dataclass(frozen=True)
class RunOption:
    """A row of the table.

    Attributes:
        name: the option without its hyphens.
        commands: that have it.
        help: one phrase.
        shape: how its value is written; empty for a switch.
        group: its title in the command's help; empty for the first one.
        read: what its text becomes.
        default: what holds where it is not given.
        choices: the words that it takes.
        required: whether it must be given.
        reads: what the command calls the file that it names and that is read.
        writes: the same, of a file that is written.
        extensions: of the output, without which it has no effect; empty for any.
        place: where its value is kept, if not by its name.
        either: of options with the same word here at most one is given, or just one if they are
            required.
        short: another name, of one letter or a word.
    """

    name: str
    commands: tuple[str, ...]
    help: str
    shape: str = ""
    group: str = ""
    read: Callable[[str], Any] | None = None
    default: Any = None
    choices: tuple[str, ...] = ()
    required: bool = False
    reads: str = ""
    writes: str = ""
    extensions: tuple[str, ...] = ()
    place: str = ""
    either: str = ""
    short: str = ""

    @property
    def option(self) -> str:
        """As it is typed."""
        return f"--{self.name}"

    @property
    def names(self) -> tuple[str, ...]:
        """All its names as they are typed."""
        hyphens = "-" * min(len(self.short), 2)
        return (hyphens + self.short, self.option) if self.short else (self.option,)

    @property
    def stored(self) -> str:
        """The attribute that holds its value."""
        return self.place or self.name.replace("-", "_")


RUN_OPTIONS = (
    RunOption(
        "output", MESHED, f"what to write: {listed(suffixes())}",
        "FILE", required=True, writes="output", short="o",
    ),
    RunOption(
        "output", ("size",),
        f"the part with its sized lattice: {listed(suffixes(meshes=True))}",
        "FILE", required=True, writes="output", short="o",
    ),
    RunOption(
        "output", ("slice",), "of layers, which replace those of the last run",
        "FOLDER", required=True, writes="output", short="o",
    ),
    RunOption(
        "output", ("solve",),
        "displacements and stress as .vtu for ParaView, or the figures as .json",
        "FILE", writes="output", short="o",
    ),
    RunOption(
        "output", ("orient",), "the part turned, with its lowest place at z = 0",
        "FILE", writes="output", short="o",
    ),
    RunOption(
        "output", ("homogenise",),
        "displacements and stress as .vtu for ParaView, the figures as .json, or a CalculiX deck "
        "as .inp",
        "FILE", writes="output", short="o",
    ),
    RunOption(
        "output", ("sweep",),
        "of records, table and page; what is done is not done again",
        "FOLDER", required=True, short="o",
    ),
    RunOption(
        "output", ("infill",), "the slicer's project", "FILE.3mf", required=True, writes="output",
        short="o",
    ),
    RunOption(
        "output", ("coupon",), "for the specimens, the ladder's table to fill in, and coupons.json",
        "FOLDER", required=True, writes="output", short="o",
    ),
    RunOption(
        "output", ("crush",), "the curve: strain, stress in MPa", "FILE.csv", writes="output",
        short="o",
    ),
    RunOption(
        "kinds", ("coupon",),
        "with commas: cube (between plates), tension (a bar with grips), bending (three points), "
        "ladder (single struts over diameter and inclination)",
        "WORDS", default="cube,tension,bending,ladder",
    ),
    RunOption("cells", ("coupon",), "along the cube's edge (default 4)", "N", read=int, default=4),
    RunOption("cells", ("crush",), "along the block's edges (default 3)", "N", read=int, default=3),
    RunOption(
        "strain", ("crush",), "how far the plate goes, over the block's height (default 0.3)", "S",
        read=float, default=0.3,
    ),
    RunOption("number", ("coupon",), "of the first one (default 1)", "N", read=int, default=1),
    RunOption(
        "diameters", ("coupon",), "of the ladder (default 0.4,0.6,0.8,1,1.5)", "MM,...",
        read=numbers, default=(0.4, 0.6, 0.8, 1.0, 1.5),
    ),
    RunOption(
        "inclinations", ("coupon",), "of the ladder (default 0,30,45,60,90)", "DEGREES,...",
        read=numbers, default=(0.0, 30.0, 45.0, 60.0, 90.0),
    ),
    RunOption(
        "format", ("coupon",), "of the specimens (default stl)", "WORD", choices=("stl", "3mf"),
        default="stl",
    ),
    RunOption("entry", ("cells",), "the cell of the catalogue", "NAME"),
    RunOption(
        "output", ("cells",), "a cell file of it", "FILE.json", writes="output", short="o",
    ),
    RunOption(
        "unit", ("fill", "slice", "infill", "size", "solve", "homogenise", "orient", "check"),
        "of the file's lengths: mm, cm, m, inch, ft or um (default: what the file says, else mm)",
        "UNIT",
    ),
    RunOption(
        "count", ("block",), "cells along x, y and z", "NX,NY,NZ",
        read=three_whole_numbers, required=True,
    ),
    RunOption(
        "spec", (*LATTICE, "coupon", "homogenise"),
        f"read a specification, or one to start from by its name "
        f"({', '.join(RECIPES)}); options override its entries",
        "FILE.toml|NAME", SPEC_GROUP, reads="specification",
    ),
    RunOption(
        "write-spec", LATTICE, "write the specification in force",
        "FILE.toml", SPEC_GROUP, writes="written specification",
    ),
    RunOption(
        "report", MESHED, "write the figures of the run as JSON", "FILE.json", writes="report",
    ),
    RunOption(
        "report", ("size",), "write the figures, or a page to print",
        "FILE.json|html", writes="report",
    ),
    RunOption(
        "report", ("solve", "orient", "homogenise"), "write the figures as JSON",
        "FILE.json", writes="report",
    ),
    RunOption(
        "max-triangles", LIMITED,
        "coarser facets, where the file would have more; the cost is told",
        "N", LIMITS_GROUP, int,
    ),
    RunOption(
        "max-size", LIMITED, "the same, where the file would be larger", "MB", LIMITS_GROUP, float,
    ),
    RunOption(
        "service", LIMITED,
        f"both, as a service takes them: {', '.join(row.name for row in SERVICES.values())}",
        "NAME", LIMITS_GROUP,
    ),
    RunOption(
        "picture", MESHED, "write a picture, cut open (needs pyvista)",
        "FILE.png", writes="picture",
    ),
    RunOption(
        "3mf", MESHED,
        "what a 3MF file holds: the part as triangles (default), its lattice as beams (small, "
        "made without a mesh), or both",
        "WORD", choices=words("3mf"), extensions=suffixes_of("3mf"), place="threemf",
    ),
    RunOption(
        "step", MESHED,
        "what a .step file holds: a plane face for every triangle (default), exact cylinders, "
        "cones and spheres (by an installed FreeCAD), or the struts' axes",
        "WORD", FORM_GROUP, choices=words("step"), extensions=suffixes_of("step"),
    ),
    RunOption(
        "inp", MESHED,
        "what an .inp file for CalculiX holds: struts as beams with stiff ends (default), or the "
        "part as second-order tetrahedra by Gmsh",
        "WORD", FORM_GROUP, choices=words("inp"),
        extensions=suffixes_of("inp"),
    ),
    RunOption(
        "material", MESHED,
        "a name in docs/cells.md, or a .toml or .json file: its density gives the mass, its "
        "modulus goes into an .inp file, for which NAME,E,NU in MPa will do (default "
        "PETG,2100,0.38)",
        "M", MATERIAL_GROUP, reads="material file",
    ),
    RunOption(
        "material", ("slice", "infill", "coupon"),
        "a name in docs/cells.md, or a .toml or .json file: its density gives the mass",
        "M", reads="material file",
    ),
    RunOption(
        "material", ("solve",),
        "in place of the load file's: a name in docs/cells.md, a .toml or .json file, or "
        "NAME,E,NU in MPa",
        "M", reads="material file",
    ),
    RunOption(
        "material", ("properties", "find"),
        "of the solid: a name in docs/cells.md, a .toml or .json file, or NAME,E,NU; without "
        "one, figures are in units of the solid's",
        "M", reads="material file",
    ),
    RunOption(
        "material", ("crush",),
        "of the struts: a name in docs/cells.md, a .toml or .json file, or NAME,E,NU; one without "
        "a yield stress stays elastic",
        "M", required=True, reads="material file",
    ),
    RunOption(
        "process", MESHED,
        "FFF, SLA, SLS, MJF, LPBF or EBM: adds its print report where there is a mesh, and says if "
        "it does not print the material",
        "P", MATERIAL_GROUP,
    ),
    RunOption(
        "process", ("size",),
        "FFF, SLA, SLS, MJF, LPBF or EBM: struts as thick and as steep to the build plate as it "
        "builds them, where limits allow, along the part's best axis without --build-direction; "
        "adds its print report",
        "P", GOAL_GROUP,
    ),
    RunOption(
        "process", ("orient",),
        "FFF, SLA, SLS, MJF, LPBF or EBM: the inclination that needs no support is its", "P",
    ),
    RunOption(
        "inclination", ("orient",),
        "least angle of a facet to the build plate that needs no support, in degrees (default 45)",
        "DEG", read=float,
    ),
    RunOption(
        "best", ("orient",), "directions that are told (default 5)", "N", read=int, default=5,
    ),
    RunOption(
        "take", ("orient",), "which of them the output is turned to (default 1)", "N", read=int,
        default=1,
    ),
    RunOption(
        "as-printed", FITTED,
        "thickness of struts as printed, by a table (LPBF-Ti64, LPBF-316L, SLS-PA12) or a .csv "
        "file of inclination, nominal, measured; the print report is of these",
        "TABLE", MATERIAL_GROUP, reads="table of printed diameters",
    ),
    RunOption(
        "as-printed", ("size",),
        "stress, stiffness and mass of struts as printed, by a table as of fill; radii are "
        "written as drawn",
        "TABLE", GOAL_GROUP, reads="table of printed diameters",
    ),
    RunOption(
        "scatter", ("size",),
        "struts thinner by so many of that table's standard deviations, for stress and buckling "
        "(default 0)",
        "N", GOAL_GROUP, float, 0.0,
    ),
    RunOption(
        "as-printed", ("properties",),
        "of struts as printed, by a table as of fill: of the one radius that takes the volume of "
        "all",
        "TABLE", reads="table of printed diameters",
    ),
    RunOption(
        "build-direction", ("properties",), "from the build plate up (default 0,0,1)", "X,Y,Z",
        read=three_numbers, default=(0.0, 0.0, 1.0),
    ),
    RunOption(
        "compensate", FITTED,
        "draw struts so that by that table they print as thick as asked for", "", MATERIAL_GROUP,
    ),
    RunOption(
        "bare-surface", ("fill",),
        "write the surface of a TPMS without thickness, for slicers that print an open mesh as "
        "single lines",
    ),
    RunOption(
        "print-report", MESHED,
        "say how the part suits a process, named as in --process", "PROCESS",
    ),
    RunOption(
        "layer", ("slice",), "height of a layer", "MM", read=float, required=True,
    ),
    RunOption(
        "pixel", ("slice",), "edge of a pixel of the pictures (default: the height of a layer)",
        "MM", read=float,
    ),
    RunOption(
        "format", ("slice",),
        "for each layer a picture of the share of material in its pixels, for resin printers "
        "(default), or a drawing; or one file of the common layer interface, for metal printers",
        "WORD", choices=words("format"), default=words("format")[0],
    ),
    RunOption(
        "slicer", ("infill",),
        "whose project it is: PrusaSlicer's, or OrcaSlicer's and Bambu Studio's (orca)",
        "WORD", choices=SLICERS, default=SLICERS[0],
    ),
    RunOption(
        "grading", ("infill",),
        "what the density follows: the depth (skin: s = 1 at the surface, 0 at the reach; core: "
        "the reverse), the place s along a direction, a field of values, or a formula (default "
        "skin)",
        "WORD", DENSITY_GROUP, choices=GRADINGS, default=GRADINGS[0],
    ),
    RunOption(
        "start", ("infill",), "density at s = 0, or where the field is smallest (default 10)",
        "PERCENT", DENSITY_GROUP, float, 10.0,
    ),
    RunOption(
        "end", ("infill",), "density at s = 1, or where the field is largest (default 50)",
        "PERCENT", DENSITY_GROUP, float, 50.0,
    ),
    RunOption(
        "profile", ("infill",), "between the two (default linear)", "WORD", DENSITY_GROUP,
        choices=("linear", "quadratic", "exponential"), default="linear",
    ),
    RunOption(
        "reach", ("infill",), "depth at which the grading ends (default 5)",
        "MM", DENSITY_GROUP, float, 5.0,
    ),
    RunOption(
        "direction", ("infill",), "along which it varies (default 0,0,1)", "X,Y,Z",
        DENSITY_GROUP, three_numbers, (0.0, 0.0, 1.0),
    ),
    RunOption(
        "field", ("infill",),
        "CSV with x, y, z and values, or a VTK file, such as the stress of a FEM result",
        "FILE", DENSITY_GROUP, reads="field file",
    ),
    RunOption(
        "sized", ("infill",),
        "a specification written by size: the density that its radii amount to, in place of a "
        "grading",
        "FILE.toml", DENSITY_GROUP, reads="sized specification",
    ),
    RunOption(
        "column", ("infill",), "of the file's values, where it has several", "NAME", DENSITY_GROUP,
    ),
    RunOption(
        "curve", ("infill",), "values and densities in place of start and end, as '0:10,80:60'",
        "TEXT", DENSITY_GROUP, default="",
    ),
    RunOption(
        "formula", ("infill",), "the density in percent of x, y and z in mm", "TEXT",
        DENSITY_GROUP, default="",
    ),
    RunOption(
        "bands", ("infill",), "densities there are at most, 2 to 8 (default 5)", "N",
        DENSITY_GROUP, int, 5,
    ),
    RunOption(
        "pattern", ("infill",), "of the infill (default gyroid)", "WORD", PRINT_GROUP,
        choices=PATTERNS, default=PATTERNS[0],
    ),
    RunOption("walls", ("infill",), "lines side by side (default 3)", "N", PRINT_GROUP, int, 3),
    RunOption(
        "top-layers", ("infill",), "solid ones (default 4)", "N", PRINT_GROUP, int, 4,
    ),
    RunOption(
        "bottom-layers", ("infill",), "solid ones (default 4)", "N", PRINT_GROUP, int, 4,
    ),
    RunOption(
        "line-width", ("infill",), "of an extruded line (default 0.45)", "MM", PRINT_GROUP, float,
        0.45,
    ),
    RunOption(
        "layer", ("infill",), "height of a layer (default 0.2)", "MM", PRINT_GROUP, float, 0.2,
    ),
    RunOption(
        "loads", ("size", "solve", "homogenise"), "load cases, see docs/loads.md",
        "FILE.toml", required=True, reads="load file",
    ),
    RunOption(
        "voxel", ("size", "solve"),
        "edge of the solver's voxels (default: what makes a quarter of a million, or lays two "
        "across the walls)",
        "MM", read=float,
    ),
    RunOption(
        "element", ("homogenise",),
        "edge of an element (default: a cell, or less where there are few)",
        "MM", read=float,
    ),
    RunOption(
        "frequencies", ("homogenise",),
        "number of lowest natural frequencies, with the first case's supports", "N",
        read=int, default=0,
    ),
    RunOption(
        "load-factors", ("homogenise",),
        "number of lowest factors of each case's loads at which the part buckles as a whole",
        "N", read=int, default=0,
    ),
    RunOption(
        "stiffest", ("homogenise",),
        "size radii or thicknesses: as stiff as the part can be at the mass that it has",
        group=GOAL_GROUP,
    ),
    RunOption(
        "safety", ("homogenise",),
        "size them for the least mass: the lattice is used up to the material's yield over this",
        "S", GOAL_GROUP, float,
    ),
    RunOption(
        "max-displacement", ("homogenise",), "the same: of any place, in any case",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "thinnest", ("homogenise",), "smallest radius or thickness (default: half of what it is)",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "thickest", ("homogenise",), "largest (default: twice what it is)",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "steps", ("homogenise",), "of the search, at most (default 40)", "N", GOAL_GROUP, int, 40,
    ),
    RunOption(
        "radii", ("homogenise",),
        "what was sized, as --radius-field reads it, of struts or a TPMS", "FILE.csv",
        GOAL_GROUP, writes="radii",
    ),
    RunOption(
        "write-spec", ("homogenise",), "the specification with what was sized, for fill",
        "FILE.toml", GOAL_GROUP, writes="written specification",
    ),
    RunOption(
        "radii", ("size",), "the radii at the nodes, as --radius-field reads it",
        "FILE.csv", writes="radii",
    ),
    RunOption(
        "thickness", ("size",), "the thickness of a skin that is sized, as --skin-field reads it",
        "FILE.csv", writes="thickness",
    ),
    RunOption(
        "max-stress", ("size",), "largest von Mises stress in a strut, and in a skin that is sized",
        "MPA", GOAL_GROUP, float,
    ),
    RunOption(
        "safety", ("size",), "the same as the material's yield over this", "S", GOAL_GROUP, float,
    ),
    RunOption(
        "max-displacement", ("size",), "of any node, in any case", "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "buckling", ("size",), "loads times this buckle no strut", "F", GOAL_GROUP, float,
    ),
    RunOption("min-frequency", ("size",), "lowest natural frequency", "HZ", GOAL_GROUP, float),
    RunOption(
        "strut-mass", ("size",),
        "of the struts, for the most stiffness (default: what the strut radius makes)",
        "G", GOAL_GROUP, float,
    ),
    RunOption(
        "thinnest", ("size",), "smallest radius (default: half the radius)",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "thickest", ("size",), "largest radius (default: what cells bear)",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "smooth", ("size",), "share of its neighbours in each node's radius, 0 to 0.9 (default 0)",
        "S", GOAL_GROUP, float, 0.0,
    ),
    RunOption(
        "skin-thinnest", ("size",), "size the skin, too: its smallest thickness",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "skin-thickest", ("size",), "its largest thickness (default: half the cell size)",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "skin-patch", ("size",),
        "how far apart it is chosen, smooth between (default: the cell size); inf: one everywhere",
        "MM", GOAL_GROUP, float,
    ),
    RunOption(
        "no-solid", ("size",),
        "keep the skin within its largest thickness where limits ask for more; otherwise the "
        "part becomes solid there",
        group=GOAL_GROUP,
    ),
    RunOption(
        "sized-mass", ("size",), "of struts and skin that are sized, for the most stiffness",
        "G", GOAL_GROUP, float,
    ),
    RunOption(
        "remove-thin", ("size",),
        "take away struts that end as thin as allowed, and size the rest again", group=GOAL_GROUP,
    ),
    RunOption(
        "radius-list", ("size",), "the radii that nodes may have, in place of bounds", "MM,...",
        GOAL_GROUP, numbers, (),
    ),
    RunOption(
        "symmetry", ("size",),
        "planes of symmetry of radii and a sized skin; loads need not have them",
        "x=MM,y=MM", GOAL_GROUP,
    ),
    RunOption("steps", ("size",), "of the search, at most (default 60)", "N", GOAL_GROUP, int, 60),
    RunOption(
        "no-proof", ("size",), "do not let CalculiX solve the final design", group=GOAL_GROUP,
    ),
    RunOption(
        "prove", ("size",),
        "solve the finished file as a solid, by voxels, beside the design and CalculiX",
        "WORD", GOAL_GROUP, choices=("file",),
    ),
    RunOption(
        "plot", ("size",), "draw mass and limits, step by step", "FILE.svg", writes="plot",
    ),
    RunOption(
        "picture", ("size",), "struts or skin in colour (needs pyvista)",
        "FILE.png", SIZED_PICTURE_GROUP, writes="picture",
    ),
    RunOption(
        "colour", ("size",),
        "what the colour tells (default radius); skin: its thickness; governing: the limit",
        "WORD", SIZED_PICTURE_GROUP,
        choices=("radius", "stress", "buckling", "displacement", "skin", "governing"),
    ),
    RunOption(
        "case", ("size",), "of which load case (default: the first)", "NAME", SIZED_PICTURE_GROUP,
    ),
    RunOption(
        "deformed", ("size",), "displacements drawn so many times as large",
        "F", SIZED_PICTURE_GROUP, float,
    ),
    RunOption("modulus", ("find",), "Young's modulus of the lattice, in MPa with a material", "E",
              read=float),
    RunOption(
        "relative-density", ("find",), "from 0 to 1; with a modulus too the nearest cells are "
        "first", "D", read=float, short="density",
    ),
    RunOption(
        "plateau", ("find",), "in place of these, of a block crushed between plates; those that "
        "absorb most are first", "MPA", read=float,
    ),
    RunOption(
        "direction", ("find",), "of the modulus: x, y, z, 100, 110, 111 or X,Y,Z (default x)", "D",
        default="x",
    ),
    RunOption("cell-size", ("find",), "edge L (default 10)", "MM", read=float, default=10.0),
    RunOption("most", ("find",), "cells told (default 10)", "N", read=int, default=10),
    RunOption(
        "cell-size", ("properties", "crush"), "edge L of a cell", "MM", read=float, required=True,
    ),
    RunOption(
        "strut-radius", ("properties", "crush"), "radius r of the struts", "MM", read=float,
        either="size", required=True,
    ),
    RunOption(
        "wall-thickness", ("properties",), "of a TPMS sheet", "MM", read=float, either="size",
        required=True,
    ),
    RunOption(
        "wall-offset", ("properties",), "of its skeleton or complement", "MM", read=float,
        either="size", required=True,
    ),
    RunOption(
        "relative-density", ("properties", "crush"), "from 0 to 1, in place of these", "D",
        read=float, either="size", required=True,
    ),
    RunOption(
        "wall-kind", ("properties",), "of a TPMS (default: sheet)", "WORD",
        choices=("sheet", "skeleton", "complement"),
    ),
    RunOption(
        "wall-formula", ("properties",), "the surface of the cell Formula", "F", default="",
    ),
    RunOption(
        "fillet", ("properties",), "round at the joints (default 0)", "MM", read=float, default=0.0,
    ),
    RunOption(
        "cell-values", ("properties",), "numbers that the cell leaves to be chosen", "TEXT",
    ),
    RunOption(
        "voxels", ("properties",), "along L (default: what the radius asks for)", "N", read=int,
    ),
    RunOption(
        "json", ("properties", "find", "crush"), "write the figures, and their errors, as JSON",
        "FILE", writes="figures",
    ),
    RunOption(
        "dry-run", ("sweep",), "say how many designs there are, and the time",
    ),
    RunOption(
        "workers", ("sweep",),
        "runs side by side (default: as many as cores and memory allow)", "N", read=int,
    ),
    RunOption(
        "workers", ("fill",),
        "processes that cut the lattice at the wall (default: this one, and one more for every "
        "150,000 triangles, at most one a core); the file is the same with any number",
        "N", read=int, either="who works",
    ),
    RunOption(
        "scheduler", ("fill",),
        "of Dask, such as tcp://HOST:8786, whose workers do that instead", "ADDRESS",
        either="who works",
    ),
    RunOption(
        "scheduler", ("sweep",), "of Dask, such as tcp://HOST:8786, for the runs", "ADDRESS",
    ),
    RunOption(
        "shard", ("sweep",), "only one part in N of them", "I/N", read=shard, default=(1, 1),
    ),
    RunOption("limit-hours", ("sweep",), "end a run that takes longer", "H", read=float),
    RunOption("limit-memory", ("sweep",), "end a run that takes more", "GB", read=float),
    RunOption("retry-failed", ("sweep",), "try again what failed before"),
    RunOption(
        "quiet",
        (*LATTICE, "infill", "coupon", "crush", "solve", "homogenise", "orient", "sweep"),
        "print nothing but errors",
    ),
    RunOption(
        "spec", ("report-bug",), "the specification of the job that failed", "FILE",
        reads="specification",
    ),
    RunOption("log", ("report-bug",), "what it printed", "FILE"),
)  # fmt: skip
#: Arguments without hyphens, and options of the table of parameters, that name files which are
#: read; what the command calls them.
_OTHER_INPUTS = {
    "part": "part",
    "cell": "cell file",
    "radius_field": "field file",
    "skin_field": "file of the skin's thickness",
    "network_field": "network's field file",
    "network_file": "network file",
}
#: What the command calls its input files, by where the options keep their names.
INPUTS = _OTHER_INPUTS | {row.stored: row.reads for row in RUN_OPTIONS if row.reads}
#: The files that it writes, the same way.
OUTPUTS = {row.stored: row.writes for row in RUN_OPTIONS if row.writes}


def add_run_options(parser: argparse.ArgumentParser, command: str) -> None:
    """Add the options of a command, in the order and the groups of the table."""
    groups: dict[str, Any] = {"": parser}
    for row in RUN_OPTIONS:
        if command not in row.commands:
            continue
        if row.group not in groups:
            groups[row.group] = parser.add_argument_group(row.group)
        into = groups[row.group]
        if row.either:
            if row.either not in groups:
                groups[row.either] = into.add_mutually_exclusive_group(required=row.required)
            into = groups[row.either]
        said: dict[str, Any] = {"help": row.help.replace("%", "%%"), "dest": row.stored}
        if row.shape:
            said |= {"default": row.default, "required": row.required and not row.either}
            said |= {"choices": row.choices} if row.choices else {"metavar": row.shape}
            said |= {"type": row.read} if row.read is not None else {}
        else:
            said["action"] = "store_true"
        into.add_argument(*row.names, **said)


def refuse_extensions(options: argparse.Namespace, command: str, out: Path) -> None:
    """Refuse an option that the output's kind of file has no place for.

    Raises:
        VolfrepError: naming it, and the extension that it needs.
    """
    for row in RUN_OPTIONS:
        if command not in row.commands or not row.extensions:
            continue
        if getattr(options, row.stored) is not None and out.suffix.lower() not in row.extensions:
            raise VolfrepError(
                f"'{out}' cannot hold what {row.option} asks for: give it the extension "
                f"{row.extensions[0]}."
            )
