# SPDX-License-Identifier: LGPL-2.1-or-later
"""3MF: the objects of the build, each where the build puts it, in the file's unit.

After the 3MF Core Specification 1.3 and the paths of its Production Extension. The lists of
vertices and triangles are taken out of the text and read as columns; what is left, a short
document, goes through an XML parser. Nothing that could make the text grow (a document type,
entities) is accepted, and no part is unpacked to more than its size in the zip warrants.
"""

from __future__ import annotations

import io
import lzma
import posixpath
import re
import struct
import zipfile
import zlib
from dataclasses import dataclass
from xml.etree import ElementTree

import numpy as np

from ...mesh.triangle_mesh import TriangleMesh, concatenate, empty_mesh
from ...util.errors import VolfrepError
from ...util.linalg import determinants, times
from ...util.types import Floats
from .contents import Contents, as_numbers, as_words, damaged
from .units import unit_named

#: A part of the zip may unpack to this many times its packed size (meshes reach about 30), or to
#: a few bytes anyway, and never to more than so many: what is made of it takes eight times that.
MOST_GROWTH = 200
SMALL_PART = 1_000_000
LARGEST_PART = 500_000_000
DAMAGE = (ValueError, OSError, EOFError, NotImplementedError, RuntimeError, struct.error)
#: An assembly may repeat its objects to no more triangles than this.
MAX_TRIANGLES = 20_000_000
MAX_DEPTH = 32
MAX_INSTANCES = 10_000
_RELATIONSHIPS = "_rels/.rels"
_MODEL_TYPE = "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"
_LIST = re.compile(rb"<((?:[\w.-]+:)?(?:vertices|triangles))(?:\s[^<>]*)?(?<!/)>")
_COMMENT = re.compile(rb"<!--.*?-->", re.DOTALL)
_CDATA = re.compile(rb"<!\[CDATA\[.*?\]\]>", re.DOTALL)


@dataclass(frozen=True, eq=False)
class _Component:
    """An object in its place: as one of an assembly, or of the build."""

    key: tuple[str, str]
    matrix: Floats


@dataclass(frozen=True, eq=False)
class _Object:
    mesh: TriangleMesh
    components: tuple[_Component, ...]
    is_part: bool
    has_beams: bool


Objects = dict[tuple[str, str], _Object]


def read_3mf(data: bytes, name: str) -> Contents:
    """The triangles of all objects that a 3MF file builds.

    Args:
        data: the whole file.
        name: of the file, for messages.

    Raises:
        VolfrepError: the file is damaged, hostile, or builds no triangles.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as package:
            return _read_package(package, name)
    except VolfrepError:
        raise
    # What zipfile raises at damage, beside its own error: it checks few of a directory's numbers.
    except (zipfile.BadZipFile, zlib.error, lzma.LZMAError, *DAMAGE) as error:
        raise damaged(name, "it is no zip file that can be unpacked") from error


def _read_package(package: zipfile.ZipFile, name: str) -> Contents:
    root = _model_path(package, name)
    objects: Objects = {}
    model = _read_model(package, root, objects, name)
    text = model.get("unit", "millimeter")
    unit = unit_named(text)
    if unit is None:
        raise damaged(name, f"its unit '{text[:40]}' is none of the format's")
    build = _child(model, "build")
    items = [] if build is None else [_component(item, root, name) for item in build]
    known: set[str] = {root}
    waiting = {item.key[0] for item in items} | _paths(objects)
    while waiting - known:
        path = min(waiting - known)
        known.add(path)
        _read_model(package, path, objects, name)
        waiting |= _paths(objects)
    if not items:
        raise VolfrepError(f"'{name}' builds no object: export the solid again.")
    budget = _Budget(name)
    meshes = [_assemble(item, objects, budget, 0) for item in items]
    return Contents(concatenate(empty_mesh(), *meshes), unit, tuple(budget.warnings))


def _model_path(package: zipfile.ZipFile, name: str) -> str:
    """Where the package keeps its model, after its relationships."""
    relations = _parse(_unpack(package, _RELATIONSHIPS, name), name)
    for relation in relations:
        if relation.get("Type") == _MODEL_TYPE:
            return _part(relation.get("Target", ""), "")
    raise damaged(name, "it names no 3D model")


def _part(path: str, beside: str) -> str:
    """The name in the zip of a part's path, which may be relative to another part."""
    if path.startswith("/"):
        return path.lstrip("/")
    return posixpath.normpath(posixpath.join(posixpath.dirname(beside), path))


def _unpack(package: zipfile.ZipFile, part: str, name: str) -> bytes:
    size = 0 if package.fp is None else package.fp.seek(0, io.SEEK_END)
    try:
        info = package.getinfo(part)
    except KeyError as error:
        raise damaged(name, f"its part '{part[:80]}' is missing") from error
    # The directory of the zip may claim anything; the file's own size does not lie.
    packed = min(info.compress_size, size)
    most = min(max(SMALL_PART, MOST_GROWTH * packed), LARGEST_PART)
    with package.open(info) as file:
        text = file.read(most + 1)
    if len(text) > most:
        raise VolfrepError(
            f"'{name}' is no ordinary file: its part '{part[:80]}' unpacks to more than "
            f"{most / 1e6:.0f} MB from {packed / 1e6:.2g} MB."
        )
    return text


def _parse(text: bytes, name: str) -> ElementTree.Element:
    # A declaration other than a comment can define entities, which may grow without bound.
    if b"<!" in text:
        raise VolfrepError(
            f"'{name}' holds an XML declaration of a document type, which 3MF does not allow: "
            "export it again."
        )
    try:
        return ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, LookupError) as error:
        raise damaged(name, "a part is no valid XML") from error


def _read_model(
    package: zipfile.ZipFile, path: str, objects: Objects, name: str
) -> ElementTree.Element:
    """Adds the objects of one part; returns the part's document without its long lists."""
    text = _unpack(package, path, name)
    if text.startswith((b"\xff\xfe", b"\xfe\xff")):
        text = text.decode("utf-16", "replace").encode()
        text = re.sub(rb"^<\?xml[^>]*\?>", b"", text)
    text = _CDATA.sub(b"", _COMMENT.sub(b"", text))
    short, lists = _without_lists(text, name)
    model = _parse(short, name)
    resources = _child(model, "resources")
    for element in [] if resources is None else resources:
        if _local(element) == "object":
            number = element.get("id", "")
            objects[path, number] = _object(element, path, lists, name)
    return model


def _without_lists(text: bytes, name: str) -> tuple[bytes, list[bytes]]:
    """The document with an empty element for each list, which tells where its text is kept."""
    pieces: list[bytes] = []
    lists: list[bytes] = []
    start = 0
    while (match := _LIST.search(text, start)) is not None:
        end = text.find(b"</" + match[1], match.end())
        close = text.find(b">", end)
        if end < 0 or close < 0:
            raise damaged(name, "it ends inside a list of vertices or triangles")
        pieces += [text[start : match.start()], b'<%b shelf="%d"/>' % (match[1], len(lists))]
        lists.append(text[match.end() : end])
        start = close + 1
    return b"".join([*pieces, text[start:]]), lists


def _local(element: ElementTree.Element) -> str:
    return element.tag.rpartition("}")[2]


def _child(element: ElementTree.Element, tag: str) -> ElementTree.Element | None:
    return next((child for child in element if _local(child) == tag), None)


def _object(element: ElementTree.Element, path: str, lists: list[bytes], name: str) -> _Object:
    mesh = _child(element, "mesh")
    assembly = _child(element, "components")
    components = [] if assembly is None else [_component(c, path, name) for c in assembly]
    return _Object(
        empty_mesh() if mesh is None else _mesh(mesh, lists, name),
        tuple(components),
        element.get("type", "model") in ("model", "solidsupport"),
        mesh is not None and _child(mesh, "beamlattice") is not None,
    )


def _component(element: ElementTree.Element, path: str, name: str) -> _Component:
    """A reference to an object, with the 4 x 3 matrix by which row vectors are multiplied."""
    other = next((v for k, v in element.items() if k.rpartition("}")[2] == "path"), None)
    matrix = np.eye(4, 3)
    given = element.get("transform")
    if given is not None:
        numbers = as_numbers(as_words(given.encode().split(), name), name)
        if numbers.size != 12 or not np.isfinite(numbers).all():
            raise damaged(name, "the place of an object is not given by twelve numbers")
        matrix = numbers.reshape(4, 3)
    number = element.get("objectid", "")
    return _Component((path if other is None else _part(other, path), number), matrix)


def _mesh(element: ElementTree.Element, lists: list[bytes], name: str) -> TriangleMesh:
    vertices = _columns(element, "vertices", ("x", "y", "z"), lists, name)
    index = _columns(element, "triangles", ("v1", "v2", "v3"), lists, name)
    outside = (index < 0) | (index >= len(vertices)) | (index != np.floor(index))
    if outside.any():
        raise damaged(name, "a triangle names a vertex that is not there")
    return TriangleMesh(vertices, index.astype(np.int32))


def _columns(
    element: ElementTree.Element, tag: str, keys: tuple[str, ...], lists: list[bytes], name: str
) -> Floats:
    """(n, 3) the values of three attributes of every element of a list."""
    child = _child(element, tag)
    shelf = None if child is None else child.get("shelf")
    if shelf is None or not shelf.isdigit() or int(shelf) >= len(lists):
        return np.zeros((0, 3))
    text = lists[int(shelf)]
    count = len(re.findall(rb"<(?:[\w.-]+:)?(?:vertex|triangle)[\s/>]", text))
    columns = [
        re.findall(rb"\s" + key.encode() + rb"\s*=\s*[\"']\s*([^\"'\s<>]*)\s*[\"']", text)
        for key in keys
    ]
    if any(len(column) != count for column in columns):
        raise damaged(name, f"an element of its {tag} lacks one of {', '.join(keys)}")
    flat = as_words([word for column in columns for word in column], name)
    return np.ascontiguousarray(as_numbers(flat, name).reshape(3, count).T)


def _paths(objects: Objects) -> set[str]:
    return {part.key[0] for item in objects.values() for part in item.components}


class _Budget:
    """How much an assembly has come to; assemblies of assemblies grow without bound."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.triangles = 0
        self.instances = 0
        self.warnings: list[str] = []

    def warn(self, note: str) -> None:
        """Tell it once."""
        if note not in self.warnings:
            self.warnings.append(note)

    def spend(self, item: _Object, depth: int) -> None:
        """Count one instance of an object.

        Raises:
            VolfrepError: the assembly is too deep or too large.
        """
        self.instances += 1
        self.triangles += len(item.mesh.triangles)
        if depth > MAX_DEPTH or self.instances > MAX_INSTANCES or self.triangles > MAX_TRIANGLES:
            raise VolfrepError(
                f"'{self.name}' builds an assembly of too many parts (the limits are "
                f"{MAX_INSTANCES} parts, {MAX_TRIANGLES / 1e6:.0f} million triangles, "
                f"{MAX_DEPTH} levels): export the solid by itself."
            )


def _assemble(place: _Component, objects: Objects, budget: _Budget, depth: int) -> TriangleMesh:
    item = objects.get(place.key)
    if item is None:
        raise damaged(budget.name, f"object '{place.key[1][:40]}' is missing")
    budget.spend(item, depth)
    if item.has_beams:
        if not len(item.mesh.triangles):
            raise VolfrepError(
                f"'{budget.name}' holds a lattice of beams, which is no solid of triangles: give "
                "the solid by itself, or a file of both."
            )
        budget.warn(
            f"'{budget.name}' holds beams beside its triangles, which were left out: in a file of "
            "both they are the same part."
        )
    if not item.is_part:
        budget.warn(
            f"Objects of '{budget.name}' that are no parts (supports, surfaces) were left out."
        )
        return empty_mesh()
    inside = [_assemble(part, objects, budget, depth + 1) for part in item.components]
    mesh = concatenate(item.mesh, *inside)
    moved = TriangleMesh(times(mesh.vertices, place.matrix[:3]) + place.matrix[3], mesh.triangles)
    mirrors = determinants(place.matrix[:3]) < 0.0
    return moved.reversed() if mirrors else moved
