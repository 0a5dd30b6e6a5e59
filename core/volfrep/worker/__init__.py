# SPDX-License-Identifier: LGPL-2.1-or-later
"""Calls of the engine in a process of their own, which can be ended at any moment without harm."""
