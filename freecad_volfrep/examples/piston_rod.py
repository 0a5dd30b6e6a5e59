# SPDX-License-Identifier: LGPL-2.1-or-later
"""A small engine's piston rod: two eyes, a tapered I-section between them, an oil hole."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from . import modelling as m

#: What the spreadsheet starts with: alias to (mm, meaning). X along the rod, Z through the eyes.
SIZES: dict[str, tuple[float, str]] = {
    "length": (121.0, "Overall length (X)"),
    "big_end": (28.0, "Outer diameter of the big end (Y)"),
    "thickness": (11.6, "Thickness of both ends (Z)"),
    "big_bore": (18.0, "Bore of the big end"),
    "small_end": (17.0, "Outer diameter of the small end"),
    "small_bore": (9.0, "Bore of the small end"),
    "shank": (9.6, "Thickness of the shank"),
    "shank_foot": (10.0, "Half width of the shank at the big end's centre"),
    "shank_tip": (6.0, "Half width of the shank at the small end"),
    "neck": (6.0, "Radius where the shank's sides enter the round ends"),
    "web": (4.0, "Thickness of the web between the pockets"),
    "flange": (3.2, "Width of the flanges beside the pockets"),
    "pocket_start": (19.0, "Begin of the pockets, from the big end's centre"),
    "pocket_end": (82.0, "Centre of the pockets' round end, from the big end's centre"),
    "oil_hole": (2.0, "Diameter of the oil hole in the small end"),
}
POCKET_RADIUS = 1.5
CORNER_RADIUS = 2.0


def make_piston_rod(doc: Any) -> Any:
    """Model the piston rod in `doc`; its sizes are in the new spreadsheet ``PistonRodSizes``.

    Returns:
        The finished part, a Part feature with one valid solid of 121 x 28 x 11.6 mm.
    """
    before = set(doc.Objects)
    sheet = m.make_sizes(doc, "PistonRodSizes", SIZES)
    s = sheet.Name + "."
    v = {alias: value for alias, (value, _) in SIZES.items()}
    pitch = f"({s}length - {s}big_end / 2 - {s}small_end / 2)"
    pitch_start = v["length"] - v["big_end"] / 2 - v["small_end"] / 2
    along_x = App.Placement(App.Vector(), App.Rotation(App.Vector(0, 0, 1), -90))

    outline = m.add_rod_outline(
        doc,
        "ShankOutline",
        along_x,
        (v["big_end"] / 2, s + "big_end / 2"),
        (pitch_start, pitch, v["small_end"] / 2, s + "small_end / 2"),
        (v["shank_foot"], s + "shank_foot", v["shank_tip"], s + "shank_tip"),
        (v["neck"], s + "neck"),
    )
    shank = m.extrude(doc, "Shank", outline, (0, 0, 1), s + "shank")
    ends = [
        _cylinder(doc, "BigEnd", s + "big_end / 2", s + "thickness", "0 mm"),
        _cylinder(doc, "SmallEnd", s + "small_end / 2", s + "thickness", pitch),
    ]
    blank = m.add(doc, "Part::MultiFuse", "Blank", {}, Shapes=[shank, *ends])

    tools = [
        _cylinder(doc, "BigBore", s + "big_bore / 2", s + "thickness", "0 mm"),
        _cylinder(doc, "SmallBore", s + "small_bore / 2", s + "thickness", pitch),
        _oil_hole(doc, s, pitch),
    ]
    # The pockets taper with the shank: its half width at a distance, less the flange.
    slope = f"({s}shank_foot - {s}shank_tip) / {pitch}"
    slope_start = (v["shank_foot"] - v["shank_tip"]) / pitch_start
    pocket_profile = m.add_rounded_taper(
        doc,
        "PocketProfile",
        along_x,
        (
            v["pocket_start"],
            s + "pocket_start",
            v["shank_foot"] - v["flange"] - slope_start * v["pocket_start"],
            f"({s}shank_foot - {s}flange - {slope} * {s}pocket_start)",
        ),
        (
            v["pocket_end"],
            s + "pocket_end",
            v["shank_foot"] - v["flange"] - slope_start * v["pocket_end"],
            f"{s}shank_foot - {s}flange - {slope} * {s}pocket_end",
        ),
        CORNER_RADIUS,
    )
    pocket_profile.setExpression("Placement.Base.z", f"({s}web + {s}shank) / 2")
    block = m.extrude(doc, "Pocket", pocket_profile, (0, 0, 1), s + "shank")
    pocket = m.fillet(doc, "RoundedPocket", block, _pocket_radius)
    normal = App.Vector(0, 0, 1)
    mirrored = m.add(doc, "Part::Mirroring", "MirroredPocket", {}, Source=pocket, Normal=normal)
    tools += [pocket, mirrored]
    cuts = m.add(doc, "Part::MultiFuse", "Cuts", {}, Shapes=tools)
    part = m.add(doc, "Part::Cut", "PistonRod", {}, Base=blank, Tool=cuts)
    doc.recompute()
    m.hide([obj for obj in doc.Objects if obj not in before and obj is not part])
    return part


def _cylinder(doc: Any, label: str, radius: str, height: str, x: str) -> Any:
    """A cylinder along Z about the XY plane at a distance along X."""
    placement = {"Placement.Base.x": x, "Placement.Base.z": f"-{height} / 2"}
    return m.add(doc, "Part::Cylinder", label, {"Radius": radius, "Height": height, **placement})


def _oil_hole(doc: Any, s: str, pitch: str) -> Any:
    """A cylinder along X from the small end's centre through its tip."""
    turned = App.Placement(App.Vector(), App.Rotation(App.Vector(0, 1, 0), 90))
    expressions = {
        "Radius": s + "oil_hole / 2",
        "Height": s + "small_end",
        "Placement.Base.x": pitch,
    }
    return m.add(doc, "Part::Cylinder", "OilHole", expressions, Placement=turned)


def _pocket_radius(edge: Any) -> float:
    """For a pocket's floor, the side towards the web."""
    floor = SIZES["web"][0] / 2
    on_floor = all(abs(abs(vertex.Point.z) - floor) < 1e-6 for vertex in edge.Vertexes)
    return POCKET_RADIUS if on_floor else 0.0
