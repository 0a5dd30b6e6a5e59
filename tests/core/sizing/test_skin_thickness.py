# SPDX-License-Identifier: LGPL-2.1-or-later
"""A skin whose thickness is sized with the struts, against thin-walled tubes."""

from dataclasses import replace

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec, fill
from volfrep.jobs.infill import Infill
from volfrep.jobs.sizing import Goal, size, sizing, skin_search
from volfrep.jobs.sizing.governing import governing_skin
from volfrep.jobs.sizing.part_model import part_model
from volfrep.jobs.sizing.skin_search import thickness_there
from volfrep.jobs.sizing.solid_places import (
    NOWHERE,
    SolidPlaces,
    more_solid,
    solid_places,
    solid_stubs,
)
from volfrep.loads.load_cases import Force, LoadCase, LoadCases, Moment, Support
from volfrep.loads.regions import InPlane
from volfrep.mechanics.materials import find_material
from volfrep.sizing.analysis import Limits, analyse
from volfrep.sizing.model import with_sized_skin
from volfrep.sizing.optimise import lightest, next_radii, uniform
from volfrep.sizing.skin import skin_model
from volfrep.sizing.tapered_beams import Elastic
from volfrep.util.cache import StageCache
from volfrep.util.progress import Monitor

TITANIUM = find_material("Ti-6Al-4V")


def on_plane(axis, value):
    point, normal = np.zeros((2, 3))
    point[axis], normal[axis] = value, 1.0
    return InPlane(tuple(point.tolist()), tuple(normal.tolist()))


def tube(size, load, *, bounds, patch, shell=1.5, cell=10.0, radius=0.25, acceleration=None):
    """A closed box held at x = 0 and loaded at its other end, about struts that hardly count."""
    solid = samples.box(size)
    case = LoadCase("end", (Support(on_plane(0, 0.0)),), (load(on_plane(0, size[0])),))
    cases = (
        (case,)
        if acceleration is None
        else (case, replace(case, name="pulled", acceleration=acceleration))
    )
    spec = LatticeSpec("CVC", cell_size=cell, strut_radius=radius, shell=shell)
    infill = Infill(solid, spec, monitor=Monitor(), cache=StageCache())
    goal = Goal(thinnest=radius)
    loads = LoadCases(TITANIUM, cases)
    model = part_model(infill, loads, goal, StageCache(), thickest=bounds[1])
    varied, roots = with_sized_skin(
        model, lambda points: np.full(len(points), shell), bounds, patch
    )
    problem = varied.problem
    radii = np.clip(
        np.full(len(model.problem.low), radius), *(model.problem.low, model.problem.high)
    )
    return model, problem, np.concatenate([radii, roots])


def test_a_skin_that_is_varied_is_the_skin_that_is_not():
    """With the thickness that the model was made with: the same stiffness and mass."""
    model, problem, first = tube(
        (20.0, 10.0, 10.0), lambda region: Force(region, (0, 0, -500.0)), bounds=(0.5, 4.0),
        patch=10.0, acceleration=(1e7, 2e7, 0.0),
    )  # fmt: skip
    limits = Limits(frequency=100.0)
    fixed = analyse(model.problem, first[: problem.skin.radii], limits)[0]
    varied = analyse(problem, first, limits)[0]
    assert varied.compliance == pytest.approx(fixed.compliance, rel=1e-6)
    assert varied.frequency == pytest.approx(fixed.frequency, rel=1e-6)
    told = model.skin.stresses(fixed.displacements[model.frame_nodes :])
    assert varied.skin_stress == pytest.approx(told, rel=1e-5)


def test_its_volume_is_the_hollow_boxs_for_any_thickness():
    """Though shells are where one of 1.5 mm has its middle, but for the cubes of its corners.

    Their area times the thickness would be 15 % less than that, and 19 % more.
    """
    size = np.array((20.0, 10.0, 10.0))
    model, problem, first = tube(
        size, lambda region: Force(region, (0, 0, -500.0)), bounds=(0.5, 4.0), patch=10.0
    )
    assert problem.skin.volume(first) == pytest.approx(model.skin_volume, rel=1e-9)
    for thick in (0.6, 1.5, 2.5):
        variables = np.where(np.arange(len(first)) < problem.skin.radii, first, np.sqrt(thick))
        hollow = size.prod() - (size - 2.0 * thick).prod()
        assert problem.skin.volume(variables) == pytest.approx(hollow, rel=0.04)


@pytest.mark.costly
def test_the_mass_asked_for_is_that_of_the_file():
    """Of struts and skin, which ends three times as thick as the search begins with."""
    solid, mass = samples.box((20.0, 10.0, 10.0)), 6.0
    force = Force(on_plane(0, 20.0), (0, 0, -500.0))
    case = LoadCase("end", (Support(on_plane(0, 0.0)),), (force,))
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.5, shell=0.6)
    goal = Goal(volume=1e3 * mass / TITANIUM.density, thinnest=0.3, skin_thinnest=0.5)
    made = size(solid, spec, LoadCases(TITANIUM, (case,)), goal, most_steps=8, prove_it=False)
    split = made.report["masses_g"]
    assert split["struts"] + split["skin"] == pytest.approx(mass, rel=0.01)
    told, governing = made.report["skin"]["governed_by"], made.skin_governing
    assert [(row["what"], row["case"]) for row in told] == list(governing.names)
    assert len(governing.rows) == len(made.spec.skin_field.points)
    thin = governing.rows == governing.names.index(("smallest thickness", ""))
    values = made.spec.skin_field.values
    assert values[thin].mean() < 0.5 * values[~thin].mean()
    file = fill(solid, made.spec).mesh.volume * TITANIUM.density / 1e3
    assert file == pytest.approx(mass, rel=0.02)


def test_the_skin_takes_what_a_strut_as_thick_as_it_may_be_cannot_bear():
    """Though a thin node has a small share in the radius of its end, which the skin cuts."""
    _, problem, radii = tube(
        (22.0, 13.0, 13.0), lambda region: Force(region, (0, 0, -500.0)), bounds=(0.5, 4.0),
        patch=10.0,
    )  # fmt: skip
    shares = problem.radii.ends.toarray().reshape(-1, 2, len(radii))
    most = shares.max(axis=1)
    strut = int(np.flatnonzero(((most > 0.0) & (most < 0.3)).any(axis=1))[0])
    asked = np.flatnonzero(most[strut] > 0.5)
    radii[asked] = problem.high[asked]
    limits = Limits(stress=500.0, skin_stress=500.0)
    found, changes = analyse(problem, radii, limits, with_changes=True)
    stress = np.zeros_like(found.stress)
    stress[strut] = 2.0 * limits.stress
    found = replace(found, stress=stress, skin_stress=np.zeros_like(found.skin_stress))
    after = next_radii(problem, found, changes, limits)
    structure = problem.structure
    middle = structure.nodes[structure.beams.struts[strut]].mean(axis=0)
    near = problem.skin.radii + problem.skin.nearest(middle[None])[0]
    assert (after[near] > radii[near]).all()
    others = np.setdiff1d(np.arange(problem.skin.radii, len(radii)), near)
    assert (after[others] < radii[others]).all()


@pytest.mark.costly
def test_the_place_of_a_strut_that_is_wider_than_long_becomes_solid_where_it_bears_too_much():
    """Where one factor for all radii and the skin would thicken the whole part for it."""
    size, thickest = (33.0, 22.0, 22.0), 4.0
    model, problem, _ = tube(
        size, lambda region: Force(region, (0, 0, -500.0)), bounds=(0.5, thickest), patch=10.0
    )
    stubs = problem.stubs(problem.high)
    plain = analyse(problem, problem.high, Limits(stress=1.0))[0].stress.max(axis=(1, 2))
    stub = int(np.argmax(np.where(stubs, plain, 0.0)))
    more = 10.0 * plain.max() / plain[stub]
    factor = np.where(np.arange(len(stubs)) == stub, more, 1.0)
    limits = Limits(stress=2.0 * plain.max(), skin_stress=1e4)
    problem = replace(problem, stress_factor=factor)
    assert analyse(problem, problem.high, limits)[0].uses["stress"] == pytest.approx(5.0)
    problem = replace(problem, spares_stubs=True)
    spared = analyse(problem, problem.high, limits)[0].uses["stress"]
    assert spared == pytest.approx(0.5 * plain[~stubs].max() / plain.max())
    solids = more_solid(problem, limits, problem.high, samples.box(size), NOWHERE, thickest)
    structure = problem.structure
    place = structure.nodes[structure.beams.struts[stub]].mean(axis=0)
    near = problem.skin.nearest(place[None])[0]
    assert set(np.flatnonzero(solids.thickness)) == set(near)
    # As the wall beside it asks for: to fill the part from side to side takes half its width.
    assert thickest <= solids.deepest < 0.5 * size[2]
    # So it does once the skin is laid, which may leave more of the strut; and no second time.
    laid = replace(model.problem, stress_factor=factor)
    found = analyse(laid, laid.high, limits)[0]
    then = replace(model, problem=laid), found, limits, samples.box(size), problem.skin
    again = solid_stubs(*then, NOWHERE, thickest)
    assert set(np.flatnonzero(again.thickness)) == set(near)
    assert solid_stubs(*then, again, thickest) is again


def test_a_skin_that_ended_even_is_compared_with_what_came_out():
    solid, force = samples.box((20.0, 10.0, 10.0)), Force(on_plane(0, 20.0), (9.0, 0, 0))
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.3, shell=0.5)
    infill = Infill(solid, spec, monitor=Monitor(), cache=StageCache())
    loads = LoadCases(TITANIUM, (LoadCase("end", (Support(on_plane(0, 0.0)),), (force,)),))
    model = part_model(infill, loads, Goal(thinnest=0.2), StageCache())
    told = thickness_there(model, infill.domain.mesh)
    assert told["there_over_asked"] == pytest.approx({"5%": 1.0, "50%": 1.0, "95%": 1.0}, rel=1e-3)


def test_what_governs_a_pulled_tubes_skin_is_told_by_area():
    """Its stress is F / A all along, away from the plates at its ends."""
    (length, side), wall, force = (40.0, 10.0), 1.0, 3600.0
    _, problem, first = tube(
        (length, side, side), lambda region: Force(region, (force, 0, 0)), bounds=(0.5, 4.0),
        patch=5.0, shell=wall,
    )  # fmt: skip
    stress = force / (side**2 - (side - 2.0 * wall) ** 2)

    def governs(roots, **limits):
        radii = np.concatenate([first[: problem.skin.radii], roots])
        limits = Limits(**limits)
        rows = governing_skin(problem, analyse(problem, radii, limits)[0], limits).of_skin()
        assert sum(row["share"] for row in rows) == pytest.approx(1.0)
        return {(row["what"], row["case"]): row["share"] for row in rows}

    roots = first[problem.skin.radii :]
    walls = 4.0 * side * (length - 2.0 * side) / (4.0 * side * length + 2.0 * side**2)
    assert governs(roots, skin_stress=stress / 0.95)["skin stress", "end"] > walls
    told = governs(roots, skin_stress=50.0 * stress)
    assert told == {("thickened with others", ""): pytest.approx(1.0)}
    thin = np.full(len(roots), np.sqrt(0.5))
    told = governs(thin, skin_stress=50.0 * stress)
    assert told == {("smallest thickness", ""): pytest.approx(1.0)}
    moves = analyse(problem, first, Limits())[0].largest[0]
    told = governs(roots, displacement=moves)
    assert told == {("displacement", "end"): pytest.approx(1.0)}


@pytest.mark.costly
def test_its_derivatives_are_those_of_differences():
    _, problem, first = tube(
        (20.0, 10.0, 10.0), lambda region: Force(region, (0, 50.0, -500.0)), bounds=(0.5, 4.0),
        patch=10.0, acceleration=(1e7, 2e7, 0.0),
    )  # fmt: skip
    place = np.clip(first * (1.0 + 0.1 * np.sin(np.arange(len(first)))), problem.low, problem.high)
    limits = Limits(displacement=1.0, frequency=100.0, frame_buckling=1.0)
    found, changes = analyse(problem, place, limits, with_changes=True)
    farthest = int(np.argmax(changes.displacement_uses))
    for row in (problem.skin.radii + 2, len(place) - 3):
        step = np.zeros(len(place))
        step[row] = 1e-4
        high, low = (analyse(problem, place + sign * step, limits)[0] for sign in (1, -1))
        expected = {
            name: (high.uses[name] - low.uses[name]) / 2e-4
            for name in ("displacement", "frequency", "frame buckling")
        }
        assert changes.compliance[row] == pytest.approx(
            (high.compliance - low.compliance) / 2e-4, rel=1e-4
        )
        assert changes.displacement[row, farthest] == pytest.approx(
            expected["displacement"], rel=1e-4
        )
        assert changes.frequency[row] == pytest.approx(expected["frequency"], rel=1e-4)
        worst = int(np.argmax(changes.frame_uses))
        assert changes.frame_buckling[row, worst] == pytest.approx(
            expected["frame buckling"], rel=2e-2
        )
        assert problem.radii.volume_change(place)[row] == pytest.approx(
            (high.volume - low.volume) / 2e-4, rel=1e-6
        )
    assert found.volume == pytest.approx(problem.radii.volume(place))


#: A twisted box of walls of 1 mm: mm and N mm.
TWISTED, TWIST_WALL, TWIST_MOMENT = (160.0, 40.0, 30.0), 1.0, 250e3


def walls_of_the_lightest(problem, first, limits, most_steps):
    """Mean thickness of the twisted box that is sized within limits, away from its ends, mm."""
    sized = lightest(problem, limits, first, most_steps=most_steps)
    assert sized.holds
    skin, length = problem.skin, TWISTED[0]
    clear = np.abs(skin.skin.centres[:, 0] - 0.5 * length) < 0.5 * length - 30.0
    thick, area = skin.of_shells(sized.analysis.radii)[clear], skin.skin.shells.area[clear]
    return thick @ area / area.sum()


def twisted_tube():
    """Its problem and the first design; and the sides of the middle of its walls, mm."""
    _, problem, first = tube(
        TWISTED, lambda region: Moment(region, (TWIST_MOMENT, 0, 0)),
        bounds=(0.3, 6.0), patch=15.0, shell=TWIST_WALL, cell=15.0, radius=0.3,
    )  # fmt: skip
    return problem, first, TWISTED[1] - TWIST_WALL, TWISTED[2] - TWIST_WALL


@pytest.mark.slow
def test_a_tube_in_torsion_has_the_mass_of_bredts_formula():
    """The twist of M S / (4 A2 G t) allowed: walls of t, away from the ends."""
    problem, first, b, h = twisted_tube()
    length, width, height = TWISTED
    shear = TITANIUM.young / (2.0 + 2.0 * TITANIUM.poisson)
    twist = TWIST_MOMENT * length * 2.0 * (b + h) / (4.0 * (b * h) ** 2 * shear * TWIST_WALL)
    limits = Limits(displacement=twist * np.hypot(0.5 * width, 0.5 * height))
    walls = walls_of_the_lightest(problem, first, limits, most_steps=30)
    assert walls == pytest.approx(TWIST_WALL, rel=0.05)


@pytest.mark.slow
def test_a_tube_in_torsion_has_the_stress_of_its_outer_side():
    """Bredt's is the mean over a wall: where it is twisted that has t S / (2 A) more outside."""
    problem, first, b, h = twisted_tube()
    bredt = np.sqrt(3.0) * TWIST_MOMENT / (2.0 * b * h * TWIST_WALL)
    limits = Limits(skin_stress=bredt * (1.0 + TWIST_WALL * (b + h) / (b * h)))
    walls = walls_of_the_lightest(problem, first, limits, most_steps=40)
    assert walls == pytest.approx(TWIST_WALL, rel=0.05)


def lightest_walls(moment, force, width, height, stress, least):
    """Of a box's section, flanges and webs of one thickness each: mm2 of both, by beam theory.

    The edge of a web has the stress of its flange and the force across.
    """
    best = np.inf, 0.0
    for web in np.linspace(least, 4.0 * least, 200):
        low, high = least, 40.0 * least
        for _ in range(40):
            flange = 0.5 * (low + high)
            area = width * flange * height
            inertia = 0.5 * area * height + web * height**3 / 6.0
            flow = 0.5 * force * 0.5 * area / inertia
            fibre = moment * 0.5 * (height + flange) / inertia
            edge = np.hypot(moment * 0.5 * height / inertia, np.sqrt(3.0) * flow / web)
            low, high = (low, flange) if max(fibre, edge) <= stress else (flange, high)
        best = min(best, (2.0 * (width * high + height * web), web))
    return best[0]


@pytest.mark.slow
def test_a_cantilevers_walls_are_nearly_as_light_as_the_best_of_one_thickness_each():
    """Webs end thicker than they need be, which have their flange's stress at their edges."""
    (length, width, height), stress, force, least = (200.0, 40.0, 30.0), 300.0, 2500.0, 0.4
    _, problem, first = tube(
        (length, width, height), lambda region: Force(region, (0, 0, -force)),
        bounds=(least, 6.0), patch=10.0, shell=1.0, cell=15.0, radius=0.3,
    )  # fmt: skip
    sized = lightest(problem, Limits(skin_stress=stress), first, most_steps=40)
    assert sized.holds
    skin = problem.skin
    x, place = skin.skin.centres[:, 0], np.linspace(20.0, length - 20.0, 9)
    across = np.abs(skin.skin.shells.axes[:, 2, 0]) < 0.7
    clear = across & (x > 15.0) & (x < length - 15.0)
    made = skin.of_shells(sized.analysis.radii)[clear] @ skin.skin.shells.area[clear]
    b, h = width - 1.0, height - 1.0
    each = [lightest_walls(force * (length - at), force, b, h, stress, least) for at in place]
    expected = np.trapz(each, place) / np.ptp(place) * (length - 30.0)
    assert made < 1.08 * expected
    even = uniform(problem, Limits(skin_stress=stress))[0]
    assert np.ptp(skin.wanted(even.radii)) < 1e-9
    assert sized.analysis.volume < 0.9 * even.volume


@pytest.mark.costly
def test_a_closed_tube_buckles_as_eulers_column():
    """Held at one end: pi2 E I / (4 length2), less what the load lets its end plate give way."""
    length, width, height, wall = 160.0, 20.0, 14.0, 1.0
    _, problem, first = tube(
        (length, width, height), lambda region: Force(region, (-1000.0, 0, 0)),
        bounds=(0.3, 3.0), patch=20.0, shell=wall, cell=14.0, radius=0.5,
    )  # fmt: skip
    found = analyse(problem, first, Limits(frame_buckling=1.0))[0]
    b, h = width - wall, height - wall
    inertia = wall * (b * h**2 / 2.0 + h**3 / 6.0)
    euler = np.pi**2 * TITANIUM.young * inertia / (4.0 * (length - wall) ** 2)
    assert found.factors[0] * 1000.0 == pytest.approx(euler, rel=0.03)


@pytest.mark.costly
def test_where_a_skin_meets_itself_the_part_is_solid_and_that_is_told():
    """A wedge: solid as far as it is thinner than two skins, which is one place of known mass."""
    length, width, thick, shell = 60.0, 12.0, 12.0, 2.0
    solid = samples.box((length, width, thick))
    points = solid.vertices.copy()
    points[:, 2] *= np.where(points[:, 0] > 0.5 * length, 2.4 / thick, 1.0)
    wedge = replace(solid, vertices=points)
    case = LoadCase("end", (Support(on_plane(0, 0.0)),), (Force(on_plane(0, length), (9.0, 0, 0)),))
    spec = LatticeSpec("CVC", cell_size=6.0, strut_radius=0.3, shell=shell)
    infill = Infill(wedge, spec, monitor=Monitor(), cache=StageCache())
    model = part_model(infill, LoadCases(TITANIUM, (case,)), Goal(thinnest=0.2), StageCache())
    heaviest, *rest = solid_places(model, wedge, infill.domain.mesh, 4.0)
    # From where it is two skins thick, 4 mm, to its end of 2.4 mm.
    from_there = (thick - 2.0 * shell) / (thick - 2.4) * length
    assert heaviest["box_mm"][1][0] == pytest.approx(length, abs=0.1)
    assert heaviest["box_mm"][0][0] == pytest.approx(from_there, abs=6.0)
    assert sum(place["mass_g"] for place in rest) < 0.3 * heaviest["mass_g"]
    assert heaviest["mass_g"] == pytest.approx(4e-3 * width * (length - from_there) * 3.2, rel=0.4)


def test_the_sides_of_a_body_that_is_filled_have_its_volume_together():
    solid = samples.box((24.0, 12.0, 12.0))
    skin = skin_model(solid, 7.2, 3.0, Elastic(110e3, 0.34))
    volume = skin.shells.area @ skin.shells.thickness
    assert volume == pytest.approx(solid.volume, rel=0.1)


@pytest.mark.slow
def test_where_the_thickest_skin_is_not_enough_the_part_becomes_solid():
    """A cantilever whose hollow section bears what it carries beyond some 15 mm only."""
    (length, side), force = (60.0, 12.0), 1000.0
    solid = samples.box((length, side, side))
    case = LoadCase(
        "end", (Support(on_plane(0, 0.0)),), (Force(on_plane(0, length), (0, 0, -force)),)
    )
    loads = LoadCases(TITANIUM, (case,))
    spec = LatticeSpec("CVC", cell_size=12.0, strut_radius=0.5, shell=0.6)
    goal = Goal(
        Limits(stress=400.0), thinnest=0.4, skin_thinnest=0.4, skin_thickest=0.8, skin_patch=6.0
    )
    made = size(solid, spec, loads, goal, most_steps=10, prove_it=False)
    (place,) = made.report["skin"]["solid"]
    assert place["filled"]
    (_, _, _), (end, _, _) = place["box_mm"]
    assert 10.0 < end < 40.0
    assert 10.0 * side**2 < place["volume_mm3"] < end * side**2
    told = "is solid where a skin of 0.8 mm is not enough"
    assert any(told in note for note in made.report["notes"])
    inner = Infill(solid, made.spec, monitor=Monitor(), cache=StageCache()).domain.mesh
    assert inner.vertices[:, 0].min() > 8.0
    hollow = size(
        solid, spec, loads, replace(goal, solid_places=False), most_steps=10, prove_it=False
    )
    assert not hollow.sized.holds
    assert not any(place["filled"] for place in hollow.report["skin"]["solid"])


@pytest.mark.costly
@pytest.mark.parametrize("bears", [True, False])
def test_a_place_is_filled_for_a_strut_only_where_thicker_struts_do_not_bear_its_load_for_less(
    monkeypatch, bears
):
    """As if one place were asked for, once the skin is laid; and struts bore all, or did not."""

    def fill_one(design, model, goal, part):
        if design.solid is not NOWHERE:
            return None
        points = design.problem.skin.points
        solids = SolidPlaces(points, np.where(np.arange(len(points)) == 0, 3.0, 0.0))
        field = skin_search._field(design.problem, design.variables, None, solids)
        return replace(design, spec=replace(design.spec, skin_field=field), solid=solids)

    def search(task, *given, real=sizing._search):
        found = real(task, *given)
        holds = bears or task.skin.solid is not NOWHERE
        return replace(found, sized=replace(found.sized, holds=holds))

    monkeypatch.setattr(sizing, "with_solid_stubs", fill_one)
    monkeypatch.setattr(sizing, "_search", search)
    case = LoadCase("end", (Support(on_plane(0, 0.0)),), (Force(on_plane(0, 20.0), (0, 0, -50.0)),))
    spec = LatticeSpec("CVC", cell_size=10.0, strut_radius=0.5, shell=0.8)
    goal = Goal(Limits(stress=400.0), thinnest=0.4, skin_thinnest=0.6)
    part = samples.box((20.0, 10.0, 10.0))
    made = size(part, spec, LoadCases(TITANIUM, (case,)), goal, most_steps=2, prove_it=False)
    assert any(place["filled"] for place in made.report["skin"]["solid"]) == (not bears)
