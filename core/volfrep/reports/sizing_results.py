# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of a sizing as one list, which the command, the window and the page show."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeGuard

from ..util.numbers import place_text
from ..util.peaks import PEAKS
from .tables import Table, shown

#: Whose a value is: of the design, of others that it is compared with, or in another solution of
#: the design; or what is allowed.
LIMIT, SIZED, SAME_MASS = "limit", "sized", "one radius, same mass"
SAME_LIMITS, NEARLY = "one radius, same limits", "one radius, as near as it gets"
ONE_SKIN, WITH_REMOVED = "one radius, one skin", "with the struts removed"
CALCULIX, FILE = "CalculiX", "the file's voxels"
COLUMNS = (
    LIMIT, SIZED, SAME_MASS, SAME_LIMITS, NEARLY, ONE_SKIN, WITH_REMOVED, CALCULIX, FILE,
)  # fmt: skip
#: Subjects, and how a line begins whose name alone does not say its own.
STRUTS, LIMITS, MASS, CASE = "Struts", "Limits", "Mass", "Results"
PRINTED, BUILT = "As printed, of which all figures are", "For printing"
SKIN, PROOF = "Skin", "The same beams in CalculiX"
_BEGINS = {LIMITS: "limit of ", SKIN: "skin: ", PROOF: "CalculiX: "}
MOVED, STRESS, SKIN_STRESS = "largest displacement", "largest stress", "largest stress of the skin"
#: What is allowed, by the name of its limit.
_ALLOWED = {
    "stress": "{:.4g} MPa", "skin stress": "{:.4g} MPa", "displacement": "{:.4g} mm",
    "frequency": "{:.4g} Hz or more", "buckling": "{:.4g} times the loads or more",
    "frame buckling": "{:.4g} times the loads or more",
}  # fmt: skip


@dataclass(frozen=True)
class Result:
    """A figure of a sizing.

    Attributes:
        subject: what it belongs to, the title of its table.
        name: what it is.
        values: by whose they are, of `COLUMNS`: numbers, words, or the two numbers of a range;
            None for unknown.
        unit: of the numbers.
        case: of which load case; empty for all.
        note: what is to be known of it.
    """

    subject: str
    name: str
    values: Mapping[str, Any]
    unit: str = ""
    case: str = ""
    note: str = ""

    @property
    def title(self) -> str:
        """Its name with the unit."""
        return f"{self.name}{', ' * bool(self.unit)}{self.unit}"

    @property
    def line(self) -> tuple[str, str]:
        """Case or subject with the name, and the values, those of the design first."""
        begins = f"{self.case}: " if self.case else _BEGINS.get(self.subject, "")
        texts: list[str] = []
        for whose in (SIZED, *(column for column in COLUMNS if column != SIZED)):
            value = self.values.get(whose)
            if value is not None:
                text = _range_text(value) if _is_range(value) else shown(value)
                unit = f" {self.unit}" * bool(self.unit and not texts)
                texts.append(f"{f'{whose} ' * (whose != SIZED)}{text}{unit}")
        return f"{begins}{self.name}", "; ".join([*texts, *([self.note] if self.note else ())])


def sizing_results(report: Mapping[str, Any]) -> list[Result]:
    """All figures of a report of `volfrep.reports.sizing_report`, in their order."""
    designs = _designs(report)
    results = [*_of_struts(report, designs), *_of_limits(report, designs)]
    if "as_printed" in report:
        results += _as_printed(report["as_printed"])
    if "building" in report:
        results += _for_printing(report["building"])
    if report["skin_mass_g"]:
        results += _of_masses(report)
    if "skin" in report:
        results += _of_skin(report["skin"])
    for k in range(len(report["cases"])):
        results += _of_case(report, designs, k)
    return results + _of_proof(report["calculix"])


def result_tables(results: Iterable[Result]) -> list[Table]:
    """A table a subject and load case, with a column for whose the values are, and notes."""
    groups: dict[tuple[str, str], list[Result]] = {}
    for one in results:
        groups.setdefault((one.subject, one.case), []).append(one)
    tables = []
    for (subject, case), rows in groups.items():
        there = {whose for one in rows for whose, value in one.values.items() if value is not None}
        columns = [whose for whose in COLUMNS if whose in there]
        cells = []
        for one in rows:
            row: list[Any] = [one.title]
            for whose in columns:
                value = one.values.get(whose)
                if _is_range(value) and len(columns) == 1:
                    row.extend(value)  # a number a column, where no header says whose
                else:
                    row.append(_range_text(value) if _is_range(value) else value)
            cells.append((*row, *([one.note] if one.note else ())))
        header = ("", *columns) if len(columns) > 1 else ()
        tables.append(Table(f"{subject}{' of ' * bool(case)}{case}", tuple(cells), header))
    return tables


def case_table(results: Iterable[Result]) -> Table:
    """Displacement and stress of the design, a row a load case and a column a solution."""
    columns: dict[str, dict[str, Any]] = {}
    for one in results:
        if one.name in (MOVED, STRESS, SKIN_STRESS):
            for whose in (SIZED, CALCULIX, FILE):
                if one.values.get(whose) is not None:
                    name = f"{one.title}{f', {whose}' * (whose != SIZED)}"
                    columns.setdefault(name, {})[one.case] = one.values[whose]
    cases = dict.fromkeys(case for column in columns.values() for case in column)
    rows = ((case, *(column.get(case) for column in columns.values())) for case in cases)
    return Table("Load cases", tuple(rows), ("", *columns))


def along_text(direction: Sequence[float]) -> str:
    """A direction as it is told: the axis that it is along, or its components."""
    axes = [k for k, part in enumerate(direction) if part]
    if len(axes) == 1:
        return f"{'-' * (direction[axes[0]] < 0.0)}{'xyz'[axes[0]]}"
    return ", ".join(f"{part:.3g}" for part in direction)


def _is_range(value: Any) -> TypeGuard[Sequence[float]]:
    return isinstance(value, (list, tuple))


def _range_text(value: Sequence[float]) -> str:
    return " to ".join(map(shown, value))


#: A design's radii in mm, mass of struts in g, uses of limits, and figures of every load case.
_Design = tuple[Any, float, Mapping[str, float], Sequence[Mapping[str, Any]]]


def _designs(report: Mapping[str, Any]) -> dict[str, _Design]:
    """The design and those that it is compared with, by whose they are."""
    cases, mass = report["cases"], report["strut_mass_g"]
    same = report["same_mass"]
    designs = {
        SIZED: (report["radii_mm"], mass, report["uses"], cases),
        SAME_MASS: (
            [same["radius_mm"]] * 2, mass, same["uses"], [case["before"] for case in cases]
        ),
    }  # fmt: skip
    if "same_limits" in report:
        even = report["same_limits"]
        designs[SAME_LIMITS if even["holds"] else NEARLY] = (
            [even["radius_mm"]] * 2, mass * even["strut_volume_mm3"] / report["strut_volume_mm3"],
            even["uses"], [case["same_limits"] for case in cases],
        )  # fmt: skip
    if "removed" in report:
        whole = report["removed"]["with_them"]
        of_cases = [
            {key: whole[key][k] for key in ("compliance_nmm", "displacement_mm")}
            for k in range(len(cases))
        ]
        designs[WITH_REMOVED] = (None, whole["strut_mass_g"], whole["uses"], of_cases)
    return designs


def _of_struts(report: Mapping[str, Any], designs: Mapping[str, _Design]) -> list[Result]:
    radii = {whose: design[0] for whose, design in designs.items() if design[0]}
    masses = {whose: design[1] for whose, design in designs.items()}
    results = [
        Result(STRUTS, "struts", {SIZED: report["struts"]}),
        Result(STRUTS, "mass of the struts", masses, "g", note=report["material"]["name"]),
        Result(STRUTS, "smallest radius", {whose: low for whose, (low, _) in radii.items()}, "mm"),
        Result(STRUTS, "largest radius", {whose: top for whose, (_, top) in radii.items()}, "mm"),
    ]
    if "radius_list" in report:
        listed = report["radius_list"]
        pairs = zip(listed["radii_mm"], listed["nodes"], strict=True)
        text = ", ".join(f"{radius:g} mm ({nodes:,} nodes)" for radius, nodes in pairs)
        cost = f"{listed['volume_over_any_radii'] - 1.0:+.1%} of the mass with any radii"
        results.append(Result(STRUTS, "radius list", {SIZED: text}, note=cost))
    if "governed_by" in report:
        text = ", ".join(
            f"{_limit(row)} ({row['struts']:,} struts)" for row in report["governed_by"]
        )
        results.append(Result(STRUTS, "governed by", {SIZED: text}))
    if "removed" in report:
        removed, where = report["removed"], ""
        places = removed.get("places", [])
        if places:
            middle = place_text(places[0]["middle_mm"])
            where = f"in {len(places)} places, {places[0]['struts']:,} about {middle}"
        results.append(
            Result(STRUTS, "thin struts removed", {SIZED: removed["struts"]}, note=where)
        )
    same = report["same_mass"]
    if same["stiffer"]:
        gain = [min(same["stiffer_at_least"]), min(same["stiffer"])]
        note = "beams say the most, solids may say the least"
        unit = "times as stiff as one radius"
        results.append(Result(STRUTS, "same mass", {SIZED: gain}, unit, note=note))
    return results


def _of_limits(report: Mapping[str, Any], designs: Mapping[str, _Design]) -> list[Result]:
    proof, results = report["calculix"], []
    for name in report["uses"]:
        uses = {whose: design[2] for whose, design in designs.items()}
        uses[CALCULIX] = {} if proof is None else proof["uses"]
        values = {whose: 100.0 * own[name] for whose, own in uses.items() if name in own}
        note = "not compared in CalculiX" * (proof is not None and CALCULIX not in values)
        allowed = _ALLOWED[name].format(report["limits"][name])
        results.append(
            Result(LIMITS, name, {LIMIT: allowed, **values}, "% of its limit", note=note)
        )
    return results


def _as_printed(printed: Mapping[str, Any]) -> list[Result]:
    rows = (
        ("table of diameters", "", printed["table"], ""),
        ("standard deviations thinner", "", printed["scatters"], "for stress and buckling"),
        ("thinnest and thickest strut as printed", "mm", printed["diameters_mm"], ""),
        ("thinnest and thickest strut as drawn", "mm", printed["drawn_diameters_mm"], ""),
        ("mass of the struts as drawn", "g", printed["drawn_strut_mass_g"], ""),
    )
    return [
        Result(PRINTED, name, {SIZED: value}, unit, "", note) for name, unit, value, note in rows
    ]


def _for_printing(built: Mapping[str, Any]) -> list[Result]:
    rows = [
        ("process", "", built["process"]),
        ("build direction", "", along_text(built["build_direction"])),
    ]
    if built["inclination_degrees"]:
        rows += [
            ("builds without support from", "degrees", built["inclination_degrees"]),
            ("flatter struts removed", "", built["removed"]),
            ("flatter parts of the outside", "mm2", built["outside"]["area_mm2"]),
        ]
        if "ceilings" in built:
            rows.append(("flatter ceilings within the skin", "mm2", built["ceilings"]["area_mm2"]))
    return [Result(BUILT, name, {SIZED: value}, unit) for name, unit, value in rows]


def _of_masses(report: Mapping[str, Any]) -> list[Result]:
    split, where, beside = report["masses_g"], "", {}
    whole = split["struts"] + split["skin"]
    if "skin" in report:
        places, even = report["skin"]["solid"], report["skin"]["even"]
        if places:
            where = (
                f"in {len(places)} places; the heaviest, {places[0]['mass_g']:.4g} g, about "
                f"{place_text(places[0]['middle_mm'])}"
            )
        if even is not None:
            beside[ONE_SKIN] = even["volume_mm3"] * report["material"]["density"] / 1000.0
    note = f"{split['skin'] / whole:.0%}"
    results = [Result(MASS, "mass of the skin", {SIZED: split["skin"]}, "g", note=note)]
    if split["solid"]:
        results.append(Result(MASS, "of that solid", {SIZED: split["solid"]}, "g", note=where))
    return [*results, Result(MASS, "mass", {SIZED: whole, **beside}, "g")]


def _of_skin(skin: Mapping[str, Any]) -> list[Result]:
    (low, high), even = skin["thickness_mm"], skin["even"]
    beside = {} if even is None else {ONE_SKIN: even["thickness_mm"]}
    held = [100.0 * skin["there_over_asked"][share] for share in ("5%", "95%")]
    governed = (f"{_limit(row)} ({row['share']:.0%} of its area)" for row in skin["governed_by"])
    results = [
        Result(SKIN, "smallest thickness", {SIZED: low, **beside}, "mm"),
        Result(SKIN, "mean thickness", {SIZED: skin["mean_thickness_mm"], **beside}, "mm"),
        Result(SKIN, "largest thickness", {SIZED: high, **beside}, "mm"),
        Result(
            SKIN, "thickness there", {SIZED: held}, "% of what was asked",
            note="on 90% of its area",
        ),
        Result(SKIN, "governed by", {SIZED: ", ".join(governed)}),
    ]  # fmt: skip
    if even is not None:
        note = "" if even["holds"] else "does not hold the limits"
        results.append(Result(SKIN, "radius", {ONE_SKIN: even["radius_mm"]}, "mm", note=note))
    return results


def _of_case(report: Mapping[str, Any], designs: Mapping[str, _Design], k: int) -> list[Result]:
    case, proof = report["cases"][k], report["calculix"] or {}
    file = report["file"]["cases"][k]["file"] if "file" in report else {}
    solid, nominal, voxels = file.get("extrapolated", {}), file.get("stress_mpa", {}), ""
    if file:
        finest = report["file"]["voxels"][-1]
        voxels = f"{finest['count']:,} voxels of {sum(finest['edge_mm']) / 3.0:.3g} mm"

    def of_all(key: str, told: Callable[[float], float] = float) -> dict[str, Any]:
        found = {whose: design[3][k].get(key) for whose, design in designs.items()}
        found[FILE] = solid.get(key)
        return {whose: None if value is None else told(value) for whose, value in found.items()}

    moved, together = of_all("displacement_mm"), of_all("frame_buckling_factor")
    if proof:
        moved[CALCULIX] = proof["largest_displacement"][k] * case["displacement_mm"]
        together[CALCULIX] = proof.get("buckling_factors", {k: None})[k]
    skin = {
        whose: solution["skin_stress_mpa"][k]
        for whose, solution in ((SIZED, report), (CALCULIX, proof))
        if "skin_stress_mpa" in solution
    }
    place = place_text(case["worst_strut"]["middle_mm"]).strip("()")
    rows = (
        ("work of the loads", "N mm", of_all("compliance_nmm"), ""),
        (MOVED, "mm", moved, voxels),
        (STRESS, "MPa", of_all("stress_mpa"), ""),
        ("buckling safety", "", of_all("buckling", lambda share: 1.0 / max(share, 1e-12)), ""),
        ("load before struts buckle together", "times", together, ""),
        (SKIN_STRESS, "MPa", skin, f"on all but {PEAKS:.1%} of its area"),
        ("nominal stress next to the outside", "MPa", {FILE: nominal.get("outside")}, ""),
        ("nominal stress where it is thick", "MPa", {FILE: nominal.get("thick")}, ""),
        ("most stressed strut", "at x, y, z", {SIZED: place}, ""),
    )
    return [
        Result(CASE, name, values, unit, case["name"], note)
        for name, unit, values, note in rows
        if any(value is not None for value in values.values())
    ]


def _of_proof(proof: Mapping[str, Any] | None) -> list[Result]:
    if proof is None:
        return [Result(PROOF, "confirmed", {SIZED: "no"}, note="it has not solved this design")]
    confirmed = "yes" if proof["confirmed"] else "no"
    skin = "with the skin" * proof["with_the_skin"]
    rows = [
        ("confirmed", "", confirmed, "; ".join(proof["doubts"])),
        ("displacements differ by", "%", 100.0 * max(proof["displacements_off"]), skin),
    ]
    if proof["worst_strut_compared"]:
        rows.append(("largest stress, CalculiX / VOLFREP", "", proof["largest_stress"], ""))
    if "lowest_frequency" in proof:
        rows.append(("lowest frequency, CalculiX / VOLFREP", "", proof["lowest_frequency"], ""))
    return [Result(PROOF, name, {SIZED: value}, unit, "", note) for name, unit, value, note in rows]


def _limit(row: Mapping[str, Any]) -> str:
    """What governs, with its load case."""
    return f"{row['what']}{' in ' * bool(row['case'])}{row['case']}"
