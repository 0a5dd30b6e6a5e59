# SPDX-License-Identifier: LGPL-2.1-or-later
"""Octants laid side by side and proved sound; struts that are missing, moved or graded."""
