# SPDX-License-Identifier: LGPL-2.1-or-later
"""Skins whose thickness follows a field."""

import numpy as np
import pytest

import samples
from volfrep import LatticeSpec
from volfrep.design.openings import OpenPlane
from volfrep.design.parameters.specification import specification, values_of
from volfrep.design.scattered_field import PointField
from volfrep.mesh.quality import measure
from volfrep.shell.domain import field_of, find_domain
from volfrep.shell.thickness_field import SLOPE, thickness_field
from volfrep.spatial.proximity import closest_points
from volfrep.util.errors import VolfrepError
from volfrep.util.progress import Monitor

SIZE = (60.0, 24.0, 20.0)


def rising(low, high):
    """A thickness that rises along the box, mm."""
    x = np.linspace(0.0, SIZE[0], 40)
    y, z = np.meshgrid([0.0, 12.0, 24.0], [0.0, 10.0, 20.0])
    points = np.array([(a, b, c) for a in x for b, c in zip(y.ravel(), z.ravel(), strict=True)])
    return PointField(points, low + (high - low) * points[:, 0] / SIZE[0])


def made(**given):
    solid = samples.box(SIZE)
    spec = LatticeSpec(cell_size=10, **given)
    return solid, spec, find_domain(solid, spec.skin, Monitor())


@pytest.mark.costly
def test_the_wall_lies_as_deep_as_the_field_says():
    solid, spec, domain = made(shell=1.0, skin_field=rising(1.0, 4.0))
    quality = measure(domain.mesh)
    assert quality.watertight
    assert (quality.bodies, quality.genus) == (1, 0)
    points = domain.mesh.vertices[domain.mesh.triangles].mean(axis=1)
    depth = closest_points(solid, points)[1]
    field = field_of(solid, spec.skin)
    assert field is not None
    assert np.abs(depth - field(points)).max() < 0.04
    # The cavity's sections are the box's less two walls of 1 + x / 20.
    x = np.linspace(1.0 / 0.95, 59.0 / 1.05, 2001)
    wall = 1.0 + x / 20.0
    section = (SIZE[1] - 2.0 * wall) * (SIZE[2] - 2.0 * wall)
    inside = float(np.sum(0.5 * (section[1:] + section[:-1]) * np.diff(x)))
    assert domain.mesh.volume == pytest.approx(inside, rel=2e-3)


def test_a_jump_of_the_field_becomes_a_slope_on_its_thin_side():
    places = (0.0, 10.0, 20.0, 20.5, 30.0, 40.0)
    points = np.array([(x, y, z) for x in places for y in (0, 9) for z in (0, 9)])
    field = PointField(points, np.where(points[:, 0] > 20.2, 5.0, 1.0))
    made_of = thickness_field(field, 1.0, np.zeros(3), np.array([40.0, 9, 9]))
    x = np.linspace(0.0, 40.0, 81)
    line = np.column_stack([x, np.full(81, 4.5), np.full(81, 4.5)])
    values = made_of(line)
    clear = np.abs(x - 25.0) > 1.5  # the grid's points lie so far apart, and there it jumps
    assert (values >= field(line) - 0.2)[clear].all()
    assert np.abs(np.diff(values) / np.diff(x)).max() <= SLOPE + 1e-9
    assert values[-1] == pytest.approx(5.0)


def test_nowhere_is_it_thinner_than_the_shell():
    solid, _, domain = made(shell=2.0, skin_field=rising(0.5, 3.0))
    assert closest_points(solid, domain.mesh.vertices)[1].min() > 1.95


@pytest.mark.costly
def test_open_faces_and_faces_with_their_own_skin_stay_so():
    opened = (OpenPlane((0, 0, 20), (0, 0, 1)),)
    _, _, domain = made(shell=1.0, skin_field=rising(1.0, 3.0), open_faces=opened)
    assert domain.is_open
    assert measure(domain.mesh).watertight
    assert domain.mesh.bounds[1][2] == pytest.approx(20.0)


def test_a_field_needs_a_skin():
    with pytest.raises(VolfrepError, match="need a skin"):
        LatticeSpec(shell=0, skin_field=rising(1, 2))


def test_it_is_a_file_in_a_specification(tmp_path):
    field = rising(1.0, 4.0)
    path = tmp_path / "skin.csv"
    rows = "".join(
        f"{x:.12g},{y:.12g},{z:.12g},{t:.12g}\n"
        for (x, y, z), t in zip(field.points, field.values, strict=True)
    )
    path.write_text("x,y,z,thickness\n" + rows)
    spec = specification({"shell": 1.0, "skin_field": str(path)})
    assert spec.skin == LatticeSpec(shell=1.0, skin_field=spec.skin_field).skin
    assert spec.digest() != LatticeSpec(shell=1.0).digest()
    assert values_of(spec)["skin_field"] == str(path)
    assert spec.skin_field([[30.0, 12.0, 0.0]]) == pytest.approx(2.5, abs=0.1)
