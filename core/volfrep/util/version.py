# SPDX-License-Identifier: LGPL-2.1-or-later
"""The engine's version, as ``pyproject.toml`` has it."""

VERSION = "0.1.0"
