# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library of unit cells, and cells from a file."""

import json
import os
from pathlib import Path

import numpy as np
import pytest

from volfrep.design.cells import (
    LIBRARY,
    MAX_FILE_BYTES,
    MAX_NODES,
    PAPERS,
    UnitCell,
    find_cell,
    load_cell,
    make_cell,
)
from volfrep.util.errors import VolfrepError

COUNTS = {
    "Box": (8, 12),
    "FCC": (14, 36),
    "BCC": (9, 20),
    "Octet": (14, 36),
    "Octahedron": (6, 12),
    "CVC": (9, 8),
}

#: Total strut length in units of L, by hand.
LENGTHS = {
    "Box": 12.0,
    "FCC": 12 + 24 * 0.5**0.5,
    "BCC": 12 + 8 * 0.75**0.5,
    "Octet": 36 * 0.5**0.5,
    "Octahedron": 12 * 0.5**0.5,
    "CVC": 8 * 0.75**0.5,
}


def test_the_library_holds_the_papers_six() -> None:
    found = {name: (len(LIBRARY[name].nodes), len(LIBRARY[name].struts)) for name in PAPERS}
    assert found == COUNTS


@pytest.mark.parametrize("name", COUNTS)
def test_a_library_cell_is_sound(name: str) -> None:
    cell = LIBRARY[name]
    again = make_cell(name, cell.nodes, cell.struts)  # passes the checks of a custom cell
    np.testing.assert_array_equal(again.nodes, cell.nodes)
    ends = cell.nodes[cell.struts]
    assert np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1).sum() == pytest.approx(LENGTHS[name])
    assert cell.is_mirror_symmetric


@pytest.mark.parametrize(
    ("name", "number"),
    [("Box", -6), ("FCC", 0), ("BCC", -1), ("Octet", 0), ("Octahedron", 0), ("CVC", -13)],
)
def test_maxwell(name: str, number: int) -> None:
    assert LIBRARY[name].maxwell_number == number


def test_cells_are_found_by_name_in_any_case() -> None:
    assert find_cell(" octet ") is LIBRARY["Octet"]
    assert find_cell("rhombic dodecahedron") is LIBRARY["Fluorite"]  # as others call it
    with pytest.raises(VolfrepError, match=r"no unit cell named 'Gyrate': choose one of .*, Box,"):
        find_cell("Gyrate")


def write(path: Path, value: object) -> Path:
    path.write_text(json.dumps(value), encoding="utf-8")
    return path


GOOD = {"name": "Strut", "nodes": [[0, 0, 0], [1, 1, 0.5]], "struts": [[0, 1]]}


def test_a_cell_from_a_file(tmp_path: Path) -> None:
    cell = find_cell(str(write(tmp_path / "cell.json", GOOD)))
    assert (cell.name, cell.nodes.shape, cell.struts.tolist()) == ("Strut", (2, 3), [[0, 1]])
    assert not cell.is_mirror_symmetric
    unnamed = {key: GOOD[key] for key in ("nodes", "struts")}
    assert load_cell(write(tmp_path / "brace.json", unnamed)).name == "brace"


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"name": 3}, "'name' must be a text"),
        ({"name": "  "}, "'name' must be a text"),
        ({"use": "stiffness"}, "'use' must be one of stiff, axial"),
        ({"about": 3}, "'about' must be a text"),
        ({"also": "X"}, "'also' must be a list of names"),
        ({"also": [3]}, "'also' must be a list of names"),
        ({"nodes": []}, "every node must be a list of 3 numbers"),
        ({"nodes": [[0, 0], [1, 1]]}, "every node must be a list of 3 numbers"),
        ({"nodes": [[0, 0, 0], [1, 1]]}, "every node must be a list of 3 numbers"),
        ({"nodes": "abc"}, "every node must be a list of 3 numbers"),
        ({"nodes": None}, "every node must be a list of 3 numbers"),
        ({"nodes": [[0, 0, 0], [1, 1, 1.5]]}, "node 1 lies outside the cell"),
        ({"nodes": [[0, 0, 0], [1, -1, 1]]}, "node 1 lies outside the cell"),
        ({"nodes": [[0, 0, 0], [1, 1, float("nan")]]}, "a node holds a number that is not finite"),
        ({"nodes": [[0, 0, 0], [1, 1, 1], [0, 0, 0]]}, "node 2 repeats node 0"),
        ({"nodes": [[0, 0, 0], [1, 1, 1], [0, 1, 0]]}, "node 2 has no strut"),
        ({"nodes": [[0, 0, k / 1e3] for k in range(MAX_NODES + 1)]}, "the limit is 500"),
        ({"struts": []}, "every strut must be a list of 2 numbers"),
        ({"struts": [[0, 2]]}, "strut 0 must name two nodes by whole numbers from 0 to 1"),
        ({"struts": [[0, -1]]}, "strut 0 must name two nodes"),
        ({"struts": [[0, 0.5]]}, "strut 0 must name two nodes"),
        ({"struts": [[0, float("inf")]]}, "a strut holds a number that is not finite"),
        ({"struts": [[1, 1]]}, "strut 0 joins node 1 to itself"),
        ({"struts": [[0, 1], [1, 0]]}, "strut 1 repeats an earlier strut"),
        ({"struts": [[0, 1]] * 2001}, "the limit is 2000"),
    ],
)
def test_what_is_wrong_with_a_cell(tmp_path: Path, change: dict[str, object], message: str) -> None:
    with pytest.raises(VolfrepError, match=message):
        load_cell(write(tmp_path / "cell.json", GOOD | change))


def test_no_cell_has_a_ball_that_hangs_on_nothing() -> None:
    corners = [[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    with pytest.raises(VolfrepError, match="unit cell 'brace', node 1 has no strut"):
        UnitCell("brace", np.array(corners, float), np.array([[0, 7], [2, 5], [3, 4]]))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "not valid JSON"),
        ("{", "not valid JSON"),
        ("[" * 100_000, "not valid JSON"),
        ("[]", "must be an object with 'nodes' and 'struts'"),
        ('{"nodes": []}', "must be an object with 'nodes' and 'struts'"),
        (" " * (MAX_FILE_BYTES + 1), "has 1,000,001 bytes"),
    ],
)
def test_what_is_wrong_with_a_file(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "cell.json"
    path.write_text(text)
    with pytest.raises(VolfrepError, match=message):
        load_cell(path)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(VolfrepError, match=r"Cannot read the cell file .*No such file"):
        find_cell(str(tmp_path / "missing.json"))
    (tmp_path / "binary.json").write_bytes(b"\xff\xfe\x00\x80")
    with pytest.raises(VolfrepError, match="no text in UTF-8"):
        load_cell(tmp_path / "binary.json")
    if not hasattr(os, "mkfifo"):  # Windows
        return
    # A pipe would be waited for, and a device never ends.
    os.mkfifo(tmp_path / "pipe.json")
    (tmp_path / "device.json").symlink_to("/dev/zero")
    for name in ("pipe.json", "device.json"):
        with pytest.raises(VolfrepError, match="is not a file"):
            load_cell(tmp_path / name)


def test_numbers_beyond_all_bounds_are_refused() -> None:
    with pytest.raises(VolfrepError, match="every node must be a list of 3 numbers"):
        make_cell("huge", [[10**400, 0, 0], [1, 1, 1]], [[0, 1]])
    with pytest.raises(VolfrepError, match="strut 0 must name two nodes"):
        make_cell("huge", [[0, 0, 0], [1, 1, 1]], [[0, 1e300]])
