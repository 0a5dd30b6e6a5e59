# SPDX-License-Identifier: LGPL-2.1-or-later
"""Sizing an infill's struts and skin for its document's analyses, and solving them as they are."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import FreeCAD as App

from freecad_volfrep.features.infill.materials import material_of
from freecad_volfrep.features.infill.sized_radii import store_radii, store_skin
from freecad_volfrep.features.jobs.progress import job_title, run_job
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, grouped, translate
from volfrep.design.parameters.specification import spec_value
from volfrep.design.parameters.table import BY_NAME
from volfrep.reports.tables import Table
from volfrep.util.errors import VolfrepError

from .as_built import building_of, printing_by, printing_of, spec_to_size
from .heat import heat_loads
from .sized_states import (
    is_sized_for,
    limits_of,
    names_of_limits,
    sized_states,
    store_states,
    why_no_states,
)

if TYPE_CHECKING:
    from volfrep.design.spec import LatticeSpec
    from volfrep.jobs.sizing import Goal, SizedPart
    from volfrep.loads.load_cases import LoadCases
    from volfrep.mechanics.materials import SolidMaterial
    from volfrep.mesh.triangle_mesh import TriangleMesh
    from volfrep.process.worker import OnItsWay
    from volfrep.sizing.optimise import Step
    from volfrep.sizing.strut_state import StrutState

#: Goals by name, and what the panel calls them.
GOALS = {
    "mass": QT_TRANSLATE_NOOP("VolfrepSizePanel", "Least mass"),
    "stiffness": QT_TRANSLATE_NOOP("VolfrepSizePanel", "Most stiffness"),
}
#: What says something for one of them only, by the names of `volfrep.jobs.sizing.GOALS`.
ONLY_OF = {
    "mass": ("max_stress", "safety", "max_displacement", "buckling", "min_frequency"),
    "stiffness": ("strut_mass",),
}
#: What the panel begins with: safety against yield; radii over the present one.
FIRST_SAFETY, SMALLEST, LARGEST = 1.5, 0.5, 2.0
NO_ANALYSIS = (
    "The document has no load case: make one with Loads and Sizing, or an analysis with the FEM "
    "workbench, with constraints on the solid's faces, edges or vertices."
)


@dataclass(frozen=True, eq=False)
class Outcome:
    """What came of it.

    Attributes:
        part: the sized lattice, in the coordinates of the infill's group.
        states: its struts in each load case.
        density: of the material, g/cm3.
        steps: rows of the table of steps.
        loads: what it was sized for.
        solid: the part, mm.
    """

    part: SizedPart
    states: tuple[StrutState, ...]
    density: float
    steps: tuple[tuple[str, ...], ...]
    loads: LoadCases
    solid: TriangleMesh

    @property
    def holds(self) -> bool:
        """Whether all limits are held."""
        return self.part.sized.holds

    @property
    def mass(self) -> float:
        """Of the struts, g."""
        return _mass(self.part.sized.analysis.volume, self.density)

    @property
    def limits(self) -> tuple[str, ...]:
        """What governs struts, by the rows of `states`."""
        return names_of_limits(self.part.governing.names)

    @property
    def printed(self) -> str:
        """Title of the table of printed diameters; empty where struts are taken as drawn."""
        printed = self.part.report.get("as_printed")
        return "" if printed is None else str(printed["table"])

    def summary(self) -> str:
        """Sentences for the panel: what was found, and whether another solver agrees."""
        report = self.part.report
        proof, built = report["calculix"], self._built()
        printed = [report["as_printed"]["note"]] if "as_printed" in report else []
        if proof is None:
            said = " ".join(note for note in report["notes"] if note not in (*printed, *built))
        else:
            off = 100.0 * max(proof["displacements_off"])
            said = (
                translate(
                    "VolfrepSizePanel",
                    "CalculiX's displacements of the same beams and skin differ by {off:.2g} %.",
                )
                if proof["with_the_skin"]
                else translate(
                    "VolfrepSizePanel",
                    "CalculiX's displacements of the same beams differ by {off:.2g} %.",
                )
            ).format(off=off)
            if not proof["confirmed"]:
                refused = translate(
                    "VolfrepSizePanel", "CalculiX does not confirm this design: see its notes."
                )
                said = f"{said} {refused}"
        return "\n".join([f"{self._found()} {said}".rstrip(), *printed, *built])

    def _built(self) -> list[str]:
        """What its process asked for, in sentences; none where it was not sized for one."""
        from volfrep.reports.sizing_results import along_text

        built = self.part.report.get("building")
        if built is None:
            return []
        said = translate(
            "VolfrepSizePanel",
            "For {process}, built along {direction}: {count} struts that lie flatter than "
            "{degrees} degrees were taken away.",
        ).format(
            process=built["process"],
            direction=along_text(built["build_direction"]),
            count=grouped(built["removed"]),
            degrees=f"{built['inclination_degrees']:g}",
        )
        return [*([said] if built["removed"] else ()), *built.get("notes", ())]

    def _found(self) -> str:
        """What was found, in a sentence."""
        from volfrep.reports.sizing_report import least_gain

        sized, before, even = self.part.sized.analysis, self.part.before, self.part.even
        report = self.part.report
        if not self.holds:
            there = (report["calculix"] or {}).get("uses", {})
            uses = {name: max(use, there.get(name, 0.0)) for name, use in report["uses"].items()}
            worst = max(uses, key=lambda name: uses[name])
            return translate(
                "VolfrepSizePanel",
                "The limit of {limit} cannot be held between these radii: {use:.0%} of it is used. "
                "Allow thicker struts, or larger cells.",
            ).format(limit=translate("VolfrepSizePanel", worst), use=uses[worst])
        if "skin" in report:
            return self._found_skin()
        if even is None:
            gain = float(before.compliance.sum() / sized.compliance.sum())
            return translate(
                "VolfrepSizePanel",
                "Struts of {mass:.4g} g, {least:.3g} to {gain:.3g} times as stiff as struts of one "
                "radius and the same mass.",
            ).format(mass=self.mass, least=least_gain(gain), gain=gain)
        analysis, held = even
        if not held:
            return translate(
                "VolfrepSizePanel",
                "Struts of {mass:.4g} g hold all limits; no one radius between these does.",
            ).format(mass=self.mass)
        return translate(
            "VolfrepSizePanel",
            "Struts of {mass:.4g} g hold all limits; of one radius they would weigh {even:.4g} g.",
        ).format(mass=self.mass, even=_mass(analysis.volume, self.density))

    def _found_skin(self) -> str:
        """What was found of struts and skin together, in a sentence."""
        skin, split = self.part.report["skin"], self.part.report["masses_g"]
        low, high = skin["thickness_mm"]
        said = translate(
            "VolfrepSizePanel",
            "Struts of {struts:.4g} g and a skin of {low:.3g} to {high:.3g} mm, {skin:.4g} g.",
        ).format(struts=split["struts"], skin=split["skin"], low=low, high=high)
        if split["solid"]:
            solid = translate(
                "VolfrepSizePanel", "Of the skin {solid:.4g} g are solid from side to side."
            )
            said = f"{said} {solid.format(solid=split['solid'])}"
        if self.part.even is None:
            return said
        held = translate("VolfrepSizePanel", "All limits are held.")
        even = skin["even"]
        if even is not None and even["holds"]:
            held = translate(
                "VolfrepSizePanel",
                "All limits are held; one radius and one thickness for all would weigh {even:.4g} "
                "g.",
            ).format(even=_mass(even["volume_mm3"], self.density))
        return f"{said} {held}"

    def tables(self) -> list[Table]:
        """Before and after, case by case, and the steps: English, as saved tables are."""
        from volfrep.reports.sizing_results import result_tables, sizing_results

        tables = result_tables(sizing_results(self.part.report))
        notes = tuple((note,) for note in self.part.report["notes"])
        if notes:
            tables.append(Table("Notes", notes))
        header = ("step", "mass, g", "work of the loads, N mm", "most used limit")
        return [*tables, Table("Steps", self.steps, header)]

    def page(self, name: str) -> str:
        """The report as a page to print, in English, of a part of a name."""
        from volfrep.reports.sizing_page import sizing_page

        return sizing_page(self.part.report, self.solid, self.loads, name)

    def to_json(self) -> str:
        """All figures, as the infill keeps them."""
        return json.dumps(self.part.report)


def _mass(volume: float, density: float) -> float:
    return volume * density / 1000.0


def analyses_of(obj: App.DocumentObject) -> list[App.DocumentObject]:
    """The analyses of an infill's document that may be load cases.

    Raises:
        VolfrepError: there is none.
    """
    from freecad_volfrep.bridge.fem_loads import has_loads, is_analysis

    found = [one for one in obj.Document.Objects if is_analysis(one) and has_loads(one)]
    if not found:
        raise VolfrepError(NO_ANALYSIS)
    return found


def size_lattice(
    obj: App.DocumentObject,
    analyses: Sequence[App.DocumentObject] | None = None,
    *,
    goal: str = "mass",
    prove: bool = True,
    remove_thin: bool = False,
    as_printed: str = "",
    scatter: float = 0.0,
    for_print: bool = False,
    **numbers: float,
) -> Outcome:
    """Size an infill and store what was found; ``doc.recompute()`` then makes the mesh.

    Args:
        obj: a lattice infill.
        analyses: of the FEM workbench, the load cases; None for all of the document.
        goal: one of `GOALS`.
        prove: let CalculiX solve the design, where it is installed.
        remove_thin: take away struts that end as thin as they may be and carry little.
        as_printed: table of printed diameters, or a .csv file of one's own: all figures are of
            struts as they come out; empty takes them as drawn. The print goes up along the
            infill's BuildDirection.
        scatter: stress and buckling are of struts thinner by so many standard deviations of it.
        for_print: struts and a sized skin no thinner than the infill's process prints, and none
            flatter as far as limits allow; the print goes up along the infill's BuildDirection.
        **numbers: by the names of `volfrep.jobs.sizing.GOALS`, in place of those that the panel
            begins with: such as ``safety=2``, ``max_displacement=0.1``, ``thinnest=0.4``, or
            ``skin_thinnest=0.8``, with which the skin is sized, too.

    Raises:
        VolfrepError: there is no goal of such a name, or as `size_struts`.
        Cancelled: as `size_struts`.
    """
    outcome = size_struts(
        obj, analyses_of(obj) if analyses is None else analyses, {**first_numbers(obj), **numbers},
        goal=goal, prove=prove, remove_thin=remove_thin, as_printed=as_printed, scatter=scatter,
        for_print=for_print,
    )  # fmt: skip
    store_outcome(obj, outcome)
    return outcome


def store_outcome(obj: App.DocumentObject, outcome: Outcome) -> None:
    """Give an infill the radii and the skin that were found, and what is to be known of them."""
    store_radii(obj, outcome.part.points, outcome.part.radii)
    spec = outcome.part.spec
    if "skin" in outcome.part.report:
        store_skin(obj, spec.shell, spec.skin_field)
    skin = outcome.part.skin_governing
    obj.SizedSkinLimits = [] if skin is None else skin.rows.tolist()
    shortest = spec_value(spec, BY_NAME["network_shortest"])
    if shortest:  # other radii would draw other struts together
        obj.NetworkShortest = shortest
    obj.RemoveBelow, obj.RemoveDangling = spec.remove_below, spec.remove_dangling
    obj.RemoveFlatter = spec_value(spec, BY_NAME["remove_flatter"]) or 0.0
    obj.SizingReport = outcome.to_json()
    store_states(obj, outcome.states, outcome.loads)


def first_numbers(obj: App.DocumentObject) -> dict[str, float]:
    """What the panel begins with, by the names of `volfrep.jobs.sizing.GOALS`.

    Struts are no thinner than the infill's process prints.
    """
    from volfrep.reports.processes import PROCESSES

    radius, process = obj.StrutRadius.Value, PROCESSES.get(obj.PrintProcess)
    thinnest = max(SMALLEST * radius, 0.0 if process is None else 0.5 * process.strut)
    thickest = max(LARGEST * radius, 2.0 * thinnest)
    return {"safety": FIRST_SAFETY, "thinnest": thinnest, "thickest": thickest}


def size_struts(
    obj: App.DocumentObject,
    analyses: Sequence[App.DocumentObject],
    numbers: Mapping[str, float],
    on_step: Callable[[tuple[str, ...]], None] | None = None,
    *,
    goal: str = "mass",
    prove: bool = True,
    remove_thin: bool = False,
    as_printed: str = "",
    scatter: float = 0.0,
    for_print: bool = False,
    ahead: Callable[[TriangleMesh, LatticeSpec], OnItsWay | None] | None = None,
) -> Outcome:
    """Size an infill's struts; the infill stays as it is (see `sized_radii.store_radii`).

    Args:
        obj: a lattice infill.
        analyses: of the FEM workbench, the load cases.
        numbers: by the names of `volfrep.jobs.sizing.GOALS`; 0 is none. Limits say nothing for
            the most stiffness, a mass nothing for the least.
        on_step: called on another thread with each step's row of the table of steps.
        goal: one of `GOALS`.
        prove: let CalculiX solve the design, where it is installed.
        remove_thin: take away struts that end as thin as they may be and carry little.
        as_printed: table of printed diameters, or a .csv file of one's own: all figures are of
            struts as they come out; empty takes them as drawn. The print goes up along the
            infill's BuildDirection.
        scatter: stress and buckling are of struts thinner by so many standard deviations of it.
        for_print: struts and a sized skin no thinner than the infill's process prints, and none
            flatter as far as limits allow; the print goes up along the infill's BuildDirection.
        ahead: what is made ahead for a solid and a specification, which is waited for.

    Raises:
        VolfrepError: no analysis is chosen, or what is asked for makes no sense or cannot be.
        Cancelled: in the window, by the user, before there was a design; afterwards a cancel keeps
            the best.
    """
    from volfrep.jobs.sizing import size

    solid, spec, cache = obj.Proxy.wanted(obj)
    spec = spec_to_size(obj, spec, for_print)
    loads = loads_of(obj, analyses)
    density = loads.material.density
    wanted = replace(
        _wanted(goal, numbers, loads.material),
        remove_thin=remove_thin,
        printing=printing_by(obj, as_printed, scatter),
        building=building_of(obj) if for_print else None,
    )
    steps: list[tuple[str, ...]] = []

    def watch(number: int, step: Step) -> bool:
        steps.append(_row(number, step, density))
        if on_step is not None:
            on_step(steps[-1])
        return True

    part = run_job(
        job_title("Sizing {label}", obj), size, solid, spec, loads, wanted,
        prove_it=prove, cache=cache, heard={"watch": watch}, keeps_best=True,
        after=None if ahead is None else ahead(solid, spec),
    )  # fmt: skip
    steps.append(_row(len(steps), part.sized.last, density))
    states = part.states
    return Outcome(part, states, density, tuple(steps), loads, solid)


def loads_of(obj: App.DocumentObject, analyses: Sequence[App.DocumentObject]) -> LoadCases:
    """What analyses say that an infill carries, of its own material or, without one, of theirs.

    Raises:
        VolfrepError: there is none, or what they say makes no sense.
    """
    from freecad_volfrep.bridge.fem_loads import load_cases_of
    from freecad_volfrep.bridge.solids import parent_placement

    if not analyses:
        raise VolfrepError("No load case is chosen: tick at least one.")
    return load_cases_of(analyses, parent_placement(obj), material_of(obj))


def carried_by(obj: App.DocumentObject, quantity: str) -> dict[str, Any]:
    """What `volfrep.jobs.figures.point_values.point_values` is given to colour by loads.

    What is kept of the lattice as it was sized, where the document has the loads of that or none
    any more: the figures are then those that Loads and Sizing told. Else the document's loads.

    Args:
        obj: a lattice infill.
        quantity: one of `OF_LOADS` or `GOVERNING` there, or `OF_HEAT`.

    Raises:
        VolfrepError: there is neither, or the loads make no sense.
    """
    from volfrep.jobs.figures.point_values import GOVERNING, OF_HEAT

    if quantity in GOVERNING:
        return {"carried": limits_of(obj, quantity)}
    if quantity == OF_HEAT:
        return {"loads": heat_loads(obj, analyses_of(obj))}
    try:
        analyses = analyses_of(obj)
    except VolfrepError:
        if why_no_states(obj):
            raise
    else:
        loads = loads_of(obj, analyses)
        if not is_sized_for(obj, loads):
            return {"loads": loads, "printing": printing_of(obj)}
    ends, states = sized_states(obj)
    return {"carried": (ends, states[quantity])}


def _wanted(goal: str, numbers: Mapping[str, float], material: SolidMaterial) -> Goal:
    """What the engine is asked for.

    Raises:
        VolfrepError: least mass without a limit, or as `volfrep.jobs.sizing.goal_of`.
    """
    from volfrep.jobs.sizing import goal_of

    idle = {name for kind, names in ONLY_OF.items() if kind != goal for name in names}
    asked = {name: value for name, value in numbers.items() if value and name not in idle}
    if "strut_mass" in asked and "skin_thinnest" in asked:
        asked["sized_mass"] = asked.pop("strut_mass")
    wanted = goal_of(material, asked)
    if goal == "mass" and not wanted.limits.any:
        raise VolfrepError(
            "Least mass needs a limit: of stress, displacement, buckling, frequency."
        )
    return wanted


def _row(number: int, step: Step, density: float) -> tuple[str, ...]:
    """A row of the table of steps."""
    worst = max(step.uses, key=lambda name: step.uses[name], default=None)
    used = "" if worst is None else f"{worst} {step.uses[worst]:.0%}"
    mass = _mass(step.volume, density)
    return str(number + 1), f"{mass:.4g}", f"{step.compliance:.4g}", used


def solve_struts(obj: App.DocumentObject) -> tuple[StrutState, ...]:
    """The struts of an infill as they are, under every analysis of its document.

    They are as printed where they were sized so.

    Raises:
        VolfrepError: there is no analysis, or it or the infill makes no sense.
        Cancelled: in the window, by the user.
    """
    from volfrep.jobs.sizing import solve_struts
    from volfrep.sizing.strut_state import strut_states

    loads = loads_of(obj, analyses_of(obj))
    printing = printing_of(obj)
    solid, spec, cache = obj.Proxy.wanted(obj)
    title = job_title("Struts of {label}", obj)
    model, analysis = run_job(
        title, solve_struts, solid, spec, loads, printing=printing, cache=cache
    )
    return strut_states(model.problem, analysis)
