# SPDX-License-Identifier: LGPL-2.1-or-later
"""What every room uses: errors, progress and cancel, threads, caches, files, arrays of rows."""
