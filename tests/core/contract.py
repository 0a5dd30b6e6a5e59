# SPDX-License-Identifier: LGPL-2.1-or-later
"""What holds for every lattice that is made, and for every refusal."""

from volfrep import LatticeSpec, StageCache, VolfrepError, fill, quality
from volfrep.export.stl import as_read
from volfrep.mesh import TriangleMesh


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
    if spec.output == "part":
        assert report.bodies == quality.measure(solid).bodies
