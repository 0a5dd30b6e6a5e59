# SPDX-License-Identifier: LGPL-2.1-or-later
"""The table of forms of output. A new one is a row here and a `Writer` in a module of its own.

The command, `Part.save`, studies and FreeCAD's export all write by this table. It is read without
numpy, so that ``--help`` answers at once; writers are imported when used.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from ..util.errors import VolfrepError, listed

if TYPE_CHECKING:
    from ..design.spec import LatticeSpec

#: What a form is made of.
MESH, BEAMS, AXES, SECTIONS, TETRAHEDRA, EXACT = (
    "mesh", "beams", "axes", "sections", "tetrahedra", "exact surfaces",
)  # fmt: skip


@dataclass(frozen=True)
class Form:
    """A row of the table.

    Attributes:
        name: of the form alone; a file's extension and `word` say it too.
        title: in a dialog of files.
        suffixes: of its files, the usual one first; of a folder's files, where it is a folder.
        writer: module and class that write it.
        needs: what it is made of, of `MESH` ... `EXACT`.
        word: that tells it from other forms with the same extension; the first of these is
            what the extension alone stands for.
        option: of the command that takes the word.
        bytes_by: module and function that write a mesh, where the form is nothing else.
        streamed: whether it holds a surface without the mesh of all of it in memory.
        octants_by: module and function that write a surface octant by octant, with processes' help.
        bare: whether it has struts without fillets only.
        of_lattice: whether it says nothing of a domain.
        takes: settings that it looks at, by their names in `writer.Settings`.
        alternative: word of the form to choose where this one does not do.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    writer: str
    needs: tuple[str, ...] = (MESH,)
    word: str = ""
    option: str = ""
    bytes_by: str = ""
    streamed: bool = False
    octants_by: str = ""
    bare: bool = False
    of_lattice: bool = False
    takes: tuple[str, ...] = ()
    alternative: str = ""

    @property
    def meshed(self) -> bool:
        """Whether a mesh is made for it, of which pictures and reports are made too."""
        return MESH in self.needs

    @property
    def is_beams_alone(self) -> bool:
        """Whether it holds struts as beams, and nothing is meshed for it."""
        return self.needs == (BEAMS,)

    @property
    def is_folder(self) -> bool:
        """Whether it is a folder of files."""
        return SECTIONS in self.needs

    def refuse(self, spec: LatticeSpec) -> None:
        """Refuse, before any work, what it cannot hold.

        Raises:
            VolfrepError: naming what to change.
        """
        if self.of_lattice and spec.output == "domain":
            raise VolfrepError(
                "The domain holds no lattice to write: make the part or the lattice, or choose "
                "--step faceted."
            )
        if self.bare and spec.fillet:
            raise VolfrepError(
                f"The form '{self.word}' has no fillets between struts: set the fillet to 0, or "
                f"choose {self.alternative}."
            )
        if EXACT in self.needs:
            from ..io.freecad_process import freecad_program

            freecad_program()


def _mesh(name: str, title: str, bytes_by: str, *, streamed: bool = False) -> Form:
    """A form that is a mesh and nothing else."""
    return Form(
        name, title, (f".{name}",), ".meshes:MeshWriter",
        bytes_by=f"..io.write.{bytes_by}", streamed=streamed,
    )  # fmt: skip


_STEP, _DECK = (".step", ".stp"), (".inp",)

#: In the order of FreeCAD's list of kinds of files.
FORMS = (
    Form("stl", "STL", (".stl",), ".meshes:MeshWriter", bytes_by="..io.write.stl:write_stl",
         streamed=True, octants_by="..io.write.stl_octants:write_surface_stl"),
    Form("3mf", "3MF", (".3mf",), ".meshes:MeshWriter", word="mesh", option="3mf",
         bytes_by="..io.write.threemf:write_3mf", streamed=True),
    Form("3mf-both", "3MF, mesh and beams", (".3mf",), ".beams:BothWriter", (MESH, BEAMS),
         word="both", option="3mf", streamed=True),
    Form("3mf-beams", "3MF, beams only", (".3mf",), ".beams:BeamsWriter", (BEAMS,),
         word="beams", option="3mf", alternative="both"),
    _mesh("ply", "PLY", "ply:write_ply", streamed=True),
    _mesh("obj", "OBJ", "obj:write_obj", streamed=True),
    _mesh("off", "OFF", "exchange:write_off"),
    _mesh("glb", "GLB, for viewers", "exchange:write_glb"),
    Form("step", "STEP, plane faces", _STEP, ".step:FacetedWriter", word="faceted", option="step",
         bytes_by="..io.write.step_faceted:write_step_faceted"),
    Form("step-exact", "STEP, exact surfaces", _STEP, ".step:ExactWriter", (MESH, EXACT),
         word="exact", option="step", bare=True, of_lattice=True, alternative="faceted"),
    Form("step-wireframe", "STEP, axes of the struts", _STEP, ".step:AxesWriter", (AXES,),
         word="wireframe", option="step", bare=True, of_lattice=True, alternative="faceted"),
    Form("inp", "CalculiX, beams", _DECK, ".decks:BeamDeckWriter", (AXES,), word="beams",
         option="inp", bare=True, of_lattice=True, takes=("material",), alternative="tetrahedra"),
    Form("inp-tetrahedra", "CalculiX, tetrahedra", _DECK, ".decks:TetrahedraWriter",
         (MESH, TETRAHEDRA), word="tetrahedra", option="inp", of_lattice=True,
         takes=("material",)),
    Form("png", "Layers, pictures for resin printers", (".png",), ".layers:LayersWriter",
         (SECTIONS,), word="png", option="format", takes=("layer", "pixel")),
    Form("svg", "Layers, drawings", (".svg",), ".layers:LayersWriter", (SECTIONS,), word="svg",
         option="format", takes=("layer",)),
    Form("cli", "Layers, common layer interface", (".cli",), ".layers:LayersWriter", (SECTIONS,),
         word="cli", option="format", takes=("layer",)),
)  # fmt: skip


def files() -> tuple[Form, ...]:
    """The forms that are one file."""
    return tuple(form for form in FORMS if not form.is_folder)


def suffixes(*, meshes: bool = False) -> tuple[str, ...]:
    """The extensions of files that can be written, or of those that hold a mesh."""
    rows = (form for form in files() if form.bytes_by or not meshes)
    return tuple(dict.fromkeys(suffix for form in rows for suffix in form.suffixes))


def words(option: str) -> tuple[str, ...]:
    """What an option of the command chooses from, the usual one first."""
    return tuple(form.word for form in FORMS if form.option == option)


def suffixes_of(option: str) -> tuple[str, ...]:
    """The extensions with which an option of the command has an effect."""
    rows = (form for form in files() if form.option == option)
    return tuple(dict.fromkeys(suffix for form in rows for suffix in form.suffixes))


def find_form(path: str | os.PathLike[str], word: str | None = None) -> Form:
    """The form of a path's extension (case does not matter), or of a word.

    Args:
        path: of the file, or of a folder of layers.
        word: a form's name, or what tells it from others of the extension; None for the usual
            one.

    Raises:
        VolfrepError: there is none; naming those there are.

    >>> find_form("part.3mf").name, find_form("part.3mf", "beams").name
    ('3mf', '3mf-beams')
    """
    suffix = Path(path).suffix.lower()
    if word is not None:
        for form in FORMS:
            if form.name == word and (form.is_folder or suffix in form.suffixes):
                return form
    found = [form for form in files() if suffix in form.suffixes]
    if not found:
        if word is not None and any(word in (form.name, form.word) for form in FORMS):
            known = next(form for form in FORMS if word in (form.name, form.word))
            raise VolfrepError(
                f"'{path}' cannot hold '{word}': give it the extension {known.suffixes[0]}."
            )
        raise VolfrepError(f"Cannot write '{path}': {unknown(path, suffixes())}")
    if word is None:
        return found[0]
    for form in found:
        if form.word == word:
            return form
    there = [form.word for form in found if form.word] or [form.name for form in found]
    raise VolfrepError(f"'{path}' cannot hold '{word}': its extension stands for {listed(there)}.")


def unknown(path: str | os.PathLike[str], known: Sequence[str]) -> str:
    """What is wrong with a path's extension."""
    suffix = Path(path).suffix
    named = f"the extension '{suffix}'" if suffix else "a name without an extension"
    return f"{named} is not a known format, use {listed(known)}."
