# SPDX-License-Identifier: LGPL-2.1-or-later
"""The row of a panel that starts from a recipe, or keeps what the panel shows as one."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import FreeCAD as App

from freecad_volfrep.features.infill.recipes import apply_recipe, known_recipes, save_recipe
from freecad_volfrep.gui.messages import tell_written
from freecad_volfrep.gui.qt import QtCore, QtWidgets
from freecad_volfrep.gui.widgets.controls import push_button
from freecad_volfrep.translation import QT_TRANSLATE_NOOP, translate
from volfrep.util.errors import VolfrepError

#: What the recipes that come with VOLFREP are called in the window.
_TITLES = {
    "bone-like": QT_TRANSLATE_NOOP("VolfrepRecipes", "Bone-like"),
    "cushion": QT_TRANSLATE_NOOP("VolfrepRecipes", "Cushion"),
    "heat-sink": QT_TRANSLATE_NOOP("VolfrepRecipes", "Heat sink"),
    "light-bracket-lpbf": QT_TRANSLATE_NOOP("VolfrepRecipes", "Light bracket, LPBF"),
}


class RecipeRow(QtWidgets.QWidget):
    """A list of recipes and a button that saves one.

    Args:
        obj: the infill.
        applied: called when its properties have got the values of a recipe.
        refused: called with a sentence where that cannot be.
    """

    def __init__(
        self,
        obj: App.DocumentObject,
        applied: Callable[[], None],
        refused: Callable[[str], None],
    ) -> None:
        super().__init__()
        self._obj, self._applied, self._refused = obj, applied, refused
        self.list = QtWidgets.QComboBox()
        self.list.setObjectName("Recipe")
        self.list.setMinimumContentsLength(8)
        self.list.setSizeAdjustPolicy(QtWidgets.QComboBox.AdjustToMinimumContentsLengthWithIcon)
        self.list.setAccessibleName(translate("VolfrepRecipes", "Recipe"))
        self.list.setToolTip(
            translate(
                "VolfrepRecipes",
                "Start from named settings: VOLFREP's own, and those that you have saved",
            )
        )
        self.list.activated.connect(self._choose)
        tip = translate(
            "VolfrepRecipes", "Keep these settings under a name, for other solids and documents"
        )
        text = translate("VolfrepRecipes", "Save...")
        self.save = push_button("SaveRecipe", text, self._ask, tip)
        row = QtWidgets.QHBoxLayout(self)
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self.list, 1)
        row.addWidget(self.save)
        self._fill()

    def _fill(self, chosen: str = "") -> None:
        from volfrep.design.parameters.recipes import describe_recipe

        self.list.clear()
        self.list.addItem(translate("VolfrepRecipes", "Recipe..."), "")
        for name, path in known_recipes().items():
            self.list.addItem(_title(name, path), str(path))
            about = describe_recipe(path) if name in _TITLES else str(path)
            self.list.setItemData(self.list.count() - 1, about, QtCore.Qt.ToolTipRole)
            if name == chosen:
                self.list.setCurrentIndex(self.list.count() - 1)

    def _choose(self, row: int) -> None:
        path = self.list.itemData(row)
        if not path:
            return
        try:
            apply_recipe(self._obj, path)
        except VolfrepError as error:
            self._refused(str(error))
        else:
            self._applied()

    def _ask(self) -> None:
        name, is_given = QtWidgets.QInputDialog.getText(
            self,
            translate("VolfrepRecipes", "Save Recipe"),
            translate("VolfrepRecipes", "Name of these settings:"),
        )
        if not is_given:
            return
        try:
            path = save_recipe(self._obj, name.strip())
        except VolfrepError as error:
            self._refused(str(error))
            return
        tell_written(str(path))
        self._fill(path.stem)


def _title(name: str, path: Path) -> Any:
    from volfrep.design.parameters.recipes import RECIPES

    known = _TITLES.get(name) if RECIPES.get(name) == path else None
    return name if known is None else translate("VolfrepRecipes", known)
