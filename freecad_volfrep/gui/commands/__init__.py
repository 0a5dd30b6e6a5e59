# SPDX-License-Identifier: LGPL-2.1-or-later
"""The workbench's commands: the table, what each does, when it can be used."""
