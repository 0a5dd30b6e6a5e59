# SPDX-License-Identifier: LGPL-2.1-or-later
"""How the catalogue of the library's cells is computed, which ships with the package."""
