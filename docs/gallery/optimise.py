# SPDX-License-Identifier: LGPL-2.1-or-later
"""The strut radius whose part weighs 12 g, by an optimiser of scipy."""

import trimesh
from scipy.optimize import minimize_scalar

import volfrep

box = volfrep.as_solid(trimesh.creation.box((40, 30, 20)))
study = volfrep.Study(parts=(box,), fixed={"cell": "BCC", "shell": 1.0}, do=("forecast",))


def loss(radius: float) -> float:
    """How far a radius is from 12 g."""
    (found,) = volfrep.evaluate(study, [{"strut_radius": radius}], "runs", workers=1)
    return float(abs(found["forecast.mass_g"] - 12.0))


best = minimize_scalar(loss, bounds=(0.4, 1.6), method="bounded", options={"maxiter": 8})
print(f"{best.x:.3f} mm, {best.fun:.2f} g off")
