# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of a sizing: one list, in lines and in tables."""

from typing import Any

import pytest

from volfrep.reports.sizing_results import case_table, result_tables, sizing_results
from volfrep.reports.tables import as_text

LARGEST = {"compliance_nmm": 4.0, "displacement_mm": 0.1, "stress_mpa": 50.0, "buckling": 0.1,
           "frame_buckling_factor": None}  # fmt: skip
CASE = {
    "name": "down", **LARGEST, "worst_strut": {"middle_mm": [1, 2, 3]},
    "before": {**LARGEST, "stress_mpa": 30.0},
}  # fmt: skip
REPORT: dict[str, Any] = {
    "radii_mm": [0.5, 1.0], "struts": 10, "strut_mass_g": 1.0, "strut_volume_mm3": 800.0,
    "skin_mass_g": 0.0, "material": {"name": "PLA"}, "uses": {}, "calculix": None, "cases": [CASE],
    "same_mass": {"radius_mm": 0.7, "stiffer": [2.0], "stiffer_at_least": [1.5], "uses": {}},
}  # fmt: skip


def lines(report: dict[str, Any]) -> dict[str, str]:
    return dict(result.line for result in sizing_results(report))


def test_stress_stands_beside_that_of_one_radius_where_it_is_more() -> None:
    assert lines(REPORT)["down: largest stress"] == "50 MPa; one radius, same mass 30"


def test_a_design_that_no_other_program_has_solved_is_told_as_such() -> None:
    assert lines(REPORT)["CalculiX: confirmed"] == "no; it has not solved this design"


def test_what_calculix_finds_stands_beside_the_design_everywhere() -> None:
    proof = {
        "confirmed": True, "doubts": [], "with_the_skin": False, "displacements_off": [0.02],
        "largest_displacement": [1.02], "largest_stress": 0.9, "worst_strut_compared": True,
        "uses": {"displacement": 0.51},
    }  # fmt: skip
    limits = {"displacement": 0.2, "stress": 100.0}
    report = {**REPORT, "uses": {"displacement": 0.5, "stress": 0.5}, "limits": limits,
              "calculix": proof}  # fmt: skip
    told = lines(report)
    assert told["limit of displacement"] == "50 % of its limit; limit 0.2 mm; CalculiX 51"
    assert told["limit of stress"].endswith("; not compared in CalculiX")
    assert told["down: largest displacement"].endswith("; CalculiX 0.102")
    results = sizing_results(report)
    tables = {table.title: table for table in result_tables(results)}
    assert tables["Limits"].header == ("", "limit", "sized", "CalculiX")
    row = dict(zip(tables["Results of down"].header[1:],
                   tables["Results of down"].rows[1][1:], strict=True))  # fmt: skip
    assert row == {"sized": 0.1, "one radius, same mass": 0.1, "CalculiX": pytest.approx(0.102)}
    (case,) = case_table(results).rows
    assert case == ("down", 0.1, pytest.approx(0.102), 50.0)


def test_columns_of_a_terminal_are_in_line() -> None:
    text = as_text(result_tables(sizing_results(REPORT)))
    (head, *rows) = text[text.index("Results of down") :].splitlines()
    stress = next(row for row in rows if row.startswith("  largest stress, MPa"))
    assert stress.index("50") == head.index("sized")
    assert stress.index("30") == head.index("one radius, same mass")


def test_a_range_stays_in_the_column_of_whose_it_is() -> None:
    (table, *_) = result_tables(sizing_results(REPORT))
    assert table.header == ("", "sized", "one radius, same mass")
    (gain,) = (row for row in table.rows if row[0].startswith("same mass"))
    assert gain[1:3] == ("1.5 to 2", None)
