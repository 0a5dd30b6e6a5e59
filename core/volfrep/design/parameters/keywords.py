# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keywords of a call: the keys of a specification's file, beside the fields of a `LatticeSpec`."""

from __future__ import annotations

import dataclasses
import difflib
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import is_dataclass
from typing import Any

import numpy as np

from ...util.deprecation import PARAMETERS as RENAMED
from ...util.deprecation import current_name
from ...util.errors import VolfrepError, brief
from ...util.numbers import number
from ...util.types import Floats
from ..cells import make_cell
from ..drawn_cell import DrawnCell
from ..grading import Field
from ..graphs import make_network
from ..spec import LatticeSpec
from .field_keywords import is_field, is_sampled, with_cell_size, with_fields
from .parameter import REPEATED, Parameter
from .specification import merge_values, specification, values_of
from .table import BY_NAME, PARAMETERS
from .values import value_from_json

#: What values of a wrong kind raise deep inside, where no sentence was thought of.
BAD_KINDS = (TypeError, ValueError, AttributeError, LookupError, OverflowError)
#: Fields of a `LatticeSpec`.
FIELDS = {field.name for field in dataclasses.fields(LatticeSpec)}
#: Keys of files, which are options of the command too.
KEYS = {row.name for row in PARAMETERS if row.in_command}
#: Fields that hold several things: None is none of them.
_SEVERAL = ("open_faces", "face_skins", "keep_solid")
#: Keys whose word stands for what a field of the same name holds.
WORDS = ("cell_map", "network", "radius_grading", "size_grading")


def with_current_names(given: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords by their names of today, with a warning for each that has changed.

    Raises:
        VolfrepError: one has changed two minor versions ago.
    """
    return {current_name(name, RENAMED): value for name, value in given.items()}


def refuse_unknown(given: Mapping[str, object], known: set[str]) -> None:
    """Refuse a keyword that there is not.

    Raises:
        VolfrepError: naming the nearest one.
    """
    unknown = [name for name in given if name not in known]
    if unknown:
        near = difflib.get_close_matches(unknown[0], known, 1)
        hint = f"did you mean '{near[0]}'?" if near else f"there are {', '.join(sorted(known))}."
        raise VolfrepError(f"A lattice has no parameter '{unknown[0]}': {hint}")


def is_key(name: str, value: object) -> bool:
    """Whether a keyword says what only the key of a file says."""
    return name in KEYS and (name not in FIELDS or (name in WORDS and isinstance(value, str)))


def spec_by_keys(
    spec: LatticeSpec | None, given: Mapping[str, Any], young: float = 1.0
) -> LatticeSpec:
    """The specification that keywords make, some of which are keys of files.

    Args:
        spec: what they stand on top of; None for the defaults.
        given: by the names of `KEYS` and `FIELDS`.
        young: the solid's modulus, MPa, for a `stiffness` in MPa.

    Raises:
        VolfrepError: a value makes no sense, or has no effect.
    """
    fields = {n: value for n, value in given.items() if n not in KEYS or _is_object(n, value)}
    keys = {name: value for name, value in given.items() if name not in fields}
    base = {} if spec is None else values_of(spec)
    made = specification(merge_values(keys, base))
    if made.target is not None and made.target.aim == "stiffness" and young != 1.0:
        made = dataclasses.replace(made, target=dataclasses.replace(made.target, young=young))
    return dataclasses.replace(made, **fields) if fields else made


def _is_object(name: str, value: object) -> bool:
    """Whether a value is what a `LatticeSpec` holds, and no entry of a file."""
    if name not in FIELDS or name == "cell":
        return False
    if name == "keep_solid" and isinstance(value, tuple):
        return any(map(is_dataclass, value))
    return not (value is None or isinstance(value, (str, int, float, tuple)))


def own_data(
    given: Mapping[str, Any],
    box: Callable[[float], Floats] | None = None,
    cell_size: float = 10.0,
) -> dict[str, Any]:
    """The keywords with what plain values, arrays, graphs, functions and dicts stand for.

    `cell` may be what `as_cell` takes, `network` a pair of nodes and struts, a mesh or a
    `networkx.Graph`; fields are those of `field_keywords`.

    Args:
        given: by the names of `KEYS` and `FIELDS`.
        box: gives the (2, 3) box in which functions are sampled, of a cell size, mm; None for no
            part.
        cell_size: L, mm, where none is given.

    Raises:
        VolfrepError: they make no sense.
    """
    result = {name: _value(name, value) for name, value in given.items()}
    network = result.get("network")
    if "cell" in result:
        result["cell"] = as_cell(result["cell"])
    for name in _SEVERAL:
        if name in result and result[name] is None:
            result[name] = ()
    if network is not None and not isinstance(network, str):
        result["network"] = as_graph(network)
    size = result.get("cell_size")
    size = cell_size if size is None or is_field("cell_size", size) else size
    bounds = None
    if box is not None and any(is_sampled(name, value) for name, value in result.items()):
        bounds = box(number("cell size", size, "mm", positive=True))
    result = with_cell_size(result, bounds)
    return with_fields(result, bounds, result.get("cell_size") or size)


def as_cell(cell: Any) -> Any:
    """A cell of a dict as a cell's file has it, of a pair of arrays, or of lines.

    Args:
        cell: with ``nodes`` and ``struts``; (n, 3) nodes in a cube from 0 to 1 and (m, 2) struts;
            what `volfrep.cell_from_lines` gives; what is none of these is left as it is.

    Raises:
        VolfrepError: it makes no cell.
    """
    if isinstance(cell, DrawnCell):
        return cell.cell
    if isinstance(cell, (tuple, list)) and len(cell) == 2:
        cell = dict(zip(("nodes", "struts"), cell, strict=True))
    if not isinstance(cell, Mapping):
        return cell
    missing = [name for name in ("nodes", "struts") if name not in cell]
    if missing:
        raise VolfrepError(
            f"A cell that is a dict has nodes and struts, as a cell's file: {missing[0]} are "
            "missing."
        )
    edges, widths = cell.get("edges", (1.0, 1.0, 1.0)), cell.get("widths", ())
    name = str(cell.get("name", "own"))
    return make_cell(name, cell["nodes"], cell["struts"], "cell", edges=edges, widths=widths)


def _value(name: str, value: Any) -> Any:
    """The value of a keyword as the key of that name in a file takes it; objects as they are.

    Raises:
        VolfrepError: it is of no kind that the key takes; the sentence begins with the name.
    """
    if name not in KEYS or name in ("cell", "stiffness") or is_field(name, value):
        return value
    row, plain = BY_NAME[name], _json_value(value)
    if plain is None or not isinstance(plain, (str, int, float, list)):
        is_object = name in (*WORDS, "keep_solid") or isinstance(value, Field)
        if plain is None or (is_object and not callable(value) and not isinstance(value, bytes)):
            return value
        kind = type(value).__name__
        raise VolfrepError(f"The parameter '{name}' does not take a {kind}: {_values_taken(row)}.")
    if name == "network" and isinstance(plain, list):
        return value
    if name == "keep_solid" and isinstance(value, (list, tuple)) and any(map(is_dataclass, value)):
        return value
    if row.kind in REPEATED and plain and isinstance(plain, list) and _is_number(plain[0]):
        plain = [plain]
    try:
        made = value_from_json(row, plain)
    except VolfrepError as error:
        raise VolfrepError(f"{name}: {error}") from error
    return None if row.is_none and name in FIELDS and not made else made


def _json_value(value: Any) -> Any:
    """Arrays and tuples as lists, numpy's numbers as Python's."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, (list, tuple)):
        return [_json_value(item) for item in value]
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def _is_number(value: object) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _values_taken(row: Parameter) -> str:
    """What a parameter takes, in words."""
    if row.choices:
        return f"choose {', '.join(row.choices)}"
    return f"it is a {row.kind.replace('_', ' ')}" + f" in {row.unit}" * bool(row.unit)


def as_graph(network: Any) -> Any:
    """A network of a pair of arrays, of a `networkx.Graph`, or of a mesh's edges.

    Args:
        network: nodes (n, 3) in mm and struts (m, 2), perhaps radii; a graph whose nodes are
            points, or have one as ``pos``; a mesh with `vertices` and `edges_unique`; what is
            none of these is left as it is.

    Raises:
        VolfrepError: it has no struts, or a node has no place.
    """
    if isinstance(network, (tuple, list)):
        if len(network) not in (2, 3):
            raise VolfrepError(
                f"A network is nodes and struts, and perhaps radii, not {brief(network)}."
            )
        return make_network(*network)
    if hasattr(network, "edges_unique") and hasattr(network, "vertices"):
        return make_network(network.vertices, network.edges_unique)
    nodes = getattr(network, "nodes", None)
    is_graph = callable(nodes) and callable(getattr(network, "edges", None))
    if not is_graph or not hasattr(nodes, "__iter__"):
        return network
    places = []
    for node, data in network.nodes(data=True):
        place = data.get("pos", node)
        if not isinstance(place, (Sequence, np.ndarray)) or len(place) != 3:
            raise VolfrepError(
                f"The node {node!r} of the graph has no place: give it pos=(x, y, z), in mm."
            )
        places.append(place)
    number = {node: row for row, node in enumerate(network.nodes)}
    struts = [(number[one], number[other]) for one, other in network.edges()]
    if not struts:
        raise VolfrepError("The graph has no struts: give it edges.")
    return make_network(places, struts)


def refuse_kind(given: Mapping[str, Any], error: Exception) -> VolfrepError:
    """What to say of a value of the wrong kind: which keyword it is."""
    for name, value in given.items():
        if name not in FIELDS:
            continue
        try:
            LatticeSpec(**{name: value})
        except VolfrepError:
            continue
        except BAD_KINDS:
            return VolfrepError(
                f"The parameter '{name}' does not take {brief(value)}: see its values in "
                "docs/reference.md."
            )
    return VolfrepError(f"A parameter has a value of the wrong kind ({error}).")
