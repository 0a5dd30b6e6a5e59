# SPDX-License-Identifier: LGPL-2.1-or-later
"""An infill in other forms: files, solids, assemblies, analyses."""
