# SPDX-License-Identifier: LGPL-2.1-or-later
"""The document objects: their proxies, and the factories that commands and scripts share.

Saved files name the proxies' classes by this package: keep the names below importable from here.
"""

from .export.slicer_infill import SlicerInfill
from .infill.lattice_infill import LatticeInfill
from .reports.print_check import PrintCheck
from .study.design_study import DesignStudy

__all__ = ["DesignStudy", "LatticeInfill", "PrintCheck", "SlicerInfill"]
