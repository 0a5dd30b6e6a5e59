# SPDX-License-Identifier: LGPL-2.1-or-later
"""Radii that follow what a part carries: what is wanted, and the job that finds them."""

from .ahead import prepare
from .as_it_is import solve_struts
from .building import Building, building_of
from .file_proof import check_file_proof, prove_file
from .goal import GOALS, Goal, goal_of
from .printed import Printing
from .sizing import (
    SizedPart,
    size,
)
from .thin_struts import radius_field

__all__ = [
    "GOALS",
    "Building",
    "Goal",
    "Printing",
    "SizedPart",
    "building_of",
    "check_file_proof",
    "goal_of",
    "prepare",
    "prove_file",
    "radius_field",
    "size",
    "solve_struts",
]
