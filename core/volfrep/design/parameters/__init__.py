# SPDX-License-Identifier: LGPL-2.1-or-later
"""The parameters of a lattice infill as one table, and specifications as values of it.

`table` is the only place that names a parameter: the command's options, the properties in FreeCAD,
the keys of a specification's file and the tables of the documentation are made from it. Importing
it costs nothing (no numpy); `specification` makes a `LatticeSpec` of values by name, `spec_file`
reads and writes them as TOML.
"""

from .parameter import GROUPS, Need, Parameter
from .table import BY_NAME, PARAMETERS

__all__ = ["BY_NAME", "GROUPS", "PARAMETERS", "Need", "Parameter"]
