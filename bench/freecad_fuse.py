# SPDX-License-Identifier: LGPL-2.1-or-later
"""Run by freecadcmd: one Part fuse of a lattice's cylinders and balls, written as fine facets.

The environment variable BENCH_JOB names a JSON file: nodes, struts, radius, joint, deflection,
out, answer. The exact volume and the seconds go into `answer`.
"""

import json
import os
import sys
import time
import traceback

code = 1
try:
    import MeshPart
    import Part
    from FreeCAD import Vector

    with open(os.environ["BENCH_JOB"], encoding="utf-8") as file:
        job = json.load(file)
    start = time.perf_counter()
    nodes = [Vector(*node) for node in job["nodes"]]
    shapes = [Part.makeSphere(job["joint"], node) for node in nodes]
    for a, b in job["struts"]:
        along = nodes[b] - nodes[a]
        shapes.append(Part.makeCylinder(job["radius"], along.Length, nodes[a], along))
    solid = shapes[0].multiFuse(shapes[1:])
    fused = time.perf_counter() - start
    mesh = MeshPart.meshFromShape(
        Shape=solid, LinearDeflection=job["deflection"], AngularDeflection=0.1
    )
    mesh.write(job["out"])
    found = {
        "fuse_seconds": fused,
        "exact_volume": solid.Volume,
        "solids": len(solid.Solids),
        "valid": solid.isValid(),
    }
    with open(job["answer"], "w", encoding="utf-8") as file:
        json.dump(found, file)
    code = 0
except BaseException:
    traceback.print_exc()
finally:
    # freecadcmd runs a script that raises a second time and then exits with 0.
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)
