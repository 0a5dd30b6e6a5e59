# SPDX-License-Identifier: LGPL-2.1-or-later
"""The bytes of files, a module a format; which forms there are is said by `output.form`."""
