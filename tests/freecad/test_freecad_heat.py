# SPDX-License-Identifier: LGPL-2.1-or-later
"""Steady heat of an infill by the document's load cases, beside closed forms of a bar."""

import FreeCAD as App
import numpy as np
import ObjectsFem
import pytest

from freecad_volfrep import make_lattice_infill
from freecad_volfrep.features.sizing.document_loads import (
    FLOW,
    FORCE,
    HELD,
    WARM,
    add_load,
    load_kind,
    make_case,
    said_load,
    set_size,
    size_of,
    toggle_face,
)
from freecad_volfrep.features.sizing.heat import solve_heat
from freecad_volfrep.features.sizing.sizing import analyses_of, carried_by, loads_of
from volfrep.jobs.figures.point_values import point_values
from volfrep.jobs.part_bricks import cell_law
from volfrep.util.errors import VolfrepError

LENGTH, WIDTH, CONDUCTIVITY = 60.0, 20.0, 7.0


def add(case, kind, base, face, size):
    """A row of the panel on one face."""
    load = add_load(case, kind)
    toggle_face(load, base, face)
    if size is not None:
        set_size(load, size)
    return load


@pytest.fixture
def bar(doc):
    """A bar of Octet cells without a skin, and a load case of it."""
    base = doc.addObject("Part::Box", "Bar")
    base.Length, base.Width, base.Height = LENGTH, WIDTH, WIDTH
    doc.recompute()
    obj = make_lattice_infill(
        doc, base, CellType="Octet", CellSize=10, StrutRadius=0.8, ShellThickness=0,
        PrintMaterial="Ti-6Al-4V", AutoUpdate=False,
    )  # fmt: skip
    obj.Conductivity = CONDUCTIVITY
    return obj, make_case(doc)


def conductance(obj):
    """W/K of the bar: k A / L, k that of the endless lattice."""
    share = cell_law(obj.Proxy.wanted(obj)[1]).conductivity[0]
    return CONDUCTIVITY * 1e-3 * share * WIDTH**2 / LENGTH


def test_between_two_temperatures_heat_flows_as_k_a_dt_over_l(bar):
    obj, case = bar
    add(case, WARM, obj.Base, "Face1", 80.0)
    add(case, WARM, obj.Base, "Face2", 20.0)
    found = solve_heat(obj, analyses_of(obj))
    flow = 60.0 * conductance(obj)
    assert [face["power_w"] for face in found.found.faces] == pytest.approx([flow, -flow], rel=1e-4)
    assert found.found.resistance == pytest.approx(1.0 / conductance(obj), rel=1e-4)
    assert found.found.ends == pytest.approx((20.0, 80.0))
    x = np.linspace(0.0, LENGTH, 7)
    points = np.stack([x, np.full(7, 3.0), np.full(7, 11.0)], axis=1)
    solid, spec, _ = obj.Proxy.wanted(obj)
    colours = point_values(
        solid, spec, "Temperature", points, points, **carried_by(obj, "Temperature")
    )
    assert colours.values == pytest.approx(80.0 - x, abs=1e-3)
    assert (colours.low, colours.high) == pytest.approx((20.0, 80.0))
    assert found.summary().startswith("Temperatures are 20 to 80 °C, 0.3624 W flow")
    assert found.tables()[1].rows[0][1] == pytest.approx(80.0)


def test_heat_that_flows_in_warms_the_end_and_a_fluid_takes_it(doc, bar):
    obj, case = bar
    add(case, FLOW, obj.Base, "Face1", 0.5)
    air = ObjectsFem.makeConstraintHeatflux(doc, "Air")
    air.References = [(obj.Base, "Face2")]
    air.ConstraintType = "Convection"
    old = isinstance(air.AmbientTemp, float)
    air.AmbientTemp = 293.15 if old else "293.15 K"
    air.FilmCoef = 50.0 if old else "50 W/m^2/K"
    case.addObject(air)
    found = solve_heat(obj, [case]).found
    outside = 20.0 + 0.5 / (50e-6 * WIDTH**2)
    assert found.faces[1]["temperature"] == pytest.approx(outside, rel=1e-3)
    assert found.ends[1] == pytest.approx(outside + 0.5 / conductance(obj), rel=5e-3)
    air.ConstraintType = "DFlux"
    with pytest.raises(VolfrepError, match="'Air' is of the type DFlux"):
        solve_heat(obj, [case])


def test_rows_are_in_degrees_and_watts_and_are_saved(doc, bar, tmp_path):
    obj, case = bar
    add(case, WARM, obj.Base, "Face1", -12.5)
    flow = add(case, FLOW, obj.Base, "Face2", -3.0)
    old = isinstance(flow.CFlux, float)
    # What FreeCAD's own writer of decks divides by 1000 for mW.
    assert (flow.CFlux if old else flow.CFlux.getValueAs("W").Value * 1e6) == pytest.approx(-3e6)
    path = tmp_path / "heat.FCStd"
    doc.saveCopy(str(path))
    again = App.openDocument(str(path))
    try:
        loads = [again.getObject(one.Name) for one in case.Group]
        assert [load_kind(load) for load in loads] == [WARM, FLOW]
        assert [size_of(load) for load in loads] == pytest.approx([-12.5, -3.0])
        said = [said_load(load) for load in loads]
        assert said == ["Temperature -12.5 °C: Face1", "Heat flow -3 W: Face2"]
        assert again.getObject(obj.Name).Conductivity == CONDUCTIVITY
    finally:
        App.closeDocument(again.Name)


def test_what_is_missing_is_said(doc, bar):
    obj, case = bar
    with pytest.raises(VolfrepError, match="No load case has heat"):
        solve_heat(obj, [case])
    add(case, WARM, obj.Base, "Face1", 80.0)
    with pytest.raises(VolfrepError, match="heat alone"):
        loads_of(obj, [case])
    other = make_case(doc)
    add(other, WARM, obj.Base, "Face2", 20.0)
    with pytest.raises(VolfrepError, match=f"'{case.Label}' and '{other.Label}': choose one"):
        solve_heat(obj, [case, other])
    obj.Conductivity = 0.0
    with pytest.raises(VolfrepError, match="conductivity is not known"):
        solve_heat(obj, [case])


def test_loads_beside_heat_are_read_without_it(bar):
    obj, case = bar
    add(case, HELD, obj.Base, "Face1", None)
    add(case, FORCE, obj.Base, "Face2", 100.0)
    before = loads_of(obj, [case])
    add(case, WARM, obj.Base, "Face1", 80.0)
    assert loads_of(obj, [case]) == before
