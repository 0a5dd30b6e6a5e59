# SPDX-License-Identifier: LGPL-2.1-or-later
"""The drawing of a load case: edges that are there, faces in colours, arrows that point right."""

import re
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest

import samples
from volfrep.loads.load_cases import Force, LoadCase, Moment, Support
from volfrep.loads.regions import InPlane
from volfrep.reports.load_arrows import HELD, LOADED
from volfrep.reports.load_drawing import load_drawing

SVG = "{http://www.w3.org/2000/svg}"


def end(x):
    return InPlane((x, 0.0, 0.0), (1.0, 0.0, 0.0))


def drawn(force=(0.0, 0.0, 1500.0)):
    case = LoadCase("up & away", (Support(end(0.0)),), (Force(end(40.0), force),))
    return ElementTree.fromstring(load_drawing(samples.box(), case))


def numbers(node, key="d"):
    return np.array([float(n) for n in re.findall(r"-?[0-9.]+", node.get(key))])


def test_a_box_has_nine_edges_in_front_and_three_behind():
    behind, front, held, loaded, arrow = drawn().iter(f"{SVG}path")
    assert [len(numbers(node)) // 4 for node in (behind, front)] == [3, 9]
    assert (held.get("fill"), loaded.get("fill"), arrow.get("stroke")) == (HELD, LOADED, LOADED)
    # Two triangles each, whose areas are those of a face of 30 x 20 mm seen at an angle.
    for node in (held, loaded):
        area = [abs(np.cross(b - a, c - a)) / 2 for a, b, c in numbers(node).reshape(-1, 3, 2)]
        assert len(area) == 2
        assert area[0] == pytest.approx(area[1], rel=0.01)


def test_an_arrow_points_where_the_force_does_and_all_is_on_the_sheet():
    root = drawn()
    x, y, u, v = numbers(list(root.iter(f"{SVG}path"))[-1])
    assert x == pytest.approx(u, abs=0.2)  # z is up
    assert v < y - 20.0
    (text,) = root.iter(f"{SVG}text")
    assert text.text == "1.5 kN"
    left, top, wide, high = (float(n) for n in root.get("viewBox").split())
    for a, b in ((x, y), (u, v), (float(text.get("x")), float(text.get("y")))):
        assert left < a < left + wide
        assert top < b < top + high
    assert root.find(f"{SVG}title").text == "up & away"
    down = list(drawn((0.0, 0.0, -1500.0)).iter(f"{SVG}path"))[-1]
    x, y, u, v = numbers(down)
    assert v > y + 20.0


def test_a_moments_arrow_has_two_heads():
    case = LoadCase("turn", (Support(end(0.0)),), (Moment(end(40.0), (0.0, 0.0, 2000.0)),))
    text = load_drawing(samples.box(), replace(case, acceleration=(0.0, 0.0, -9806.65)))
    root = ElementTree.fromstring(text)
    assert len(list(root.iter(f"{SVG}polygon"))) == 2 + 1
    assert [node.text for node in root.iter(f"{SVG}text")] == ["2 N m", "1 g"]
