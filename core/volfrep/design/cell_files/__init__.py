# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a cell's file may hold beside plain nodes and struts; and cells of a catalogue's text."""
