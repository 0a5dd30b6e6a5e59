# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole jobs with networks in place of cells."""

from .infill import NetworkInfill, infill_of, network_alone

__all__ = ["NetworkInfill", "infill_of", "network_alone"]
