# SPDX-License-Identifier: LGPL-2.1-or-later
"""Plane sections of a part, straight from its struts, joints and walls: no mesh is made."""
