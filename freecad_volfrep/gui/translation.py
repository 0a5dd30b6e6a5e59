# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of the window in the user's language.

`translate(context, text)` gives a text in that language; `QT_TRANSLATE_NOOP(context, text)` only
marks one, for a table that is translated when it is shown. Both names are what ``make
translations`` looks for, so that their arguments must be literal.
"""

from __future__ import annotations

import FreeCAD as App

translate = App.Qt.translate
QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP

__all__ = ["QT_TRANSLATE_NOOP", "translate"]
