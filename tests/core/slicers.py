# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slicing with other people's programs, so that the filament's volume is the part's.

One wall, the inside filled with lines side by side, no overlap, and nothing beside the part.
"""

from __future__ import annotations

import math
import os
import re
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
#: Where Cura's printer definitions may be: installed, or unpacked by tools/setup.sh.
CURA_RESOURCES = [
    folder / "usr/share/cura/resources" for folder in (Path("/"), ROOT / ".cache/cura")
]
LAYER, WIDTH, FILAMENT = 0.2, 0.4, 1.75

_PRUSA = f"""
printer_technology = FFF
nozzle_diameter = {WIDTH}
layer_height = {LAYER}
first_layer_height = {LAYER}
extrusion_width = {WIDTH}
first_layer_extrusion_width = {WIDTH}
perimeter_extrusion_width = {WIDTH}
external_perimeter_extrusion_width = {WIDTH}
infill_extrusion_width = {WIDTH}
solid_infill_extrusion_width = {WIDTH}
top_infill_extrusion_width = {WIDTH}
filament_diameter = {FILAMENT}
perimeters = 1
perimeter_generator = classic
top_solid_layers = 0
bottom_solid_layers = 0
fill_density = 100%
fill_pattern = rectilinear
infill_overlap = 0%
overhangs = 0
thick_bridges = 0
elefant_foot_compensation = 0
resolution = 0.01
skirts = 0
brim_width = 0
retract_length = 0
start_gcode =
end_gcode =
bed_shape = 0x0,300x0,300x300,0x300
max_print_height = 300
"""
_CURA = {
    "layer_height": LAYER, "layer_height_0": LAYER, "infill_sparse_thickness": LAYER,
    "wall_line_count": 1, "top_layers": 0, "bottom_layers": 0,
    "infill_pattern": "lines", "infill_sparse_density": 100, "infill_line_distance": WIDTH,
    "infill_overlap_mm": 0, "skin_overlap_mm": 0, "layer_0_z_overlap": 0,
    "adhesion_type": "none", "retraction_enable": "false", "material_diameter": FILAMENT,
    "machine_start_gcode": "", "machine_end_gcode": "", "machine_center_is_zero": "true",
    "machine_width": 400, "machine_depth": 400, "machine_height": 400,
}  # fmt: skip


def prusa_slicer() -> bool:
    """Whether PrusaSlicer is installed."""
    return shutil.which("prusa-slicer") is not None


def cura_resources() -> Path | None:
    """Cura's printer definitions, if they and CuraEngine are there."""
    if shutil.which("CuraEngine") is None:
        return None
    return next((folder for folder in CURA_RESOURCES if folder.is_dir()), None)


def _run(command: list[str], folder: Path, environment: dict[str, str]) -> str:
    done = subprocess.run(
        command, cwd=folder, env={**os.environ, **environment}, capture_output=True, text=True
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0, said[-2000:]
    assert "[error]" not in said.lower(), said[-2000:]
    return said


def prusa_info(path: Path) -> dict[str, str]:
    """What PrusaSlicer says of a model; a model that it repaired has more entries."""
    said = _run(["prusa-slicer", "--info", str(path)], path.parent, {})
    return dict(re.findall(r"^(\w+) = +(.*)$", said, re.MULTILINE))


def prusa_volume(path: Path) -> float:
    """Volume in mm3 of the filament that PrusaSlicer wants for a model."""
    settings, gcode = path.with_suffix(".ini"), path.with_suffix(".prusa.gcode")
    settings.write_text(_PRUSA)
    command = ["prusa-slicer", "--export-gcode", "--load", str(settings), "--output", str(gcode)]
    _run([*command, str(path)], path.parent, {})
    length = re.search(r"filament used \[mm\] = ([\d.]+)", gcode.read_text())
    assert length
    return _volume(float(length[1]))


def prusa_project_volume(path: Path) -> float:
    """Volume in mm3 of the filament for a project that says itself how it is to be printed.

    Infill reaches into walls as far as the slicer has it by itself.
    """
    own = ("perimeters", "top_solid_layers", "bottom_solid_layers", "fill_density", "fill_pattern",
           "infill_overlap")  # fmt: skip
    rest = [line for line in _PRUSA.splitlines() if line.partition(" =")[0] not in own]
    settings, gcode = path.with_suffix(".ini"), path.with_suffix(".prusa.gcode")
    settings.write_text("\n".join(rest))
    command = ["prusa-slicer", "--export-gcode", "--load", str(settings), "--output", str(gcode)]
    _run([*command, str(path)], path.parent, {})
    length = re.search(r"filament used \[mm\] = ([\d.]+)", gcode.read_text())
    assert length
    return _volume(float(length[1]))


def cura_volume(path: Path) -> float:
    """Volume in mm3 of the filament that CuraEngine wants for an STL file that starts at z = 0."""
    resources = cura_resources()
    assert resources is not None
    gcode = path.with_suffix(".cura.gcode")
    settings = [word for name, value in _CURA.items() for word in ("-s", f"{name}={value}")]
    command = ["CuraEngine", "slice", "-j", str(resources / "definitions/fdmprinter.def.json")]
    command += ["-o", str(gcode), *settings, "-e0", *settings, "-l", str(path)]
    search = f"{resources / 'definitions'}:{resources / 'extruders'}"
    _run(command, path.parent, {"CURA_ENGINE_SEARCH_PATH": search})
    # Without retractions the extruder only goes forward; G92 sets its count back to zero.
    length = last = 0.0
    for line in gcode.read_text().splitlines():
        to = re.match(r"G(92|[01]) (?:.* )?E(-?[\d.]+)", line)
        if to:
            position = float(to[2])
            length += 0.0 if to[1] == "92" else position - last
            last = position
    return _volume(length)


def _volume(length: float) -> float:
    return length * math.pi * FILAMENT**2 / 4.0
