# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a script's author wants beyond the gallery (test_gallery): notebooks, refusals, files."""

from __future__ import annotations

from pathlib import Path

import pytest
import trimesh

import volfrep

LOADS = """
material = "Ti-6Al-4V"
[[support]]
plane = { point = [0, 0, 0], normal = [1, 0, 0] }
fixed = true
[[case]]
name = "down"
[[case.load]]
plane = { point = [20, 0, 0], normal = [1, 0, 0] }
force = [0, 0, -100]
"""


def test_a_part_shows_itself_in_a_notebook() -> None:
    box = trimesh.creation.box((20, 20, 10))
    part = volfrep.fill(box, cell="BCC", cell_size=10, strut_radius=1, shell=0, resolution=8)
    assert part.nodes.shape == (len(part.struts.nodes), 3)
    assert f"{part.report.struts:,} struts" in repr(part)
    shown = part._repr_html_()
    assert shown.count("<path ") == len(part.struts.struts)
    assert f"<td>{part.report.struts}</td>" in shown
    assert part.properties().relative_density == volfrep.properties("BCC", 10, 1).relative_density
    assert part.fields["to_surface"].max() <= 10.0


def test_layers_of_a_part(tmp_path: Path) -> None:
    box = trimesh.creation.box((20, 20, 10))
    part = volfrep.fill(box, cell="BCC", cell_size=10, strut_radius=1, shell=1, resolution=8)
    assert part.layers(tmp_path / "layers", layer=1.0, pixel=0.5).count == 10
    with pytest.raises(volfrep.VolfrepError, match="no format 'tif'"):
        part.layers(tmp_path / "more", layer=1.0, form="tif")


def test_struts_are_sized_for_loads(tmp_path: Path) -> None:
    (tmp_path / "loads.toml").write_text(LOADS, encoding="utf-8")
    box = trimesh.creation.box(bounds=((0, 0, 0), (20, 10, 10)))
    part = volfrep.size(
        box, tmp_path / "loads.toml", cell="CVC", cell_size=5, strut_radius=0.5, shell=0,
        boundary="whole", activation="inside", resolution=8, safety=3, steps=5, proof=False,
    )  # fmt: skip
    assert part.sized is not None
    assert part.struts.radii.min() < part.struts.radii.max()


def test_a_goal_that_there_is_not(tmp_path: Path) -> None:
    with pytest.raises(volfrep.VolfrepError, match="did you mean 'max_stress'"):
        volfrep.size(
            trimesh.creation.box((9, 9, 9)),
            tmp_path / "loads.toml",
            max_stres=3,  # type: ignore[call-arg]
        )
