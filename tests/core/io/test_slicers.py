# SPDX-License-Identifier: LGPL-2.1-or-later
"""Slicers take the files without repairing anything, and want as much filament as we say."""

from pathlib import Path

import pytest

import samples
from bench.parts import NO_PARTS, PARTS
from slicers import cura_resources, cura_volume, prusa_info, prusa_slicer, prusa_volume
from volfrep import LatticeSpec, Result, StageCache, read_solid
from volfrep.io.write.threemf import write_3mf_beams
from volfrep.jobs.beam_part import beam_model
from volfrep.jobs.blocks import block
from volfrep.jobs.pipeline import fill
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output.meshes import write_mesh

needs_prusa_slicer = pytest.mark.skipif(not prusa_slicer(), reason="PrusaSlicer is not installed")
needs_cura = pytest.mark.skipif(
    cura_resources() is None, reason="CuraEngine or its printer definitions are not installed"
)
needs_parts = pytest.mark.skipif(not PARTS.is_dir(), reason=NO_PARTS)

#: What PrusaSlicer says of a model that it took as it is.
INFO = {f"{what}_{axis}" for what in ("size", "min", "max") for axis in "xyz"}
INFO |= {"number_of_facets", "manifold", "number_of_parts", "volume"}

SOLID = samples.box((20.0, 20.0, 20.0))
SPEC = LatticeSpec(cell="Box", cell_size=10, strut_radius=1, shell=1.2)


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> tuple[Result, Path]:
    """A small part, and the folder with its files."""
    folder = tmp_path_factory.mktemp("slicers")
    cache = StageCache()
    result = fill(SOLID, SPEC, cache=cache)
    for suffix in ("stl", "3mf", "obj"):
        write_mesh(result.mesh, folder / f"mesh.{suffix}")
    beams = beam_model(SOLID, SPEC, cache=cache)
    write_3mf_beams(beams, folder / "both.3mf", result.mesh)
    write_3mf_beams(beams, folder / "beams.3mf")
    return result, folder


@needs_prusa_slicer
@pytest.mark.parametrize("name", ["mesh.stl", "mesh.3mf", "mesh.obj", "both.3mf"])
def test_prusa_slicer_has_nothing_to_repair(small, name):
    result, folder = small
    said = prusa_info(folder / name)
    assert said.keys() == INFO
    assert said["manifold"] == "yes"
    assert int(said["number_of_facets"]) == result.report.triangles
    assert int(said["number_of_parts"]) == result.report.bodies + result.report.voids
    assert float(said["volume"]) == pytest.approx(result.report.volume_mm3, rel=1e-4)
    assert float(said["size_x"]) == pytest.approx(20.0)


@needs_prusa_slicer
def test_prusa_slicer_refuses_beams_alone_rather_than_print_the_skin(small):
    with pytest.raises(AssertionError, match="not contain a valid model"):
        prusa_info(small[1] / "beams.3mf")


@pytest.mark.costly
@pytest.mark.slow_cases("both.3mf")
@needs_prusa_slicer
@pytest.mark.parametrize("name", ["mesh.stl", "both.3mf"])
def test_prusa_slicer_wants_the_filament_of_the_part(small, name):
    result, folder = small
    assert prusa_volume(folder / name) == pytest.approx(result.report.volume_mm3, rel=0.05)


@needs_cura
def test_cura_wants_the_filament_of_the_part(small):
    result, folder = small
    assert cura_volume(folder / "mesh.stl") == pytest.approx(result.report.volume_mm3, rel=0.05)


def made(name: str) -> Result:
    """A part of its name, with a lattice that a 0.4 mm nozzle can lay."""
    if name == "block":
        return block(LatticeSpec(cell="Octet", cell_size=15, strut_radius=1.5), (3, 3, 3))
    size, radius, shell = {"ge_bracket": (10, 1, 3), "piston_rod": (5, 0.6, 1)}[name]
    spec = LatticeSpec(cell="CVC", cell_size=size, strut_radius=radius, shell=shell)
    return fill(read_solid(PARTS / f"{name}.stl"), spec)


@pytest.mark.slow
@pytest.mark.parametrize("suffix", ["stl", "3mf"])
@pytest.mark.parametrize(
    "name",
    [
        "block",
        pytest.param("piston_rod", marks=needs_parts),
        pytest.param("ge_bracket", marks=needs_parts),
    ],
)
@needs_prusa_slicer
def test_prusa_slicer_slices_real_parts(tmp_path: Path, name: str, suffix: str):
    result = made(name)
    path = tmp_path / f"{name}.{suffix}"
    write_mesh(result.mesh, path)
    assert prusa_info(path).keys() == INFO
    assert prusa_volume(path) == pytest.approx(result.report.volume_mm3, rel=0.05)


@pytest.mark.slow
@needs_cura
@needs_parts
def test_cura_slices_a_real_part(tmp_path: Path):
    result = made("piston_rod")
    # CuraEngine alone slices what lies above the plate, where its window would have put the part.
    raised = result.mesh.vertices - result.mesh.bounds[0]
    write_mesh(TriangleMesh(raised, result.mesh.triangles), tmp_path / "rod.stl")
    volume = cura_volume(tmp_path / "rod.stl")
    assert volume == pytest.approx(result.report.volume_mm3, rel=0.05)
