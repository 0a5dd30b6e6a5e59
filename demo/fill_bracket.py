# SPDX-License-Identifier: LGPL-2.1-or-later
"""Models the two example parts in FreeCAD, fills the bracket, and writes every kind of file.

Run by ``make demo`` as ``freecadcmd demo/fill_bracket.py``; leaves in build/demo:

    bracket.FCStd        the bracket, its spreadsheet, its lattice, and the faceted sample
    bracket.stl          the filled bracket
    bracket_solid.stl    the bracket before it was filled
    bracket_report.json  what was made, in figures
    sample.step          a small filled block as an ordinary solid
    piston_rod.FCStd     the piston rod
    piston_rod.step
"""

from __future__ import annotations

import json
import os
import sys
import time
import traceback
from pathlib import Path
from typing import Any

import FreeCAD as App
import MeshPart

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "build" / "demo"
sys.path.insert(0, str(ROOT))

LATTICE = {"CellType": "CVC", "CellSize": 10, "StrutRadius": 1, "ShellThickness": 3}
#: The faceted sample: a few cells, coarse, so that STEP readers open it at once.
SAMPLE = {
    "CellType": "CVC",
    "CellSize": 10,
    "StrutRadius": 1,
    "ShellThickness": 1,
    "Resolution": 10,
}
SAMPLE_SIZE = (20.0, 20.0, 20.0)


def main() -> None:
    """Make everything, or raise."""
    from freecad_volfrep import export_mesh, make_lattice_infill, make_solid
    from freecad_volfrep.examples import make_bracket, make_piston_rod

    OUT.mkdir(parents=True, exist_ok=True)

    doc = App.newDocument("piston_rod")
    rod = make_piston_rod(doc)
    _check(doc)
    rod.Shape.exportStep(str(OUT / "piston_rod.step"))
    doc.saveAs(str(OUT / "piston_rod.FCStd"))
    _say(f"piston rod: {_size(rod.Shape)}, {rod.Shape.Volume:.0f} mm3")

    doc = App.newDocument("bracket")
    bracket = make_bracket(doc)
    _check(doc)
    _say(f"bracket: {_size(bracket.Shape)}, {bracket.Shape.Volume:.0f} mm3")
    start = time.perf_counter()
    infill = make_lattice_infill(doc, bracket, Label="Light bracket", **LATTICE)
    doc.recompute()
    seconds = time.perf_counter() - start
    _check(doc)
    export_mesh(infill, OUT / "bracket.stl")
    (OUT / "bracket_report.json").write_text(infill.Report + "\n")
    report = json.loads(infill.Report)
    _say(
        f"filled with {report['cells_active']} of {report['cells_total']} cells in "
        f"{seconds:.1f} s: {report['volume_mm3'] / bracket.Shape.Volume:.0%} of the solid's "
        f"volume, {report['triangles']} triangles, {report['bodies']} body"
    )

    facets = MeshPart.meshFromShape(
        Shape=bracket.Shape, LinearDeflection=0.05, AngularDeflection=0.2
    )
    facets.write(str(OUT / "bracket_solid.stl"))

    cube = doc.addObject("Part::Box", "SampleCube")
    cube.Length, cube.Width, cube.Height = SAMPLE_SIZE
    cube.Placement.Base = App.Vector(0, 0, 150)
    sample = make_lattice_infill(doc, cube, Label="Sample lattice", **SAMPLE)
    doc.recompute()
    start = time.perf_counter()
    faceted = make_solid(doc, sample)
    doc.recompute()
    _check(doc)
    faceted.Shape.exportStep(str(OUT / "sample.step"))
    _say(
        f"sample: {sample.Triangles} triangles as a solid of {len(faceted.Shape.Faces)} faces "
        f"in {time.perf_counter() - start:.1f} s"
    )
    doc.saveAs(str(OUT / "bracket.FCStd"))


def _check(doc: Any) -> None:
    """Refuse to go on where any object is not what it should be: FreeCAD itself would not."""
    broken = [obj.Label for obj in doc.Objects if not obj.isValid()]
    if broken:
        raise RuntimeError(f"These objects did not compute: {', '.join(broken)}.")


def _size(shape: Any) -> str:
    box = shape.BoundBox
    return f"{box.XLength:.1f} x {box.YLength:.1f} x {box.ZLength:.1f} mm"


def _say(text: str) -> None:
    print(f"demo: {text}", flush=True)


# FreeCAD gives this file a name of its own, not __main__, answers an exception by running the
# file once more, and exits with 0 whatever happened: so the exit code is set here.
code = 1
try:
    main()
    code = 0
except Exception:
    traceback.print_exc()
finally:
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
