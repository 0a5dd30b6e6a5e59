# SPDX-License-Identifier: LGPL-2.1-or-later
"""Beams: divided as said, and solved by CalculiX against closed forms."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from bench.static_step import StaticStep
from volfrep import LatticeSpec
from volfrep.fem.beam_mesh import JOINT_LENGTH, beam_model, fitted_beams
from volfrep.fem.calculix import solve
from volfrep.fem.deck import sides, write_beams
from volfrep.grid.strut_graph import Wireframe
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.mechanics.materials import Material
from volfrep.util.errors import VolfrepError

needs_calculix = pytest.mark.skipif(
    shutil.which("ccx") is None, reason="CalculiX (ccx) is not installed"
)
STEEL = Material("STEEL", 210_000.0, 0.3, 7.85)


def one_strut(length=50.0, radii=(1.0, 1.0), along=(1.0, 0.0, 0.0)):
    along = np.array(along) / np.linalg.norm(along)
    return Wireframe(
        np.array([np.zeros(3), length * along]),
        np.array([[0, 1]], np.int32),
        np.array([radii], float),
        np.array(radii, float),
    )


def lattice(cell="CVC", count=(3, 2, 1), size=20.0, radius=2.0):
    spec = LatticeSpec(cell=cell, cell_size=size, strut_radius=radius, resolution=10)
    return block(spec, count).wireframe


def test_the_elements_cover_every_strut_once():
    frame = lattice()
    model = beam_model(frame)
    assert np.array_equal(model.nodes[: model.joints], frame.nodes)
    ends = model.nodes[model.elements]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    full = np.linalg.norm(np.diff(frame.nodes[frame.struts], axis=1)[:, 0], axis=1)
    assert np.bincount(model.strut, length) == pytest.approx(full)
    stiff = np.bincount(model.strut, length * model.is_joint)
    assert stiff == pytest.approx(np.full(len(full), 2 * JOINT_LENGTH * 2.0))
    # One chain a strut: every inner node has two elements, every joint as many as struts.
    uses = np.bincount(model.elements.ravel(), minlength=len(model.nodes))
    assert (uses[model.joints :] == 2).all()
    assert np.array_equal(uses[: model.joints], np.bincount(frame.struts.ravel()))
    assert (np.bincount(model.strut) == 10).all()
    assert model.radii.tolist() == [2.0]


def test_no_stiff_end_at_a_wall_and_short_struts_have_few_elements():
    model = beam_model(one_strut(50.0), np.array([True, False]))
    assert model.is_joint.tolist() == [False] * 8 + [True]
    stub = beam_model(one_strut(1.0))
    ends = np.linalg.norm(np.diff(stub.nodes[stub.elements], axis=1)[:, 0], axis=1)
    assert ends == pytest.approx([0.45, 0.1, 0.45])


def test_a_cone_has_steps_within_the_tolerance():
    model = beam_model(one_strut(50.0, (1.0, 2.0)), joint_length=0.0, elements_per_strut=50)
    place = model.nodes[model.elements].mean(axis=1)[:, 0] / 50.0
    wanted = 1.0 + place
    assert np.abs(model.radii[model.section] / wanted - 1).max() < 0.0101
    assert len(model.radii) < 50
    finer = beam_model(
        one_strut(50.0, (1.0, 2.0)), joint_length=0.0, elements_per_strut=50, radius_tolerance=1e-4
    )
    assert len(finer.radii) == 50


def test_arguments_that_make_no_sense():
    frame = one_strut()
    nothing = Wireframe(
        frame.nodes, np.zeros((0, 2), np.int32), np.zeros((0, 2)), frame.joint_radii
    )
    with pytest.raises(VolfrepError, match="no struts"):
        beam_model(nothing)
    with pytest.raises(VolfrepError, match="0 to 2 radii"):
        beam_model(frame, joint_length=-1)
    with pytest.raises(VolfrepError, match="at least one element"):
        beam_model(frame, elements_per_strut=0)
    with pytest.raises(VolfrepError, match="tolerance of the radius"):
        beam_model(frame, radius_tolerance=0)
    with pytest.raises(VolfrepError, match="Poisson's ratio"):
        Material("RUBBER", 1.0, 0.5, 1.0)


@needs_calculix
@pytest.mark.parametrize("along", [(1, 0, 0), (0, 0, 1), (1, 1, 1), (1, -2, 0.5)])
def test_a_cantilever(tmp_path: Path, along):
    model = beam_model(one_strut(50.0, (1.0, 1.0), along), joint_length=0.0, elements_per_strut=20)
    axis = np.array(along) / np.linalg.norm(along)
    across = np.cross(axis, [0.3, 0.5, -0.8])
    across /= np.linalg.norm(across)
    area, inertia, shear = np.pi, np.pi / 4, 210_000 / 2.6
    tip = np.array([1])
    expected = {
        "pull": (axis, 100 * 50 / 210_000 / area),
        "bend": (across, 50**3 / 3 / 210_000 / inertia + 50 / 0.9 / shear / area),
    }
    for case, (way, displacement) in expected.items():
        force = way * (100 if case == "pull" else 1)
        write_beams(model, tmp_path / "beam.inp", STEEL)
        step = StaticStep(np.array([0]), tip, tuple(force))
        step.add_to(tmp_path / "beam.inp", of_beams=True)
        moved = solve(tmp_path / "beam.inp")[1] @ way
        # The square section has 2 % less area than the circle.
        assert moved == pytest.approx(displacement, rel=0.03)


@needs_calculix
def test_a_stiff_end_does_not_bend(tmp_path: Path):
    """A cantilever with a stiff root is one that begins at the root's end."""
    model = beam_model(one_strut(50.0, (2.0, 2.0)), np.array([False, True]), joint_length=2.0)
    write_beams(model, tmp_path / "b.inp", STEEL)
    step = StaticStep(np.array([0]), np.array([1]), (0, 0, 1.0))
    step.add_to(tmp_path / "b.inp", of_beams=True)
    free, inertia, area = 46.0, np.pi * 4, np.pi * 4
    expected = free**3 / 3 / 210_000 / inertia + free / 0.9 / (210_000 / 2.6) / area
    assert solve(tmp_path / "b.inp")[1, 2] == pytest.approx(expected, rel=0.03)


@needs_calculix
def test_a_slender_cubic_lattice_is_as_stiff_as_theory(tmp_path: Path):
    """Pulled along its struts, a block of n x n cells is (n + 1) squared struts side by side."""
    frame = lattice("Box", (2, 2, 3), 20.0, 0.5)
    side = sides(frame.nodes)
    write_beams(beam_model(frame, joint_length=0.0), tmp_path / "box.inp", STEEL)
    step = StaticStep(side["ZMIN"], side["ZMAX"], (0, 0, 900.0))
    step.add_to(tmp_path / "box.inp", of_beams=True)
    moved = solve(tmp_path / "box.inp")[side["ZMAX"], 2].mean()
    assert moved == pytest.approx(100 * 60 / 210_000 / (np.pi * 0.25), rel=0.03)


@pytest.mark.slow
@needs_calculix
def test_a_slender_octet_is_as_stiff_as_theory(tmp_path: Path):
    """Stretched along x between smooth walls: C11 = rho (1/6 + lambda / 2), with rigid joints.

    Smooth walls are mirrors: nodes on each side of one cell move along the wall only. A strut in
    a wall is shared with the mirror image and has half its section there.
    """
    size, radius = 20.0, 0.4
    frame = lattice("Octet", (1, 1, 1), size, radius)
    middle = frame.nodes[frame.struts].mean(axis=1)
    on_side = ((middle < 1e-6) | (middle > size - 1e-6)).any(axis=1)
    # Half the area is what counts where struts carry tension: 1 / sqrt 2 of the radius.
    thin = np.where(on_side[:, None], frame.radii / np.sqrt(2), frame.radii)
    model = beam_model(
        Wireframe(frame.nodes, frame.struts, thin, frame.joint_radii), joint_length=0.0
    )
    path = tmp_path / "octet.inp"
    write_beams(model, path, STEEL)
    walls = "".join(
        f"{name},{axis},{axis}{',0.01' if name == 'XMAX' else ''}\n"
        + "".join(f"{name},{turn},{turn}\n" for turn in (4, 5, 6) if turn != axis + 3)
        for axis, letter in enumerate("XYZ", 1)
        for name in (f"{letter}MIN", f"{letter}MAX")
    )
    step = f"*STEP\n*STATIC\n*BOUNDARY\n{walls}*NODE PRINT,NSET=NALL\nU\n"
    path.write_text(path.read_text() + step + "*NODE PRINT,NSET=XMAX,TOTALS=ONLY\nRF\n*END STEP\n")
    force = total_force(path)
    strain = 0.01 / size
    slender = (radius / (size / np.sqrt(2))) ** 2
    rho = 6 * np.sqrt(2) * np.pi * slender
    expected = 210_000 * rho * (1 / 6 + slender / 2) * strain * size**2
    assert force == pytest.approx(expected, rel=0.03)


def total_force(path: Path) -> float:
    """The sum of the reactions along x that CalculiX prints."""
    import subprocess

    subprocess.run(["ccx", "-i", path.stem], cwd=path.parent, capture_output=True, check=True)
    lines = path.with_suffix(".dat").read_text().splitlines()
    start = next(k for k, line in enumerate(lines) if "total force" in line)
    values = next(line.split() for line in lines[start + 1 :] if line.strip())
    return float(values[0])


@pytest.mark.parametrize(("radius", "told"), [(1.5, False), (1.6, True)])
def test_struts_beyond_what_was_measured_are_told_with_the_range(radius, told):
    spec = LatticeSpec("Octet", cell_size=10, strut_radius=radius)
    frame = block_wireframe(spec, (1, 1, 1))
    sentences = fitted_beams(frame, None, spec.unit_cell(), 10.0)[1]
    assert [("up to 0.15" in sentence) for sentence in sentences] == [True] * told
