# SPDX-License-Identifier: LGPL-2.1-or-later
"""A lattice as kinds of joints, held to closed forms and to brute force."""

import dataclasses

import numpy as np
import pytest

from volfrep import LatticeSpec
from volfrep.grid.congruent_joints import Joint, distinct_joints, joint_volume, refuse_overlaps
from volfrep.grid.strut_graph import Wireframe
from volfrep.io.write.step_exact import predict_exact
from volfrep.jobs.blocks import block
from volfrep.util.errors import VolfrepError


def lattice(cell="CVC", count=(3, 3, 3), size=20.0, radius=2.0):
    spec = LatticeSpec(cell=cell, cell_size=size, strut_radius=radius, resolution=10)
    return block(spec, count).wireframe


def joint(arms, radii, ball):
    count = len(arms)
    return Joint(
        np.array(arms, float), np.array(radii, float), ball, np.zeros(1, np.int64),
        np.arange(count)[None], np.zeros((1, count), bool),
    )  # fmt: skip


@pytest.mark.slow_but("CVC-27")
@pytest.mark.parametrize(("cell", "kinds"), [("CVC", 27), ("Box", 27), ("Octet", 27)])
def test_a_block_has_few_kinds_however_large(cell, kinds):
    small, large = (distinct_joints(lattice(cell, count)) for count in ((3, 3, 3), (6, 4, 5)))
    assert len(small) == len(large) == kinds


def test_every_half_of_every_strut_is_an_arm_of_its_node():
    frame = lattice()
    seen = np.zeros((len(frame.struts), 2), int)
    nodes = []
    for kind in distinct_joints(frame):
        nodes.append(kind.places)
        ends = frame.struts[kind.struts, kind.at_end.astype(int)]
        assert (ends == kind.places[:, None]).all()
        middle = frame.nodes[frame.struts].mean(axis=1)[kind.struts]
        arms = middle - frame.nodes[kind.places][:, None]
        assert np.abs(arms - kind.arms).max() < 1e-9
        np.add.at(seen, (kind.struts, kind.at_end.astype(int)), 1)
    assert (seen == 1).all()
    assert np.array_equal(np.sort(np.concatenate(nodes)), np.arange(len(frame.nodes)))


def test_radii_tell_joints_apart():
    frame = lattice(count=(2, 1, 1))
    before = len(distinct_joints(frame))
    radii = frame.radii.copy()
    radii[0, 0] = 1.9
    changed = distinct_joints(dataclasses.replace(frame, radii=radii))
    # The strut's middle changes too, so both its joints are unlike all others now.
    assert len(changed) > before
    cones = next(kind for kind in changed if 1.9 in kind.radii[:, 0].round(9))
    assert cones.radii[cones.radii[:, 0].round(9) == 1.9, 1] == pytest.approx([1.95])


@pytest.mark.slow_but("CVC-21.765592-39.191836")
@pytest.mark.parametrize(
    ("cell", "first", "second"),
    [("Box", 9.424778, 11.313708), ("CVC", 21.765592, 39.191836), ("Octet", 53.314595, 154.509668)],
)
def test_the_volume_of_an_endless_lattice(cell, first, second):
    """A2 x2 - A3 x3 of the published closed forms; the joints of the middle cell stand for it."""
    frame = lattice(cell)
    inside = ((frame.nodes > 20 - 1e-6) & (frame.nodes < 40 - 1e-6)).all(axis=1)
    total = sum(joint_volume(kind) * inside[kind.places].sum() for kind in distinct_joints(frame))
    assert total / 20**3 == pytest.approx(first * 0.01 - second * 0.001, rel=3e-3)


def test_volumes_of_joints_by_hand():
    ball = 4 / 3 * np.pi * 2.0**3
    assert joint_volume(joint([[0, 0, 10]], [[1, 1]], 2.0)) == pytest.approx(
        ball + np.pi * 10 - np.pi * (np.sqrt(3) + (2 - np.sqrt(3)) ** 2 * (4 + np.sqrt(3)) / 3),
        rel=5e-3,
    )
    # A cone that begins so small that it hardly counts within the ball.
    cone = np.pi / 3 * 10 * (0.01 + 0.1 * 2 + 4)
    inside = np.pi / 3 * 2 * (0.01 + 0.1 * 0.48 + 0.2304)
    assert joint_volume(joint([[10, 0, 0]], [[0.1, 2.0]], 2.0)) == pytest.approx(
        ball + cone - inside, rel=1e-2
    )


def test_struts_that_overlap_away_from_joints():
    refuse_overlaps(lattice())
    rods = Wireframe(
        np.array([[0.0, 0, 0], [10, 0, 0], [5, -5, 1.9], [5, 5, 1.9]]),
        np.array([[0, 1], [2, 3]], np.int32),
        np.ones((2, 2)),
        np.ones(4),
    )
    with pytest.raises(VolfrepError, match=r"near \(5, 0, 0\).*faceted"):
        refuse_overlaps(rods)
    refuse_overlaps(dataclasses.replace(rods, radii=np.full((2, 2), 0.94), joint_radii=np.ones(4)))
    ball = Wireframe(
        np.array([[0.0, 0, 0], [10, 0, 0], [5, 2.5, 0], [5, 9, 0]]),
        np.array([[0, 1], [2, 3]], np.int32),
        np.full((2, 2), 0.5),
        np.array([0.6, 0.6, 2.1, 0.6]),
    )
    with pytest.raises(VolfrepError, match="overlap"):
        refuse_overlaps(ball)


def test_nearest_approach_against_brute_force():
    rng = np.random.default_rng(5)
    share = np.linspace(0, 1, 201)
    refused = agreed = 0
    for _ in range(60):
        nodes = rng.uniform(0, 10, (4, 3))
        one = nodes[0] + share[:, None] * (nodes[1] - nodes[0])
        two = nodes[2] + share[:, None] * (nodes[3] - nodes[2])
        gap = np.linalg.norm(one[:, None] - two[None], axis=2).min()
        for radius, bad in ((gap / 2 * 1.02, True), (gap / 2 * 0.97, False)):
            frame = Wireframe(
                nodes, np.array([[0, 1], [2, 3]], np.int32), np.full((2, 2), radius), np.zeros(4)
            )
            try:
                refuse_overlaps(frame)
            except VolfrepError:
                refused += 1
                agreed += bad
            else:
                agreed += not bad
    assert (refused, agreed) == (60, 120)


def test_a_graded_lattice_is_predicted_to_take_longer():
    frame = lattice(count=(6, 6, 6))
    uniform = predict_exact(frame)
    rng = np.random.default_rng(0)
    graded = predict_exact(
        dataclasses.replace(frame, radii=rng.uniform(1.5, 2.0, frame.radii.shape))
    )
    assert uniform.kinds == 27
    assert graded.kinds == len(frame.nodes)
    assert graded.seconds > 50 * uniform.seconds
    assert graded.megabytes > 4 * uniform.megabytes
