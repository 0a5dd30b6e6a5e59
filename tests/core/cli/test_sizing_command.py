# SPDX-License-Identifier: LGPL-2.1-or-later
"""`volfrep size`: from a part and its load cases to a part whose struts follow them."""

import json
import re
import shutil
import signal
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
import trimesh

from command import run
from volfrep.cli import size as size_command
from volfrep.io.solid import read_triangles
from volfrep.io.write.stl import write_stl
from volfrep.jobs.sizing import Goal
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.sizing.optimise import Step

SVG = "{http://www.w3.org/2000/svg}"
LATTICE = ["--cell", "CVC", "--cell-size", "10", "--strut-radius", "0.8"]
WHOLE = ["--shell", "0", "--boundary", "whole", "--activation", "inside"]
LOADS = """
material = "Ti-6Al-4V"
yield_stress = 900
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [40, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -40]
[[case]]
name = "aside"
[[case.load]]
plane = { point = [40, 0, 0], normal = [1, 0, 0] }
force = [0, 40, 0]
"""


@pytest.fixture
def part(tmp_path: Path) -> Path:
    shape = trimesh.creation.box((40, 10, 10))
    shape.apply_translation((20, 5, 5))
    mesh = TriangleMesh(np.array(shape.vertices), np.array(shape.faces).astype(np.int32))
    write_stl(mesh, tmp_path / "part.stl")
    (tmp_path / "loads.toml").write_text(LOADS, encoding="utf-8")
    return tmp_path / "part.stl"


def size(part: Path, *more: object) -> int:
    loads, out = part.with_name("loads.toml"), part.with_name("out.stl")
    return run("size", part, "--loads", loads, "-o", out, *LATTICE, "--quiet", *more)


def refusal(part: Path, capsys: pytest.CaptureFixture[str], *more: object) -> str:
    assert size(part, *more) == 2
    assert not part.with_name("out.stl").exists()
    return capsys.readouterr().err


@pytest.mark.costly
def test_the_sized_part_is_an_ordinary_graded_one(part: Path, tmp_path: Path) -> None:
    spec, report = (tmp_path / name for name in ("s.toml", "report.json"))
    more = ("--write-spec", spec, "--report", report, "--no-proof")
    assert size(part, *WHOLE, "--safety", "3", *more) == 0
    assert (tmp_path / "s.radii.csv").is_file()  # beside the specification that names it
    again = tmp_path / "again.stl"
    assert run("fill", part, "-o", again, "--spec", spec, "--quiet") == 0
    assert again.read_bytes() == (tmp_path / "out.stl").read_bytes()
    told = json.loads(report.read_text(encoding="utf-8"))
    figures = told["sizing"]
    assert figures["holds"]
    assert figures["uses"]["stress"] == pytest.approx(1.0, abs=5e-3)
    assert max(case["stress_mpa"] for case in figures["cases"]) <= 300.5
    assert figures["same_limits"]["mass_saved"] > 0.1
    assert figures["strut_volume_mm3"] == pytest.approx(told["part"]["volume_mm3"], rel=3e-3)


@pytest.mark.costly
@pytest.mark.slow_but("CVC")
@pytest.mark.parametrize("cell", ["CVC", "Octahedron"])
def test_the_mass_asked_for_is_that_of_the_mesh(part: Path, cell: str) -> None:
    report, out = part.with_name("report.json"), part.with_name("out.stl")
    more = ("--strut-mass", 3, "--thickest", 1.6, "--steps", 8, "--no-proof", "--report", report)
    assert size(part, *WHOLE, "--cell", cell, *more) == 0
    told = json.loads(report.read_text(encoding="utf-8"))["sizing"]["strut_mass_g"]
    assert told == pytest.approx(3.0, rel=1e-4)
    assert trimesh.load(out).volume * 4.41e-3 == pytest.approx(told, rel=3e-3)


# FreeCAD's test of the same shows it sooner.
@pytest.mark.slow
def test_the_file_of_a_sized_part_keeps_within_limits(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    wanted = ("--steps", "3", "--no-proof", *WHOLE)
    size(part, *wanted)
    most = int(0.75 * len(read_triangles(part.with_name("out.stl")).triangles))
    size(part, *wanted, "--max-triangles", most)
    count = len(read_triangles(part.with_name("out.stl")).triangles)
    assert 0.6 * most < count <= most
    assert "facets along a cell in place of" in capsys.readouterr().err


def test_a_design_for_its_process_passes_the_print_check(part: Path, tmp_path: Path) -> None:
    """Along the part's best axis; and its file is made again of its specification."""
    spec, report = tmp_path / "s.toml", tmp_path / "report.json"
    more = ("--write-spec", spec, "--report", report, "--no-proof", "--steps", "3", "--safety", "2")
    built = ("--process", "LPBF", "--thinnest", "0.1")
    assert size(part, *WHOLE, "--cell", "FCC", *more, *built) == 0
    told = json.loads(report.read_text(encoding="utf-8"))
    assert told["print_report"]["findings"] == []
    assert told["print_report"]["build_direction"] == [1.0, 0.0, 0.0]
    assert told["print_report"]["thinnest_strut_mm"] >= 0.6 - 1e-6
    assert told["part"]["flat_struts_removed"] == told["sizing"]["building"]["removed"] > 0
    again = tmp_path / "again.stl"
    assert run("fill", part, "-o", again, "--spec", spec, "--quiet") == 0
    assert again.read_bytes() == (tmp_path / "out.stl").read_bytes()


def test_struts_that_cannot_be_spared_stay_and_are_told(part: Path, tmp_path: Path) -> None:
    """Of CVC cells all lie at 35 degrees."""
    report = tmp_path / "report.json"
    more = ("--process", "LPBF", "--report", report, "--no-proof", "--steps", "3", "--safety", "2")
    assert size(part, *WHOLE, "--cell", "CVC", *more) == 0
    told = json.loads(report.read_text(encoding="utf-8"))
    assert told["part"]["flat_struts_removed"] == 0
    assert any("flatter than LPBF builds stay" in note for note in told["sizing"]["notes"])
    assert any("such as FCCz with its z upwards" in note for note in told["sizing"]["notes"])
    assert told["print_report"]["overhanging_share"] == pytest.approx(1.0)


@pytest.mark.slow
def test_thin_struts_that_carry_little_are_taken_away(part: Path, tmp_path: Path) -> None:
    radii, spec, report = (tmp_path / name for name in ("r.csv", "s.toml", "report.json"))
    more = ("--radii", radii, "--write-spec", spec, "--report", report, "--no-proof")
    # What lies beyond the load carries nothing.
    half = LOADS.replace("[40, 0, 0]", "[20, 0, 0]")
    part.with_name("loads.toml").write_text(half, encoding="utf-8")
    bcc = (*WHOLE, "--cell", "BCC")
    assert size(part, *bcc, "--safety", "4", "--thinnest", "0.4", "--remove-thin", *more) == 0
    again = tmp_path / "again.stl"
    assert run("fill", part, "-o", again, "--spec", spec, "--quiet") == 0
    assert again.read_bytes() == (tmp_path / "out.stl").read_bytes()
    told = json.loads(report.read_text(encoding="utf-8"))
    gone, whole = told["sizing"]["removed"]["struts"], told["sizing"]["removed"]["with_them"]
    made = told["part"]
    assert gone == made["thin_struts_removed"] + made["struts_dangling_removed"]
    assert made["thin_struts_removed"] > 0
    places = told["sizing"]["removed"]["places"]
    assert sum(place["struts"] for place in places) == gone
    assert places[0]["middle_mm"][0] > 20.0
    assert made["struts"] == told["sizing"]["struts"]
    assert (made["bodies"], made["watertight"]) == (1, True)
    assert told["sizing"]["holds"]
    assert told["sizing"]["strut_volume_mm3"] < whole["strut_volume_mm3"]


@pytest.mark.slow
def test_with_a_skin_the_struts_end_in_it_and_both_are_told(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report = part.with_name("report.json")
    loads, out = part.with_name("loads.toml"), part.with_name("out.stl")
    done = run(
        "size", part, "--loads", loads, "-o", out, "--cell", "Octet", "--cell-size", 20,
        "--strut-radius", 1.5, "--shell", 1, "--steps", 2, "--buckling", 1.1,
        "--report", report, "--no-proof",
    )  # fmt: skip
    assert done == 0
    told, warned = capsys.readouterr()
    assert "dimples of" in warned
    assert "load before struts buckle together" in told
    assert "mass of the skin" in told
    assert "as stiff as one radius" in told
    figures = json.loads(report.read_text(encoding="utf-8"))
    skin = (40 * 10 * 10 - 38 * 8 * 8) * 4.41e-3
    assert figures["sizing"]["skin_mass_g"] == pytest.approx(skin, rel=1e-3)
    mass = figures["sizing"]["strut_mass_g"] + figures["sizing"]["skin_mass_g"]
    assert mass == pytest.approx(trimesh.load(out).volume * 4.41e-3, rel=3e-3)
    assert min(figures["sizing"]["same_mass"]["stiffer"]) >= 1.0 - 1e-9
    assert read_triangles(out).volume == pytest.approx(figures["part"]["volume_mm3"], rel=1e-5)


@pytest.mark.slow
def test_the_finished_file_as_a_solid_stands_beside_the_design(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    report, loads, out = (part.with_name(n) for n in ("report.json", "loads.toml", "out.stl"))
    done = run(
        "size", part, "--loads", loads, "-o", out, "--cell", "CVC", "--cell-size", 10,
        "--strut-radius", 0.8, "--shell", 1, "--steps", 2, "--no-proof", "--prove", "file",
        "--voxel", 0.4, "--report", report,
    )  # fmt: skip
    assert done == 0
    told = capsys.readouterr().out
    assert "voxels of 0.4 mm" in told
    assert "nominal stress next to the outside" in told
    figures = json.loads(report.read_text(encoding="utf-8"))
    file = figures["sizing"]["file"]
    assert file["solid_volume_mm3"] == pytest.approx(figures["part"]["volume_mm3"], rel=1e-5)
    assert file["voxels"][-1]["volume_mm3"] == pytest.approx(file["solid_volume_mm3"], rel=2e-3)
    assert [case["name"] for case in file["cases"]] == ["down", "aside"]
    for case in file["cases"]:  # beams and shells against solids
        print(f"design over file {case['compliance_of_file']:.3f}")
        assert case["compliance_of_file"] == pytest.approx(1.0, abs=0.15)
        assert case["displacement_of_file"] == pytest.approx(1.0, abs=0.15)


@pytest.mark.parametrize(
    ("more", "says"),
    [
        (["--voxel", "1"], "give --prove file"),
        (["--max-stress", "100", "--safety", "2"], "give one of them"),
        (["--max-stress", "100", "--strut-mass", "3"], "least mass, or a volume"),
        (["--safety", "0"], "--safety must be above 0"),
        (["--max-stress", "-1"], "limit of stress must be above 0"),
        (["--strut-mass", "900"], "cannot be reached"),
        (["--thinnest", "3", "--thickest", "2"], "make no sense"),
        (["--steps", "0"], "at least one step"),
        (["--fillet", "0.2"], "set the fillet to 0"),
        (["--smooth", "2"], "from 0 to 0.9"),
        (["--colour", "stress"], "give it"),
    ],
)
def test_what_makes_no_sense_is_refused(
    part: Path, capsys: pytest.CaptureFixture[str], more: list[str], says: str
) -> None:
    assert says in refusal(part, capsys, *WHOLE, *more)


@pytest.mark.parametrize("option", ["--radii", "--report", "--write-spec"])
@pytest.mark.parametrize(("source", "called"), [("part.stl", "part"), ("loads.toml", "load file")])
def test_no_output_is_an_input(
    part: Path, capsys: pytest.CaptureFixture[str], option: str, source: str, called: str
) -> None:
    before = part.with_name(source).read_bytes()
    assert f"is the {called} itself" in refusal(part, capsys, option, part.with_name(source))
    assert part.with_name(source).read_bytes() == before


def test_a_part_that_is_not_held_is_refused(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    loads = part.with_name("loads.toml")
    text = LOADS.replace("fixed = true", "x = 0")
    loads.write_text(text, encoding="utf-8")
    assert "move freely" in refusal(part, capsys, *WHOLE, "--no-proof")


@pytest.mark.slow
def test_a_target_says_what_mass_struts_have_before_they_are_sized(
    part: Path, tmp_path: Path
) -> None:
    loads, out, report = (
        part.with_name("loads.toml"),
        part.with_name("out.stl"),
        tmp_path / "r.json",
    )
    lattice = ["--cell", "CVC", "--cell-size", 10, "--relative-density", 0.05, *WHOLE, "--no-proof"]
    more = ["--quiet", "--steps", 3, "--report", report]
    assert run("size", part, "--loads", loads, "-o", out, *lattice, *more) == 0
    found = json.loads(report.read_text())
    assert found["part"]["relative_density"] == pytest.approx(0.05, rel=0.02)
    assert "struts have their mass" in found["sizing"]["notes"][0]


@pytest.mark.costly
def test_the_steps_are_drawn(part: Path, tmp_path: Path) -> None:
    plot, report = tmp_path / "steps.svg", tmp_path / "r.json"
    more = ("--plot", plot, "--report", report, "--no-proof", "--steps", 5)
    assert size(part, *WHOLE, "--safety", 2, "--max-displacement", 0.1, *more) == 0
    root = ElementTree.parse(plot).getroot()
    lines = [node.get("points", "").split() for node in root.iter(f"{SVG}polyline")]
    steps = json.loads(report.read_text())["sizing"]["steps"]
    assert [len(line) for line in lines] == [len(steps)] * 3
    figures = json.loads(report.read_text())["sizing"]
    assert steps[-1]["strut_volume_mm3"] == figures["strut_volume_mm3"]
    assert steps[-1]["uses"] == figures["uses"]
    told = [node.text for node in root.iter(f"{SVG}text")]
    assert {"mass of the struts, g", "use of stress, %", "use of displacement, %"} <= set(told)
    heights = np.array([float(point.split(",")[1]) for point in lines[0]])
    mass = np.array([step["strut_volume_mm3"] for step in steps])
    assert heights == pytest.approx(350 - 310 * mass / mass.max(), abs=0.06)


def test_a_plot_is_an_svg(part: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "is an .svg file" in refusal(part, capsys, "--plot", part.with_name("steps.png"))


@pytest.mark.costly
@pytest.mark.slow_but("2")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_a_signal_to_stop_keeps_the_best_design_so_far(
    part: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: signal.Signals
) -> None:
    told = []
    handlers = [signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)]

    def interrupting(quiet: bool, most_steps: int, goal: Goal) -> Callable[[int, Step], bool]:
        def watch(count: int, step: Step) -> bool:
            told.append(step)
            if count == 2:
                signal.raise_signal(number)
            return True

        return watch

    monkeypatch.setattr(size_command, "_teller", interrupting)
    report = tmp_path / "r.json"
    assert size(part, *WHOLE, "--no-proof", "--report", report) == 0
    assert len(told) == 3 or len(told) == 4
    assert json.loads(report.read_text())["sizing"]["stopped"] == "cancelled"
    assert part.with_name("out.stl").exists()
    assert [signal.getsignal(each) for each in (signal.SIGINT, signal.SIGTERM)] == handlers


def test_every_step_and_stage_is_told_though_nobody_looks(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ("--loads", part.with_name("loads.toml"), "-o", part.with_name("out.stl"))
    assert run("size", part, *options, *WHOLE, "--no-proof", "--steps", "3") in (0, 3)
    told = capsys.readouterr().err.splitlines()
    lines = [line for line in told if line.startswith("step ")]
    assert len(lines) == 3
    assert "40%: sizing" in told[: told.index(lines[0])]
    assert re.fullmatch(r"step 1: struts [\d,]+ mm3", lines[0])
    assert re.search(r", [\d.]+ (s|min) a step, at most \d+ s more$", lines[1])


@pytest.mark.costly_cases("x = 0-sliding across x and turning about x through (")
@pytest.mark.slow_but("fixed = true-", "x = 0-sliding across x and turning about x through (")
@pytest.mark.parametrize(
    ("held", "says"),
    [
        ("x = 0", "sliding across x and turning about x through ("),
        ("x = 0\nz = 0", "sliding along y in case 'pull'"),
        ("fixed = true", ""),
    ],
)
def test_a_part_that_may_slide_is_told(
    part: Path, capsys: pytest.CaptureFixture[str], held: str, says: str
) -> None:
    """Pulled along x only: where that is solved, or refused because a pivot is 0, it is named."""
    case = (
        LOADS.split("[[case]]")[0].replace("fixed = true", held)
        + """
[[case]]
name = "pull"
[[case.load]]
plane = { point = [40, 0, 0], normal = [1, 0, 0] }
force = [100, 0, 0]
"""
    )
    part.with_name("loads.toml").write_text(case, encoding="utf-8")
    assert size(part, *WHOLE, "--steps", "1", "--no-proof") in ((0, 2) if says else (0,))
    said = capsys.readouterr().err
    assert says in said
    assert ("Nothing keeps the part from" in said) == bool(says)


@pytest.mark.costly
def test_limits_that_cannot_be_held_are_told(
    part: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert size(part, *WHOLE, "--max-stress", "1", "--steps", "2", "--no-proof") == 3
    assert part.with_name("out.stl").is_file()
    said = capsys.readouterr().err
    assert "limit of stress cannot be held" in said
    assert "by the strut at (" in said
    assert "What may help: thicker struts, where --thickest limits them" in said


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed")
def test_a_design_of_which_nothing_was_compared_is_not_told_as_proved(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A slender box, nearly solid: its struts are shorter than thick, the limit cannot be held."""
    shape = trimesh.creation.box((40, 10, 10))
    shape.apply_translation((20, 5, 5))
    mesh = TriangleMesh(np.array(shape.vertices), np.array(shape.faces).astype(np.int32))
    write_stl(mesh, tmp_path / "part.stl")
    (tmp_path / "loads.toml").write_text(LOADS, encoding="utf-8")
    out, report = tmp_path / "out.stl", tmp_path / "report.json"
    lattice = ["--cell", "CVC", "--cell-size", 12, "--strut-radius", 1, "--shell", 2]
    run(
        "size", tmp_path / "part.stl", "--loads", tmp_path / "loads.toml", "-o", out, *lattice,
        "--max-stress", 2, "--steps", 6, "--report", report,
    )  # fmt: skip
    told, warned = capsys.readouterr()
    limit = next(line for line in told.splitlines() if line.startswith("  stress, %"))
    assert limit.endswith("  not compared in CalculiX")
    assert re.search(r"\n  confirmed +no +\S", told)
    assert "not confirmed by CalculiX: the most stressed strut is too short" in warned
    for what in ("thicker than r/L = 0.15", "of the space", "shorter than their diameter"):
        assert what in warned.split("Beams and shells hardly hold here")[1]
    figures = json.loads(report.read_text(encoding="utf-8"))["sizing"]
    proof = figures["calculix"]
    assert proof["confirmed"] is False
    assert "of the space that they fill" in proof["doubts"][-1]
    assert "stress" not in proof["uses"]
    assert proof["largest_stress"] is None
    rows = dict(line.split("  ", 1) for line in told.splitlines() if "  " in line)
    assert float(rows["time"].split()[0]) > figures["seconds"]["total"]


@pytest.mark.costly
def test_the_report_is_a_page_to_print(part: Path, tmp_path: Path) -> None:
    page = tmp_path / "report.html"
    more = ("--report", page, "--no-proof", "--steps", 3)
    assert size(part, *WHOLE, "--safety", 2, *more) == 0
    text = page.read_text(encoding="utf-8")
    assert text.count("<svg") == 2 + 1  # two cases, and the steps
    assert not re.search(r"(src|href|url)\s*[=(]", text)  # nothing outside of it
    assert "@page" in text
    for said in (
        "<figcaption>down<",
        "<figcaption>aside<",
        "stress",
        "not solved by another program",
        "fatigue",
    ):
        assert said in text
    (limit, used) = re.findall(r"stress, % of its limit.*?([0-9.]+) MPa</td><td>([0-9.]+)<", text)[
        0
    ]
    assert limit == "450"  # half of what the material of the loads yields at
    stress = re.findall(r"<td>(?:down|aside)[^/]*</td>.*<td>([0-9.]+)</td>", text)
    assert max(map(float, stress)) == pytest.approx(float(limit) * float(used) / 100.0, rel=0.01)
    (mass,) = re.findall(r"<td>mass of the struts, g[^/]*</td><td>([0-9.]+)<", text)
    assert float(mass) == pytest.approx(
        trimesh.load(part.with_name("out.stl")).volume * 4.41e-3, rel=0.01
    )
