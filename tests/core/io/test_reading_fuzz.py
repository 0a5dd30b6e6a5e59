# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files with something wrong in them, at random: a refusal in a sentence, or a right solid.

A mutation starts from the file of a good solid in one of the formats, and cuts it short, flips
bits, swaps, reverses, repeats or drops pieces. It is read in a process that may take 4 GB and
20 s. What is read must be closed, and must be either the solid before the mutation or what the
mutated triangles enclose by solid angles, which know nothing of edges and repairs.
"""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import zipfile
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
import trimesh

import samples
from volfrep.io.solid import read_solid, read_triangles
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import concatenate
from volfrep.output.meshes import write_mesh
from volfrep.util.errors import VolfrepError
from winding import disagreement

resource = pytest.importorskip("resource", reason="this system has no limits for a process")

MEMORY = 4 << 30
SECONDS = 20
#: Of the box's points, at which the solid and the triangles may disagree: those near a mended
#: place. Of 400 points one is 0.25 %.
DISAGREE = 0.02
POINTS = 400
BATCH = 25


@cache
def solids():
    void = samples.box((10.0, 10.0, 10.0), (5.0, 5.0, 5.0)).reversed()
    return (
        samples.box(),
        samples.plate(16),
        samples.bracket(20.0),
        samples.sphere(20.0, 2),
        samples.ring(),
        concatenate(samples.box(), void),
        concatenate(samples.box(), samples.box((40.0, 30.0, 20.0), (20.0, 5.0, 5.0))),
    )


@cache
def encoded(which, kind):
    """The file of a solid, and its extension."""
    mesh = solids()[which]
    shape = trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)
    if kind in ("3mf", "step"):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / f"x.{kind}"
            write_mesh(mesh, path)
            return path.read_bytes(), path.suffix
    data = {
        "stl": lambda: shape.export(file_type="stl"),
        "ascii": lambda: shape.export(file_type="stl_ascii"),
        "obj": lambda: shape.export(file_type="obj"),
        "ply": lambda: shape.export(file_type="ply"),
        "text": lambda: shape.export(file_type="ply", encoding="ascii"),
    }[kind]()
    suffix = {"stl": ".stl", "ascii": ".stl", "obj": ".obj", "ply": ".ply", "text": ".ply"}[kind]
    return data if isinstance(data, bytes) else data.encode(), suffix


#: From here on seeds mutate STEP files, each of which takes FreeCAD a second.
STEP_SEEDS = 1_000_000
KINDS = ("stl", "stl", "ascii", "obj", "ply", "text", "3mf")


def mutated(seed):
    """A file's bytes, its extension, and which solid it was."""
    rng = np.random.default_rng(seed)
    which = int(rng.integers(len(solids())))
    kind = KINDS[rng.integers(len(KINDS))] if seed < STEP_SEEDS else "step"
    data, suffix = encoded(which, kind)
    if kind == "3mf" and rng.random() < 0.7:  # most of the time what is in the zip
        return _in_zip(data, rng), suffix, which
    return _mutate(data, kind, rng), suffix, which


def _in_zip(data, rng):
    result = BytesIO()
    with zipfile.ZipFile(BytesIO(data)) as old, zipfile.ZipFile(result, "w") as new:
        for name in old.namelist():
            text = old.read(name)
            hit = name.endswith(".model") or rng.random() < 0.1
            new.writestr(name, _mutate(text, "xml", rng) if hit else text)
    return result.getvalue()


def _mutate(data, kind, rng):
    way = rng.integers(8)
    if way == 0:
        return data[: rng.integers(len(data))]
    if way == 1:
        return _flip_bits(data, rng)
    if way == 2:
        start, end = np.sort(rng.integers(len(data), size=2))
        return data[:start] + data[min(end, start + 500) :]
    if way == 3:
        start = rng.integers(len(data))
        return data[:start] + rng.bytes(int(rng.integers(1, 60))) + data[start:]
    return _shuffle_pieces(data, kind, rng, way)


def _flip_bits(data, rng):
    letters = np.frombuffer(data, np.uint8).copy()
    places = rng.integers(len(letters), size=int(rng.integers(1, 12)))
    letters[places] ^= (1 << rng.integers(8, size=len(places))).astype(np.uint8)
    return letters.tobytes()


def _shuffle_pieces(data, kind, rng, way):
    """Facets or lines swapped, reversed, repeated or dropped."""
    if kind == "stl":
        head, pieces = data[:84], [data[k : k + 50] for k in range(84, len(data), 50)]
    elif kind == "ply":
        return _flip_bits(data, rng)
    else:
        cut = {"xml": b"/>", "ascii": b"endfacet"}.get(kind, b"\n")
        head, pieces = b"", [piece + cut for piece in data.split(cut)]
    chosen = rng.integers(len(pieces), size=int(rng.integers(1, 6)))
    if way == 4:
        for k in chosen:
            other = rng.integers(len(pieces))
            pieces[k], pieces[other] = pieces[other], pieces[k]
    elif way == 5:
        for k in chosen:
            pieces.insert(int(rng.integers(len(pieces))), pieces[k])
    elif way == 6:
        pieces = [p for k, p in enumerate(pieces) if k not in chosen]
    else:
        for k in chosen:
            pieces[k] = _reverse(pieces[k], kind)
    if kind == "stl":
        head = head[:80] + np.array(len(pieces), "<u4").tobytes()
    return head + b"".join(pieces)


def _reverse(piece, kind):
    """A facet seen from the other side; any other piece with its words in another order."""
    if kind == "stl" and len(piece) == 50:
        return piece[:12] + piece[24:36] + piece[12:24] + piece[36:]
    words = piece.split(b" ")
    return b" ".join([words[0], *words[:0:-1]])


def verdict(seed, folder):
    """'refused', 'as before', 'as given', or what is wrong."""
    data, suffix, which = mutated(seed)
    path = Path(folder) / f"part{suffix}"
    path.write_bytes(data)
    try:
        solid = read_solid(path)
    except VolfrepError as error:
        text = str(error)
        return "refused" if text.endswith((".", "?")) and path.name in text else f"says '{text}'"
    if not measure(solid).watertight or solid.volume <= 0.0:
        return "not a closed solid"
    before = read_solid_before(which)
    same_box = np.allclose(solid.bounds, before.bounds, rtol=1e-3, atol=0.05)
    if same_box and abs(solid.volume / before.volume - 1.0) < 2e-3:
        return "as before"
    wrong = disagreement(solid, read_triangles(path), POINTS)
    return "as given" if wrong <= DISAGREE else f"differs at {wrong:.1%} of the box: {solid.notes}"


@cache
def read_solid_before(which):
    from volfrep.io.solid import check_solid

    return check_solid(solids()[which], "sample")


def judge(first, count):
    """In a process of its own: a line of JSON for each seed."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(first, first + count):
            print(json.dumps([seed, "started"]), flush=True)
            # Of the processor's time: a busy machine makes no file slower.
            signal.setitimer(signal.ITIMER_PROF, SECONDS)
            try:
                said = verdict(seed, folder)
            except Exception as error:
                said = f"{type(error).__name__}: {error}"
            signal.setitimer(signal.ITIMER_PROF, 0)
            print(json.dumps([seed, said]), flush=True)


def verdicts(first, count):
    """{seed: verdict} of many mutations, in processes with limits."""
    results = {}
    for start in range(first, first + count, BATCH):
        size = min(BATCH, first + count - start)
        done = subprocess.run(
            [sys.executable, __file__, str(start), str(size)],
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "PYTHONPATH": str(Path(__file__).resolve().parents[1])},
        )
        results.update(dict(map(json.loads, done.stdout.splitlines())))
        for seed in range(start, start + size):
            results.setdefault(seed, f"not reached: {done.stderr[-300:]}")
    return results


def check(first, count):
    results = verdicts(first, count)
    good = ("refused", "as before", "as given")
    assert {seed: said for seed, said in results.items() if said not in good} == {}
    counts = {word: sum(said == word for said in results.values()) for word in good}
    # Not everything is refused, and not everything is read.
    assert counts["refused"] > count / 10
    assert counts["as before"] > count / 20


@pytest.mark.slow
def test_fifty_mutated_files_give_a_sentence_or_a_right_solid():
    check(0, 50)


@pytest.mark.slow
def test_two_thousand_mutated_files_give_a_sentence_or_a_right_solid():
    check(100, 2000)


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("freecadcmd") is None, reason="freecadcmd is not on the PATH")
def test_mutated_step_files_are_refused_or_read_rightly():
    check(STEP_SEEDS, 100)


if __name__ == "__main__":
    judge(int(sys.argv[1]), int(sys.argv[2]))
