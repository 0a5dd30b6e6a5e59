# SPDX-License-Identifier: LGPL-2.1-or-later
"""Windows beside the work: tables of a report, plots, help, the installation of packages."""
