# SPDX-License-Identifier: LGPL-2.1-or-later
"""Commands that hand a lattice infill on: as a file, as a solid, as an analysis."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import FreeCAD as App
import FreeCADGui as Gui

from freecad_volfrep.gui.messages import (
    ask,
    ask_lengths,
    choose,
    errors_shown,
    file_name,
    tell_error,
    tell_written,
)
from freecad_volfrep.gui.qt import QtWidgets
from freecad_volfrep.gui.undo import undo_step
from freecad_volfrep.translation import marked, translate
from volfrep.util.errors import VolfrepError

#: Names of FEM models, marked for translation.
MODEL_NAMES = marked("VolfrepCommands", "beams", "tetrahedra")


def export(obj: App.DocumentObject) -> None:
    """Ask for the file's name and write it."""
    from freecad_volfrep.features.export.mesh_file import (
        FITTED,
        chosen_format,
        estimate_export,
        export_mesh,
        formats_of,
    )

    folder = Path(obj.Document.FileName).parent if obj.Document.FileName else Path.home()
    formats = {form.filter: form for form in formats_of(obj)}
    path, chosen = QtWidgets.QFileDialog.getSaveFileName(
        Gui.getMainWindow(),
        translate("VOLFREP_Export", "Export Lattice"),
        str(folder / f"{file_name(obj.Label)}{next(iter(formats.values())).suffix}"),
        ";;".join(formats),
    )
    if not path:
        return
    form = None
    with errors_shown(box=True):
        path, form = chosen_format(path, formats[chosen], list(formats.values()))
    if form is None:
        return
    if form.content == "layers":
        _export_layers(obj, path, form.suffix[1:])
        return
    if form.content == FITTED:
        _export_for_printer(obj, path)
        return
    with errors_shown(box=True):
        estimate = estimate_export(obj, form)
        if estimate and not ask(
            translate("VolfrepCommands", "{file}: {estimate}. Write it?").format(
                file=Path(path).name, estimate=estimate
            )
        ):
            return
        export_mesh(obj, path, form.content)
        tell_written(path)


def _export_for_printer(obj: App.DocumentObject, path: str) -> None:
    """Ask for limits and the printer, write a file that keeps to them, and say what that costs."""
    from freecad_volfrep.features.export.printer_file import export_for_printer
    from freecad_volfrep.gui.printing.export_box import ask_for_printer

    wanted = ask_for_printer(obj)
    if wanted is None:
        return
    with errors_shown(box=True):
        export_for_printer(obj, path, **wanted)
        tell_written(path)


def _export_layers(obj: App.DocumentObject, path: str, form: str) -> None:
    """Ask how high the layers are to be, and write them into a folder of that name."""
    from freecad_volfrep.features.export.layer_export import (
        LAYER,
        PIXEL,
        estimate_layers,
        export_layers,
        layers_folder,
    )

    folder = layers_folder(path)
    wanted = {translate("VolfrepCommands", "Height of a layer"): LAYER}
    if form == "png":
        wanted[translate("VolfrepCommands", "Edge of a pixel")] = PIXEL

    def estimate(lengths: list[float]) -> str:
        return f"{folder.name}: {estimate_layers(obj, *lengths, *[None] * (2 - len(lengths)))}"

    lengths = ask_lengths(translate("VolfrepCommands", "Export Layers"), wanted, estimate)
    if lengths is None:
        return
    with errors_shown(box=True):
        export_layers(obj, folder, *lengths, form=form)
        tell_written(str(folder))


def make_solid_of(obj: App.DocumentObject) -> None:
    """Say what each kind of solid takes, ask which, and make it."""
    from freecad_volfrep.features.export.solids import kinds_of, make_kind

    doc = obj.Document
    kinds = {
        kind.name: (translate("VolfrepSolids", kind.title), lambda kind=kind: kind.predict(obj))
        for kind in kinds_of(obj)
    }
    question = translate("VolfrepCommands", "Make of '{label}':").format(label=obj.Label)
    chosen = _chosen(question, kinds)
    if chosen is None:
        return
    with errors_shown(), undo_step(doc, translate("VOLFREP_ToSolid", "Lattice To Solid")):
        made = make_kind(doc, obj, chosen)
        obj.Visibility = not made.Visibility
    doc.recompute()


def analyse(infill: App.DocumentObject) -> None:
    """Say what each model takes, ask which, and make an analysis of it."""
    from freecad_volfrep.features.export.fem_analysis import (
        MODELS,
        estimate_analysis,
        make_fem_analysis,
    )

    chosen = _chosen(
        translate("VolfrepCommands", "Analyse '{label}' with:").format(label=infill.Label),
        {
            model: (
                translate("VolfrepCommands", model),
                lambda m=model: estimate_analysis(infill, m),
            )
            for model in MODELS
        },
    )
    if chosen is None:
        return
    step = translate("VOLFREP_FemAnalysis", "FEM Analysis")
    with errors_shown(), undo_step(infill.Document, step):
        make_fem_analysis(infill.Document, infill, chosen)


def _chosen(label: str, kinds: dict[str, tuple[str, Callable[[], str]]]) -> str | None:
    """The kind that the user picks by its title and what it will take; None for none.

    `kinds` gives, by name, the title and what predicts; kinds that are refused are named above
    the list, and alone they are an error.
    """
    offered, refused = {}, []
    for name, (title, predict) in kinds.items():
        try:
            offered[f"{title}: {predict()}"] = name
        except VolfrepError as error:
            refused.append(f"{title}: {error}")
    if not offered:
        tell_error("\n".join(refused))
        return None
    item = choose(label, list(offered), refused)
    return None if item is None else offered[item]
