# SPDX-License-Identifier: LGPL-2.1-or-later
"""The words of the window in the user's language.

`translate(context, text)` gives a text in that language; `QT_TRANSLATE_NOOP(context, text)` only
marks one, for a table that is translated when it is shown. Both names are what ``make
translations`` looks for. What varies is put in afterwards: ``translate(...).format(name=...)``.

What is stored in documents and files is never translated, nor are the sentences of the engine's
errors, which a search for their words should find.
"""

from __future__ import annotations

from pathlib import Path

import FreeCAD as App

translate = App.Qt.translate
QT_TRANSLATE_NOOP = App.Qt.QT_TRANSLATE_NOOP
#: Compiled: volfrep_de.qm and the like.
TRANSLATIONS = Path(__file__).resolve().parent / "resources" / "translations"

__all__ = ["QT_TRANSLATE_NOOP", "TRANSLATIONS", "translate", "words"]


def words(name: str) -> str:
    """The name of a property as words: RadiusMin as 'Radius min'."""
    text = "".join(f" {letter.lower()}" if letter.isupper() else letter for letter in name)
    return text.strip().capitalize()
