# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lug bracket: a scalloped base plate on four bolts that carries a pin between two lugs."""

from __future__ import annotations

from typing import Any

import FreeCAD as App

from . import modelling as m

#: What the spreadsheet starts with: alias to (mm, meaning). X along the plate, Y up, Z across.
SIZES: dict[str, tuple[float, str]] = {
    "length": (178.5, "Length of the base plate (X)"),
    "height": (62.5, "Height over the lugs (Y)"),
    "width": (108.3, "Width of the base plate (Z)"),
    "plate": (20.0, "Thickness of the base plate"),
    "scallop": (30.0, "Radius of the scallops in the plate's short ends"),
    "scallop_offset": (14.0, "Scallop centres beyond the plate's ends"),
    "bolt_x": (140.0, "Bolt pitch along the plate"),
    "bolt_z": (74.0, "Bolt pitch across the plate"),
    "bolt_hole": (10.5, "Diameter of the bolt holes"),
    "bolt_seat": (24.0, "Diameter of the spot faces under the bolt heads"),
    "seat_depth": (2.0, "Depth of the spot faces"),
    "lug": (23.0, "Thickness of a lug"),
    "lug_gap": (26.0, "Gap between the lugs"),
    "lug_foot": (58.0, "Half length of a lug at the plate's underside"),
    "eye": (20.5, "Outer radius of the lug eyes"),
    "pin": (20.0, "Diameter of the pin hole"),
    "rib": (9.0, "Thickness of the ribs beside the lugs"),
    "rib_x": (48.0, "Distance between a lug's two ribs"),
    "rib_height": (13.0, "Height of the ribs above the plate"),
    "rib_foot": (14.0, "Length of the ribs on the plate"),
}
CORNER_RADIUS = 13.0
SCALLOP_RADIUS = 6.0
FOOT_RADIUS = 6.0


def make_bracket(doc: Any) -> Any:
    """Model the bracket in `doc`; its sizes are in the new spreadsheet ``BracketSizes``.

    Returns:
        The finished part, a Part feature with one valid solid of 178.5 x 62.5 x 108.3 mm.
    """
    before = set(doc.Objects)
    sheet = m.make_sizes(doc, "BracketSizes", SIZES)
    s = sheet.Name + "."
    start = {alias: value for alias, (value, _) in SIZES.items()}
    upright = App.Rotation(App.Vector(1, 0, 0), -90)  # turns a cylinder's axis from Z to Y

    plate = m.add(
        doc,
        "Part::Box",
        "BasePlate",
        {
            "Length": s + "length",
            "Width": s + "plate",
            "Height": s + "width",
            "Placement.Base.x": f"-{s}length / 2",
            "Placement.Base.z": f"-{s}width / 2",
        },
    )
    scallops = [
        m.add(
            doc,
            "Part::Cylinder",
            "Scallop",
            {
                "Radius": s + "scallop",
                "Height": s + "plate",
                "Placement.Base.x": f"{sign}({s}length / 2 + {s}scallop_offset)",
            },
            Placement=App.Placement(App.Vector(), upright),
        )
        for sign in ("", "-")
    ]
    outline = m.add(
        doc, "Part::Cut", "Outline", {}, Base=plate, Tool=_union(doc, "Scallops", scallops)
    )
    rounded = m.fillet(doc, "RoundedPlate", outline, _corner_radius)

    lugs = []
    for sign in ("", "-"):
        profile = m.add_tangent_taper(
            doc,
            "LugProfile",
            None,
            (0.5, f"{s}plate / 40", start["lug_foot"], s + "lug_foot"),
            (start["height"] - start["eye"], f"{s}height - {s}eye", start["eye"], s + "eye"),
        )
        profile.setExpression("Placement.Base.z", f"{sign}({s}lug_gap + {s}lug) / 2")
        lugs.append(m.extrude(doc, "Lug", profile, (0, 0, 1), s + "lug"))
    raw = _union(doc, "PlateAndLugs", [rounded, *lugs])
    filleted = m.fillet(doc, "FilletedFeet", raw, _foot_radius)

    ribs = [_rib(doc, s, x_sign, z_sign) for x_sign in ("", "-") for z_sign in ("", "-")]
    ribbed = _union(doc, "RibbedBody", [filleted, *ribs])

    holes = [
        m.add(
            doc,
            "Part::Cylinder",
            "PinHole",
            {
                "Radius": s + "pin / 2",
                "Height": s + "width",
                "Placement.Base.y": f"{s}height - {s}eye",
                "Placement.Base.z": f"-{s}width / 2",
            },
        )
    ]
    for x_sign in ("", "-"):
        for z_sign in ("", "-"):
            place = {
                "Placement.Base.x": f"{x_sign}{s}bolt_x / 2",
                "Placement.Base.z": f"{z_sign}{s}bolt_z / 2",
            }
            hole = {"Radius": s + "bolt_hole / 2", "Height": s + "plate", **place}
            seat = {
                "Radius": s + "bolt_seat / 2",
                "Height": s + "plate",
                "Placement.Base.y": f"{s}plate - {s}seat_depth",
                **place,
            }
            for label, expressions in (("BoltHole", hole), ("BoltSeat", seat)):
                placement = App.Placement(App.Vector(), upright)
                holes.append(m.add(doc, "Part::Cylinder", label, expressions, Placement=placement))
    part = m.add(doc, "Part::Cut", "Bracket", {}, Base=ribbed, Tool=_union(doc, "Holes", holes))
    doc.recompute()
    m.hide([obj for obj in doc.Objects if obj not in before and obj is not part])
    return part


def _rib(doc: Any, s: str, x_sign: str, z_sign: str) -> Any:
    """A triangular rib from a lug's outer face down to the plate."""
    inner, outer = f"({s}lug_gap + {s}lug) / 2", f"{s}lug_gap / 2 + {s}lug"
    reach = f"{outer} + {s}rib_foot"
    ends = (f"-({reach})", f"-({outer})", f"-{inner}") if z_sign else (inner, outer, reach)
    low, high = ends[0], ends[2]
    top = (ends[1], high) if z_sign else (low, ends[1])
    sides = (f"{x_sign}{s}rib_x / 2 - {s}rib / 2", f"{x_sign}{s}rib_x / 2 + {s}rib / 2")
    return m.add(
        doc,
        "Part::Wedge",
        "Rib",
        {
            **{"Xmin": sides[0], "X2min": sides[0], "Xmax": sides[1], "X2max": sides[1]},
            **{"Ymin": s + "plate / 2", "Ymax": f"{s}plate + {s}rib_height"},
            **{"Zmin": low, "Zmax": high, "Z2min": top[0], "Z2max": top[1]},
        },
    )


def _union(doc: Any, label: str, shapes: list[Any]) -> Any:
    return m.add(doc, "Part::MultiFuse", label, {}, Shapes=shapes)


def _corner_radius(edge: Any) -> float:
    """For an upright edge of the plate's outline: a corner, or where a scallop meets an end."""
    first, last = edge.Vertexes[0].Point, edge.Vertexes[-1].Point
    upright = abs(first.x - last.x) + abs(first.z - last.z) < 1e-6 < abs(first.y - last.y)
    is_corner = abs(first.z) > SIZES["width"][0] / 2 - 1e-6
    return (CORNER_RADIUS if is_corner else SCALLOP_RADIUS) if upright else 0.0


def _foot_radius(edge: Any) -> float:
    """For an edge in the plate's upper face that is not on its rim: around a lug's foot."""
    box, plate = edge.BoundBox, SIZES["plate"][0]
    in_upper_face = abs(box.YMin - plate) < 1e-4 and abs(box.YMax - plate) < 1e-4
    furthest_lug = SIZES["lug_gap"][0] / 2 + SIZES["lug"][0] + 1e-4
    beside_lug = max(abs(box.ZMin), abs(box.ZMax)) < furthest_lug
    within_foot = max(abs(box.XMin), abs(box.XMax)) < SIZES["lug_foot"][0]
    return FOOT_RADIUS if in_upper_face and beside_lug and within_foot else 0.0
