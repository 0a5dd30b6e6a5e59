# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small matrices in bulk: numpy's answers, and the same bits whatever the threads."""

import ast
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import volfrep
from volfrep.util import linalg

ENGINE = Path(volfrep.__file__).parent
#: Rooms that no coordinate of a file comes from, and modules that only tell figures.
#: What a solver finds (loads, radii sized to them) is no more exact than its own sums.
FIGURES = ("mechanics", "fem", "reports", "cli", "loads", "sizing", "voxels", "continuum")
FIGURES_OF = (
    "jobs/preview.py",
    "jobs/rough_radius.py",
    "jobs/sizing/notes.py",
    "jobs/sizing/skin_search.py",
    "design/forecast.py",
    "design/kinds/strut_cells.py",
    "grid/congruent_joints.py",
)
LIBRARY = {"dot", "matmul", "tensordot", "inner", "vdot"}
#: What a source has that has any of these.
MAY = re.compile(r"[^@\n]@[ =\n]|linalg|" + "|".join(LIBRARY))


@pytest.fixture(scope="module")
def symmetric():
    random = np.random.default_rng(3)
    normal = random.normal(size=(500, 5, 3)) * 10.0 ** random.uniform(-4, 0, (500, 1, 3))
    flat = np.zeros((2, 3, 3))
    flat[1, 2, 2] = 1.0
    return np.concatenate([np.einsum("nki,nkj->nij", normal, normal), flat, np.eye(3)[None]])


def test_eigenvalues_and_vectors_are_numpys(symmetric):
    values, vectors = linalg.symmetric_eigen(symmetric)
    scale = np.abs(symmetric).max(axis=(1, 2)).clip(1e-300)
    assert (np.abs(values - np.linalg.eigvalsh(symmetric)) <= 1e-14 * scale[:, None]).all()
    again = np.einsum("nik,nk,njk->nij", vectors, values, vectors)
    assert (np.abs(again - symmetric) <= 1e-14 * scale[:, None, None]).all()
    turned = np.einsum("nki,nkj->nij", vectors, vectors)
    assert np.abs(turned - np.eye(3)).max() < 1e-14


def test_solutions_determinants_and_turns_are_numpys(symmetric):
    definite = symmetric + 1e-3 * np.eye(3)
    right = np.random.default_rng(4).normal(size=(len(definite), 3))
    expected = np.linalg.solve(definite, right[:, :, None])[:, :, 0]
    np.testing.assert_allclose(
        linalg.solve_symmetric(definite, right), expected, rtol=1e-10, atol=1e-10
    )
    maps = np.eye(3) + 0.2 * np.random.default_rng(5).normal(size=(200, 3, 3))
    np.testing.assert_allclose(linalg.determinants(maps), np.linalg.det(maps), rtol=1e-12)
    left, _, rest = np.linalg.svd(maps)
    np.testing.assert_allclose(linalg.turns(maps), left @ rest, atol=1e-12)


def test_no_coordinate_comes_from_sums_that_threads_order():
    """The library behind `@` and `numpy.linalg` adds in another order on another number."""
    found = []
    for path in sorted(ENGINE.rglob("*.py")):
        name = path.relative_to(ENGINE).as_posix()
        if name.split("/")[0] in FIGURES or name in FIGURES_OF:
            continue
        text = path.read_text(encoding="utf-8")
        for node in ast.walk(ast.parse(text)) if MAY.search(text) else ():
            product = isinstance(node, ast.BinOp) and isinstance(node.op, ast.MatMult)
            called = isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute)
            solver = called and (
                node.func.attr in LIBRARY
                or (ast.unparse(node.func.value) == "np.linalg" and node.func.attr != "norm")
            )
            if product or solver:
                found.append(f"{name}:{node.lineno}")
    assert not found


@pytest.mark.costly
def test_a_part_has_the_same_bytes_with_one_thread_and_with_two():
    script = (
        "import sys; sys.path.insert(0, sys.argv[1])\n"
        "import hashlib, samples; from volfrep import LatticeSpec; "
        "from volfrep.jobs.pipeline import fill\n"
        "spec = LatticeSpec('BCC', cell_size=10, strut_radius=1, shell=1.5, resolution=8)\n"
        "mesh = fill(samples.bracket(10.0), spec).mesh\n"
        "print(hashlib.sha256(mesh.vertices.tobytes() + mesh.triangles.tobytes()).hexdigest())\n"
    )
    tests = str(Path(__file__).parents[1])
    digests = [
        subprocess.run(
            [sys.executable, "-c", script, tests],
            env={**os.environ, "OMP_NUM_THREADS": count, "OPENBLAS_NUM_THREADS": count},
            capture_output=True, check=True,
        ).stdout
        for count in ("1", "2")
    ]  # fmt: skip
    assert digests[0] == digests[1]
