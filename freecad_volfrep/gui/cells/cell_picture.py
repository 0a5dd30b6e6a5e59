# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of unit cells, drawn from their nodes and struts."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from freecad_volfrep.gui.qt import QtCore, QtGui

if TYPE_CHECKING:
    from volfrep.design.cells import UnitCell

#: Rows: to the right, up, and towards whoever looks, of x, y and z.
_VIEW = np.array([[0.87, -0.5, 0.0], [0.22, 0.37, 0.9], [0.45, 0.78, -0.43]])
_CUBE = [(a, b) for a in range(8) for b in range(a) if (a ^ b) in (1, 2, 4)]


def cell_icon(cell: UnitCell | None, size: int = 72) -> QtGui.QIcon:
    """The cell seen from a corner, in its cube: nearer struts darker and thicker.

    None stands for a cell that is not there yet: its cube is empty.
    """
    corners = np.array([[k & 1, k >> 1 & 1, k >> 2 & 1] for k in range(8)], float)
    placed = (corners - 0.5) @ _VIEW.T
    scale = 0.92 * size / np.ptp(placed[:, :2], axis=0).max()
    pixmap = QtGui.QPixmap(size, size)
    pixmap.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(pixmap)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    painter.translate(size / 2, size / 2)

    def line(a: Sequence[float], b: Sequence[float]) -> None:
        painter.drawLine(
            QtCore.QPointF(a[0] * scale, -a[1] * scale), QtCore.QPointF(b[0] * scale, -b[1] * scale)
        )

    painter.setPen(QtGui.QPen(QtGui.QColor(150, 150, 150), size / 72.0))
    for a, b in _CUBE:
        line(placed[a], placed[b])
    if cell is not None:
        nodes = (cell.nodes - 0.5) @ _VIEW.T
        depth = nodes[cell.struts, 2].mean(axis=1)
        order = np.argsort(depth)
        nearness = np.clip(depth[order] + 0.5, 0.0, 1.0).tolist()
        for near, ends in zip(nearness, nodes[cell.struts[order]].tolist(), strict=True):
            pen = QtGui.QPen(QtGui.QColor.fromHsv(210, 200, int(230 - 110 * near)))
            pen.setWidthF(size / 72.0 * (2.0 + 2.5 * near))
            pen.setCapStyle(QtCore.Qt.RoundCap)
            painter.setPen(pen)
            line(*ends)
    painter.end()
    return QtGui.QIcon(pixmap)


def tpms_icon(name: str, size: int = 72) -> QtGui.QIcon:
    """A cell of walls seen from a corner: where they meet the faces of its cube.

    Of a formula of one's own the cube is empty.
    """
    from volfrep.design.expression import compile_expression
    from volfrep.design.tpms import SURFACES
    from volfrep.tpms.midsurface import VARIABLES

    surface = SURFACES.get(name)
    if surface is None:
        return cell_icon(None, size)
    corners = np.array([[k & 1, k >> 1 & 1, k >> 2 & 1] for k in range(8)], float) - 0.5
    scale = np.ptp((corners @ _VIEW.T)[:, :2], axis=0).max() / (0.92 * size)
    x, y = np.meshgrid(np.arange(size) + 0.5 - size / 2, size / 2 - 0.5 - np.arange(size))
    start = scale * (x[..., None] * _VIEW[0] + y[..., None] * _VIEW[1])
    # Lines towards whoever looks leave the cube at the face that is seen.
    towards = np.cross(_VIEW[0], _VIEW[1])
    ends = (np.sign(towards) * 0.5 - start) / towards
    begins = (-np.sign(towards) * 0.5 - start) / towards
    face = ends.argmin(axis=2)
    point = start + ends.min(axis=2)[..., None] * towards
    seen = begins.max(axis=2) < ends.min(axis=2)
    formula = compile_expression(surface.formula, VARIABLES)
    value = np.abs(formula(*np.moveaxis(4.0 * np.pi * (point + 0.5), -1, 0)))
    solid = value < np.quantile(value[seen], 0.4)
    shade = np.array([0.75, 0.9, 1.0])[face]
    pixels = np.zeros((size, size, 4), np.uint8)
    for channel, (dark, light) in enumerate(((45, 225), (105, 230), (180, 238))):
        pixels[..., channel] = shade * np.where(solid, dark, light)
    pixels[..., 3] = np.where(seen, 255, 0)
    image = QtGui.QImage(pixels.tobytes(), size, size, 4 * size, QtGui.QImage.Format_RGBA8888)
    return QtGui.QIcon(QtGui.QPixmap.fromImage(image.copy()))


def graph_icon(kind: str, size: int = 72) -> QtGui.QIcon:
    """A graph lattice in the plane: between points, of a file, or in layers along faces.

    Args:
        kind: a value of the property `Network` other than Cells.
        size: of the picture, px.
    """
    from scipy.spatial import Delaunay, Voronoi

    pixmap = QtGui.QPixmap(size, size)
    pixmap.fill(QtCore.Qt.transparent)
    painter = QtGui.QPainter(pixmap)
    painter.setRenderHint(QtGui.QPainter.Antialiasing)
    painter.scale(size, size)
    points = np.random.default_rng(7).uniform(-0.2, 1.2, (60, 2))
    lines, frame = np.zeros((0, 2, 2)), QtGui.QPainterPath()
    frame.addRect(0.06, 0.06, 0.88, 0.88)
    if kind == "Voronoi":
        cells = Voronoi(points)
        lines = cells.vertices[[ridge for ridge in cells.ridge_vertices if min(ridge) >= 0]]
    elif kind == "Delaunay":
        corners = Delaunay(points[:30]).simplices
        lines = points[np.concatenate([corners[:, [a, b]] for a, b in ((0, 1), (1, 2), (2, 0))])]
    elif kind == "File":
        frame = QtGui.QPainterPath(QtCore.QPointF(0.18, 0.06))
        for x, y in ((0.62, 0.06), (0.82, 0.26), (0.82, 0.94), (0.18, 0.94)):
            frame.lineTo(x, y)
        frame.closeSubpath()
        nodes = np.array([[0.32, 0.78], [0.42, 0.4], [0.68, 0.56], [0.68, 0.82], [0.3, 0.2]])
        lines = nodes[[[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 4]]]
    elif kind == "Faces":
        along = np.linspace(0.06, 0.94, 6)
        arch = 0.5 - 2.0 * (along - 0.5) ** 2
        rows = [np.stack([along, 0.9 - arch * 0.9 - 0.24 * row], axis=1) for row in range(3)]
        frame = QtGui.QPainterPath()
        for row in (rows[0], rows[2]):
            frame.moveTo(*row[0])
            for x, y in row[1:]:
                frame.lineTo(x, y)
        pairs = [(a[k], b[k + 1]) for a, b in ((rows[0], rows[1]), (rows[1], rows[2]),
                 (rows[1], rows[0]), (rows[2], rows[1])) for k in range(5)]  # fmt: skip
        lines = np.array(pairs)
    painter.setPen(QtGui.QPen(QtGui.QColor(150, 150, 150), 0.02))
    painter.drawPath(frame)
    if kind in ("Voronoi", "Delaunay"):
        painter.setClipPath(frame)
    pen = QtGui.QPen(QtGui.QColor.fromHsv(210, 200, 170), 0.05)
    pen.setCapStyle(QtCore.Qt.RoundCap)
    painter.setPen(pen)
    for a, b in lines:
        painter.drawLine(QtCore.QPointF(*a), QtCore.QPointF(*b))
    painter.end()
    return QtGui.QIcon(pixmap)
