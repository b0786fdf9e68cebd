"""The kinds of assemblies, a row of ``kinds.psv`` each: where the recipe is found, and what it makes in a phrase."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from parts.base.lazy import Index
from parts.base.psv import rows_of

if TYPE_CHECKING:
    from parts.recipes.recipe import Recipe

RECIPES: Index[Recipe[Any]] = Index(rows_of(__file__, "kinds"))
