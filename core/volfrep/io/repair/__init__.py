# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a mesh from a file may need: a module a kind of repair."""
