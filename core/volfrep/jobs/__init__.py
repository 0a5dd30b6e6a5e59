# SPDX-License-Identifier: LGPL-2.1-or-later
"""Whole jobs: a filled part, a block, a preview, a part whose lattice stays beams."""
