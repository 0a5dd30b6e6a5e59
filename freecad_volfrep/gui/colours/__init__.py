# SPDX-License-Identifier: LGPL-2.1-or-later
"""Infills coloured by quantities, and what their struts carry."""
