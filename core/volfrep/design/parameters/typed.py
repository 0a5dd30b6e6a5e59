# SPDX-License-Identifier: LGPL-2.1-or-later
"""The keywords of `fill`, `block`, `size`; written by tools/typed_keywords.py."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, TypedDict

from numpy.typing import ArrayLike

from ..grading import Field

#: A value by place: a function of (n, 3) points that gives (n,) values, a formula of x, y and z,
#: or (n, 3) points and (n,) values.
ByPlace = Callable[[Any], ArrayLike] | str | tuple[ArrayLike, ArrayLike] | Field


class Keywords(TypedDict, total=False):
    """Keys of a specification's file, and fields of a `LatticeSpec`."""

    activation: Literal["touching", "centre", "inside"]
    """Which cells hold a lattice: those that touch the inside, whose centre lies inside, or that
    lie wholly inside; touching if not given.
    """
    boundary: Literal["trim", "whole"]
    """trim: the lattice is cut at the wall; whole: cells stay whole, and a skin joins what reaches
    it; trim if not given.
    """
    build_direction: Any
    """From the build plate up; 0,0,1 if not given."""
    cell: Any
    """The unit cell: one of the library, a TPMS such as Gyroid, or the .json file of your own; CVC
    if not given.
    """
    cell_map: Any
    """Cells along straight axes, about an axis, or about a centre; cartesian if not given."""
    cell_size: float | ByPlace | None
    """L: edge length of the cubic cell, mm, 1e-09 to 1e+06; 10 if not given; or by place."""
    cell_values: str
    """Numbers that the cell leaves to be chosen, such as 'arm = 0.15' of Re-entrant; 'volfrep
    cells' tells which.
    """
    density: float | str | None
    """Density of the material in g/cm3, g/cm3, 1e-06 to 1000; 1 if not given."""
    deviation: float | str | None
    """Largest distance between a facet and the exact struts and joints, kept within 1.5 times; 0
    for a thirty-fifth of the radius, mm, 0 or 1e-09 to 1e+06; 0 if not given.
    """
    drain: Any
    """A point of the surface where a hole is drilled, and its direction if that is not across the
    surface; may be repeated.
    """
    drain_count: int | None
    """Holes for each void that is still closed, at its lowest places along the build direction; 0
    if not given.
    """
    drain_diameter: float | str | None
    """Diameter of the holes that let powder or resin out of the skin; 0 for none, mm, 0 or 1e-09 to
    1e+06; 0 if not given.
    """
    drains: Any
    """A `LatticeSpec`'s drains."""
    face_skins: Any
    """A `LatticeSpec`'s face_skins."""
    fillet: float | str | None
    """Radius of the round between struts where they meet; 0 for none, mm, 0 or 1e-09 to 1e+06; 0 if
    not given.
    """
    flat_struts: Any
    """A `LatticeSpec`'s flat_struts."""
    grading_direction: Any
    """Cells grow along it; 1,0,0 if not given."""
    keep_pieces: bool
    """Keep pieces of the lattice that hang on nothing; otherwise they are left out, and told; no if
    not given.
    """
    keep_radius: bool
    """Where cells are stretched or bent, struts stay straight and round; otherwise they are
    deformed with their cells, as published; yes if not given.
    """
    keep_solid: Any
    """What stays solid: the room of a closed body in a file (STL, PLY, OBJ, OFF, GLB), or what is
    nearer than a distance, the last number, to the smooth face at a point or the faces in a plane;
    may be repeated.
    """
    lambda_end: float | None
    """lambda at the far end, s = 1, 1e-06 to 1e+06."""
    lambda_formula: str
    """lambda as a formula of s."""
    lambda_start: float | None
    """lambda at the near end, s = 0, 1e-06 to 1e+06; 1 if not given."""
    make: Literal["part", "lattice", "domain"]
    """part: skin and lattice; lattice: without the skin; domain: what the lattice fills; part if
    not given.
    """
    map_around: int | None
    """Cells around the full turn; 0 for as many as make them L wide half-way out; 0 if not
    given.
    """
    map_axis: Any
    """Axis that the cells lie about; 0,0,1 if not given."""
    map_centre: Any
    """A point of the axis, or the centre, mm; the middle of the part's box if not given."""
    mass: float | str | None
    """In place of the radius: mass of the finished part, with its skin, g, 1e-09 to 1e+12."""
    network: Any
    """What the lattice consists of: cells, Voronoi or Delaunay edges of random points, nodes and
    struts of a file, or layers of cells that follow faces picked in FreeCAD; cells if not given.
    """
    network_angle: float | None
    """Of two struts that meet at less than so many degrees the longer one goes, 1e-06 to 1e+06; 25
    if not given.
    """
    network_density: str | ByPlace
    """Density of the points as a formula of s, 0 at the wall and 1 at the deepest place, such as '3
    - 2 * s'; empty for an even one; or by place.
    """
    network_field: str | ByPlace
    """A field that the density of the points follows in place of the depth: s is 0 at its smallest
    value and 1 at its largest (files as of a radius field, of one column); or by place.
    """
    network_file: Any
    """Nodes and struts: .json, .csv, lines of .obj or .vtk, beams of .3mf; or a mesh (.vtk, .vtu,
    .inp, .msh, .obj) whose hexahedra the cell is laid into, on whose quadrilaterals layers of it
    lie, or whose tetrahedra's edges are struts.
    """
    network_layers: int | None
    """How many layers of cells lie upon a surface or between two; 0 for as many as come nearest to
    the cell size; 0 if not given.
    """
    network_on_wall: bool
    """Struts run along the wall, too, where it cuts the faces of the points' cells; no if not
    given.
    """
    network_points: int | None
    """How many points lie in the part; 0 for as many as lie a cell size apart; 0 if not given."""
    network_relax: int | None
    """How often each point moves to the middle of its cell, which evens them out; 2 if not
    given.
    """
    network_reversed: bool
    """Layers upon one surface lie on its other side, against its normals; no if not given."""
    network_seed: int | None
    """Another seed draws other points; 1 if not given."""
    network_shortest: float | str | None
    """Struts shorter than this are drawn together into one node; 0 for four radii, mm, 0 or 1e-09
    to 1e+06; 0 if not given.
    """
    network_thickness: float | str | None
    """Of the layers of cells upon one surface together, mm, 0 or 1e-09 to 1e+06; 0 if not given."""
    open_faces: Any
    """A `LatticeSpec`'s open_faces."""
    open_plane: Any
    """A plane, by a point and a normal, whose faces have no skin; may be repeated."""
    orientation: Any
    """A `LatticeSpec`'s orientation."""
    origin: Any
    """A point that is to be a corner of a cell; of a network of a file, where its own origin is to
    lie, mm; the corner of the part's box; of a file 0, 0, 0 if not given.
    """
    output: Any
    """A `LatticeSpec`'s output."""
    radius_column: str
    """Which values of the file or the FEM result; empty for the only ones, or for vonMises."""
    radius_curve: Any
    """Values and their radii in mm, such as '0:0.5, 120:1.2', in place of the start and the end."""
    radius_direction: Any
    """The radius varies along it; 1,0,0 if not given."""
    radius_end: float | str | None
    """Radius at s = 1, or where the field is largest; 0 for the strut radius, mm, 0 or 1e-09 to
    1e+06; 0 if not given.
    """
    radius_field: str | ByPlace
    """File of points and values: .csv, .txt, .vtu, .vtk; or by place."""
    radius_formula: str
    """Radius in mm as a formula of s."""
    radius_grading: Any
    """Struts whose radius varies: along a direction, by the depth below the skin (s = 1 at the
    skin, or at the core), or by a field of values; none if not given.
    """
    radius_profile: Literal["linear", "quadratic", "exponential", "formula"]
    """Profile of the radius over s; linear if not given."""
    radius_reach: float | str | None
    """Depth at which the profile ends, mm, 1e-09 to 1e+06; 5 if not given."""
    radius_start: float | str | None
    """Radius at s = 0, or where the field is smallest; 0 for the strut radius, mm, 0 or 1e-09 to
    1e+06; 0 if not given.
    """
    relative_density: float | ByPlace | None
    """In place of the radius: volume of the lattice over that of what it fills, between 0 and 1,
    1e-06 to 1e+06; or by place.
    """
    remove_below: float | str | None
    """Take away struts that are nowhere thicker than this radius; 0 for none, mm, 0 or 1e-09 to
    1e+06; 0 if not given.
    """
    remove_dangling: bool
    """Take away struts with a free end, again and again until there are none; no if not given."""
    remove_flatter: float | None
    """Take away struts that lie flatter than so many degrees to the build plate, and those with a
    free end then; 0 for none, 0 or 1e-06 to 1e+06; 0 if not given.
    """
    resolution: int | None
    """Facets along the edge of a cell; 0 to choose it by the deviation; 0 if not given."""
    rotate: Any
    """Turns the lattice, not the solid: about this axis, by this angle, counter-clockwise seen
    against it; cells then begin at a corner of the box that is turned with them; not turned if not
    given.
    """
    rotate_origin: Any
    """The point that stays in place when the lattice turns, mm; the middle of the part's box, or a
    cell map's centre if not given.
    """
    shell: float | ByPlace | None
    """Thickness of the closed skin; 0 for none: the lattice is cut at the outer surface, mm, 1e-09
    to 1e+06; 2 if not given; or by place.
    """
    shortest_stub: float | str | None
    """Take away struts with a free end that are shorter than this; 0 for none, mm, 0 or 1e-09 to
    1e+06; 0 if not given.
    """
    size_grading: Any
    """Cells that grow along a direction: the profile of lambda (section 2.5 of the method); none if
    not given.
    """
    skin_face: Any
    """Skin below the smooth face at a point, or below the faces in a plane by a point and a normal,
    of a thickness, the last number; 0 leaves them open; may be repeated.
    """
    skin_field: str | ByPlace
    """File of points and thicknesses of the skin, which it follows below all other faces, nowhere
    thinner than the shell; or by place.
    """
    stiffness: Any
    """In place of the radius: Young's modulus along 100, 110, 111 or X,Y,Z of the cell, in MPa with
    a material, else in units of the solid's.
    """
    strut_radius: float | ByPlace | None
    """r: radius of the struts, mm, 1e-09 to 1e+06; 1 if not given; or by place."""
    target: Any
    """A `LatticeSpec`'s target."""
    wall: Any
    """A `LatticeSpec`'s wall."""
    wall_formula: str
    """The surface of the cell Formula: zero on it, of x, y and z, which run from 0 to 2 pi over a
    cell.
    """
    wall_kind: Literal["sheet", "skeleton", "complement"]
    """sheet: a wall about the surface; skeleton: where its formula is negative; complement: where
    it is positive; sheet if not given.
    """
    wall_offset: float | None
    """By how many mm a skeleton or complement is thicker than up to the surface; negative for a
    thinner one, 0 or 1e-06 to 1e+06; 0 if not given.
    """
    wall_thickness: float | ByPlace | None
    """Thickness of a sheet, measured across it, mm, 1e-09 to 1e+06; 1 if not given; or by place."""


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
    skin_thinnest: float
    skin_thickest: float
    skin_patch: float
    sized_mass: float
