# SPDX-License-Identifier: LGPL-2.1-or-later
"""Previews of walls and networks, and the radius of a network that has a target."""

from __future__ import annotations

import numpy as np
import pytest

import samples
from volfrep.design.cells import LIBRARY, make_cell
from volfrep.design.grading import CellMap, RadiusGrading
from volfrep.design.graphs import RandomGraph, make_network
from volfrep.design.profile import Profile
from volfrep.design.spec import LatticeSpec
from volfrep.design.target import Target
from volfrep.design.tpms import TpmsSheet
from volfrep.io.solid import check_solid
from volfrep.jobs.pipeline import fill
from volfrep.jobs.preview import PartDepth, preview
from volfrep.jobs.targets import fill_with_target, solve_block_target, solve_target
from volfrep.mesh.quality import inspect
from volfrep.util.errors import Cancelled, VolfrepError
from volfrep.util.progress import Monitor

BOX = check_solid(samples.box((24.0, 18.0, 16.0), (-12.0, -9.0, -8.0)), "box")
DEPTH = PartDepth(BOX)
BONE = RandomGraph("voronoi", points=40)
#: Struts along x, y and z through the box.
GRID = np.stack(np.meshgrid([-16.0, -8, 0, 8, 16], [-8.0, 0, 8], [-8.0, 0, 8], indexing="ij"), -1)
NODES = GRID.reshape(-1, 3)
STRUTS = np.argwhere(np.triu(np.isclose(np.linalg.norm(NODES[:, None] - NODES, axis=2), 8.0)))
OWN = make_network(NODES, STRUTS)


@pytest.mark.costly
@pytest.mark.slow_but("more1", "more6")
@pytest.mark.parametrize(
    "more",
    [
        {"cell": "Gyroid", "wall": TpmsSheet("sheet", 1.0)},
        {"cell": "Schwarz P", "shell": 0.0, "wall": TpmsSheet("skeleton", offset=-0.5)},
        {"cell": "Gyroid", "target": Target("relative_density", 0.3)},
        {"cell": "Gyroid", "cell_map": CellMap("cylindrical")},
        {
            "cell": "Gyroid",
            "radius_grading": RadiusGrading("skin", Profile("linear", 0.8, 1.6), reach=5.0),
        },
        {"network": BONE, "strut_radius": 0.5},
        {"network": OWN, "strut_radius": 0.8},
        {"network": BONE, "target": Target("mass", 3.0)},
    ],
)
def test_a_preview_has_the_figures_of_what_is_made(more: dict[str, object]) -> None:
    spec = LatticeSpec(**({"cell_size": 8.0, "shell": 1.0} | more))  # type: ignore[arg-type]
    shown, made = preview(BOX, spec, DEPTH), fill(BOX, spec).report
    assert shown.relative_density == pytest.approx(made.relative_density, rel=0.06)
    assert shown.volume == pytest.approx(made.volume_mm3, rel=0.04)
    assert shown.cells == made.cells_active
    if spec.kind.has_struts:
        assert shown.struts == pytest.approx(made.struts, rel=0.1 if more["network"] is BONE else 1)
        assert len(shown.start) >= shown.struts
        return
    assert shown.surface is not None
    found = inspect(shown.surface).quality
    assert found.watertight
    # What is drawn ends at the skin: nothing lies in it, or beside the part.
    assert DEPTH.below_skin(shown.surface.vertices, 0.0).min() > spec.shell - 0.1
    lattice = made.relative_density * made.domain_volume_mm3
    assert 0.7 * lattice < found.volume < 1.6 * lattice  # thin sheets are drawn thicker


@pytest.mark.slow
def test_walls_that_are_too_many_are_not_shown() -> None:
    with pytest.raises(VolfrepError, match="too much to be shown"):
        preview(BOX, LatticeSpec("Gyroid", 0.3, wall=TpmsSheet("sheet", 0.1)), DEPTH)


@pytest.mark.slow
@pytest.mark.parametrize("network", [BONE, OWN])
@pytest.mark.parametrize("target", [Target("relative_density", 0.15), Target("mass", 3.5)])
def test_a_network_in_a_part_meets_its_target(network: object, target: Target) -> None:
    spec = LatticeSpec(cell_size=8.0, shell=1.0, network=network, target=target)  # type: ignore[arg-type]
    result, found = fill_with_target(BOX, spec)
    reached = result.report.relative_density
    if target.aim == "mass":
        reached = result.report.volume_mm3 / 1000.0
    assert reached == pytest.approx(target.value, rel=3e-3)
    assert result.report.bodies == 1
    again = fill(BOX, LatticeSpec(
        cell_size=8.0, shell=1.0, network=found.network, strut_radius=found.strut_radius
    ))  # fmt: skip
    assert again.report.volume_mm3 == pytest.approx(result.report.volume_mm3, rel=1e-9)


@pytest.mark.costly
def test_targets_that_a_network_cannot_meet_are_refused() -> None:
    spec = LatticeSpec(cell_size=8.0, network=OWN, target=Target("relative_density", 0.95))
    with pytest.raises(VolfrepError, match="No strut radius meets the target"):
        solve_target(BOX, spec)
    with pytest.raises(VolfrepError, match="own radii say how thick"):
        LatticeSpec(
            network=make_network(NODES, STRUTS, np.ones(len(STRUTS))), target=Target("mass", 3.0)
        )
    with pytest.raises(VolfrepError, match="target of stiffness is for cells"):
        LatticeSpec(network=BONE, target=Target("stiffness", 10.0, (1.0, 0.0, 0.0), 1000.0))
    flat = make_cell("Flat", LIBRARY["BCC"].nodes, LIBRARY["BCC"].struts, edges=(1.0, 1.0, 0.8))
    squat = LatticeSpec(flat, target=Target("mass", 3.0))
    with pytest.raises(VolfrepError, match="takes no target of mass"):
        solve_block_target(squat, (2, 2, 2))


@pytest.mark.parametrize(
    "more",
    [
        {"cell": "BCC", "strut_radius": 0.8},
        {"cell": "Gyroid", "wall": TpmsSheet("sheet", 1.0)},
        {"network": BONE, "strut_radius": 0.5},
    ],
    ids=["cells", "walls", "network"],
)
def test_a_preview_ends_where_it_is_told_to_and_can_be_made_afterwards(
    more: dict[str, object],
) -> None:
    spec = LatticeSpec(**({"cell_size": 8.0, "shell": 1.0} | more))  # type: ignore[arg-type]
    depth = PartDepth(BOX)
    depth.monitor = Monitor(lambda *_: False)
    with pytest.raises(Cancelled):
        preview(BOX, spec, depth)
    depth.monitor = Monitor()
    assert preview(BOX, spec, depth).mass == preview(BOX, spec, DEPTH).mass
