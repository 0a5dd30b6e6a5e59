# SPDX-License-Identifier: LGPL-2.1-or-later
"""Random solids and options through the whole engine, judged without it.

    .venv/bin/python tools/fuzz.py --minutes 10             # new seeds
    .venv/bin/python tools/fuzz.py --seed 7 --job 12        # one job again, with what it was

A job is a solid (boxes, balls, rods, plates, wedges, united, cut and hollowed, one body or several,
1 mm to 2 m, near the origin or far) and a specification. What comes out is a refusal in one
sentence, or a file that is held to be what was asked for:

- points on random lines lie inside the file's triangles if and only if they lie in the skin, or in
  a strut or joint inside it, by distances that are computed here;
- read back, the file is closed and has the bodies, voids and volume of the report;
- no two of its triangles run through each other by more than 16 steps of single precision; pairs
  that do by less are counted.

Each job is a process of its own with a bound on its time and memory. Exit code 1 after a fault.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import math
import os
import resource
import sys
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np

from volfrep import LatticeSpec, VolfrepError
from volfrep.design.cells import LIBRARY, UnitCell
from volfrep.design.forecast import forecast_fill
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.openings import DrainHoles
from volfrep.design.profile import Profile
from volfrep.io.solid import check_solid, read_triangles
from volfrep.io.write.stl import as_read
from volfrep.jobs.infill import Infill
from volfrep.mesh.booleans import from_library
from volfrep.mesh.float32_repair import shortest_edge
from volfrep.mesh.quality import measure
from volfrep.mesh.triangle_mesh import TriangleMesh
from volfrep.output.meshes import write_mesh
from volfrep.spatial.piercing import piercing_pairs
from volfrep.spatial.self_intersection import crossing_triangles

SUFFIXES = (".stl", ".3mf", ".ply", ".obj", ".off")
SECONDS = 240
BYTES = 8e9
#: Lines through the result, and points on each.
LINES, ON_LINE = 24, 24
#: A typical job has no more expected triangles, and no more squares of the skin's thickness on its
#: surface, so that it takes about a second; this share of the jobs has no such bounds.
EXPECTED_TRIANGLES, EXPECTED_SQUARES, LARGE = 40_000, 4_000.0, 0.05
#: Points nearer than this to a surface are not judged: to a strut's, in radii; to a wall, in
#: thicknesses of the skin; and so much of the judged ones may be wrong.
NEAR_STRUT, NEAR_WALL, WRONG = 0.25, 0.1, 0.01
#: Triangles up to which crossings are looked for.
MOST_TRIANGLES = 400_000
#: After so many jobs, a line on the standard error says how far it is.
PROGRESS = 100


def random_solid(rng: np.random.Generator) -> tuple[TriangleMesh, list[str]]:
    """A solid within a box of 1, then scaled, turned and moved."""
    kinds = []

    def piece() -> manifold3d.Manifold:
        kind = str(rng.choice(["box", "ball", "rod", "plate", "wedge", "tube"]))
        kinds.append(kind)
        made: manifold3d.Manifold
        if kind == "box":
            made = manifold3d.Manifold.cube(tuple(rng.uniform(0.2, 1.0, 3)), True)
        elif kind == "ball":
            made = manifold3d.Manifold.sphere(rng.uniform(0.15, 0.5), int(rng.integers(6, 48)))
        elif kind == "rod":
            made = manifold3d.Manifold.cylinder(
                1.0, rng.uniform(0.05, 0.3), -1.0, int(rng.integers(3, 40)), True
            )
        elif kind == "plate":
            made = manifold3d.Manifold.cube(
                (1.0, rng.uniform(0.4, 1), rng.uniform(0.05, 0.2)), True
            )
        elif kind == "wedge":
            made = manifold3d.Manifold.cylinder(
                rng.uniform(0.2, 1.0), 0.5, rng.uniform(0.0, 0.05), int(rng.integers(3, 30)), True
            )
        else:
            out = rng.uniform(0.25, 0.5)
            made = manifold3d.Manifold.cylinder(0.8, out, -1.0, 32, True)
            made -= manifold3d.Manifold.cylinder(1.0, out * rng.uniform(0.3, 0.8), -1.0, 32, True)
        if rng.random() < 0.5:
            made = made.rotate(tuple(rng.uniform(0, 360, 3)))
        return made

    solid = piece()
    for _ in range(int(rng.integers(0, 4))):
        what = rng.random()
        other = piece().translate(tuple(rng.uniform(-0.4, 0.4, 3)))
        if what < 0.45:
            solid += other
            kinds.append("united")
        elif what < 0.8 and (solid - other).volume() > 0.2 * solid.volume():
            solid -= other
            kinds.append("cut")
        elif what < 0.9:
            solid -= other.scale((0.3, 0.3, 0.3))
            kinds.append("hollowed")
        else:
            solid += other.translate((1.6, 0.0, 0.0))
            kinds.append("apart")
    size = 10.0 ** rng.uniform(0.0, 3.3)
    shift = np.zeros(3)
    if rng.random() < 0.3:
        shift = rng.uniform(-1, 1, 3) * size * 10.0 ** rng.uniform(0, 3)
        kinds.append("far")
    raw = solid.to_mesh64()
    vertices = np.asarray(raw.vert_properties, float)[:, :3] * size + shift
    vertices = vertices.astype(np.float32).astype(float)
    return TriangleMesh(vertices, np.asarray(raw.tri_verts, np.int32)), kinds


def random_cell(rng: np.random.Generator) -> str | UnitCell:
    """One of the library, or a few struts through the cell's corners and middle."""
    if rng.random() < 0.8:
        return str(rng.choice(list(LIBRARY)))
    corners = np.array(np.meshgrid([0, 1], [0, 1], [0, 1])).reshape(3, -1).T.astype(float)
    inner = rng.uniform(0.25, 0.75, (int(rng.integers(1, 4)), 3)).round(3)
    nodes = np.concatenate([corners, inner])
    struts = {(int(rng.integers(8)), 8 + k) for k in range(len(inner)) for _ in range(3)}
    struts |= {(0, 1), (0, 2), (0, 4)}
    used, rows = np.unique(sorted(struts), return_inverse=True)
    return UnitCell("Random", nodes[used], rows.reshape(-1, 2))


def random_spec(rng: np.random.Generator, solid: TriangleMesh) -> LatticeSpec:
    """What to fill it with; sizes that suit it more or less."""
    size = float(np.ptp(solid.bounds, axis=0).max())
    large = rng.random() < LARGE
    length = size / rng.uniform(1.5, 8.0 if large else 5.0)
    radius = length * rng.uniform(0.04, 0.2)
    shell = size * 10.0 ** rng.uniform(-2.0, -0.9)
    if not large:
        shell = max(shell, math.sqrt(solid.area / EXPECTED_SQUARES))
    made: dict[str, Any] = {
        "cell": random_cell(rng), "cell_size": length, "strut_radius": radius,
        "shell": 0.0 if rng.random() < 0.3 else shell,
        "activation": str(rng.choice(["touching"] * 8 + ["centre", "inside"])),
        "boundary": str(rng.choice(["trim", "trim", "whole"])),
        "output": str(rng.choice(["part", "part", "part", "lattice", "domain"])),
        "remove_dangling": bool(rng.random() < 0.2), "keep_pieces": bool(rng.random() < 0.15),
        "keep_radius": bool(rng.random() < 0.85),
    }  # fmt: skip
    if rng.random() < 0.1:
        made["shortest_stub"] = radius * rng.uniform(0.5, 4.0)
    if rng.random() < 0.5:
        made["resolution"] = int(rng.integers(4, 20))
    elif rng.random() < 0.3:
        made["deviation"] = radius * rng.uniform(0.02, 0.2)
    if rng.random() < 0.15:
        made["fillet"] = radius * rng.uniform(0.1, 1.0)
    if rng.random() < 0.3:
        made["origin"] = tuple((solid.bounds[0] + rng.uniform(-1, 1, 3) * length).tolist())
    if rng.random() < 0.15:
        profile = Profile("linear", 1.0, rng.uniform(0.6, 2.0))
        made["size_grading"] = SizeGrading(profile, tuple(rng.normal(size=3).tolist()))
    if rng.random() < 0.2:
        by = str(rng.choice(["direction", "skin", "core"]))
        ends = Profile("linear", radius, radius * rng.uniform(0.5, 1.5))
        made["radius_grading"] = RadiusGrading(by, ends, reach=size / 5)
    if rng.random() < 0.1:
        made["cell_map"] = CellMap(str(rng.choice(["cylindrical", "spherical"])))
    if rng.random() < 0.2:
        axis = tuple(rng.normal(size=3).tolist())
        made["orientation"] = Orientation(axis, float(rng.uniform(0, 90)))
    if made["shell"] and made["output"] == "part" and rng.random() < 0.1:
        made["drains"] = DrainHoles(made["shell"] * rng.uniform(0.5, 2.0), count=1)
    spec = LatticeSpec(**made)
    if large:
        return spec
    excess = forecast_fill(solid, spec).triangles / EXPECTED_TRIANGLES
    if excess <= 1.0:
        return spec
    # Fewer cells of the same shape; where facets have a size of their own, that grows as well.
    grown = math.sqrt(excess) if "deviation" in made else np.cbrt(excess)
    return dataclasses.replace(spec, **{
        name: made[name] * grown
        for name in ("cell_size", "strut_radius", "deviation", "fillet", "shortest_stub")
        if name in made
    })  # fmt: skip


# --- judged by distances of our own ---------------------------------------------------------------


def to_triangles(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(n,) distances of points from (m, 3, 3) triangles: to their planes inside, else to edges."""
    best = np.full(len(points), np.inf)
    a, b, c = corners.swapaxes(0, 1)
    normal = np.cross(b - a, c - a)
    area = np.linalg.norm(normal, axis=1)
    some = area > 0
    a, b, c, normal = a[some], b[some], c[some], (normal / np.maximum(area, 1e-300)[:, None])[some]
    for begin in range(0, len(points), 200):
        p = points[begin : begin + 200, None]
        off = np.abs(np.einsum("nmi,mi->nm", p - a, normal))
        inside = np.ones(off.shape, bool)
        edge = np.full(off.shape, np.inf)
        for s, e in ((a, b), (b, c), (c, a)):
            way, from_start = e - s, p - s
            inside &= np.einsum("nmi,mi->nm", np.cross(way, from_start), normal) >= 0
            share = np.einsum("nmi,mi->nm", from_start, way) / (way * way).sum(axis=1)
            foot = from_start - np.clip(share, 0, 1)[:, :, None] * way
            edge = np.minimum(edge, np.sqrt((foot * foot).sum(axis=2)))
        best[begin : begin + 200] = np.where(inside, off, edge).min(axis=1)
    return best


def to_struts(points: np.ndarray, frame: Any) -> tuple[np.ndarray, np.ndarray]:
    """(n,) distances from cones and balls, negative inside, and the radius of the nearest."""
    start, end = frame.nodes[frame.struts].swapaxes(0, 1)
    way, low, high = end - start, frame.radii[:, 0], frame.radii[:, 1]
    length = np.linalg.norm(way, axis=1)
    best, radius = np.full(len(points), np.inf), np.full(len(points), np.inf)
    for begin in range(0, len(points), 100):
        p = points[begin : begin + 100, None]
        share = np.einsum("nmi,mi->nm", p - start, way) / (length * length)
        off = np.linalg.norm(p - start - share[:, :, None] * way, axis=2)
        share = np.clip(share + off / length * (high - low) / length, 0, 1)  # across the cone
        at = low + share * (high - low)
        gap = np.linalg.norm(p - start - share[:, :, None] * way, axis=2) - at
        ball = np.linalg.norm(p - frame.nodes, axis=2) - frame.joint_radii
        best[begin : begin + 100] = np.minimum(gap.min(axis=1), ball.min(axis=1))
        nearest = gap.argmin(axis=1)
        radius[begin : begin + 100] = at[np.arange(len(nearest)), nearest]
    return best, radius


def endless(spec: LatticeSpec, solid: TriangleMesh) -> Any:
    """Struts and joints of equal cells over the solid's box, laid here, from the cell alone."""
    cell, length = spec.unit_cell(), spec.cell_size
    corner = solid.bounds[0] if spec.origin is None else np.array(spec.origin)
    low = np.floor((solid.bounds[0] - corner) / length) - 1
    count = (np.ceil((solid.bounds[1] - corner) / length) + 1 - low).astype(int)
    places = np.stack(np.meshgrid(*map(np.arange, count), indexing="ij"), axis=-1).reshape(-1, 3)
    nodes = (places[:, None] + low + cell.nodes).reshape(-1, 3) * length + corner
    struts = (np.arange(len(places))[:, None, None] * len(cell.nodes) + cell.struts).reshape(-1, 2)
    radius = spec.strut_radius
    joint = radius * (1.0 + radius / length)
    return argparse.Namespace(
        nodes=nodes, struts=struts, radii=np.full((len(struts), 2), radius),
        joint_radii=np.full(len(nodes), joint),
    )  # fmt: skip


def inside_by_lines(mesh: TriangleMesh, start: np.ndarray, share: np.ndarray, axis: int) -> Any:
    """(lines, points) whether points on lines along an axis lie inside: by what they cross."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    corners = mesh.vertices[mesh.triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    result = np.zeros(share.shape, bool)
    for line, point in enumerate(start):
        near = np.flatnonzero(
            (low[:, u] <= point[u]) & (point[u] <= high[:, u])
            & (low[:, v] <= point[v]) & (point[v] <= high[:, v])
        )  # fmt: skip
        a, b, c = corners[near].swapaxes(0, 1)

        def side(p: np.ndarray, q: np.ndarray, at: np.ndarray = point) -> np.ndarray:
            return (q[:, u] - p[:, u]) * (at[v] - p[:, v]) - (q[:, v] - p[:, v]) * (at[u] - p[:, u])

        x, y, z = side(b, c), side(c, a), side(a, b)
        hit = ((x > 0) & (y > 0) & (z > 0)) | ((x < 0) & (y < 0) & (z < 0))
        total = (x + y + z)[hit]
        height = (x[hit] * a[hit, axis] + y[hit] * b[hit, axis] + z[hit] * c[hit, axis]) / total
        above = height[None] > share[line][:, None]
        result[line] = (np.where(above, -np.sign(total), 0.0).sum(axis=1) * -1.0) != 0
    return result


def wrong_points(
    rng: np.random.Generator, solid: TriangleMesh, infill: Infill, mesh: TriangleMesh
) -> tuple[int, int]:
    """How many points on random lines are judged, and how many of them are wrong in the mesh."""
    spec = infill.spec
    low, high = solid.bounds
    room = 0.02 * (high - low)
    judged = wrong = 0
    plain = not spec.is_graded and spec.activation == "touching" and spec.boundary == "trim"
    plain &= not (spec.remove_dangling or spec.shortest_stub)
    frame = endless(spec, solid) if plain else infill.struts
    for axis in range(3):
        start = rng.uniform(low - room, high + room, (LINES // 3, 3))
        share = rng.uniform(low[axis] - room[axis], high[axis] + room[axis], (len(start), ON_LINE))
        points = np.repeat(start, ON_LINE, axis=0)
        points[:, axis] = share.ravel()
        found = inside_by_lines(mesh, start, share, axis).ravel()
        in_solid = inside_by_lines(solid, start, share, axis).ravel()
        depth = to_triangles(points, solid.vertices[solid.triangles])
        gap, radius = to_struts(points, frame)
        near_wall = NEAR_WALL * spec.shell + 1e-3 * spec.cell_size
        clear = depth > near_wall
        in_strut = gap < 0
        known = (np.abs(gap) > NEAR_STRUT * radius) & ~((gap > 0) & (gap < 1.5 * spec.fillet))
        if spec.output == "domain" or (not spec.with_skin and spec.shell):
            within = in_solid & (depth > spec.shell)
        else:
            within = in_solid
        at_skin = np.abs(depth - spec.shell) < near_wall if spec.shell else ~clear
        whole = spec.boundary == "whole" and not spec.with_skin
        if spec.output == "domain":
            expected, known = within, ~at_skin
        elif spec.with_skin:
            skin = in_solid & (depth < spec.shell)
            expected = skin | (within & in_strut)
            known = (known | skin | ~in_solid) & ~(at_skin & ~in_strut)
        elif whole:
            expected = in_strut
        else:
            expected, known = within & in_strut, (known | ~within) & ~at_skin
        known &= clear | whole
        judged += int(known.sum())
        wrong += int((known & (expected != found)).sum())
    return judged, wrong


def run_job(seed: int, number: int) -> dict[str, Any]:
    """One job; its fault, if it has one."""
    rng = np.random.default_rng([seed, number])
    told: dict[str, Any] = {"job": number}
    try:
        raw, kinds = random_solid(rng)
        told["solid"] = kinds
        solid = check_solid(raw, "fuzz")
        spec = random_spec(rng, solid)
        told["spec"] = spec.as_dict()
        infill = Infill(solid, spec)
        result = infill.result
    except VolfrepError as error:
        sentence = str(error)
        bad = len(sentence) > 500 or "\n" in sentence or "defect" in sentence
        return told | {"refused": sentence, "fault": "a strange refusal" if bad else ""}
    report, faults = result.report, []
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"part{rng.choice(SUFFIXES)}"
        write_mesh(result.mesh, path, figures=report.figures)
        mesh = as_read(read_triangles(path))
        told["file"] = path.suffix
    read = measure(mesh)
    faults += [
        f"{name}: {getattr(report, name)} told, {getattr(read, name)} read"
        for name in ("watertight", "bodies", "voids", "triangles")
        if getattr(read, name) != getattr(report, name)
    ]
    if not math.isclose(read.volume, report.volume_mm3, rel_tol=1e-3) or read.volume <= 0:
        faults.append(f"volume: {report.volume_mm3:.6g} told, {read.volume:.6g} read")
    through = any("through" in sentence for sentence in report.warnings)
    if len(mesh.triangles) < MOST_TRIANGLES and not through:
        told["shallow"] = len(piercing_pairs(mesh))
        every = np.ones(len(mesh.triangles), bool)
        crossing = int(crossing_triangles(mesh, every, shortest_edge(mesh)).sum())
        if crossing:
            faults.append(f"{crossing} triangles cross others")
    lost = report.pieces_removed or report.struts_dangling_removed or report.stubs_removed
    deformed = spec.is_graded and not spec.keep_radius
    if spec.drains is None and not deformed and not through:
        judged, wrong = wrong_points(rng, solid, infill, mesh)
        told |= {"judged": judged, "wrong": wrong}
        if wrong > WRONG * max(judged, 1) + 3 and not lost:
            faults.append(f"{wrong} of {judged} points are on the wrong side")
    return told | {"fault": "; ".join(faults)}


def in_a_process(seed: int, number: int) -> dict[str, Any]:
    """A job in a process of its own, with bounds on its time and memory."""
    read, write = os.pipe()
    child = os.fork()
    if not child:
        os.close(read)
        resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS + 5))
        resource.setrlimit(resource.RLIMIT_AS, (int(BYTES), int(BYTES)))
        try:
            told = run_job(seed, number)
        except BaseException as error:
            told = {"job": number, "fault": f"{type(error).__name__}: {error}"}
            told["traceback"] = traceback.format_exc()
        with os.fdopen(write, "w", encoding="utf-8") as file:
            json.dump(told, file, default=str)
        os._exit(0)
    os.close(write)
    with os.fdopen(read, encoding="utf-8") as file:
        text = file.read()
    _, status = os.waitpid(child, 0)
    if text:
        return dict(json.loads(text))
    return {"job": number, "fault": f"the process ended with signal {status & 127}"}


def _import_all() -> None:
    """Import what jobs use, once and not in each one's process."""
    cube = from_library(manifold3d.Manifold.cube((1.0, 1.0, 1.0)).to_mesh64())
    with tempfile.TemporaryDirectory() as folder:
        for suffix in SUFFIXES:
            write_mesh(cube, Path(folder) / f"cube{suffix}")
            read_triangles(Path(folder) / f"cube{suffix}")


def main() -> int:
    """Run jobs for so many minutes; tell faults as they come, counts on the way and at the end."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=5.0)
    parser.add_argument("--seed", type=int, default=None, help="default: of the clock")
    parser.add_argument("--job", type=int, default=None, help="run this one only, and print it")
    parser.add_argument("--first", type=int, default=0, help="number of the first job")
    options = parser.parse_args()
    seed = int(time.time()) % 100_000 if options.seed is None else options.seed
    if options.job is not None:
        print(json.dumps(run_job(seed, options.job), indent=1, default=str))
        return 0
    print(f"seed {seed}", flush=True)
    _import_all()
    end = time.monotonic() + 60.0 * options.minutes
    number, made, refused, faults, judged, shallow = options.first, 0, 0, 0, 0, 0
    while time.monotonic() < end:
        told = in_a_process(seed, number)
        refused += "refused" in told
        made += "refused" not in told
        judged += told.get("judged", 0)
        shallow += bool(told.get("shallow"))
        if told.get("fault"):
            faults += 1
            print(json.dumps(told, default=str), flush=True)
        number += 1
        if (number - options.first) % PROGRESS == 0:
            counts = f"{made} made, {refused} refused, {faults} faults"
            print(f"seed {seed}: to job {number - 1}, {counts}", file=sys.stderr, flush=True)
    print(
        f"seed {seed}: jobs {options.first} to {number - 1}, {made} made, {refused} refused, "
        f"{judged:,} points judged, {shallow} with triangles that cross within rounding, "
        f"{faults} faults",
        flush=True,
    )
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
