# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parts of windows that know no subject: fields, folding sections, docks, manners of panels."""
