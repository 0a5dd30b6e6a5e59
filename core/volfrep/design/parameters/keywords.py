# SPDX-License-Identifier: LGPL-2.1-or-later
"""Keywords of a call: the keys of a specification's file, beside the fields of a `LatticeSpec`."""

from __future__ import annotations

import dataclasses
import difflib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...util.errors import VolfrepError
from ..cells import make_cell
from ..graphs import make_network
from ..scattered_field import PointField
from ..spec import LatticeSpec
from .parameter import REPEATED
from .specification import merge_values, specification, values_of
from .table import BY_NAME, PARAMETERS

#: Fields of a `LatticeSpec`.
FIELDS = {field.name for field in dataclasses.fields(LatticeSpec)}
#: Keys of files, which are options of the command too.
KEYS = {row.name for row in PARAMETERS if row.in_command}
#: Keys whose word stands for what a field of the same name holds.
WORDS = ("cell_map", "network", "radius_grading", "size_grading")


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
    fields = {
        name: value
        for name, value in given.items()
        if name not in KEYS or (name in FIELDS and not _is_word(name, value))
    }
    keys = {name: _plain(name, value) for name, value in given.items() if name not in fields}
    base = {} if spec is None else values_of(spec)
    made = specification(merge_values(keys, base))
    if made.target is not None and made.target.aim == "stiffness" and young != 1.0:
        made = dataclasses.replace(made, target=dataclasses.replace(made.target, young=young))
    return dataclasses.replace(made, **fields) if fields else made


def _is_word(name: str, value: object) -> bool:
    return isinstance(value, str) if name in WORDS else name not in ("open_faces", "keep_solid")


def _plain(name: str, value: Any) -> Any:
    """Lists and arrays as tuples; one row of a key that takes several as the only one."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if not isinstance(value, (list, tuple)):
        return value
    rows = tuple(tuple(row) if isinstance(row, (list, np.ndarray)) else row for row in value)
    if BY_NAME[name].kind in REPEATED and rows and isinstance(rows[0], (int, float)):
        return (rows,)
    return rows


def own_data(given: Mapping[str, Any]) -> dict[str, Any]:
    """The keywords with what arrays, graphs and dicts stand for.

    `cell` may be a dict with the ``nodes`` and ``struts`` of a cell's file, `network` a pair of
    nodes and struts, a mesh or a `networkx.Graph`, `radius_field` a pair of points and values.

    Raises:
        VolfrepError: they make no sense.
    """
    result = dict(given)
    cell, network, field = (result.get(n) for n in ("cell", "network", "radius_field"))
    if isinstance(cell, Mapping):
        missing = [name for name in ("nodes", "struts") if name not in cell]
        if missing:
            raise VolfrepError(
                f"A cell that is a dict has nodes and struts, as a cell's file: {missing[0]} are "
                "missing."
            )
        result["cell"] = make_cell(
            str(cell.get("name", "own")), cell["nodes"], cell["struts"], "cell",
            edges=cell.get("edges", (1.0, 1.0, 1.0)), widths=cell.get("widths", ()),
        )  # fmt: skip
    if network is not None and not isinstance(network, str):
        result["network"] = as_graph(network)
    if isinstance(field, tuple) and len(field) == 2 and not isinstance(field, PointField):
        result["radius_field"] = PointField(
            np.asarray(field[0], float), np.asarray(field[1], float)
        )
    return result


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
        return make_network(*network)
    if hasattr(network, "edges_unique") and hasattr(network, "vertices"):
        return make_network(network.vertices, network.edges_unique)
    if not (callable(getattr(network, "nodes", None)) and hasattr(network, "edges")):
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
        except (TypeError, ValueError, AttributeError, IndexError):
            return VolfrepError(
                f"The parameter '{name}' does not take {value!r} ({type(value).__name__}): see its "
                "values in docs/reference.md."
            )
    return VolfrepError(f"A parameter has a value of the wrong kind ({error}).")
