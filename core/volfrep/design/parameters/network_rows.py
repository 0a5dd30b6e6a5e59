# SPDX-License-Identifier: LGPL-2.1-or-later
"""The rows of the table of parameters that are about networks in place of cells."""

from __future__ import annotations

from .parameter import Need, Parameter

#: Networks in place of cells: edges between random points, or those of a file.
RANDOM = ("voronoi", "delaunay")
_RANDOM = (Need(("network",), RANDOM),)
#: What lies somewhere of its own accord, and may lie elsewhere: cells, and the network of a file.
GIVEN = (Need(("network",), ("cells", "file")),)
#: Cells in layers: on the quadrilaterals of a file, or upon or between faces picked in FreeCAD.
_LAYERS = (Need(("network",), ("file", "faces")),)

NETWORK = (
    Parameter(
        "network", "choice", "Network",
        "What the lattice consists of: cells, the Voronoi or the Delaunay edges of random points, "
        "the nodes and struts of a file, or layers of cells that follow faces picked in FreeCAD",
        default="cells", choices=("cells", *RANDOM, "file", "faces"), of_block=False,
    ),
    Parameter(
        "network_file", "file", "Network",
        "Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, "
        ".vtu, .inp, .msh, .obj) whose hexahedra the cell is laid into, on whose quadrilaterals "
        "layers of it lie, or whose tetrahedra's edges are struts",
        needs=(Need(("network",), ("file",)),), required=True, of_block=False,
    ),
    Parameter(
        "network_faces", "faces", "Network",
        "Two faces between which cells lie, or one upon which they do; each has four sides",
        needs=(Need(("network",), ("faces",)),), in_command=False,
    ),
    Parameter(
        "network_thickness", "length", "Network",
        "Of the layers of cells upon one surface together",
        default=0.0, needs=_LAYERS, of_block=False,
    ),
    Parameter(
        "network_layers", "integer", "Network",
        "How many layers of cells lie upon a surface or between two; 0 for as many as come "
        "nearest to the cell size",
        default=0, needs=_LAYERS, of_block=False,
    ),
    Parameter(
        "network_reversed", "flag", "Network",
        "Layers upon one surface lie on its other side, against its normals",
        default=False, needs=_LAYERS, of_block=False,
    ),
    Parameter(
        "network_points", "integer", "Network",
        "How many points lie in the part; 0 for as many as lie a cell size apart",
        default=0, needs=_RANDOM, of_block=False,
    ),
    Parameter(
        "network_seed", "integer", "Network",
        "Another seed draws other points",
        default=1, needs=_RANDOM, of_block=False,
    ),
    Parameter(
        "network_relax", "integer", "Network",
        "How often each point moves to the middle of its cell, which evens them out",
        default=2, needs=_RANDOM, of_block=False,
    ),
    Parameter(
        "network_density", "text", "Network",
        "Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such "
        "as '3 - 2 * s'; empty for an even one",
        default="", needs=_RANDOM, of_block=False,
    ),
    Parameter(
        "network_field", "file", "Network",
        "A field that the density of the points follows in place of the depth: s is 0 at its "
        "smallest value and 1 at its largest (files as of a radius field, of one column)",
        needs=(*_RANDOM, Need(("network_density",))), of_block=False,
    ),
    Parameter(
        "network_on_wall", "flag", "Network",
        "Struts run along the wall, too, where it cuts the faces of the points' cells",
        default=False, needs=(Need(("network",), ("voronoi",)),), of_block=False,
    ),
    Parameter(
        "network_shortest", "length", "Network",
        "Struts shorter than this are drawn together into one node; 0 for four radii",
        default=0.0, needs=_RANDOM, of_block=False,
    ),
    Parameter(
        "network_angle", "number", "Network",
        "Of two struts that meet at less than so many degrees the longer one goes",
        default=25.0, needs=_RANDOM, of_block=False,
    ),
)  # fmt: skip
