# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lattice cut at the wall: the Boolean, clipped struts, pruned struts, drain holes."""
