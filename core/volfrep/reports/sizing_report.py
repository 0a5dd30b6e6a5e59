# SPDX-License-Identifier: LGPL-2.1-or-later
"""What sizing came to: before and after, at the same mass and at the same limits."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..loads.load_cases import LoadCases
from ..sizing.analysis import Analysis
from ..sizing.model import SizingModel
from ..sizing.optimise import Sized
from ..util.numbers import place_text
from ..util.peaks import PEAKS

#: Cantilevers of the six cells as second-order tetrahedra, sized and of one radius, gained at least
#: 0.79 of what is told: joints of thick struts between thin ones are less stiff than those of a
#: cell of one radius, to which beams' ends are fitted. So no less than this is left.
GAIN_IN_SOLIDS = 0.75


def sizing_report(
    loads: LoadCases,
    model: SizingModel,
    sized: Sized,
    before: Analysis,
    even: tuple[Analysis, bool] | None,
    proof: Mapping[str, Any] | None,
    *,
    seconds: Mapping[str, float],
    notes: tuple[str, ...] = (),
    unthinned: tuple[Analysis, int] | None = None,
) -> dict[str, Any]:
    """The figures as plain JSON values.

    Args:
        loads: material and cases.
        model: what was solved.
        sized: the design.
        before: one radius, the same volume.
        even: one radius, the same limits, and whether it holds them; None without limits.
        proof: how far another solver agrees; None where none was asked.
        seconds: by stage; their sum is told, too.
        notes: sentences for the user.
        unthinned: the design with the struts that were taken away, and how many these are; None
            where none was.
    """
    problem, final, density = model.problem, sized.analysis, loads.material.density
    # What supports alone strain is not more or less stiff.
    works = np.abs(final.compliance) > 0.0
    gains = (before.compliance[works] / final.compliance[works]).tolist()
    result: dict[str, Any] = {
        "material": loads.material.as_dict(),
        "struts": len(problem.structure.beams.struts),
        "nodes": len(final.radii),
        "radii_mm": [float(final.radii.min()), float(final.radii.max())],
        "bounds_mm": [float(problem.low.min()), float(problem.high.max())],
        "strut_volume_mm3": final.volume,
        "strut_mass_g": final.volume * density / 1000.0,
        "skin_mass_g": model.skin_volume * density / 1000.0,
        "masses_g": {
            "struts": final.volume * density / 1000.0,
            "skin": model.skin_volume * density / 1000.0,
            "solid": 0.0,
        },
        "holds": sized.holds,
        "uses": final.uses,
        "cases": [_case(model, before, final, k) for k in range(len(problem.cases))],
        "same_mass": {
            "radius_mm": float(before.radii.mean()),
            "stiffer": gains,
            "stiffer_at_least": [least_gain(gain) for gain in gains],
            "less_stress": float(before.stress.max() / final.stress.max()),
        },
        "stopped": sized.stopped,
        "steps": [
            {"strut_volume_mm3": step.volume, "compliance": step.compliance, "uses": step.uses}
            for step in (*sized.steps, sized.last)
        ],
        "calculix": None if proof is None else dict(proof),
        "seconds": {**seconds, "total": sum(seconds.values())},
        "notes": list(notes),
    }
    if not np.isnan(final.frequency):
        result["lowest_frequency_hz"] = final.frequency
    if unthinned is not None:
        whole, gone = unthinned
        result["removed"] = {
            "struts": gone,
            "with_them": {
                "strut_volume_mm3": whole.volume,
                "strut_mass_g": whole.volume * density / 1000.0,
                "compliance_nmm": whole.compliance.tolist(),
                "displacement_mm": whole.largest.tolist(),
                "uses": whole.uses,
            },
        }
    if even is not None:
        uniform, holds = even
        result["same_limits"] = {
            "radius_mm": float(uniform.radii.mean()),
            "holds": holds,
            "strut_volume_mm3": uniform.volume,
            "mass_saved": 1.0 - final.volume / uniform.volume,
        }
    if model.skin is not None:
        moved = final.displacements[model.frame_nodes :]
        result["skin_stress_mpa"] = model.skin.peaks(moved)
    return result


def least_gain(gain: float) -> float:
    """What solids may leave of how many times as stiff a design is as one radius."""
    return min(gain, max(1.0, GAIN_IN_SOLIDS * gain))


def sizing_rows(report: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The figures as lines for a user."""
    low, high = report["radii_mm"]
    rows: list[tuple[str, str]] = [
        ("struts", f"{report['struts']:,}, radii {low:.3g} to {high:.3g} mm"),
        ("strut mass", f"{report['strut_mass_g']:.4g} g of {report['material']['name']}"),
    ]
    if "as_printed" in report:
        thin, thick = report["as_printed"]["diameters_mm"]
        value = f"this mass and all that follows is of struts {thin:.3g} to {thick:.3g} mm thick"
        rows.append(("as printed", f"{value} ({report['as_printed']['table']})"))
    if "building" in report:
        rows.append(("built", _built(report["building"])))
    if report["skin_mass_g"]:
        rows.append(("skin mass", f"{report['skin_mass_g']:.4g} g"))
    if "radius_list" in report:
        listed = report["radius_list"]
        pairs = zip(listed["radii_mm"], listed["nodes"], strict=True)
        text = ", ".join(f"{radius:g} mm ({nodes:,} nodes)" for radius, nodes in pairs)
        cost = listed["volume_over_any_radii"] - 1.0
        rows.append(("radius list", f"{text}; {cost:+.1%} of the mass with any radii"))
    if "governed_by" in report:
        rows.append(("governed by", _governed(report["governed_by"])))
    proof = report["calculix"]
    there = (proof or {}).get("uses", {})
    for name, use in report["uses"].items():
        said = "" if proof is None else ", not compared in CalculiX"
        if name in there:
            said = f", {there[name]:.1%} in CalculiX"
        rows.append((f"{name} limit", f"{use:.1%} used{said}"))
    factors = (report["calculix"] or {}).get("buckling_factors", [None] * len(report["cases"]))
    for k, case in enumerate(report["cases"]):
        own = case["frame_buckling_factor"]
        if own is not None:
            found = "" if factors[k] is None else f", {factors[k]:.3g} in CalculiX"
            text = f"the whole buckles at {own:.3g} times the load{found}"
            rows.append((f"case {case['name']}", text))
    rows += [
        (
            f"case {case['name']}",
            f"moves {case['displacement_mm']:.4g} mm, stress {case['stress_mpa']:.4g} MPa, "
            f"{case['buckling']:.1%} of buckling; one radius of the same mass: "
            f"{case['before']['displacement_mm']:.4g} mm, {case['before']['stress_mpa']:.4g} MPa",
        )
        for case in report["cases"]
    ]
    if "removed" in report:
        whole, places = report["removed"]["with_them"], report["removed"].get("places", [])
        where = ""
        if places:
            where = (
                f" in {len(places)} places, {places[0]['struts']:,} about "
                f"{place_text(places[0]['middle_mm'])}"
            )
        rows.append(
            (
                "removed",
                f"{report['removed']['struts']:,} thin struts{where}; with them "
                f"{whole['strut_mass_g']:.4g} g and {max(whole['displacement_mm']):.4g} mm",
            )
        )
    same = report["same_mass"]
    value = f"one radius of {same['radius_mm']:.3g} mm"
    if same["stiffer"]:
        value = (
            f"{min(same['stiffer_at_least']):.2f} to {min(same['stiffer']):.2f} times as stiff as "
            f"{value} (beams say the most, solids may say the least)"
        )
    rows.append(("same mass", f"{value}, {_share_of_stress(same['less_stress'])}"))
    if "same_limits" in report:
        even = report["same_limits"]
        what = "holds the same limits" if even["holds"] else "does not even hold the limits"
        rows.append(
            (
                "same limits",
                f"one radius of {even['radius_mm']:.3g} mm {what} with "
                f"{even['strut_volume_mm3'] / report['strut_volume_mm3']:.2f} times the mass",
            )
        )
    if "skin_stress_mpa" in report:
        most = max(report["skin_stress_mpa"])
        stress = (proof or {}).get("skin_stress_mpa")
        value = f", {max(stress):.4g} MPa in CalculiX" if stress else ""
        rows.append(("skin stress", f"{most:.4g} MPa on all but {PEAKS:.1%} of its area{value}"))
    if "skin" in report:
        skin, held = report["skin"], report["skin"]["there_over_asked"]
        low, high = skin["thickness_mm"]
        rows.append(
            (
                "skin",
                f"{low:.3g} to {high:.3g} mm, {skin['mean_thickness_mm']:.3g} mm on average; in "
                f"the part {held['5%']:.1%} to {held['95%']:.1%} of that on 90% of its area",
            )
        )
        governed = ", ".join(
            f"{_limit(row)} ({row['share']:.0%} of its area)" for row in skin["governed_by"]
        )
        rows.append(("skin governed by", governed))
        if skin["solid"]:
            rows.append(("solid", _solid(skin["solid"])))
        if skin["even"] is not None:
            even = skin["even"]
            mass = even["volume_mm3"] * report["material"]["density"] / 1000.0
            what = "hold the same limits" if even["holds"] else "do not even hold the limits"
            rows.append(
                (
                    "one skin",
                    f"{even['thickness_mm']:.3g} mm and one radius of {even['radius_mm']:.3g} mm "
                    f"{what} with {mass:.4g} g",
                )
            )
    rows.append(("CalculiX", _confirmation(proof)))
    if "file" in report:
        rows += _file_rows(report["file"])
    return rows


def _built(figures: Mapping[str, Any]) -> str:
    """By which process, along which direction, and what of the part is less steep than it asks."""
    said = f"by {figures['process']} along {along_text(figures['build_direction'])}"
    least = figures["inclination_degrees"]
    if not least:
        return f"{said}, which needs no support"
    hanging = ", ".join(
        f"{figures[name]['area_mm2']:,.0f} mm2 of {what}"
        for name, what in (("outside", "its outside"), ("ceilings", "ceilings within its skin"))
        if name in figures
    )
    return (
        f"{said}: {figures['removed']:,} struts flatter than {least:g} degrees removed; flatter "
        f"are {hanging}"
    )


def along_text(direction: Sequence[float]) -> str:
    """A direction as it is told: the axis that it is along, or its components."""
    axes = [k for k, part in enumerate(direction) if part]
    if len(axes) == 1:
        return f"{'-' * (direction[axes[0]] < 0.0)}{'xyz'[axes[0]]}"
    return ", ".join(f"{part:.3g}" for part in direction)


def _governed(rows: list[dict[str, Any]]) -> str:
    """Which limit, in which case, says how thick how many struts are."""
    return ", ".join(f"{_limit(row)} ({row['struts']:,} struts)" for row in rows)


def _limit(row: Mapping[str, Any]) -> str:
    """What governs, with its load case."""
    return f"{row['what']}{' in ' * bool(row['case'])}{row['case']}"


def _solid(places: list[dict[str, Any]]) -> str:
    """How much is solid, in how many places, and where the heaviest lies."""
    mass = sum(place["mass_g"] for place in places)
    return (
        f"{mass:.4g} g of the skin where both its sides meet, in {len(places)} places; the "
        f"heaviest, {places[0]['mass_g']:.4g} g, about {place_text(places[0]['middle_mm'])}"
    )


def _file_rows(file: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The finished file solved as a solid, beside the design and CalculiX."""
    edge = sum(file["voxels"][-1]["edge_mm"]) / 3.0
    rows = [("the file", f"solved as {file['voxels'][-1]['count']:,} voxels of {edge:.3g} mm")]
    for case in file["cases"]:
        own, solid = case["design"], case["file"]
        limit, stress = solid["extrapolated"], solid["stress_mpa"]
        there = case["calculix"]["displacement_mm"]
        calculix = "" if there is None else f", in CalculiX {there:.4g}"
        rows.append(
            (
                f"case {case['name']}",
                f"moves {limit['displacement_mm']:.4g} mm ({solid['displacement_mm']:.4g} before "
                f"extrapolation), in the design {own['displacement_mm']:.4g}{calculix}; work "
                f"{limit['compliance_nmm'] / 2:.4g} N mm, in the design "
                f"{own['compliance_nmm'] / 2:.4g}",
            )
        )
        skin = own["skin_stress_mpa"]
        beside = "" if skin is None else f" (the design's skin {skin:.4g})"
        thick = stress["thick"]
        deep = "" if thick is None else f", where it is thick {thick:.4g}"
        rows.append(
            ("", f"nominal stress next to the outside {stress['outside']:.4g} MPa{beside}{deep}")
        )
    return rows


def _confirmation(proof: Mapping[str, Any] | None) -> str:
    """How far CalculiX agrees, and whether that confirms the design."""
    if proof is None:
        return "not confirmed: it has not solved this design"
    skin = ", skin included" if proof["with_the_skin"] else ""
    if not proof["confirmed"]:
        return f"NOT CONFIRMED{skin}: {'; '.join(proof['doubts'])}"
    stress = "the most stressed strut is too short to be compared"
    if proof["worst_strut_compared"]:
        stress = f"largest stress {proof['largest_stress'] - 1:+.2%}"
    off = max(proof["displacements_off"])
    return f"confirmed{skin}: displacements {off:.2%} off, {stress}"


def _case(model: SizingModel, before: Analysis, final: Analysis, k: int) -> dict[str, Any]:
    """One load case: what is largest in it, and where."""
    beams = model.problem.structure.beams
    strut = int(np.argmax(final.stress[:, :, k].max(axis=1)))
    place = model.problem.structure.nodes[beams.struts[strut]].mean(axis=0)
    return {
        "name": model.problem.cases[k].name,
        "compliance_nmm": float(final.compliance[k]),
        "displacement_mm": float(final.largest[k]),
        "stress_mpa": float(final.stress[:, :, k].max()),
        "worst_strut": {"number": strut, "middle_mm": place.tolist()},
        "buckling": float(final.buckling[:, k].max()),
        "frame_buckling_factor": _known(final.factors[k]),
        "before": {
            "compliance_nmm": float(before.compliance[k]),
            "displacement_mm": float(before.largest[k]),
            "stress_mpa": float(before.stress[:, :, k].max()),
            "buckling": float(before.buckling[:, k].max()),
            "frame_buckling_factor": _known(before.factors[k]),
        },
    }


def _share_of_stress(less: float) -> str:
    """The largest stress against that of one radius, whichever is larger."""
    if less >= 1.0:
        return f"largest stress {less:.2f} times lower"
    return f"largest stress {1.0 / less:.2f} times higher"


def _known(factor: float) -> float | None:
    """A load factor; None where it was not asked for, or nothing buckles."""
    return float(factor) if np.isfinite(factor) else None
