# SPDX-License-Identifier: LGPL-2.1-or-later
"""The keywords of `fill`, `block`, `size`; written by tools/typed_keywords.py."""

from __future__ import annotations

from typing import Any, Literal, TypedDict


class Keywords(TypedDict, total=False):
    """Keys of a specification's file, and fields of a `LatticeSpec`."""

    #: Which cells hold a lattice: those that touch the inside, whose centre lies inside, or ...
    activation: Literal["touching", "centre", "inside"]
    #: trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what ...
    boundary: Literal["trim", "whole"]
    #: From the build plate up; 0,0,1 if not given
    build_direction: Any
    #: The unit cell: one of the library, a surface that walls follow (Gyroid and others), or ...
    cell: Any
    #: Cells along straight axes, about an axis, or about a centre; cartesian if not given
    cell_map: Any
    #: L: edge length of the cubic cell, mm; 10 if not given
    cell_size: float | None
    #: Numbers that the cell leaves to be chosen, such as 'arm = 0.15' of Re-entrant; 'volfrep ...
    cell_values: Any
    #: Density of the material in g/cm3, g/cm3; 1 if not given
    density: Any
    #: Largest distance between a facet and the exact struts and joints, kept within 1.5 times; ...
    deviation: float | None
    #: A point of the surface where a hole is drilled, and its direction if that is not across ...
    drain: Any
    #: Holes for each void that is still closed, at its lowest places along the build ...
    drain_count: Any
    #: Diameter of the holes that let powder or resin out of the skin; 0 for none, mm; 0 if not ...
    drain_diameter: float | None
    #: A `LatticeSpec`'s drains.
    drains: Any
    #: A `LatticeSpec`'s face_skins.
    face_skins: Any
    #: Radius of the round between struts where they meet; 0 for none, mm; 0 if not given
    fillet: float | None
    #: Cells grow along it; 1,0,0 if not given
    grading_direction: Any
    #: Keep pieces of the lattice that hang on nothing; otherwise they are left out, and told; ...
    keep_pieces: bool
    #: Where cells are stretched or bent, struts stay straight and round; otherwise they are ...
    keep_radius: bool
    #: What stays solid: the room of a closed body in a file (STL, PLY, OBJ, OFF, GLB), or what ...
    keep_solid: Any
    #: lambda at the far end, s = 1
    lambda_end: float | None
    #: lambda as a formula of s
    lambda_formula: Any
    #: lambda at the near end, s = 0; 1 if not given
    lambda_start: float | None
    #: part: skin and lattice; lattice: without the skin; domain: what the lattice fills; part ...
    make: Literal["part", "lattice", "domain"]
    #: Cells around the full turn; 0 for as many as make them L wide half-way out; 0 if not given
    map_around: Any
    #: Axis that the cells lie about; 0,0,1 if not given
    map_axis: Any
    #: A point of the axis, or the centre, mm; the middle of the part's box if not given
    map_centre: Any
    #: In place of the radius: mass of the finished part, with its skin, g
    mass: Any
    #: What the lattice consists of: cells, the Voronoi or the Delaunay edges of random points, ...
    network: Any
    #: Of two struts that meet at less than so many degrees the longer one goes; 25 if not given
    network_angle: float | None
    #: Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such ...
    network_density: Any
    #: A field that the density of the points follows in place of the depth: s is 0 at its ...
    network_field: Any
    #: Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, ...
    network_file: Any
    #: How many layers of cells lie upon a surface or between two; 0 for as many as come ...
    network_layers: Any
    #: Struts run along the wall, too, where it cuts the faces of the points' cells; no if not ...
    network_on_wall: bool
    #: How many points lie in the part; 0 for as many as lie a cell size apart; 0 if not given
    network_points: Any
    #: How often each point moves to the middle of its cell, which evens them out; 2 if not given
    network_relax: Any
    #: Layers upon one surface lie on its other side, against its normals; no if not given
    network_reversed: bool
    #: Another seed draws other points; 1 if not given
    network_seed: Any
    #: Struts shorter than this are drawn together into one node; 0 for four radii, mm; 0 if ...
    network_shortest: float | None
    #: Of the layers of cells upon one surface together, mm; 0 if not given
    network_thickness: float | None
    #: A `LatticeSpec`'s open_faces.
    open_faces: Any
    #: A plane, by a point and a normal, whose faces have no skin; may be repeated
    open_plane: Any
    #: A `LatticeSpec`'s orientation.
    orientation: Any
    #: A point that is to be a corner of a cell; of a network of a file, where its own origin ...
    origin: Any
    #: A `LatticeSpec`'s output.
    output: Any
    #: Which values of the file or the FEM result; empty for the only ones, or for vonMises
    radius_column: Any
    #: Values and their radii in mm, such as '0:0.5, 120:1.2', in place of the start and the end
    radius_curve: Any
    #: The radius varies along it; 1,0,0 if not given
    radius_direction: Any
    #: Radius at s = 1, or where the field is largest; 0 for the strut radius, mm; 0 if not given
    radius_end: float | None
    #: File of points and values: .csv, .txt, .vtu, .vtk
    radius_field: Any
    #: Radius in mm as a formula of s
    radius_formula: Any
    #: Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the ...
    radius_grading: Any
    #: Profile of the radius over s; linear if not given
    radius_profile: Literal["linear", "quadratic", "exponential", "formula"]
    #: Depth at which the profile ends, mm; 5 if not given
    radius_reach: float | None
    #: Radius at s = 0, or where the field is smallest; 0 for the strut radius, mm; 0 if not given
    radius_start: float | None
    #: In place of the radius: volume of the lattice over that of what it fills, between 0 and 1
    relative_density: float | None
    #: Take away struts that are nowhere thicker than this radius; 0 for none, mm; 0 if not given
    remove_below: float | None
    #: Take away struts with a free end, again and again until there are none; no if not given
    remove_dangling: bool
    #: Facets along the edge of a cell; 0 to choose it by the deviation; 0 if not given
    resolution: Any
    #: Turns the lattice, not the solid: about this axis, by this angle, counter-clockwise seen ...
    rotate: Any
    #: The point that stays in place when the lattice turns, mm; the middle of the part's box, ...
    rotate_origin: Any
    #: Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface, mm; 2 ...
    shell: float | None
    #: Take away struts with a free end that are shorter than this; 0 for none, mm; 0 if not given
    shortest_stub: float | None
    #: Cells that grow along a direction: the profile of lambda (section 2.5 of the method); ...
    size_grading: Any
    #: A skin of its own thickness below the smooth face at a point, or below the faces in a ...
    skin_face: Any
    #: In place of the radius: Young's modulus of the lattice along 100, 110, 111 or X,Y,Z of ...
    stiffness: Any
    #: r: radius of the struts, mm; 1 if not given
    strut_radius: float | None
    #: A `LatticeSpec`'s target.
    target: Any
    #: A `LatticeSpec`'s wall.
    wall: Any
    #: The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi ...
    wall_formula: Any
    #: sheet: a wall about the surface; skeleton: all where its formula is negative; ...
    wall_kind: Literal["sheet", "skeleton", "complement"]
    #: By how many mm a skeleton or complement is thicker than up to the surface; negative for ...
    wall_offset: float | None
    #: Thickness of a sheet, measured across it, mm; 1 if not given
    wall_thickness: float | None


class SizeKeywords(Keywords, total=False):
    """Those, and what is wanted of sized struts."""

    max_stress: float
    safety: float
    max_displacement: float
    buckling: float
    min_frequency: float
    strut_mass: float
    thinnest: float
    thickest: float
    smooth: float
