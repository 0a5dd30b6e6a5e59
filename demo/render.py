# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures for the README, with VTK on a virtual screen.

    xvfb-run python demo/render.py cutaway PART.stl SOLID.stl SHELL PICTURE.png
    xvfb-run python demo/render.py cells PICTURE.png
    xvfb-run python demo/render.py graded PICTURE.png
    xvfb-run python demo/render.py deformed PICTURE.png
    PYTHONPATH=.cache/plot xvfb-run -a python demo/render.py loads PICTURE.png
    PYTHONPATH=.cache/plot xvfb-run -a python demo/render.py sized FOLDER

The first cuts a corner out of a filled part so that its skin, its lattice and the cut faces are
seen, each in a colour of its own; the second shows the library's unit cells with their names; the
third blocks whose cells or struts vary; the fourth the paper's sample, pulled (see docs/solver.md);
the fifth the load cases of a bracket (see docs/loads.md); the sixth sizes that bracket's struts for
them, which takes minutes, and makes the pictures of it (see docs/sizing.md).
"""

from __future__ import annotations

import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import manifold3d
import numpy as np
import trimesh
import vtk
from numpy.typing import NDArray
from PIL import Image
from scipy.spatial import cKDTree
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from volfrep import LatticeSpec
from volfrep.design.cells import LIBRARY
from volfrep.design.grading import CellMap, Orientation, RadiusGrading, SizeGrading
from volfrep.design.profile import Profile
from volfrep.fem.calculix import solve
from volfrep.fem.deck import write_tetrahedra
from volfrep.fem.joint_loads import balls_of
from volfrep.fem.tet_mesh import tetrahedra
from volfrep.jobs.blocks import block, block_wireframe
from volfrep.mesh.triangle_mesh import TriangleMesh

Colour = tuple[float, float, float]
SKIN: Colour = (0.72, 0.76, 0.82)
WALL: Colour = (0.80, 0.82, 0.86)
LATTICE: Colour = (0.20, 0.50, 0.86)
CELL: Colour = (0.34, 0.62, 0.92)
CUT: Colour = (0.98, 0.58, 0.16)

#: Rendered this many times larger and scaled down: smooth edges without the driver's help.
OVERSAMPLING = 2
#: Edges sharper than this stay sharp, in degrees.
FEATURE_ANGLE = 40.0


def cutaway(part_file: str, solid_file: str, shell: float, picture: str) -> None:
    """Cut the corner towards the viewer out of a part and picture what remains.

    Args:
        part_file: STL of the filled part.
        solid_file: STL of the solid before it was filled; tells skin from lattice.
        shell: thickness of the skin, mm.
        picture: PNG to write.
    """
    part = _read(part_file)
    solid = _read(solid_file)
    low, high = solid.bounds
    length, height, width = high - low
    # One cut lengthwise through the front lug, one across it: the corner between them goes.
    corner = low + np.array([0.40 * length, -0.1 * height, 0.725 * width])
    mesh, is_cut = _remove_box(part, corner, np.array([length, 1.2 * height, width]))

    samples = trimesh.sample.sample_surface_even(
        trimesh.Trimesh(solid.vertices, solid.triangles, process=False), 400_000, seed=1
    )[0]
    depth = cKDTree(samples).query(mesh.vertices, workers=-1)[0][mesh.triangles]
    is_skin = (depth < 0.25 * shell).all(axis=1) & ~is_cut
    is_wall = ((depth > 0.9 * shell) & (depth < 1.12 * shell)).all(axis=1) & ~is_cut
    is_lattice = ~(is_skin | is_wall | is_cut)

    scene = _Scene((1400, 860), ambient_occlusion_radius=9.0)
    for selected, colour in (
        (is_skin, SKIN),
        (is_wall, WALL),
        (is_lattice, LATTICE),
        (is_cut, CUT),
    ):
        if selected.any():
            # The cut faces are flat: an even colour reads better there than a shaded one.
            scene.add(mesh, selected, colour, ambient=0.75 if colour is CUT else 0.25)
    scene.look(direction=(0.62, 0.62, 1.0), up=(0.0, 1.0, 0.0), zoom=1.66, raised=0.10)
    scene.save(picture)


def cells(picture: str) -> None:
    """Picture every cell of the library as a free-standing block of one, with its name."""
    size, columns = 10.0, 7
    scene = _Scene((1600, 1000))
    for k, name in enumerate(LIBRARY):
        row, column = divmod(k, columns)
        radius = 0.8 if len(LIBRARY[name].struts) < 40 else 0.5
        spec = LatticeSpec(cell=name, cell_size=size, strut_radius=radius, resolution=40)
        mesh = block(spec, (1, 1, 1)).mesh
        place = np.array([2.0 * size * column, -2.25 * size * row, 0.0])
        # Turned in place, so that every cell is seen from the same side, with z upwards.
        upright = np.array([[1.0, 0, 0], [0, 0, 1], [0, -1, 0]])
        turned = (mesh.vertices - mesh.bounds.mean(axis=0)) @ (_turn(-28.0, 20.0) @ upright).T
        scene.add(TriangleMesh(turned + place, mesh.triangles), None, CELL, ambient=0.0)
        label = name.replace(" ", "\n").replace("cubo", "cubo-\n") if len(name) > 13 else name
        below = 0.95 + 0.17 * label.count("\n") + 0.1
        scene.label(label, place + np.array([0.0, -below * size, 0.0]))
    scene.look(direction=(0.0, 0.0, 1.0), up=(0.0, 1.0, 0.0), zoom=1.62)
    scene.save(picture)


def graded(picture: str) -> None:
    """Picture what may vary in a lattice, one block each."""
    linear = SizeGrading(Profile("linear", 1.0, 1.8))
    thicker = RadiusGrading("direction", Profile("linear", 0.4, 1.3))
    asked: tuple[tuple[str, dict[str, Any], tuple[int, int, int]], ...] = (
        ("size, round struts", {"size_grading": linear}, (4, 3, 2)),
        ("size, struts deformed", {"size_grading": linear, "keep_radius": False}, (4, 3, 2)),
        ("radius", {"radius_grading": thicker}, (6, 3, 2)),
        ("turned", {"orientation": Orientation((0, 0, 1), 30.0)}, (5, 3, 2)),
        ("cylindrical", {"cell_map": CellMap("cylindrical")}, (2, 16, 2)),
        ("spherical", {"cell_map": CellMap("spherical"), "strut_radius": 0.5}, (1, 5, 16)),
    )
    scene = _Scene((1200, 720))
    for k, (name, grading, count) in enumerate(asked):
        row, column = divmod(k, 3)
        spec = LatticeSpec("BCC", **({"strut_radius": 0.7, "resolution": 24} | grading))
        mesh = block(spec, count).mesh
        place = np.array([82.0 * column, -80.0 * row, 0.0])
        size = 60.0 / np.ptp(mesh.bounds, axis=0)[:2].max()
        turned = size * (mesh.vertices - mesh.bounds.mean(axis=0)) @ _turn(-16.0, 34.0).T + place
        scene.add(TriangleMesh(turned, mesh.triangles), None, CELL, ambient=0.0)
        scene.label(name, place + np.array([0.0, -37.0, 0.0]))
    scene.look(direction=(0.0, 0.0, 1.0), up=(0.0, 1.0, 0.0), zoom=1.85)
    scene.save(picture)


def deformed(picture: str) -> None:
    """Picture the paper's sample under 200 N: its displacement, five times enlarged.

    Gmsh and CalculiX must be installed; about half a minute.
    """
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
    from bench.static_step import joint_step

    spec = LatticeSpec(cell="CVC", cell_size=20.0, strut_radius=2.0, resolution=20)
    count, force = (3, 2, 1), (200.0, 0.0, 0.0)
    mesh, frame = block(spec, count).mesh, block_wireframe(spec, count)
    filled = tetrahedra(mesh)
    x = frame.nodes[:, 0]
    fixed = balls_of(filled, frame, np.flatnonzero(x < 1e-6))
    loaded = balls_of(filled, frame, np.flatnonzero(x > 60.0 - 1e-6))
    with tempfile.TemporaryDirectory() as folder:
        deck = Path(folder) / "sample.inp"
        write_tetrahedra(filled, deck)
        joint_step(fixed, loaded, force).add_to(deck, of_beams=False)
        moved = solve(deck)
    own = moved[cKDTree(filled.nodes).query(mesh.vertices)[1]]
    size = np.linalg.norm(own, axis=1)
    scene = _Scene((1200, 560))
    scene.add(mesh, None, (0.86, 0.88, 0.90), opacity=0.35)
    enlarged = TriangleMesh(mesh.vertices + 5.0 * own, mesh.triangles)
    scene.add(enlarged, None, CELL, values=size)
    scene.look(direction=(0.35, -1.0, 0.75), up=(0.0, 0.0, 1.0), zoom=1.5)
    scene.scale("displacement, mm", float(size.max()))
    scene.save(picture)


class _Scene:
    """A white stage, lit from above the viewer's shoulder, seen without perspective."""

    def __init__(self, size: tuple[int, int], ambient_occlusion_radius: float = 0.0) -> None:
        self.size = size
        self.renderer = vtk.vtkRenderer()
        self.renderer.SetBackground(1.0, 1.0, 1.0)
        self.renderer.AutomaticLightCreationOff()
        for position, intensity in (
            ((-0.5, 1.0, 0.9), 0.95),
            ((1.0, 0.25, 0.6), 0.42),
            ((0.0, -0.6, 1.0), 0.22),
        ):
            light = vtk.vtkLight()
            light.SetLightTypeToCameraLight()
            light.SetPosition(*position)
            light.SetIntensity(intensity)
            self.renderer.AddLight(light)
        if ambient_occlusion_radius > 0.0:
            shade = vtk.vtkSSAOPass()
            shade.SetRadius(ambient_occlusion_radius)
            shade.SetBias(0.02 * ambient_occlusion_radius)
            shade.SetKernelSize(96)
            shade.BlurOn()
            shade.SetDelegatePass(vtk.vtkRenderStepsPass())
            self.renderer.SetPass(shade)
        self.window = vtk.vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*(OVERSAMPLING * side for side in size))
        self.window.AddRenderer(self.renderer)

    def add(
        self,
        mesh: TriangleMesh,
        selected: NDArray[np.bool_] | None,
        colour: Colour,
        ambient: float = 0.25,
        opacity: float = 1.0,
        values: NDArray[np.float64] | None = None,
    ) -> None:
        triangles = mesh.triangles if selected is None else mesh.triangles[selected]
        data = vtk.vtkPolyData()
        points = vtk.vtkPoints()
        points.SetData(numpy_to_vtk(mesh.vertices, deep=True))
        data.SetPoints(points)
        table = np.insert(triangles.astype(np.int64), 0, 3, axis=1)
        faces = vtk.vtkCellArray()
        faces.SetCells(len(triangles), numpy_to_vtkIdTypeArray(table.ravel(), deep=True))
        data.SetPolys(faces)
        normals = vtk.vtkPolyDataNormals()
        normals.SetInputData(data)
        normals.SetFeatureAngle(FEATURE_ANGLE)
        normals.ConsistencyOff()
        mapper = vtk.vtkPolyDataMapper()
        mapper.SetInputConnection(normals.GetOutputPort())
        if values is None:
            mapper.ScalarVisibilityOff()
        else:
            data.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
            mapper.SetLookupTable(_rainbow())
            mapper.SetScalarRange(0.0, float(values.max()))
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        look = actor.GetProperty()
        look.SetColor(*colour)
        look.SetAmbient(ambient)
        look.SetDiffuse(1.0 - ambient)
        look.SetSpecular(0.12)
        look.SetSpecularPower(25)
        look.SetOpacity(opacity)
        self.renderer.AddActor(actor)

    def label(self, text: str, place: NDArray[np.float64]) -> None:
        label = vtk.vtkBillboardTextActor3D()
        label.SetInput(text)
        label.SetPosition(*place)
        style = label.GetTextProperty()
        style.SetFontSize(26 * OVERSAMPLING)
        style.SetColor(0.2, 0.22, 0.26)
        style.SetJustificationToCentered()
        self.renderer.AddActor(label)

    def scale(self, title: str, most: float) -> None:
        """A bar of the colours of the values from 0 to `most`."""
        table = _rainbow()
        table.SetTableRange(0.0, most)
        bar = vtk.vtkScalarBarActor()
        bar.SetLookupTable(table)
        bar.SetTitle(title)
        bar.SetNumberOfLabels(5)
        bar.SetLabelFormat("%.1f")
        bar.UnconstrainedFontSizeOn()
        bar.SetPosition(0.86, 0.12)
        bar.SetWidth(0.08)
        bar.SetHeight(0.76)
        for style, points in ((bar.GetTitleTextProperty(), 20), (bar.GetLabelTextProperty(), 20)):
            style.SetFontSize(points * OVERSAMPLING)
            style.SetColor(0.2, 0.22, 0.26)
            style.ItalicOff()
            style.BoldOff()
            style.ShadowOff()
        self.renderer.AddViewProp(bar)

    def look(
        self, direction: Sequence[float], up: Sequence[float], zoom: float, raised: float = 0.0
    ) -> None:
        camera = self.renderer.GetActiveCamera()
        camera.ParallelProjectionOn()
        camera.SetPosition(*direction)
        camera.SetFocalPoint(0.0, 0.0, 0.0)
        camera.SetViewUp(*up)
        self.renderer.ResetCamera()
        camera.Zoom(zoom)
        camera.SetWindowCenter(0.0, -raised)
        self.renderer.ResetCameraClippingRange()

    def save(self, picture: str) -> None:
        self.window.Render()
        grab = vtk.vtkWindowToImageFilter()
        grab.SetInput(self.window)
        grab.ReadFrontBufferOff()
        grab.Update()
        image = grab.GetOutput()
        wide, high, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(high, wide, -1)[::-1]
        if int(pixels.min()) == int(pixels.max()):
            raise RuntimeError(f"The picture {picture} came out empty: is there a screen?")
        full = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
        small = full.resize(self.size, Image.LANCZOS)
        small.quantize(255, method=Image.MEDIANCUT, dither=Image.FLOYDSTEINBERG).save(
            picture, optimize=True
        )


def _rainbow() -> Any:
    """Blue for nothing, red for the most."""
    table = vtk.vtkLookupTable()
    table.SetHueRange(0.62, 0.0)
    table.SetSaturationRange(0.75, 0.85)
    table.Build()
    return table


def _read(path: str) -> TriangleMesh:
    mesh = trimesh.load(path, process=True)
    return TriangleMesh(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int32))


def _remove_box(
    part: TriangleMesh, corner: NDArray[np.float64], size: NDArray[np.float64]
) -> tuple[TriangleMesh, NDArray[np.bool_]]:
    """The part less a box, and which of its triangles the box left behind."""
    body = manifold3d.Manifold(
        manifold3d.Mesh(part.vertices.astype(np.float32), part.triangles.astype(np.uint32))
    )
    tool = manifold3d.Manifold.cube(tuple(size)).translate(tuple(corner)).as_original()
    rest = (body - tool).to_mesh()
    owner = np.repeat(rest.run_original_id, np.diff(rest.run_index) // 3)
    mesh = TriangleMesh(
        np.asarray(rest.vert_properties[:, :3], float), np.asarray(rest.tri_verts, np.int32)
    )
    return mesh, owner == tool.original_id()


def loads(picture: str) -> None:
    """Picture the load cases of demo/bracket_loads.toml, with pyvista (see tools/setup.sh)."""
    root = Path(__file__).resolve().parents[1]
    sys.path[:0] = [str(root), str(root / ".cache" / "plot")]
    from load_picture import load_picture

    from bench.parts import lug_bracket
    from volfrep.loads.load_file import read_load_cases

    bracket = lug_bracket()
    cases = read_load_cases(Path(__file__).with_name("bracket_loads.toml"), bracket).cases
    size = (900, 640)
    sheet = Image.new("RGB", (2 * size[0], 2 * size[1]), "white")
    with tempfile.TemporaryDirectory() as folder:
        for k, case in enumerate(cases):
            file = Path(folder) / f"{k}.png"
            load_picture(bracket, case, file, size=size, y_up=True)
            row, column = divmod(k, 2)
            sheet.paste(Image.open(file), (column * size[0], row * size[1]))
    sheet.resize(size, Image.LANCZOS).save(picture, optimize=True)


def sized(folder: str) -> None:
    """Pictures of the bracket of docs/bracket.md: radii, stress before and after, the steps."""
    root = Path(__file__).resolve().parents[1]
    sys.path[:0] = [str(root), str(root / ".cache" / "plot")]
    from bench.parts import modelled_file
    from volfrep.io.solid import read_solid
    from volfrep.jobs.sizing import Goal, size
    from volfrep.loads.load_file import read_load_cases
    from volfrep.reports.sizing_picture import sizing_picture
    from volfrep.reports.sizing_plot import write_sizing_plot
    from volfrep.sizing.analysis import Limits

    bracket = read_solid(modelled_file("bracket", root / "build" / "parts"))
    wide = (1400, 900)
    loads = read_load_cases(Path(__file__).with_name("bracket_loads.toml"), bracket)
    spec = LatticeSpec("CVC", cell_size=15, strut_radius=1.5, shell=1.5)
    assert loads.material.yield_stress is not None
    goal = Goal(Limits(stress=loads.material.yield_stress / 1.5), thinnest=0.5, skin_thinnest=0.8)
    made = size(bracket, spec, loads, goal)
    for name, value in made.report.items():
        if name != "steps":
            print(name, value)
    out = Path(folder)
    write_sizing_plot(made.report, out / "sized_bracket_steps.svg")
    one, most = made.sized.analysis, float(made.sized.analysis.stress[:, :, 0].max())
    file = out / "sized_bracket.png"
    sizing_picture(made.model, one, file, size=wide, y_up=True)
    _smaller(Image.open(file), 2).save(file, optimize=True)
    skin = out / "sized_bracket_skin.png"
    sizing_picture(made.model, one, skin, colour="skin", size=wide, y_up=True)
    _smaller(Image.open(skin), 2).save(skin, optimize=True)
    sheet = Image.new("RGB", (wide[0], 2 * wide[1]), "white")
    for row, design in enumerate((made.before, one)):
        sizing_picture(
            made.model, design, file.with_name("part.png"), colour="stress", case=0, size=wide,
            y_up=True, deformed=20.0, scale=(0.0, most),
        )  # fmt: skip
        sheet.paste(Image.open(file.with_name("part.png")), (0, row * wide[1]))
    file.with_name("part.png").unlink()
    _smaller(sheet, 2).save(out / "sized_bracket_stress.png", optimize=True)


def _smaller(picture: Image.Image, times: int) -> Image.Image:
    return picture.convert("RGB").resize(
        (picture.width // times, picture.height // times), Image.LANCZOS
    )


def _turn(about_y: float, about_x: float) -> NDArray[np.float64]:
    """Rotation about Y, then about X, in degrees."""
    a, b = np.radians([about_y, about_x])
    yaw = np.array([[np.cos(a), 0, np.sin(a)], [0, 1, 0], [-np.sin(a), 0, np.cos(a)]])
    pitch = np.array([[1, 0, 0], [0, np.cos(b), -np.sin(b)], [0, np.sin(b), np.cos(b)]])
    rotation: NDArray[np.float64] = pitch @ yaw
    return rotation


PICTURES = {"cells": cells, "graded": graded, "deformed": deformed, "loads": loads, "sized": sized}


def main(arguments: list[str]) -> None:
    """Dispatch on the first argument."""
    kind, *rest = arguments
    if kind == "cutaway":
        part, solid, shell, picture = rest
        cutaway(part, solid, float(shell), picture)
    elif kind in PICTURES:
        PICTURES[kind](*rest)
    else:
        raise SystemExit(f"There is no picture '{kind}': choose cutaway, {', '.join(PICTURES)}.")


if __name__ == "__main__":
    main(sys.argv[1:])
