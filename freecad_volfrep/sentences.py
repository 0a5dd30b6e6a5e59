# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the engine and documents say, in the user's language: the sentences met most often.

The engine and what is stored know English only. A panel shows what they say through `localise`: it
finds the pattern that a sentence was made of, and puts the figures into the pattern's translation.
The report view has them through `report_line`. A sentence that is not listed stays English.
"""

from __future__ import annotations

import re
from functools import lru_cache

from freecad_volfrep.translation import marked, spoken, translate

_CONTEXT = "VolfrepSentences"

#: As they are written where they are made; tests/core/test_translations.py looks for each there.
SENTENCES = marked(
    "VolfrepSentences",
    # Status of infills, bands and studies.
    "Up to date",
    "Out of date: AutoUpdate is off, use Update Lattice Infill",
    "Out of date: a large job, use Update Lattice Infill",
    "Out of date: the mesh of these values is not there yet",
    "Out of date: values have changed since this mesh was asked for; recompute",
    "Out of date: values have changed since this mesh was made; recompute",
    "Failed: see the report view",
    "Cancelled: the mesh is that of the last finished update; use Update Lattice Infill to try "
    "again.",
    "Cancelled: there is no mesh yet; use Update Lattice Infill to make it.",
    "Cancelled: the bands are those of the last recompute, if there was one.",
    "Cancelled: what was done is kept, and the next start goes on from there.",
    "Saved by a FreeCAD without VOLFREP: recompute, and whatever was changed there is followed",
    "Not run yet",
    "Results were of a wrong type, as another program leaves them: recompute for new ones",
    "{designs} designs of {infill}",
    # Advice, and what keeps a preview from being shown.
    "{material} is printed by {processes}, not by {process}.",
    "Struts of {diameter} mm are thinner than {process} prints: at least {least} mm.",
    "There is no solid to fill: choose one as Base.",
    "The part is nowhere thicker than two skins of {shell} mm, so that nothing is left to fill: "
    "reduce the skin thickness.",
    "The skin and what is kept solid leave nothing to fill: reduce the skin thickness, that of "
    "faces with their own, or what is kept solid.",
    "No strut of cells of {size} mm lies inside the skin: reduce the cell size or the skin "
    "thickness.",
    "No strut of the network lies inside the skin: reduce the skin thickness.",
    "No TPMS lies inside the skin: reduce the skin thickness.",
    "No cell of {size} mm lies wholly inside the domain: reduce the cell size or choose the "
    "activation 'touching'.",
    "No cell of {size} mm has its centre inside the domain: reduce the cell size or choose the "
    "activation 'touching'.",
    "Cells of {size} mm are larger than the part, which measures {x} x {y} x {z} mm: reduce the "
    "cell size, or see whether the part is in another unit.",
    "Every strut has a free end or is too thin, so that none is left: keep dangling and thin "
    "struts, reduce the cell size or choose the activation 'touching'.",
    "Struts of radius {radius} mm are too thick for a cell of {size} mm: keep the radius below "
    "{limit} mm or enlarge the cell.",
    "Walls of {thickness} mm are too thick for a cell of {size} mm: reduce the thickness or "
    "enlarge the cell.",
    "Cells of {size} mm are too large for struts of radius {radius} mm: make the cells {largest} "
    "mm or smaller, or the struts {thinnest} mm or thicker.",
    "No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}, of "
    "which the skin is {skin}.",
    "No strut radius gives a mass of {value} with {cells}: choose one from {least} to {most}.",
    "No strut radius gives a relative density of {value} with {cells}: choose one from {least} to "
    "{most}.",
    "{count} cells are too many to be shown as lines: enlarge the cells.",
    "A stiffness that drives the radius is that of a material: choose one for the infill.",
    "The cell type Custom needs a cell: choose its .json file as CellFile.",
    "The material Custom needs a file: choose its .toml or .json file as MaterialFile.",
    "{solid} has no material in FreeCAD: give it one, or choose another for the infill.",
    "Open faces, drain holes, faces with a skin of their own, and what is kept solid, need a skin "
    "that they belong to: give a skin thickness above 0.",
    "A network along faces has none: pick one or two of the solid as NetworkFaces.",
    "'{label}' is a {shape} without a solid: choose a solid, or close it and convert it to one "
    "(Part > Convert to solid).",
    "'{element}' is no face of the part: pick faces of it, or another solid.",
    "'{element}' has no direction: pick a straight or a round edge, a plane or a round face, an "
    "axis or a plane.",
    "'{element}' has no middle: pick a vertex, edge or face.",
    "The expression '{expression}' of {name} has no value ({reason}): correct it.",
    "cells '{cell}' of {size} mm",
    "values or the solid have changed since it was made",
    "what it is made of has changed and is not recomputed yet",
    "its present values cannot be computed",
    # What results, checks and the report view say.
    "{active} of {total} cells, {triangles} triangles, {mass} g in {seconds} s",
    "A resolution of {given} is too coarse for struts of radius {radius} mm, which would not "
    "have their volume: {facets} facets along a cell are made.",
    "The lattice is {bodies} bodies that do not touch each other: only the part's skin holds "
    "them together.",
    "{removed} pieces that hang on nothing left out, {share} % of the lattice's volume: smaller"
    " cells or another origin may join them, and so does a skin.",
    "The void about {place} has room for {room} of its {wanted} drain holes: choose a smaller "
    "diameter, or give their places.",
    "Cancelled: other figures are those of the last finished check, if there was one.",
    "Not enough memory: choose larger cells or a coarser deviation.",
    "The engine failed with a {kind} ({error}), which is a defect of VOLFREP: please report it "
    "with the traceback in the report view's log messages.",
    "The Python that goes with this FreeCAD cannot run the engine by itself: runs are done one "
    "after the other.",
    "'{label}' is out of date: update it first.",
    "'{label}' is out of date: recompute it first.",
    "The mesh of '{label}' is out of date ({why}): recompute it for a present one.",
    "'{label}' has no mesh to export: update it first.",
    "'{label}' has no mesh to check: update it first.",
    "'{label}' is not a lattice infill: choose one.",
    "'{label}' is no solid: choose one.",
    "'{label}' holds no lattice: set its Output to part.",
    "There is no lattice infill: make one of a solid first.",
    "There is no solid to print: choose one as Base.",
    "There is nothing to look at: choose a lattice infill as Infill.",
    "There is nothing to vary: choose a lattice infill as Infill.",
    "An expression or another object says how '{label}' lies: turn that instead.",
    "No coupon is chosen: tick at least one.",
    "Choose limits, a printer whose struts are known, or both.",
    "Struts are down to {thin} mm thick near {place}, and {process} wants {least} mm: enlarge "
    "the radius.",
    "Walls are down to {wall} mm thick in every cell, and {process} wants {least} mm: make them"
    " thicker, or enlarge the cells of a skeleton.",
    "Walls are only {gap} mm apart in every cell, and {process} wants {least} mm: they may fuse"
    " or hold powder; make them thinner, or enlarge the cells.",
    "Struts are only {gap} mm apart near {place}, and {process} wants {least} mm: they may fuse"
    " or hold powder; enlarge the cells.",
    "{share} % of the struts' length is less than {inclination} degrees above the build plate: "
    "choose another build direction or cell, or count on sagging undersides.",
    "Flat struts hang free over up to {length} mm near {place}, and {process} bridges {most} "
    "mm: make the cells smaller or choose another build direction.",
    "1 closed void holds {volume} mm3 of unused material: open each with a hole of {hole} mm or"
    " more.",
    "{count} closed voids hold {volume} mm3 of unused material: open each with a hole of {hole}"
    " mm or more.",
    # Rows of a print check.
    "process",
    "limits from",
    "thinnest strut",
    "thinnest wall",
    "narrowest gap",
    "largest ball that gets out",
    "below {angle} degrees",
    "longest of these",
    "longest flat",
    "inclinations",
    "closed voids",
    "surface",
    "mass",
    "findings",
    "none",
    "over {value} (limit {limit})",
    "{value} (limit {limit})",
    "{share} % of the struts' length, {area}",
    "{count}, holding {volume} mm3",
    "{classes} % from 0 to 90 degrees, by {step}",
    "band {number}: {mean} % of {volume} mm3, told as {told} %",
    "band {number}: {mean} % of {volume} mm3, told as {told} % (narrow: joined ends of lines make "
    "up the rest)",
    "solid: {volume} mm3 of walls and solid layers",
    "filament: {volume} mm3, {mass} g",
    "as even: {density} % everywhere would take the same",
    # Loads and Sizing, Design Study.
    "Results of {case}",
    "No process is chosen to build for: choose one for the infill.",
    "Struts are no thinner than {process} prints: {radius} mm in radius.",
    "All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} "
    "to {most} mm, {mass} g.",
    "All figures are of struts as printed ({table}), {thin} to {thick} mm thick; drawn are {least} "
    "to {most} mm, {mass} g; stress and buckling are of struts thinner by {scatters} standard "
    "deviations.",
    "The skin is no thinner than {process} prints: {wall} mm.",
    "Struts that lie flatter than {process} builds stay: {reason}.",
    "without them the limits cannot be held",
    "Every strut lies too flat to be built, or has a free end without those, so that none is left: "
    "choose another build direction or cell",
    "Built along {axis} the lattice carries without flatter struts: choose that build direction "
    "where you can.",
    "Built along {axis} the lattice without flatter struts is {times} times as stiff for its "
    "volume: choose that build direction where you can.",
    "Built along none of the part's axes the cell carries without flatter struts: choose another "
    "one, such as {cells} with its z upwards.",
    "{process} builds {degrees} degrees and more without support, and {area} mm2 of the part's "
    "outside are flatter, as at {place}: another build direction may have less.",
    "{process} builds {degrees} degrees and more without support, and {area} mm2 of ceilings "
    "within its skin, which only struts hold, are flatter, as at {place}: another build direction "
    "may have less.",
    "No load case is chosen: tick at least one.",
    "The load cases have heat alone: hold faces and load some, too.",
    "The solid's conductivity is not known: type it in Loads and Sizing, W/(m K).",
    "No load case has heat: give faces a temperature or a heat flow.",
    "No heat has a temperature: give one to where the heat leaves.",
    "Two load cases have heat, '{one}' and '{other}': choose one, or suppress the heat of the "
    "other.",
    "Least mass needs a limit: of stress, displacement, buckling, frequency.",
    "The document has no load case: make one with Loads and Sizing, or an analysis with the FEM "
    "workbench, with constraints on the solid's faces, edges or vertices.",
    "Neither the infill nor its load cases have a material: choose one for the infill.",
    "'{label}' refers to no face, edge or vertex: choose some of the part's.",
    "{name} has no values: write them as 6, 8, 10 or as 6 to 10 in 5.",
    "The infill of this study has gone: choose another one as Infill.",
    # What a cell does.
    "0: it carries nothing that way",
    "{figure} E of the solid",
    "{figure} of the solid's yield stress",
    "{figure} of the solid's",
)  # fmt: skip
#: A number as the engine writes it, with the error or the unit behind it.
_NUMBERS = re.compile(r"[-+]?[\d,]*\.?\d+(e[-+]?\d+)?( \+- [\d.e-]+ %| g| mm[23]?)?")


def localise_cell(text: str) -> str:
    """The same of a table's cell, which may be a number."""
    return _localise_value(text)


def report_line(label: str, sentence: str) -> str:
    """A line of the report view about an object, in the user's language as far as it is known.

    Args:
        label: of the object.
        sentence: of the engine or a document, in English.
    """
    return f"VOLFREP, {label}: {localise(sentence)}\n"


def localise_rows(text: str) -> str:
    """Lines of a name and a value, which blanks stand between, in the user's language.

    Args:
        text: of a report, in English.
    """
    rows = [re.split(" {2,}", line, maxsplit=1) for line in text.split("\n")]
    said = [[_localise_value(cell) for cell in row] for row in rows]
    width = max(len(row[0]) for row in said) + 2
    return "\n".join(row[0].ljust(width) + "".join(row[1:]) for row in said)


def localise(text: str) -> str:
    """A sentence, or several lines of them, in the user's language as far as they are known.

    Args:
        text: of the engine or a document, in English.
    """
    return "\n".join(map(_localise_line, text.split("\n")))


def _localise_line(line: str) -> str:
    if not line:
        return line
    exact = translate(_CONTEXT, line)
    if exact != line:
        return str(exact)
    for sentence, pattern in _patterns():
        found = pattern.fullmatch(line)
        if found is not None:
            said = translate(_CONTEXT, sentence)
            if said != sentence:  # else the user reads English
                return str(
                    said.format(**{k: _localise_value(v) for k, v in found.groupdict().items()})
                )
    return line


def _localise_value(value: str) -> str:
    return spoken(value) if _NUMBERS.fullmatch(value) else _localise_line(value)


@lru_cache(maxsize=1)
def _patterns() -> tuple[tuple[str, re.Pattern[str]], ...]:
    """The sentences that figures are put into, and what finds those again."""
    return tuple(
        (sentence, re.compile(re.sub(r"\\\{(\w+)\\\}", r"(?P<\1>.+?)", re.escape(sentence))))
        for sentence in SENTENCES
        if "{" in sentence
    )
