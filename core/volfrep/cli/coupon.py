# SPDX-License-Identifier: LGPL-2.1-or-later
"""The command ``volfrep coupon``: specimens of a lattice to print and measure.

numpy and the engine are imported inside the functions, as in `command`.
"""

from __future__ import annotations

import argparse

from ..util.progress_bar import drawn
from .files import check_files
from .parameter_options import specified
from .telling import print_rows


def run_coupon(given: argparse.Namespace) -> None:
    """Run ``volfrep coupon``."""
    from ..jobs.coupons import make_coupons
    from ..mechanics.materials import find_material
    from ..output.meshes import write_mesh
    from ..util.files import make_folder, replacing, write_json

    found = specified(given)
    check_files(given, found.files, folder=True)
    density = found.spec.density
    if given.material is not None:
        density = find_material(given.material).density
    kinds = [word.strip() for word in given.kinds.split(",") if word.strip()]
    with drawn(given.quiet) as progress:
        made = make_coupons(
            found.spec, kinds, cells=given.cells, first=given.number, diameters=given.diameters,
            inclinations=given.inclinations, progress=progress,
        )  # fmt: skip
    folder = make_folder(given.output)
    rows = []
    for one in made:
        path = folder / f"{one.number}_{one.kind}.{given.format}"
        write_mesh(one.mesh, path)
        mass = one.mesh.volume * density / 1000.0
        sizes = {name: round(value, 4) for name, value in one.sizes.items()}
        rows.append({"number": one.number, "kind": one.kind, "file": path.name,
                     "volume_mm3": round(one.mesh.volume, 3), "mass_g": round(mass, 4),
                     **sizes})  # fmt: skip
        if not given.quiet:
            lengths = ", ".join(f"{name} {value:g}" for name, value in sizes.items())
            print_rows((f"{one.number} {one.kind}", f"{path}, {mass:.2f} g; mm: {lengths}"))
        if one.struts:
            with replacing(folder / f"{one.number}_{one.kind}.csv") as file:
                file.write(one.table().encode())
    write_json(folder / "coupons.json", {"lattice": found.spec.as_dict(), "coupons": rows})
