# SPDX-License-Identifier: LGPL-2.1-or-later
"""What holds for every lattice that is made, and for every refusal."""

from dataclasses import asdict

import pytest

from volfrep import LatticeSpec, StageCache, VolfrepError
from volfrep.io.write.stl import as_read
from volfrep.jobs.pipeline import fill
from volfrep.mesh import quality
from volfrep.mesh.quality import Quality
from volfrep.mesh.triangle_mesh import TriangleMesh


def check_contract(
    solid: TriangleMesh,
    spec: LatticeSpec,
    refusals: tuple[str, ...],
    cache: StageCache | None = None,
) -> None:
    """One closed surface, also as a reader sees it; or a sentence that holds one of the words."""
    refusal = ""
    try:
        result = fill(solid, spec, cache=cache)
    except VolfrepError as error:
        refusal = str(error)
    if refusal:
        assert any(word in refusal for word in refusals), refusal
        return
    report, read = result.report, quality.measure(as_read(result.mesh))
    assert report.watertight
    assert read.watertight
    assert read.degenerate_triangles == 0
    assert (read.bodies, read.genus) == (report.bodies, report.genus)
    if spec.with_skin:  # without, whole cells reach from one body into the next
        assert report.bodies == quality.measure(solid).bodies


def assert_same_quality(one: Quality, two: Quality) -> None:
    """Counts are equal; volume, area and bounds agree up to rounding."""
    first, second = asdict(one), asdict(two)
    for name in ("volume", "area", "bounds"):
        assert first.pop(name) == pytest.approx(second.pop(name), rel=1e-9, abs=1e-9), name
    assert first == second
