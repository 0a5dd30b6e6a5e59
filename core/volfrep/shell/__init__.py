# SPDX-License-Identifier: LGPL-2.1-or-later
"""The skin: depth below the surface, the offset wall by dual contouring, the domain inside."""
