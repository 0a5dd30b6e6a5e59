# SPDX-License-Identifier: LGPL-2.1-or-later
"""Only their rooms ask of which kind a lattice is; elsewhere kinds answer what is asked of them."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh

import rods
import volfrep
from rods import SIDES
from volfrep.design import kinds as design_kinds
from volfrep.design.forecast import forecast_fill
from volfrep.design.spec import LatticeSpec
from volfrep.design.target import Target
from volfrep.jobs import kinds as job_kinds
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.jobs.preview import PartDepth, preview
from volfrep.jobs.targets import solve_target
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.studies.expectation import expect
from volfrep.util.errors import VolfrepError

ROOT = Path(__file__).parents[2]
CORE = ROOT / "core" / "volfrep"
#: The kinds' rooms, and the modules that define what they are told by.
ROOMS = tuple(
    CORE / name
    for name in (
        "design/kinds", "design/tpms", "design/graphs", "jobs/kinds", "jobs/tpms", "tpms", "graphs",
        "design/cells.py", "design/spec.py", "design/spec_fields.py",
    )
)  # fmt: skip
#: Names that are lists of the cells of a kind; and functions that tell whether one is of it.
LISTS, TELLING = {"SURFACES", "WALLS"}, {"surface_name", "find_surface"}
#: Attributes of a specification that some kinds have only.
OWN = {"network", "surface", "thicknesses", "wall"}


def modules() -> list[Path]:
    """All that is outside the rooms."""
    found = [*CORE.rglob("*.py"), *(ROOT / "freecad_volfrep").rglob("*.py")]
    return [path for path in found if not any(path.is_relative_to(room) for room in ROOMS)]


def kinds() -> set[str]:
    """The classes of the kinds, and those that they are told by."""
    rooms = (path for room in ROOMS for path in ([room] if room.suffix else room.rglob("*.py")))
    trees = [ast.parse(path.read_text(encoding="utf-8")) for path in rooms]
    return {node.name for tree in trees for node in ast.walk(tree) if type(node) is ast.ClassDef}


KINDS = kinds()
#: A source that asks has one of these words.
WORDS = {"hasattr", "getattr", "measure", "kind"} | OWN | LISTS | TELLING | KINDS
ASKING = re.compile(rf"\b({'|'.join(sorted(WORDS))})\b")


def last_name(node: ast.AST) -> str:
    """What a name, an attribute or a call is called at its end; empty for other nodes."""
    if isinstance(node, ast.Call):
        return last_name(node.func)
    return getattr(node, "attr", getattr(node, "id", ""))


def questions(source: str) -> Iterator[int]:
    """Lines that ask for the kind of a lattice."""
    for node in ast.walk(ast.parse(source)) if ASKING.search(source) else ():
        if is_question(node):
            yield node.lineno  # type: ignore[attr-defined]


def is_question(node: ast.AST) -> bool:
    """Whether a node asks for the kind of a lattice."""
    if isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load):
        of_spec = last_name(node.value) == "spec" and node.attr in OWN - {"wall"}
        return node.attr == "network" or of_spec
    if isinstance(node, ast.Call) and not isinstance(node.func, ast.Call):
        return asks_by_call(last_name(node.func), node.args)
    if isinstance(node, ast.MatchClass):
        return last_name(node.cls) in KINDS
    if isinstance(node, ast.Compare):
        return asks_by_comparing([node.left, *node.comparators], node.ops)
    return False


def asks_by_call(function: str, arguments: list[ast.expr]) -> bool:
    """Whether `isinstance`, `hasattr` and their like ask for a kind."""
    if function in ("isinstance", "issubclass"):
        return any(last_name(part) in KINDS for part in ast.walk(arguments[1]))
    if function in ("hasattr", "getattr"):
        name = getattr(arguments[1], "value", None)
        of_kind = last_name(arguments[0]) in ("spec", "kind", "network", "cell")
        given = isinstance(arguments[0], ast.Name) and last_name(arguments[0]) != "spec"
        return name in OWN or (of_kind and not given)
    return False


def asks_by_comparing(sides: list[ast.expr], operators: list[ast.cmpop]) -> bool:
    """Whether a comparison is one with a kind, its class, its name, or a list of its cells."""
    names = [last_name(side) for side in sides]
    if any(isinstance(one, (ast.In, ast.NotIn)) for one in operators) and LISTS & {*names}:
        return True
    is_none = any(getattr(side, "value", ...) is None for side in sides)
    if is_none and TELLING & {*names}:
        return True
    if "type" in names and KINDS & {*names}:
        return True
    if any(isinstance(side, ast.Attribute) and side.attr == "measure" for side in sides):
        return True
    parts = [part for side in sides for part in ast.walk(side)]
    return any(
        isinstance(part, ast.Attribute)
        and part.attr == "kind"
        and last_name(part.value) in ("spec", "infill")
        and (part in sides or (not is_none and has_text(sides)))
        for part in parts
    ) or any(last_name(side) == "type" and has_kind(side) for side in sides)


def has_text(sides: list[ast.expr]) -> bool:
    """Whether something is compared with a word."""
    return any(isinstance(getattr(side, "value", None), str) for side in sides)


def has_kind(side: ast.expr) -> bool:
    """Whether a call is made of `spec.kind`."""
    return any(last_name(part) == "kind" for part in ast.walk(side))


def test_no_module_asks_for_the_kind_of_a_lattice() -> None:
    found = {
        str(path.relative_to(ROOT)): list(questions(path.read_text(encoding="utf-8")))
        for path in modules()
    }
    assert len(found) > 400
    assert {path: lines for path, lines in found.items() if lines} == {}


@pytest.mark.parametrize(
    "question",
    [
        "if spec.network is not None: pass",
        "x = 1 if spec.surface is None else 2",
        "if infill.spec.network: pass",
        "assert isinstance(cell, PeriodicSurface)",
        "isinstance(cell, (str, UnitCell))",
        "isinstance(network, GivenGraph | RandomGraph)",
        "issubclass(kind, GraphKind)",
        "isinstance(infill.filling, TpmsLattice)",
        "type(spec.cell) is UnitCell",
        "type(spec.kind) == other",
        "spec.kind is other",
        "spec.kind.name == 'tpms'",
        "spec.kind.measure == 'strut_radius'",
        "hasattr(infill.spec.kind, 'surface')",
        "getattr(spec, 'network', None)",
        "getattr(spec.network, 'widths', ())",
        "obj.CellType in WALLS",
        "name not in SURFACES",
        "surface_name(name) is None",
        "match spec.cell:\n    case PeriodicSurface(): pass",
    ],
)
def test_a_question_is_found(question: str) -> None:
    assert list(questions(question))


@pytest.mark.parametrize(
    "asked",
    [
        "spec.kind.catalogue_cell",
        "if spec.kind.has_struts: pass",
        "cleared.surface is not surface",
        "isinstance(cell, str)",
        "found = find_surface(name) or find_cell(name)",
        "hasattr(network, 'edges')",  # of an object that a user brings
        "parameter.kind == 'choice'",
    ],
)
def test_what_is_no_question_is_not(asked: str) -> None:
    assert not list(questions(asked))


# --- a kind of one's own ------------------------------------------------------------------------

#: Rods 6 mm apart in a box of 24 x 18 x 12 mm: 4 x 3 of them.
SIZE, COUNT, APART, RADIUS = (24.0, 18.0, 12.0), 12, 6.0, 1.0
#: Area of a polygon in place of a circle.
SECTION = 0.5 * SIDES * np.sin(2.0 * np.pi / SIDES) * RADIUS**2


@pytest.fixture
def solid(monkeypatch: pytest.MonkeyPatch) -> TriangleMesh:
    """The box; with a row for rods in either table of kinds."""
    monkeypatch.setitem(design_kinds.KINDS, rods.Rods, rods.RodSpec)
    monkeypatch.setitem(job_kinds.LATTICE_KINDS, rods.RodSpec, (rods.__name__, "RodKind"))
    box = trimesh.creation.box(SIZE)
    return TriangleMesh(box.vertices, box.faces.astype(np.int32))


def rod_spec(**given: Any) -> LatticeSpec:
    """A specification of rods."""
    return LatticeSpec(**{"cell": rods.Rods(), "cell_size": APART, "strut_radius": RADIUS, **given})


def test_a_new_kind_of_one_module_fills_a_box(solid: TriangleMesh) -> None:
    bare = fill(solid, rod_spec(shell=0, keep_pieces=True)).report
    assert bare.volume_mm3 == pytest.approx(COUNT * SECTION * SIZE[2], rel=1e-6)
    assert (bare.bodies, bare.struts, bare.watertight) == (COUNT, COUNT, True)
    part = fill(solid, rod_spec(shell=1)).report
    inside = np.prod(np.array(SIZE) - 2.0)
    rods_inside = COUNT * SECTION * (SIZE[2] - 2.0)
    assert part.volume_mm3 == pytest.approx(np.prod(SIZE) - inside + rods_inside, rel=1e-3)
    assert part.relative_density == pytest.approx(rods_inside / inside, rel=1e-2)
    assert (part.bodies, part.genus, part.cells_active) == (1, COUNT, 0)
    assert part.spec["cell"] == "Rods"


@pytest.mark.costly
def test_a_new_kind_is_forecast_and_previewed(solid: TriangleMesh) -> None:
    spec = rod_spec(shell=1)
    forecast = forecast_fill(solid, spec)
    assert forecast.triangles > 0
    assert COUNT / 2 < forecast.struts < 3 * COUNT * SIZE[2] / APART
    shown = preview(solid, spec, PartDepth(solid))
    made = fill(solid, spec).report
    assert shown.struts == COUNT
    assert shown.volume == pytest.approx(made.volume_mm3, rel=0.02)
    assert expect(solid, spec, PartDepth(solid)).mass_g == pytest.approx(made.mass_g, rel=0.02)


def test_a_new_kind_is_saved(solid: TriangleMesh, tmp_path: Path) -> None:
    part = volfrep.fill(solid, rod_spec(shell=1))
    part.save(tmp_path / "rods.stl")
    read = trimesh.load(tmp_path / "rods.stl")
    assert read.is_watertight
    assert read.volume == pytest.approx(part.report.volume_mm3, rel=1e-5)
    assert part.check("SLS").struts == COUNT


def test_a_new_kind_refuses_what_it_does_not_do(solid: TriangleMesh) -> None:
    with pytest.raises(VolfrepError, match=r"target of relative density: give the thickness\.$"):
        solve_target(solid, rod_spec(target=Target("relative_density", 0.2)))
    with pytest.raises(VolfrepError, match="has no one stiffness"):
        volfrep.fill(solid, rod_spec(shell=1)).properties()
    with pytest.raises(VolfrepError, match=r"no blocks of such a lattice: fill a box with it\.$"):
        block(rod_spec(), (2, 2, 2))
    with pytest.raises(VolfrepError, match=r"touch each other: make them thinner\.$"):
        rod_spec(strut_radius=3.0)
