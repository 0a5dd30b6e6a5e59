# SPDX-License-Identifier: LGPL-2.1-or-later
"""A part seen cut open: skin, lattice and cut faces, each in a colour of its own.

pyvista draws; it is an optional package.
"""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from ..design.spec import LatticeSpec
from ..mesh.booleans import difference
from ..mesh.triangle_mesh import TriangleMesh
from ..util.errors import VolfrepError
from ..util.files import check_writable, replacing
from ..util.packages import package
from ..util.types import Bools, Floats
from . import facet_roles

if TYPE_CHECKING:
    import pyvista

#: The colours, as the README's picture has them.
SKIN, WALL, LATTICE, CUT = "#b8c2d1", "#ccd1db", "#3380db", "#fa9429"
#: The viewer looks from here, with z up; the eighth of the part towards him is cut away.
VIEW = np.array([1.0, -1.3, 0.8])
SIZE = (1400, 900)
#: Places beside the viewer, and how bright.
LIGHTS = (((-0.5, 1.0, 0.9), 0.95), ((1.0, 0.25, 0.6), 0.42), ((0.0, -0.6, 1.0), 0.3))
#: Edges sharper than this stay sharp, degrees.
FEATURE_ANGLE = 40.0
#: Facets this near to a surface lie on it, in units of the part's diagonal.
ON_SURFACE = 1e-5


def picture(
    mesh: TriangleMesh,
    spec: LatticeSpec,
    file: str | os.PathLike[str] | None = None,
    *,
    solid: TriangleMesh | None = None,
    cut: bool = True,
    size: tuple[int, int] = SIZE,
) -> None:
    """Draw a part into a PNG, or show it in a window.

    Args:
        mesh: what was made, mm.
        spec: of what.
        file: the PNG to write, beside it first and then renamed; None opens a window, or shows
            the picture in a notebook.
        solid: the part before it was filled, by which skin and lattice are told apart; None for a
            lattice without a skin.
        cut: whether the eighth towards the viewer is cut away.
        size: of the picture, pixels.

    Raises:
        VolfrepError: pyvista is missing, the name does not end in .png, or it cannot be written.
    """
    stage = new_stage(file, size)
    for triangles, colour, ambient in _colour_parts(mesh, spec, solid, cut):
        if len(triangles.triangles):
            add_surface(stage, triangles, colour, ambient)
    show_stage(stage, file)


def new_stage(file: str | os.PathLike[str] | None, size: tuple[int, int] = SIZE) -> Any:
    """An empty scene of pyvista, lit, for a PNG or, without one, for a window.

    Raises:
        VolfrepError: pyvista is missing, the name does not end in .png, or it cannot be written.
    """
    library = drawing_library()
    if file is not None:
        check_picture(file)
    stage = library.Plotter(off_screen=file is not None, window_size=list(size), lighting="none")
    stage.set_background("white")
    for place, intensity in LIGHTS:
        light = library.Light(light_type="camera light", intensity=intensity)
        light.position = place
        stage.add_light(light)
    return stage


def add_surface(stage: Any, mesh: TriangleMesh, colour: str, ambient: float = 0.25) -> None:
    """Put a mesh into a scene: of its colour so much is not shaded."""
    stage.add_mesh(
        _surface(drawing_library(), mesh), color=colour, ambient=ambient, diffuse=1.0 - ambient,
        specular=0.12, specular_power=25, smooth_shading=True, split_sharp_edges=True,
        feature_angle=FEATURE_ANGLE,
    )  # fmt: skip


def show_stage(
    stage: Any, file: str | os.PathLike[str] | None, *, y_up: bool = False, zoom: float = 1.35
) -> None:
    """Look at all of a scene, and write it or open it in a window.

    Args:
        stage: the scene.
        file: the PNG to write; None opens a window.
        y_up: whether y is up, and not z.
        zoom: how much of the picture is filled.

    Raises:
        VolfrepError: nothing can be drawn here, or the file cannot be written.
    """
    stage.enable_anti_aliasing("ssaa")
    stage.enable_parallel_projection()
    view, up = VIEW, np.array([0.0, 0.0, 1.0])
    if y_up:
        view, up = (vector[[0, 2, 1]] * (1.0, 1.0, -1.0) for vector in (view, up))
    stage.camera_position = [tuple(view), (0.0, 0.0, 0.0), tuple(up)]
    stage.reset_camera()
    stage.camera.zoom(zoom)
    if file is None:
        stage.show()
        return
    image = stage.screenshot(return_img=True)
    stage.close()
    if image.min() == image.max():
        raise VolfrepError("The picture came out empty: pyvista found no way to draw here.")
    from PIL import Image  # comes with pyvista

    with replacing(file) as target:
        Image.fromarray(image).save(target, format="PNG", optimize=True)


def check_picture(file: str | os.PathLike[str]) -> None:
    """Refuse, before any work, a picture that could not be made.

    Raises:
        VolfrepError: pyvista is missing, the name does not end in .png, or it cannot be written.
    """
    drawing_library()
    if check_writable(file).suffix.lower() != ".png":
        raise VolfrepError(f"Cannot write '{file}': a picture's name ends in .png.")


def drawing_library() -> Any:
    """The package that draws, pyvista.

    Raises:
        VolfrepError: it is missing; the text says how to install it.
    """
    return package("pyvista", "A picture")


def _colour_parts(
    mesh: TriangleMesh, spec: LatticeSpec, solid: TriangleMesh | None, cut: bool
) -> list[tuple[TriangleMesh, str, float]]:
    """Parts of the mesh, each with its colour and how much of it is not shaded."""
    near = ON_SURFACE * float(np.linalg.norm(np.ptp(mesh.bounds, axis=0)))
    faces: Bools = np.zeros(len(mesh.triangles), bool)
    if cut:
        low, high = mesh.bounds
        middle = 0.5 * (low + high)
        corner = np.where(VIEW > 0.0, high, low)
        away = corner + 0.1 * (corner - middle)
        mesh = difference(mesh, _box(np.minimum(middle, away), np.maximum(middle, away)))
        corners = mesh.vertices[mesh.triangles]
        # Cut faces lie in the planes through the middle, within the box that went.
        inside = ((corners - middle) * np.sign(VIEW) > -near).all(axis=(1, 2))
        flat = (np.abs(corners - middle) < near).all(axis=1).any(axis=1)
        faces = inside & flat
    kinds = np.full(len(mesh.triangles), facet_roles.LATTICE, np.uint8)
    if solid is not None:
        kinds = facet_roles.kinds_of_triangles(mesh, solid, spec)
    skin, wall, lattice = (
        (kinds == kind) & ~faces
        for kind in (facet_roles.OUTSIDE, facet_roles.WALL, facet_roles.LATTICE)
    )
    # A flat cut reads better in an even colour than in a shaded one.
    parts = ((skin, SKIN, 0.25), (wall, WALL, 0.25), (lattice, LATTICE, 0.25), (faces, CUT, 0.75))
    return [
        (TriangleMesh(mesh.vertices, mesh.triangles[chosen]), colour, ambient)
        for chosen, colour, ambient in parts
    ]


def _box(low: Floats, high: Floats) -> TriangleMesh:
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float)
    sides = np.array(
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    )
    triangles = np.concatenate([sides[:, [0, 1, 2]], sides[:, [0, 2, 3]]]).astype(np.int32)
    return TriangleMesh(low + corners * (high - low), triangles)


def _surface(library: Any, mesh: TriangleMesh) -> pyvista.PolyData:
    used, index = np.unique(mesh.triangles, return_inverse=True)
    surface: pyvista.PolyData = library.PolyData.from_regular_faces(
        mesh.vertices[used], index.reshape(-1, 3)
    )
    return surface
