# SPDX-License-Identifier: LGPL-2.1-or-later
"""`make crush-curves`: the crush curves that the package ships, those that are missing.

Each takes some seconds to a minute; the file is written after every one.
"""

from __future__ import annotations

import json

import numpy as np

from volfrep.jobs.crushing import crush
from volfrep.mechanics.crush_curves import FILE, STRAINS

CELLS = ("Box", "FCC", "BCC", "Octet", "Octahedron", "CVC", "Kelvin")
MATERIALS = ("TPU", "PA12", "Ti-6Al-4V")
DENSITIES = (0.1, 0.2, 0.3)


def main() -> None:
    """Compute what is missing."""
    rows = json.loads(FILE.read_text(encoding="utf-8")) if FILE.is_file() else []
    known = {(row["cell"], row["material"], row["relative_density"]) for row in rows}
    for material in MATERIALS:
        for cell in CELLS:
            for density in DENSITIES:
                if (cell, material, density) in known:
                    continue
                found = crush(cell, 10.0, relative_density=density, material=material)
                inside = STRAINS[found.strain[-1] + 1e-9 >= STRAINS]
                stress = np.interp(inside, found.strain, found.stress)
                rows.append({
                    "cell": cell, "material": material, "relative_density": density,
                    "ratio": round(found.strut_radius / 10.0, 5),
                    "stress": [float(f"{value:.4g}") for value in stress],
                })  # fmt: skip
                print(cell, material, density, *found.notes, sep="; ", flush=True)
                text = ",\n".join(json.dumps(row) for row in rows)
                FILE.write_text(f"[\n{text}\n]\n", encoding="utf-8")


if __name__ == "__main__":
    main()
