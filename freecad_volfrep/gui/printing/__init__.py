# SPDX-License-Identifier: LGPL-2.1-or-later
"""Windows for those who print: a slicer's infill, files within limits, coupons, build direction."""
