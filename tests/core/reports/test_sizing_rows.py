# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the figures of a sizing say in words."""

import pytest

from volfrep.reports.sizing_report import sizing_rows

CASE = {
    "name": "down", "displacement_mm": 0.1, "stress_mpa": 50.0, "buckling": 0.1,
    "frame_buckling_factor": None,
    "before": {"displacement_mm": 0.2, "stress_mpa": 30.0},
}  # fmt: skip


@pytest.mark.parametrize(
    ("less", "says"), [(0.6, "largest stress 1.67 times higher"), (2.0, "2.00 times lower")]
)
def test_more_stress_is_called_more(less: float, says: str) -> None:
    report = {
        "radii_mm": [0.5, 1.0], "struts": 10, "strut_mass_g": 1.0, "skin_mass_g": 0.0,
        "material": {"name": "PLA"}, "uses": {}, "calculix": None, "cases": [CASE],
        "same_mass": {"radius_mm": 0.7, "stiffer": [2.0], "stiffer_at_least": [1.5],
                      "less_stress": less},
    }  # fmt: skip
    told = dict(sizing_rows(report))["same mass"]
    assert says in told
    assert "less stress" not in told
