# SPDX-License-Identifier: LGPL-2.1-or-later
"""What is made without manifold3d, and what is said where it is needed."""

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
import trimesh

from volfrep.util.manifold import INSTALL

ENGINE = Path(__file__).resolve().parents[3] / "core" / "volfrep"
#: A prism over an L: its ends are concave polygons.
OUTLINE = ((0, 0), (30, 0), (30, 20), (10, 20), (10, 10), (0, 10))
PART = "".join(f"v {x} {y} {z}\n" for z in (0, 20) for x, y in OUTLINE)
PART += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n"
PART += "".join(f"f {k + 1} {m + 1} {m + 7} {k + 7}\n" for k, m in enumerate((1, 2, 3, 4, 5, 0)))
#: Runs jobs one after the other in a Python that cannot import manifold3d.
SCRIPT = """
import contextlib, io, json, sys
sys.modules["manifold3d"] = None
from volfrep.__main__ import main
results = []
for words in json.loads(sys.argv[1]):
    sys.argv = ["volfrep", *words]
    said = io.StringIO()
    with contextlib.redirect_stderr(said), contextlib.redirect_stdout(said):
        try:
            code = main()
        except SystemExit as end:
            code = end.code
    results.append((code or 0, said.getvalue()))
print(json.dumps(results))
"""
LATTICE = ("--cell-size", "10", "--strut-radius", "1")
TPMS = (
    "--cell",
    "Schwarz P",
    "--wall-kind",
    "skeleton",
    "--cell-size",
    "10",
    "--relative-density",
    "0.5",
)
#: What is made: the file, and how.
MADE = {
    "block.stl": ("block", "--count", "2,2,2", "--cell", "Octet", *LATTICE),
    "walls.stl": ("block", "--count", "2,2,2", *TPMS),
    "part.stl": ("fill", "part.obj", *LATTICE, "--shell", "2"),
    "bare.stl": ("fill", "part.obj", *LATTICE, "--shell", "0", "--boundary", "whole"),
    "tpms.stl": ("fill", "part.obj", *TPMS, "--shell", "2"),
    "beams.3mf": ("fill", "part.obj", *LATTICE, "--shell", "2", "--3mf", "beams"),
    "deck.inp": ("fill", "part.obj", *LATTICE, "--shell", "2", "--inp", "beams"),
    "axes.step": ("fill", "part.obj", *LATTICE, "--shell", "2", "--step", "wireframe"),
    "layers": ("slice", "part.obj", *LATTICE, "--shell", "2", "--layer", "4"),
}
#: What is refused: by what the sentence begins with.
REFUSED = {
    "Outlines of layers": (
        "slice", "part.obj", *LATTICE, "--shell", "2", "--layer", "4", "--format", "svg",
    ),
    "Cutting or uniting solids": (
        "fill", "part.obj", *LATTICE, "--shell", "2", "--open-plane", "0,0,20,0,0,1",
    ),
}  # fmt: skip


@pytest.fixture(scope="module")
def without(tmp_path_factory):
    """What the jobs have ended with and said, by their names, and the folder of their files."""
    folder = tmp_path_factory.mktemp("without")
    (folder / "part.obj").write_text(PART)
    jobs = [[*words, "-o", name] for name, words in MADE.items()]
    jobs += [[*words, "-o", "none.stl"] for words in REFUSED.values()]
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, json.dumps(jobs)], cwd=folder, capture_output=True,
        text=True, env=dict(os.environ, **{INSTALL: "pip install it"}),
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    results = json.loads(done.stdout)
    return folder, dict(zip([*MADE, *REFUSED], results, strict=True))


@pytest.mark.slow
@pytest.mark.parametrize("name", MADE)
def test_without_the_package_it_is_made(name, without):
    folder, results = without
    code, said = results[name]
    assert code == 0, said
    assert (folder / name).exists()


@pytest.mark.slow
def test_the_part_without_it_is_the_part(without, tmp_path):
    """Closed, and of the volume that the one with it has; the skin's facets are more, as told."""
    import volfrep

    folder, results = without
    assert "pip install it" in results["part.stl"][1]
    for name, bodies in (("block.stl", 1), ("part.stl", 2), ("walls.stl", 1)):
        mesh = trimesh.load(folder / name)
        assert mesh.is_watertight, name
        assert mesh.is_winding_consistent, name
        if name == "part.stl":
            other = volfrep.fill(folder / "part.obj", cell_size=10, strut_radius=1, shell=2)
            assert mesh.volume == pytest.approx(other.report.volume_mm3, rel=1e-4)
        assert len(mesh.split(only_watertight=False)) == bodies, name
    block = volfrep.block((2, 2, 2), cell="Octet", cell_size=10, strut_radius=1)
    mesh = trimesh.load(folder / "block.stl")
    assert mesh.volume == pytest.approx(block.report.volume_mm3, rel=1e-6)


@pytest.mark.slow
@pytest.mark.parametrize("what", REFUSED)
def test_what_needs_it_says_so_in_one_sentence(what, without):
    folder, results = without
    code, said = results[what]
    assert code == 2
    assert said.strip().splitlines()[-1] == (
        f"volfrep: {what} needs the Python package manifold3d, which is not installed: install it "
        "with the command  pip install it  and start again."
    )
    assert not (folder / "none.stl").exists()


def test_one_door_leads_to_the_package():
    """No module imports it at run time but that one."""
    found = set()
    for path in ENGINE.rglob("*.py"):
        text = path.read_text(encoding="utf-8")
        if "import manifold3d" not in text and "from manifold3d" not in text:
            continue
        tree = ast.parse(text)
        typed = {
            id(inner)
            for node in ast.walk(tree)
            if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING"
            for inner in ast.walk(node)
        }
        for node in ast.walk(tree):
            if id(node) in typed or not isinstance(node, (ast.Import, ast.ImportFrom)):
                continue
            names = [alias.name for alias in node.names] + [getattr(node, "module", "") or ""]
            if any(name.split(".")[0] == "manifold3d" for name in names):
                found.add(path.name)
    assert found == set()
