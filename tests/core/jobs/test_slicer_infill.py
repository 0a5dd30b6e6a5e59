# SPDX-License-Identifier: LGPL-2.1-or-later
"""A field of densities as bands of a slicer's infill: nested, closed, of the field's filament."""

import itertools
import xml.etree.ElementTree as ET
import zipfile
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import trimesh
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

import samples
from bench import parts
from command import run
from slicers import WIDTH, prusa_info, prusa_project_volume, prusa_slicer
from volfrep import LatticeSpec, VolfrepError, slicer_infill
from volfrep.design.cells import find_cell
from volfrep.io.write.stl import write_stl
from volfrep.mesh.booleans import as_manifold
from volfrep.spatial.rays import inside_points
from volfrep.util.progress import Monitor

needs_prusa_slicer = pytest.mark.skipif(not prusa_slicer(), reason="PrusaSlicer is not installed")
BOX = samples.box((60.0, 40.0, 20.0))
BARE = {"walls": 0, "top_layers": 0, "bottom_layers": 0, "line_width": WIDTH}
_CORE = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"


def by_depth(reach: float) -> float:
    """Mean over the box of what falls evenly from 60 at its surface to 10 at a depth, %."""
    depth = np.linspace(0.0, reach, 20001)
    deeper = (60 - 2 * depth) * (40 - 2 * depth) * (20 - 2 * depth)
    share = ((deeper[1:] + deeper[:-1]) / 2).mean() / (60 * 40 * 20)
    return float(60.0 - 50.0 * share)


@pytest.fixture(scope="module")
def graded():
    return slicer_infill(BOX, start=10, end=60, reach=8, **BARE)


def test_the_filament_is_the_integral_of_the_field(graded):
    assert graded.mean_density == pytest.approx(by_depth(8.0), rel=0.01)
    assert graded.filament == pytest.approx(48000 * by_depth(8.0) / 100, rel=0.01)
    assert sum(band.volume for band in graded.bands) == pytest.approx(48000, rel=1e-6)
    assert type(graded.mass) is type(graded.mean_density) is float  # of Python, for whoever prints


def test_bands_are_closed_and_lie_within_the_one_before(graded):
    meshes = [trimesh.Trimesh(b.mesh.vertices, b.mesh.triangles) for b in graded.bands[1:]]
    assert len(meshes) == 4
    assert all(mesh.is_watertight and mesh.is_winding_consistent for mesh in meshes)
    volumes = [mesh.volume for mesh in meshes]
    assert volumes == sorted(volumes, reverse=True)
    for outer, inner in itertools.pairwise(as_manifold(b.mesh) for b in graded.bands[1:]):
        assert (inner - outer).volume() < 0.01 * inner.volume()


def test_walls_and_solid_layers_are_counted():
    plain = slicer_infill(BOX, grading="direction", start=20, end=20, walls=2, line_width=WIDTH,
                          top_layers=5, bottom_layers=3, layer=0.2)  # fmt: skip
    wall = 2 * (WIDTH - 0.2 * (1 - np.pi / 4))
    inner = (60 - 2 * wall) * (40 - 2 * wall) * (20 - 8 * 0.2)
    assert len(plain.bands) == 1
    assert plain.solid_volume == pytest.approx(48000 - inner, rel=0.01)
    assert plain.filament == pytest.approx(48000 - 0.8 * inner, rel=0.01)


@pytest.mark.costly
def test_bands_are_so_few_that_most_are_wide():
    for reach, count in ((4.0, 3), (8.0, 5)):
        made = slicer_infill(BOX, start=10, end=50, reach=reach, line_width=WIDTH)
        assert len(made.bands) == count


@pytest.mark.costly
def test_a_formula_says_the_density_at_every_place():
    made = slicer_infill(BOX, grading="formula", formula="20 + 30 * x / 60", **BARE)
    assert [band.mean for band in made.bands] == pytest.approx([23, 29, 35, 41, 47], abs=0.3)
    assert made.mean_density == pytest.approx(35.0, rel=0.005)
    function = slicer_infill(BOX, field=lambda p: 20 + p[:, 0] / 2, grading="field", **BARE)
    assert function.mean_density == pytest.approx(35.0, rel=0.005)


@pytest.mark.parametrize(
    ("wanted", "said"),
    [
        ({"start": 120}, "from 0 to 95 %"),
        ({"grading": "formula", "formula": "x * 10"}, "from 0 to 95 %"),
        ({"grading": "formula"}, "give both"),
        ({"pattern": "lightning"}, "choose gyroid"),
        ({"bands": 40}, "from 2 to 8"),
        ({"layer": 0.5}, "as high as a line"),
        ({"grading": "field", "field": 5}, "points with values, not 5"),
        ({"wals": 2}, "did you mean 'walls'"),
    ],
)
def test_what_makes_no_sense_is_refused_in_a_sentence(wanted, said):
    with pytest.raises(VolfrepError, match=said):
        slicer_infill(BOX, **wanted)


@pytest.mark.costly
@pytest.mark.slow_but("part0-wanted0")
@needs_prusa_slicer
@pytest.mark.parametrize(
    ("part", "wanted"),
    [
        (BOX, {"grading": "formula", "formula": "20 + 30 * x / 60"}),
        (BOX, {"start": 15, "end": 60, "reach": 8, "pattern": "cubic"}),
        pytest.param(BOX, {"grading": "core", "start": 15, "reach": 9}, marks=pytest.mark.slow),
        (
            samples.sphere(20.0),
            {"start": 15, "end": 50, "reach": 12, "bands": 3, "top_layers": 0, "bottom_layers": 0},
        ),
        # Five bands would be of two lines each, and 5 and 7 % off.
        (BOX, {"start": 10, "end": 50, "reach": 4, "walls": 3}),
        (samples.box((50.0, 8.0, 30.0)), {"start": 10, "end": 50, "reach": 4, "walls": 3}),
        # Solid layers on slopes are widened where they are narrow.
        (samples.sphere(20.0), {"start": 15, "end": 50, "reach": 12, "bands": 3}),
        (parts.at_hand("ge_bracket.stl", "bracket"), {"start": 10, "end": 50, "reach": 6}),
    ],
)
def test_prusa_slicer_lays_the_filament_that_was_told(part, wanted, tmp_path: Path):
    made = slicer_infill(part, **{"line_width": WIDTH, "walls": 2, **wanted})
    path = tmp_path / "part.3mf"
    made.save(path)
    assert float(prusa_info(path)["volume"]) == pytest.approx(made.solid.volume, rel=1e-4)
    assert prusa_project_volume(path) == pytest.approx(made.filament, rel=0.03)


@pytest.mark.costly
@needs_prusa_slicer
def test_a_narrow_room_is_told_less_and_gets_what_is_wanted(tmp_path: Path):
    """Between walls 1.5 mm apart joined ends of lines make up about half of 14 %.

    At one angle a gyroid lays up to a quarter more or less, as its waves happen to meet the walls.
    """
    got, box = [], samples.box((50.0, 4.0, 8.0))
    for angle in np.radians(np.arange(0.0, 90.0, 15.0)):
        across = np.array([-np.sin(angle), np.cos(angle), 0.0])
        frame = np.array([np.cross(across, [0.0, 0.0, 1.0]), across, [0.0, 0.0, 1.0]])
        thin = replace(box, vertices=box.vertices @ frame)
        made, walls = (
            slicer_infill(thin, grading="formula", formula=f"{share} + 0 * x", line_width=WIDTH,
                          walls=3, top_layers=0, bottom_layers=0)
            for share in (14, 0)
        )  # fmt: skip
        assert made.bands[0].density < 0.75 * made.bands[0].mean
        assert "joined ends of lines make up the rest" in made.rows()[0][1]
        made.save(tmp_path / "part.3mf")
        laid = prusa_project_volume(tmp_path / "part.3mf") - walls.filament
        got.append(laid / made.bands[0].volume)
    assert np.mean(got) == pytest.approx(0.14, rel=0.12)


@pytest.mark.costly
@needs_prusa_slicer
def test_prusa_slicer_takes_the_density_of_each_band(tmp_path: Path):
    """Were a modifier overlooked, the part would take what its own density does."""
    dense = slicer_infill(BOX, grading="direction", start=10, end=60, bands=2, **BARE)
    dense.save(tmp_path / "part.3mf")
    laid = prusa_project_volume(tmp_path / "part.3mf")
    assert laid == pytest.approx(0.35 * 48000, rel=0.03)
    assert laid > 1.5 * 48000 * dense.bands[0].mean / 100


def test_orca_finds_an_object_of_components_with_the_settings_of_each(graded, tmp_path: Path):
    path = tmp_path / "part.3mf"
    graded.save(path, "orca")
    with zipfile.ZipFile(path) as package:
        assert package.testzip() is None
        model = ET.fromstring(package.read("3D/3dmodel.model"))
        config = ET.fromstring(package.read("Metadata/model_settings.config"))
    built = model.find(f"{_CORE}build/{_CORE}item").get("objectid")
    objects = {one.get("id"): one for one in model.iter(f"{_CORE}object")}
    components = [c.get("objectid") for c in objects[built].iter(f"{_CORE}component")]
    whole = config.find("object")
    assert whole.get("id") == built
    assert [part.get("id") for part in whole.iter("part")] == components
    kinds = [part.get("subtype") for part in whole.iter("part")]
    assert kinds == ["normal_part"] + ["modifier_part"] * (len(graded.bands) - 1)
    for part, band in zip(list(whole.iter("part"))[1:], graded.bands[1:], strict=True):
        said = {m.get("key"): m.get("value") for m in part.iter("metadata")}
        assert said["sparse_infill_density"] == f"{band.density:.1f}%"
        assert said["sparse_infill_pattern"] == "gyroid"
        mesh = objects[part.get("id")].find(f"{_CORE}mesh")
        assert len(mesh.find(f"{_CORE}triangles")) == len(band.mesh.triangles)
    # Its reader moves the first mesh by the item's transform, and none of the others.
    moved = "1 0 0 0 1 0 0 0 1 {} {} 0"
    assert model.find(f"{_CORE}build/{_CORE}item").get("transform") == moved.format(0, 0)
    places = {c.get("transform") for c in objects[built].iter(f"{_CORE}component")}
    assert places == {moved.format(98, 108)}
    of_object = {m.get("key"): m.get("value") for m in whole.findall("metadata")}
    assert of_object["wall_loops"] == "0"
    loaded = trimesh.load(path)
    assert len(loaded.geometry) == len(graded.bands)
    assert loaded.bounds[0] == pytest.approx([98, 108, 0], abs=3)  # bands reach out of the box


def test_the_command_writes_the_project_and_tells_the_filament(tmp_path: Path, capsys):
    part, out = tmp_path / "part.stl", tmp_path / "part.3mf"
    write_stl(samples.box((30.0, 20.0, 10.0)), part)
    wanted = ("--grading", "direction", "--end", 40, "--bands", 3, "--material", "PLA")
    assert run("infill", part, "-o", out, "--slicer", "orca", *wanted) == 0
    told = capsys.readouterr().out
    assert "band 3" in told
    assert "filament" in told
    assert out.stat().st_size < 100_000
    assert run("infill", part, "-o", tmp_path / "part.stl", *wanted) == 2


def bending_stiffness(part, density_at, step: float, exponent: float) -> float:
    """Force over deflection of a box on two lines at its ends, pressed in the middle; E = 1.

    Eight-noded bricks whose modulus is the mean, over points within, of density^exponent.
    """
    low, high = part.bounds
    count = np.round((high - low) / step).astype(int)
    nodes = np.arange((count + 1).prod()).reshape(count + 1)
    corner = np.stack(np.meshgrid(*map(np.arange, count), indexing="ij"), -1).reshape(-1, 3)
    offsets = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    offsets = np.vstack([offsets, offsets + np.array([0, 0, 1])])
    of_brick = nodes[tuple((corner[:, None] + offsets).transpose(2, 0, 1))]
    modulus = np.zeros(len(corner))
    within = (np.stack(np.meshgrid(*[np.arange(4)] * 3), -1).reshape(-1, 3) + 0.5) / 4
    for place in within:
        points = low + (corner + place) * step
        modulus += (density_at(points) / 100.0) ** exponent / len(within)
    matrix = brick(step)
    dofs = (3 * of_brick[:, :, None] + np.arange(3)).reshape(len(corner), 24)
    rows, columns = np.repeat(dofs, 24, axis=1).ravel(), np.tile(dofs, (1, 24)).ravel()
    values = (modulus[:, None] * matrix.ravel()).ravel()
    stiffness = coo_matrix((values, (rows, columns))).tocsc()
    fixed = [*(3 * nodes[0, :, 0] + 2), *(3 * nodes[-1, :, 0] + 2), 3 * nodes[0, 0, 0],
             *(3 * nodes[[0, -1], 0, 0] + 1)]  # fmt: skip
    pressed = 3 * nodes[count[0] // 2, :, -1] + 2
    load = np.zeros(3 * nodes.size)
    load[pressed] = -1.0 / len(pressed)
    free = np.setdiff1d(np.arange(len(load)), fixed)
    moved = np.zeros(len(load))
    moved[free] = spsolve(stiffness[free][:, free], load[free])
    return float(-1.0 / moved[pressed].mean())


def brick(step: float, poisson: float = 0.35) -> np.ndarray:
    """(24, 24) stiffness of a cube of modulus 1, by 2 x 2 x 2 points."""
    signs = np.array([(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)])
    signs = np.vstack([signs, signs * (1, 1, -1)])
    shear = 1 / (2 * (1 + poisson))
    bulk = poisson / ((1 + poisson) * (1 - 2 * poisson))
    law = np.diag([2 * shear] * 3 + [shear] * 3)
    law[:3, :3] += bulk
    result = np.zeros((24, 24))
    for point in signs / np.sqrt(3):
        shape = 1 + signs * point
        slope = np.stack([signs[:, k] * shape[:, (k + 1) % 3] * shape[:, (k + 2) % 3] / 8
                          for k in range(3)]) * 2 / step  # fmt: skip
        strain = np.zeros((6, 24))
        for k in range(3):
            strain[k, k::3] = slope[k]
            one, other = (k + 1) % 3, (k + 2) % 3
            strain[3 + k, one::3], strain[3 + k, other::3] = slope[other], slope[one]
        result += strain.T @ law @ strain * (step / 2) ** 3
    return result


def test_the_bricks_bend_as_a_beam_does():
    beam = samples.box((96.0, 8.0, 8.0))
    found = bending_stiffness(beam, lambda p: np.full(len(p), 100.0), 2.0, 1.0)
    inertia, shear = 8**4 / 12, 1 / (2 * 1.35)
    bent, sheared = 96**3 / (48 * inertia), 96 / (4 * 5 / 6 * shear * 64)
    assert found == pytest.approx(1 / (bent + sheared), rel=0.08)


@pytest.mark.slow
def test_a_beam_with_bands_is_stiffer_than_one_of_even_infill_of_the_same_filament():
    """Moduli go with the 1.53th power of the density, as measured on grids of PLA."""
    beam = samples.box((96.0, 16.0, 16.0))
    formula = "8 + 80 * abs(z / 8 - 1) ** 3 * (1 - abs(x / 48 - 1) ** 2)"
    common = {"walls": 1, "top_layers": 1, "bottom_layers": 1, "pattern": "grid"}
    made = slicer_infill(beam, grading="formula", formula=formula, **common)
    even = slicer_infill(
        beam, grading="direction", start=made.mean_density, end=made.mean_density, **common
    )
    assert even.filament == pytest.approx(made.filament, rel=0.005)
    wall, layer = made.wanted.wall_thickness, made.wanted.layer

    def printed(infill):
        def density(points):
            result = np.full(len(points), infill.bands[0].mean)
            for band in infill.bands[1:]:
                result[inside_points(band.mesh, points, Monitor())] = band.mean
            from_side = np.minimum(points[:, :2], beam.bounds[1, :2] - points[:, :2]).min(axis=1)
            from_face = np.minimum(points[:, 2], beam.bounds[1, 2] - points[:, 2])
            result[(from_side < wall) | (from_face < layer)] = 100.0
            return result

        return density

    stiff, plain = (bending_stiffness(beam, printed(one), 2.0, 1.53) for one in (made, even))
    assert stiff > 1.3 * plain


def sized_spec(folder: Path) -> Path:
    """A specification as sizing writes it: radii from 0.5 to 1.5 mm along the box."""
    x = np.linspace(0.0, 60.0, 25)
    lines = [f"{at},20,10,{0.5 + at / 60.0}" for at in x]
    (folder / "radii.csv").write_text("\n".join(["x,y,z,radius", *lines]))
    path = folder / "sized.toml"
    path.write_text(
        'cell = "BCC"\ncell_size = 10\nstrut_radius = 1\nradius_grading = "field"\n'
        'radius_field = "radii.csv"\nradius_curve = "0.5:0.5,1.5:1.5"\n'
    )
    return path


@pytest.mark.costly
def test_the_density_that_sizing_wants_is_that_of_its_radii(tmp_path):
    path = sized_spec(tmp_path)
    made = slicer_infill(BOX, sized=path, bands=4, **BARE)
    thinnest, thickest = made.bands[0].mean, made.bands[-1].mean
    # A BCC cell of r = 0.05 L is 6.5 % solid, one of 0.15 L 49 %.
    assert thinnest == pytest.approx(11.0, abs=3.0)
    assert thickest == pytest.approx(43.0, abs=4.0)
    even = slicer_infill(BOX, grading="direction", direction=(1, 0, 0), start=6.5, end=49.0, **BARE)
    assert made.mean_density < even.mean_density, "it grows faster than the radius"
    plain = LatticeSpec(find_cell("BCC"), 10.0, 1.0)
    with pytest.raises(VolfrepError, match="no radii of a sizing"):
        slicer_infill(BOX, sized=plain)


def test_the_command_takes_what_size_has_written(tmp_path, capsys):
    part, target = tmp_path / "part.stl", tmp_path / "part.3mf"
    write_stl(BOX, part)
    wanted = ("--sized", sized_spec(tmp_path), "--bands", 3)
    assert run("infill", part, "-o", target, *wanted) == 0
    assert "band 3" in capsys.readouterr().out
