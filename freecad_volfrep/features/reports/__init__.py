# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures of an infill: against a printing process, of its mesh, beside others."""
