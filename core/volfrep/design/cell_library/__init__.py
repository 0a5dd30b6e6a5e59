# SPDX-License-Identifier: LGPL-2.1-or-later
"""The library of unit cells: data only, a JSON file a cell, read by `volfrep.design.cells`."""
