# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants placed side by side and proved sound; struts that are missing, deformed or graded."""
