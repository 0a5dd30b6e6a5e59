# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of parameters of a lattice infill: a new parameter is a row of it.

Lengths are in mm, angles in degrees, the density in g/cm3. The texts are translated in FreeCAD's
windows: ``make translations`` reads them here.
"""

from __future__ import annotations

from ..tpms.library import FORMULA, SURFACES
from .parameter import Need, Parameter

#: The entry of the property `CellType` for a cell of the user's own, read from `CellFile`.
CUSTOM_CELL = "Custom"
#: Entries of the properties `PrintMaterial` and `PrintProcess` beside the tables' names: nothing
#: chosen, a material of the user's own (from `MaterialFile`), and the one that FreeCAD's solid has.
NOTHING, OWN_MATERIAL, SOLIDS_MATERIAL = "None", "Custom", "Of the solid"

#: What may say how thick struts are, in a document.
DRIVERS = ("radius", "relative density", "mass", "stiffness")

TWO_ENDED = ("linear", "quadratic", "exponential")
PROFILES = ("scalar", *TWO_ENDED, "formula")
BY_DEPTH = ("skin", "core")
BY_PLACE = ("direction", *BY_DEPTH)

#: Cells of walls; and what is for all other cells.
WALLS = (*SURFACES, FORMULA)
#: What says how thick they are.
SIZES = ("wall_thickness", "wall_offset")
OF_WALLS = Need(("cell",), WALLS)
OF_STRUTS = Need(("cell",), WALLS, absent=True)

#: Networks in place of cells: edges between random points, or those of a file.
RANDOM = ("voronoi", "delaunay")
_RANDOM = (Need(("network",), RANDOM),)
#: What lies somewhere of its own accord, and may lie elsewhere: cells, and the network of a file.
GIVEN = (Need(("network",), ("cells", "file")),)
#: Cells in layers: on the quadrilaterals of a file, or upon or between faces picked in FreeCAD.
_LAYERS = (Need(("network",), ("file", "faces")),)

_OWN_RADIUS = Need(("radius_driven_by",), ("radius",))
_DRAINED = (Need(("drain_diameter",)),)
_BY_FIELD = (Need(("radius_grading",), ("field",)),)
_MAPPED = (Need(("cell_map",)),)
_RADIUS_ENDS = (
    Need(("radius_grading",)),
    Need(("radius_profile",), TWO_ENDED),
    Need(("radius_curve",), absent=True),
)

PARAMETERS = (
    Parameter(
        "base", "link", "Solid",
        "The solid to fill: a solid, a Body, a Part, a link to one of these, or a closed mesh",
        in_command=False,
    ),
    Parameter(
        "cell", "cell", "Lattice",
        "The unit cell: one of the library, a TPMS such as Gyroid, or the .json file of your own",
        default="CVC", freecad_name="CellType",
    ),
    Parameter(
        "cell_file", "file", "Lattice",
        "The .json file of your own unit cell (nodes and struts), for the cell type Custom",
        needs=(Need(("cell",), (CUSTOM_CELL,)),), in_command=False, in_panel=True,
    ),
    Parameter(
        "cell_values", "text", "Lattice",
        "Numbers that the cell leaves to be chosen, such as 'arm = 0.15' of Re-entrant; "
        "'volfrep cells' tells which",
        default="", needs=(OF_STRUTS,),
    ),
    Parameter(
        "cell_size", "length", "Lattice",
        "L: edge length of the cubic cell",
        default=10.0, in_panel=True, field="cell_size",
    ),
    Parameter(
        "radius_driven_by", "choice", "Lattice",
        "What sets the struts' radius: itself, or a target of the lattice or the part, for which "
        "it is found",
        default="radius", choices=DRIVERS, in_command=False, in_panel=True,
    ),
    Parameter(
        "target_density", "number", "Lattice",
        "Volume of the lattice over that of what it fills, between 0 and 1",
        default=0.2, needs=(Need(("radius_driven_by",), ("relative density",)),),
        in_command=False, in_panel=True,
    ),
    Parameter(
        "target_mass", "mass", "Lattice",
        "Mass of the finished part, with its skin",
        default=0.0, needs=(Need(("radius_driven_by",), ("mass",)),),
        in_command=False, in_panel=True,
    ),
    Parameter(
        "target_stiffness", "stress", "Lattice",
        "Young's modulus of the lattice along StiffnessDirection, of the chosen material",
        default=0.0, needs=(Need(("radius_driven_by",), ("stiffness",)),),
        in_command=False, in_panel=True,
    ),
    Parameter(
        "stiffness_direction", "direction", "Lattice",
        "Along this direction of the cell: 1,0,0 along its edges, 1,1,0 across its faces, 1,1,1 "
        "along its diagonals",
        default=(0.0, 0.0, 1.0), needs=(Need(("radius_driven_by",), ("stiffness",)),),
        in_command=False, in_panel=True,
    ),
    Parameter(
        "strut_radius", "length", "Lattice",
        "r: radius of the struts",
        default=1.0, needs=(OF_STRUTS,), in_panel=True,
        instead_of=("relative_density", "mass", "stiffness"), field="strut_radius",
    ),
    Parameter(
        "relative_density", "number", "Lattice",
        "In place of the radius: volume of the lattice over that of what it fills, between 0 and 1",
        in_freecad=False, instead_of=("strut_radius", "mass", "stiffness", *SIZES),
    ),
    Parameter(
        "mass", "mass", "Lattice",
        "In place of the radius: mass of the finished part, with its skin",
        in_freecad=False,
        instead_of=("strut_radius", "relative_density", "stiffness", *SIZES),
    ),
    Parameter(
        "stiffness", "stiffness", "Lattice",
        "In place of the radius: Young's modulus along 100, 110, 111 or X,Y,Z of the cell, in "
        "MPa with a material, else in units of the solid's",
        in_freecad=False, instead_of=("strut_radius", "relative_density", "mass", *SIZES),
    ),
    Parameter(
        "shell", "length", "Lattice",
        "Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface",
        default=2.0, freecad_name="ShellThickness", of_block=False, in_panel=True, field="shell",
    ),
    Parameter(
        "fillet", "length", "Lattice",
        "Radius of the round between struts where they meet; 0 for none",
        default=0.0, needs=(OF_STRUTS,), freecad_name="JointFillet", in_panel=True, field="fillet",
    ),
    Parameter(
        "wall_kind", "choice", "Walls",
        "sheet: a wall about the surface; skeleton: where its formula is negative; complement: "
        "where it is positive",
        default="sheet", choices=("sheet", "skeleton", "complement"), needs=(OF_WALLS,),
        in_panel=True, field="wall.kind",
    ),
    Parameter(
        "wall_thickness", "length", "Walls",
        "Thickness of a sheet, measured across it",
        default=1.0, needs=(OF_WALLS, Need(("wall_kind",), ("sheet",))), in_panel=True,
        instead_of=("relative_density", "mass"), field="wall.thickness",
    ),
    Parameter(
        "wall_offset", "number", "Walls",
        "By how many mm a skeleton or complement is thicker than up to the surface; negative for "
        "a thinner one",
        default=0.0, needs=(OF_WALLS, Need(("wall_kind",), ("skeleton", "complement"))),
        in_panel=True, instead_of=("relative_density", "mass"), field="wall.offset",
    ),
    Parameter(
        "wall_formula", "text", "Walls",
        "The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi "
        "over a cell",
        needs=(Need(("cell",), (FORMULA,)),), required=True, initial="cos(x) + cos(y) + cos(z)",
        in_panel=True,
    ),
    Parameter(
        "network", "choice", "Network",
        "What the lattice consists of: cells, Voronoi or Delaunay edges of random points, nodes "
        "and struts of a file, or layers of cells that follow faces picked in FreeCAD",
        default="cells", choices=("cells", *RANDOM, "file", "faces"), of_block=False,
        field="network.kind",
    ),
    Parameter(
        "network_file", "file", "Network",
        "Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, "
        ".vtu, .inp, .msh, .obj) whose hexahedra the cell is laid into, on whose quadrilaterals "
        "layers of it lie, or whose tetrahedra's edges are struts",
        needs=(Need(("network",), ("file",)),), required=True, of_block=False, in_panel=True,
    ),
    Parameter(
        "network_faces", "faces", "Network",
        "Two faces between which cells lie, or one upon which they do; each has four sides",
        needs=(Need(("network",), ("faces",)),), in_command=False,
    ),
    Parameter(
        "network_thickness", "length", "Network",
        "Of the layers of cells upon one surface together",
        default=0.0, needs=_LAYERS, of_block=False, in_panel=True,
    ),
    Parameter(
        "network_layers", "integer", "Network",
        "How many layers of cells lie upon a surface or between two; 0 for as many as come "
        "nearest to the cell size",
        default=0, needs=_LAYERS, of_block=False, in_panel=True,
    ),
    Parameter(
        "network_reversed", "flag", "Network",
        "Layers upon one surface lie on its other side, against its normals",
        default=False, needs=_LAYERS, of_block=False, in_panel=True,
    ),
    Parameter(
        "network_points", "integer", "Network",
        "How many points lie in the part; 0 for as many as lie a cell size apart",
        default=0, needs=_RANDOM, of_block=False, in_panel=True, field="network.points",
    ),
    Parameter(
        "network_seed", "integer", "Network",
        "Another seed draws other points",
        default=1, needs=_RANDOM, of_block=False, in_panel=True, field="network.seed",
    ),
    Parameter(
        "network_relax", "integer", "Network",
        "How often each point moves to the middle of its cell, which evens them out",
        default=2, needs=_RANDOM, of_block=False, in_panel=True, field="network.relax",
    ),
    Parameter(
        "network_density", "text", "Network",
        "Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such "
        "as '3 - 2 * s'; empty for an even one",
        default="", needs=_RANDOM, of_block=False, field="network.density",
    ),
    Parameter(
        "network_field", "file", "Network",
        "A field that the density of the points follows in place of the depth: s is 0 at its "
        "smallest value and 1 at its largest (files as of a radius field, of one column)",
        needs=(*_RANDOM, Need(("network_density",))), of_block=False,
        field="network.field", is_none=True,
    ),
    Parameter(
        "network_on_wall", "flag", "Network",
        "Struts run along the wall, too, where it cuts the faces of the points' cells",
        default=False, needs=(Need(("network",), ("voronoi",)),), of_block=False, in_panel=True,
        field="network.on_wall",
    ),
    Parameter(
        "network_shortest", "length", "Network",
        "Struts shorter than this are drawn together into one node; 0 for four radii",
        default=0.0, needs=_RANDOM, of_block=False, in_panel=True, field="network.shortest",
    ),
    Parameter(
        "network_angle", "number", "Network",
        "Of two struts that meet at less than so many degrees the longer one goes",
        default=25.0, needs=_RANDOM, of_block=False, field="network.least_angle",
    ),
    Parameter(
        "origin", "point", "Lattice",
        "A point that is to be a corner of a cell; of a network of a file, where its own origin is "
        "to lie",
        switch="Put a corner of a cell at Origin; otherwise the cells start at the corner of the "
        "solid",
        otherwise="the corner of the part's box; of a file 0, 0, 0", needs=GIVEN, of_block=False,
        field="origin",
    ),
    Parameter(
        "activation", "choice", "Boundary",
        "Which cells hold a lattice: those that touch the inside, whose centre lies inside, or "
        "that lie wholly inside",
        default="touching", choices=("touching", "centre", "inside"), of_block=False, in_panel=True,
        field="activation",
    ),
    Parameter(
        "boundary", "choice", "Boundary",
        "trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what "
        "reaches it",
        default="trim", choices=("trim", "whole"), of_block=False, in_panel=True, field="boundary",
    ),
    Parameter(
        "remove_dangling", "flag", "Boundary",
        "Take away struts with a free end, again and again until there are none",
        default=False, needs=(OF_STRUTS,), of_block=False, in_panel=True, field="remove_dangling",
    ),
    Parameter(
        "remove_flatter", "number", "Boundary",
        "Take away struts that lie flatter than so many degrees to the build plate, and those with "
        "a free end then; 0 for none",
        default=0.0, needs=(OF_STRUTS,), of_block=False, field="flat_struts.inclination",
    ),
    Parameter(
        "shortest_stub", "length", "Boundary",
        "Take away struts with a free end that are shorter than this; 0 for none",
        default=0.0, needs=(OF_STRUTS,), of_block=False, in_panel=True, field="shortest_stub",
    ),
    Parameter(
        "keep_pieces", "flag", "Boundary",
        "Keep pieces of the lattice that hang on nothing; otherwise they are left out, and told",
        default=False, of_block=False, field="keep_pieces",
    ),
    Parameter(
        "open_faces", "faces", "Openings",
        "Faces of the solid that have no skin: the cavity opens there, struts are cut flush",
        in_command=False,
    ),
    Parameter(
        "open_plane", "planes", "Openings",
        "A plane, by a point and a normal, whose faces have no skin; may be repeated",
        in_freecad=False, of_block=False,
    ),
    Parameter(
        "skin_faces", "faces", "Openings",
        "Faces of the solid whose skin has a thickness of its own, each with its number in "
        "SkinThicknesses",
        in_command=False,
    ),
    Parameter(
        "skin_thicknesses", "lengths", "Openings",
        "Thickness of the skin below each of the SkinFaces, in mm; 0 leaves the face open",
        default=(), in_command=False,
    ),
    Parameter(
        "skin_face", "thick_faces", "Openings",
        "Skin below the smooth face at a point, or below the faces in a plane by a point and a "
        "normal, of a thickness, the last number; 0 leaves them open; may be repeated",
        in_freecad=False, of_block=False,
    ),
    Parameter(
        "skin_field", "file", "Openings",
        "File of points and thicknesses of the skin, which it follows below all other faces, "
        "nowhere thinner than the shell",
        of_block=False, field="skin_field",
    ),
    Parameter(
        "keep_solid_around", "faces", "Openings",
        "Faces round which the part stays solid, up to KeepDistance, and solids whose room in it "
        "does",
        in_command=False,
    ),
    Parameter(
        "keep_distance", "length", "Openings",
        "Distance from the faces of KeepSolidAround up to which the part stays solid",
        default=5.0, in_command=False,
    ),
    Parameter(
        "keep_solid", "solids", "Openings",
        "What stays solid: the room of a closed body in a file (STL, PLY, OBJ, OFF, GLB), or "
        "what is nearer than a distance, the last number, to the smooth face at a point or the "
        "faces in a plane; may be repeated",
        in_freecad=False, of_block=False,
    ),
    Parameter(
        "drain_diameter", "length", "Openings",
        "Diameter of the holes that let powder or resin out of the skin; 0 for none",
        default=0.0, of_block=False, field="drains.diameter",
    ),
    Parameter(
        "drain_points", "points", "Openings",
        "Points where holes are drilled",
        needs=_DRAINED, in_command=False,
    ),
    Parameter(
        "drain_faces", "faces", "Openings",
        "Faces in the middle of which holes are drilled",
        needs=_DRAINED, in_command=False,
    ),
    Parameter(
        "drain", "places", "Openings",
        "A point of the surface where a hole is drilled, and its direction if that is not across "
        "the surface; may be repeated",
        needs=_DRAINED, in_freecad=False, of_block=False,
    ),
    Parameter(
        "drain_count", "integer", "Openings",
        "Holes for each void that is still closed, at its lowest places along the build direction",
        default=0, needs=_DRAINED, of_block=False, field="drains.count",
    ),
    Parameter(
        "build_direction", "direction", "Openings",
        "From the build plate up",
        default=(0.0, 0.0, 1.0), field="drains.build_direction",
    ),
    Parameter(
        "size_grading", "choice", "Cell size",
        "Cells that grow along a direction: the profile of lambda (section 2.5 of the method)",
        default="none", choices=("none", *PROFILES), in_panel=True,
        field="size_grading.profile.kind",
    ),
    Parameter(
        "lambda_start", "number", "Cell size",
        "lambda at the near end, s = 0",
        default=1.0, needs=(Need(("size_grading",), PROFILES[:-1]),), in_panel=True,
        field="size_grading.profile.start",
    ),
    Parameter(
        "lambda_end", "number", "Cell size",
        "lambda at the far end, s = 1",
        needs=(Need(("size_grading",), TWO_ENDED),), required=True, initial=2.0, in_panel=True,
        field="size_grading.profile.end",
    ),
    Parameter(
        "lambda_formula", "formula", "Cell size",
        "lambda as a formula of s",
        needs=(Need(("size_grading",), ("formula",)),), required=True, initial="1 + s",
        in_panel=True, field="size_grading.profile.expression",
    ),
    Parameter(
        "grading_direction", "direction", "Cell size",
        "Cells grow along it",
        default=(1.0, 0.0, 0.0), needs=(Need(("size_grading",)),), field="size_grading.direction",
    ),
    Parameter(
        "cell_map", "choice", "Cell map",
        "Cells along straight axes, about an axis, or about a centre",
        default="cartesian", choices=("cartesian", "cylindrical", "spherical"),
        field="cell_map.kind",
    ),
    Parameter(
        "map_centre", "point", "Cell map",
        "A point of the axis, or the centre",
        switch="Put the axis through MapCentre; otherwise through the middle of the solid's box",
        otherwise="the middle of the part's box", needs=_MAPPED, field="cell_map.centre",
    ),
    Parameter(
        "map_axis", "direction", "Cell map",
        "Axis that the cells lie about",
        default=(0.0, 0.0, 1.0), needs=_MAPPED, field="cell_map.axis",
    ),
    Parameter(
        "map_around", "integer", "Cell map",
        "Cells around the full turn; 0 for as many as make them L wide half-way out",
        default=0, needs=_MAPPED, field="cell_map.around", is_none=True,
    ),
    Parameter(
        "keep_radius", "flag", "Cell size",
        "Where cells are stretched or bent, struts stay straight and round; otherwise they are "
        "deformed with their cells, as published",
        default=True, needs=(OF_STRUTS, Need(("size_grading", "cell_map")),), field="keep_radius",
    ),
    Parameter(
        "rotate", "rotation", "Orientation",
        "Turns the lattice, not the solid: about this axis, by this angle, counter-clockwise seen "
        "against it; cells then begin at a corner of the box that is turned with them",
        otherwise="not turned", needs=GIVEN, freecad_name="Orientation",
    ),
    Parameter(
        "rotate_origin", "point", "Orientation",
        "The point that stays in place when the lattice turns",
        switch="Turn about the position of Orientation; otherwise about the middle of the solid's "
        "box",
        otherwise="the middle of the part's box, or a cell map's centre",
        needs=(Need(("rotate",)),), freecad_name="RotationOrigin", position_of="rotate",
        field="orientation.origin",
    ),
    Parameter(
        "radius_grading", "choice", "Strut radius",
        "Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the "
        "skin, or at the core), or by a field of values",
        default="none", choices=("none", *BY_PLACE, "field"), needs=(_OWN_RADIUS,), in_panel=True,
        field="radius_grading.by",
    ),
    Parameter(
        "radius_field", "file", "Strut radius",
        "File of points and values: .csv, .txt, .vtu, .vtk",
        needs=_BY_FIELD, in_panel=True, field="radius_grading.field",
    ),
    Parameter(
        "radius_result", "link", "Strut radius",
        "Result of a FEM solver, instead of a file",
        needs=_BY_FIELD, in_command=False,
    ),
    Parameter(
        "radius_column", "text", "Strut radius",
        "Which values of the file or the FEM result; empty for the only ones, or for vonMises",
        default="", needs=_BY_FIELD, in_panel=True, field="radius_grading.column", is_none=True,
    ),
    Parameter(
        "radius_curve", "curve", "Strut radius",
        "Values and their radii in mm, such as '0:0.5, 120:1.2', in place of the start and the end",
        default="", needs=_BY_FIELD, instead_of=("radius_start", "radius_end"), in_panel=True,
        field="radius_grading.curve",
    ),
    Parameter(
        "radius_profile", "choice", "Strut radius",
        "Profile of the radius over s",
        default="linear", choices=PROFILES[1:], needs=(Need(("radius_grading",), BY_PLACE),),
        in_panel=True, field="radius_grading.profile.kind",
    ),
    Parameter(
        "radius_start", "length", "Strut radius",
        "Radius at s = 0, or where the field is smallest; 0 for the strut radius",
        default=0.0, needs=_RADIUS_ENDS, instead_of=("radius_curve",), in_panel=True,
        field="radius_grading.profile.start",
    ),
    Parameter(
        "radius_end", "length", "Strut radius",
        "Radius at s = 1, or where the field is largest; 0 for the strut radius",
        default=0.0, needs=_RADIUS_ENDS, instead_of=("radius_curve",), in_panel=True,
        field="radius_grading.profile.end",
    ),
    Parameter(
        "radius_formula", "formula", "Strut radius",
        "Radius in mm as a formula of s",
        needs=(Need(("radius_profile",), ("formula",)),), required=True, initial="0.8 + 0.4 * s",
        in_panel=True, field="radius_grading.profile.expression",
    ),
    Parameter(
        "radius_direction", "direction", "Strut radius",
        "The radius varies along it",
        default=(1.0, 0.0, 0.0), needs=(Need(("radius_grading",), ("direction",)),),
        field="radius_grading.direction",
    ),
    Parameter(
        "radius_reach", "length", "Strut radius",
        "Depth at which the profile ends",
        default=5.0, needs=(Need(("radius_grading",), BY_DEPTH),), in_panel=True,
        field="radius_grading.reach",
    ),
    Parameter(
        "remove_below", "length", "Strut radius",
        "Take away struts that are nowhere thicker than this radius; 0 for none",
        default=0.0, needs=(OF_STRUTS, Need(("radius_grading",))), of_block=False, in_panel=True,
        field="remove_below",
    ),
    Parameter(
        "resolution", "integer", "Mesh",
        "Facets along the edge of a cell; 0 to choose it by the deviation",
        default=0, instead_of=("deviation",), field="resolution", is_none=True,
    ),
    Parameter(
        "deviation", "length", "Mesh",
        "Largest distance between a facet and the exact struts and joints, kept within 1.5 times; "
        "0 for a thirty-fifth of the radius",
        default=0.0, instead_of=("resolution",), field="deviation", is_none=True,
    ),
    Parameter(
        "make", "choice", "Mesh",
        "part: skin and lattice; lattice: without the skin; domain: what the lattice fills",
        default="part", choices=("part", "lattice", "domain"), freecad_name="Output",
        of_block=False, field="output",
    ),
    Parameter(
        "auto_update", "flag", "Mesh",
        "Compute at every change; switch it off for large jobs and use Update Lattice Infill",
        default=True, in_command=False,
    ),
    Parameter(
        "print_material", "material", "Material",
        "What the part is made of: its density gives the mass, its stiffness goes into solver "
        "decks",
        default=NOTHING, in_command=False, in_panel=True,
    ),
    Parameter(
        "material_file", "file", "Material",
        "The .toml or .json file of your own material",
        needs=(Need(("print_material",), (OWN_MATERIAL,)),), in_command=False, in_panel=True,
    ),
    Parameter(
        "print_process", "process", "Material",
        "How the part is printed: its limits are those of the print check",
        default=NOTHING, in_command=False, in_panel=True,
    ),
    Parameter(
        "material_price", "number", "Material",
        "Price of a kilogram of the material in your currency, for the cost in the panel; 0 for "
        "not known",
        default=0.0, in_command=False, in_panel=True,
    ),
    Parameter(
        "density", "density", "Material",
        "Density of the material in g/cm3",
        default=1.0, field="density",
    ),
)  # fmt: skip

#: The same rows by their names.
BY_NAME = {parameter.name: parameter for parameter in PARAMETERS}
