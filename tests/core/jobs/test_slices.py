# SPDX-License-Identifier: LGPL-2.1-or-later
"""Layers straight from the struts are the sections of the mesh, in pictures and in outlines."""

import json
import re
from dataclasses import replace

import numpy as np
import pytest
from PIL import Image

import samples
from volfrep import Cancelled, LatticeSpec, StageCache, VolfrepError, fill
from volfrep.design.grading import Orientation, RadiusGrading
from volfrep.design.openings import DrainHoles, OpenPlane
from volfrep.design.profile import Profile
from volfrep.design.target import Target
from volfrep.jobs import slices
from volfrep.jobs.slices import write_layers
from volfrep.mesh.booleans import as_manifold

#: Facets so fine that their sections are compared with, not judged.
SPEC = LatticeSpec(cell="BCC", cell_size=8, strut_radius=0.9, shell=1.2, deviation=0.012)
PART = samples.box((24.0, 20.0, 12.0))
CACHE = StageCache()
GRADED = RadiusGrading("direction", Profile("linear", 0.5, 1.2), direction=(0, 0, 1))


def figures(folder):
    return json.loads((folder / "layers.json").read_text())


@pytest.mark.slow_but("lattice", "domain")
@pytest.mark.parametrize(
    "spec",
    [
        SPEC,
        replace(SPEC, shell=0),
        replace(
            SPEC, boundary="whole", activation="inside", cell_size=5, strut_radius=0.5, shell=0
        ),
        replace(SPEC, output="lattice"),
        replace(SPEC, output="domain"),
        replace(SPEC, remove_dangling=True),
        replace(SPEC, radius_grading=GRADED),
        replace(SPEC, drains=DrainHoles(2.0, count=1)),
    ],
    ids=["skin", "bare", "whole cells", "lattice", "domain", "pruned", "graded", "drained"],
)
def test_layers_are_the_sections_of_the_mesh(spec, tmp_path):
    made = write_layers(PART, spec, tmp_path / "layers", layer=0.9, form="svg", cache=CACHE)
    mesh = as_manifold(fill(PART, spec, cache=CACHE).result.mesh)
    for layer in figures(tmp_path / "layers")["layers"]:
        # A facet's section strays by its deviation times the outline, both ways; by more where
        # the plane touches struts that lie in it.
        assert layer["area_mm2"] == pytest.approx(mesh.slice(layer["z"]).area(), rel=0.03, abs=15)
    middles = np.array([layer["z"] for layer in figures(tmp_path / "layers")["layers"]])
    sections = sum(mesh.slice(z).area() for z in middles)
    assert made.area == pytest.approx(sections, rel=3e-3)


@pytest.mark.costly
def test_a_picture_has_the_area_of_the_outlines(tmp_path):
    solid, spec = samples.plate(32), replace(SPEC, deviation=None)
    made = write_layers(solid, spec, tmp_path / "png", layer=0.9, cache=CACHE, pixel=0.05)
    drawn = write_layers(solid, spec, tmp_path / "svg", layer=0.9, cache=CACHE, form="svg")
    assert made.volume == pytest.approx(drawn.volume, rel=1e-3)
    for layer in figures(tmp_path / "png")["layers"]:
        picture = np.asarray(Image.open(tmp_path / "png" / layer["file"]))
        assert picture.dtype == np.uint8
        assert (picture.shape[1], picture.shape[0]) == made.pixels
        assert picture.sum() / 255 * 0.05**2 == pytest.approx(layer["area_mm2"], rel=1e-4)


def test_a_picture_lies_where_the_part_lies(tmp_path):
    solid = samples.box((20.0, 10.0, 6.0), (100.0, -50.0, 3.0))
    write_layers(solid, replace(SPEC, cell_size=5), tmp_path / "png", layer=1.0, pixel=0.1)
    told = figures(tmp_path / "png")
    assert [round(layer["z"], 6) for layer in told["layers"]] == [3.5, 4.5, 5.5, 6.5, 7.5, 8.5]
    rows, columns = np.nonzero(Image.open(tmp_path / "png" / told["layers"][2]["file"]))
    x, y = told["pixel"]["upper_left"]
    assert (x + 0.1 * columns.min(), x + 0.1 * (columns.max() + 1)) == pytest.approx((100, 120))
    assert (y - 0.1 * (rows.max() + 1), y - 0.1 * rows.min()) == pytest.approx((-50, -40))


def test_the_common_layer_interface_tells_every_outline(tmp_path):
    made = write_layers(PART, SPEC, tmp_path / "cli", layer=1.0, form="cli", cache=CACHE)
    text = (tmp_path / "cli" / "part.cli").read_text()
    assert text.startswith("$$HEADERSTART\n$$ASCII\n$$UNITS/1\n")
    assert text.endswith("$$GEOMETRYEND\n")
    tops = [float(top) for top in re.findall(r"\$\$LAYER/(\S+)", text)]
    assert tops == pytest.approx(np.arange(1, 13))
    area = 0.0
    for turn, count, numbers in re.findall(r"\$\$POLYLINE/1,([01]),(\d+),(\S+)", text):
        corners = np.array(numbers.split(","), float).reshape(-1, 2)
        assert len(corners) == int(count)
        assert (corners[0] == corners[-1]).all()
        x, y = corners.T
        own = 0.5 * (x[:-1] * y[1:] - x[1:] * y[:-1]).sum()
        assert (own > 0) == (turn == "1")
        area += own
    assert area == pytest.approx(made.area, rel=1e-3)


@pytest.mark.slow
def test_an_open_face_is_open_in_the_layers(tmp_path):
    solid = samples.box((20.0, 20.0, 10.0))
    spec = replace(
        SPEC, cell_size=5, strut_radius=0.5, open_faces=(OpenPlane((5, 5, 10), (0, 0, 1)),)
    )
    write_layers(solid, spec, tmp_path / "svg", layer=0.8, form="svg")
    last = figures(tmp_path / "svg")["layers"][-1]
    mesh = as_manifold(fill(solid, spec).result.mesh)
    assert last["area_mm2"] == pytest.approx(mesh.slice(last["z"]).area(), rel=0.02)
    assert last["area_mm2"] < 0.6 * 20 * 20


def test_a_lattice_in_slabs_has_the_same_layers(tmp_path, monkeypatch):
    turned = replace(SPEC, orientation=Orientation((1, 2, 0), 25))
    for name, spec in (("straight", SPEC), ("turned", turned)):
        whole = write_layers(PART, spec, tmp_path / name, layer=0.9, form="svg", cache=CACHE)
        with monkeypatch.context() as patch:
            patch.setattr(slices, "MOST_WHOLE", 3)
            slabs = write_layers(
                PART, spec, tmp_path / f"{name} slabs", layer=0.9, form="svg", cache=CACHE
            )
        assert slabs.volume == pytest.approx(whole.volume, rel=1e-9)
        assert "layer by layer" in slabs.warnings[-1]


@pytest.mark.slow
def test_a_target_is_met_in_layers(tmp_path):
    spec = replace(SPEC, target=Target("relative_density", 0.2))
    # The skin is six layers thick.
    made = write_layers(PART, spec, tmp_path / "svg", layer=0.2, form="svg", cache=CACHE)
    domain = fill(PART, SPEC, output="domain").report.volume_mm3
    skin = PART.volume - domain
    assert (made.volume - skin) / domain == pytest.approx(0.2, rel=0.02)


@pytest.mark.costly_cases("wrong1-make them higher")
@pytest.mark.parametrize(
    ("wrong", "why"),
    [
        ({"layer": 0}, "layer height must be above 0"),
        ({"layer": 1e-9}, "make them higher"),
        ({"layer": 1, "pixel": -1}, "pixel must be above 0"),
        ({"layer": 1, "pixel": 1e-4}, "make them larger"),
        ({"layer": 1, "form": "bmp"}, "There is no format 'bmp'"),
        ({"layer": 1, "form": "svg", "pixel": 0.1}, "Only pictures have pixels"),
    ],
)
def test_what_makes_no_sense_is_refused_with_nothing_left(wrong, why, tmp_path):
    with pytest.raises(VolfrepError, match=why):
        write_layers(samples.box(), SPEC, tmp_path / "layers", **wrong)
    assert list(tmp_path.iterdir()) == []


def test_fillets_are_refused(tmp_path):
    with pytest.raises(VolfrepError, match="no fillets"):
        write_layers(samples.box(), replace(SPEC, fillet=0.3), tmp_path / "a", layer=1)


def test_layers_are_replaced_and_other_files_are_not(tmp_path):
    target = tmp_path / "layers"
    write_layers(samples.box(), SPEC, target, layer=2)
    write_layers(samples.box(), SPEC, target, layer=5)
    assert len(list(target.glob("*.png"))) == 4
    (target / "layers.json").unlink()
    with pytest.raises(VolfrepError, match="holds other files"):
        write_layers(samples.box(), SPEC, target, layer=5)
    assert len(list(target.glob("*.png"))) == 4
    (tmp_path / "file").write_text("mine")
    with pytest.raises(VolfrepError, match="is not a folder"):
        write_layers(samples.box(), SPEC, tmp_path / "file", layer=5)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "layers"]


@pytest.mark.slow
def test_cancelled_layers_leave_the_old_ones(tmp_path):
    target = tmp_path / "layers"
    write_layers(samples.box(), SPEC, target, layer=5)
    before = {path.name: path.read_bytes() for path in target.iterdir()}
    with pytest.raises(Cancelled):
        write_layers(
            samples.box(), SPEC, target, layer=1,
            progress=lambda fraction, stage: not (stage == "slice" and fraction > 0.7),
        )  # fmt: skip
    assert {path.name: path.read_bytes() for path in target.iterdir()} == before
    assert [path.name for path in tmp_path.iterdir()] == ["layers"]
