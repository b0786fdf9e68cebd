"""The kinds of assemblies, one entry each: where the recipe is found, and what it makes in a phrase."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from parts.base.lazy import Index

if TYPE_CHECKING:
    from parts.recipes.recipe import Recipe

RECIPES: Index[Recipe[Any]] = Index(
    {
        "cam_model": (
            "parts.recipes.cam_model:CAM_MODEL",
            "Model of a cam of flat parts and dowels: its sliding follower's slot runs on two pins of a frame",
        ),
        "gear_pair_model": (
            "parts.recipes.gear_pair_model:GEAR_PAIR_MODEL",
            "Model of a gear pair of flat parts: two spur gears that turn on dowels in a frame",
        ),
        "planetary_set": (
            "parts.recipes.planetary_set:PLANETARY_SET",
            "Planetary set: central wheels, satellites with one rim or two on a carrier, with a frame and a crank",
        ),
        "power_module": (
            "parts.recipes.power_module:POWER_MODULE",
            "Two-coordinate power module of the thesis: every position of its parts list, sized by rules",
        ),
        "power_module_kinematics": (
            "parts.recipes.power_module_kinematics:POWER_MODULE_KINEMATICS",
            "Disks and wheels of the two-disk power module; cranks, idlers or the thesis's wheels turn its platform",
        ),
        "power_table": (
            "parts.recipes.power_table:POWER_TABLE",
            (
                "Two-disk power table of flat parts and pins, turned by two hand cranks; cranks keep its "
                "platform parallel"
            ),
        ),
    }
)
