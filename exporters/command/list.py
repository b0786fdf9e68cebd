"""``higherpair list``: kinds of parts, mates and assemblies, built-in scenes, materials."""

from __future__ import annotations

from argparse import Namespace

from exporters.command.asked import DONE, check_language, language_of_command, print_json
from parts.base.densities import DENSITIES
from parts.base.registry import KINDS
from parts.base.texts import words
from parts.mates.registry import MATES
from parts.recipes.registry import RECIPES
from parts.scene.files import built_in_scenes, title_of


def run(options: Namespace) -> int:
    """The exit code."""
    check_language(options)
    told = words(language_of_command(options))
    indices = KINDS.phrases, MATES.phrases, RECIPES.phrases
    kinds, mates, assemblies = ({name: told.text(text) for name, text in index.items()} for index in indices)
    scenes = {name: title_of(file, language_of_command(options)) for name, file in built_in_scenes().items()}
    if options.json:
        tables = {"parts": kinds, "mates": mates, "assemblies": assemblies, "scenes": scenes, "materials": DENSITIES}
        print_json([""], [tables])
        return DONE
    listed = {
        told.text("kinds of parts (higherpair new KIND):"): kinds,
        told.text("kinds of mates between instances (higherpair new KIND prints a table to add to a scene):"): mates,
        told.text("assemblies, which become parts and mates (higherpair new KIND, --expand shows them):"): assemblies,
        told.text("built-in scenes (higherpair build NAME; higherpair new NAME.toml prints one to change):"): scenes,
    }
    for title, rows in listed.items():
        print(title)
        for name, meaning in rows.items():
            print(f"  {name:<22} {meaning}{'' if rows is scenes else '.'}")
    print(told.text("materials whose density is known (g/cm^3; any other needs `density` too):"))
    for density in sorted(set(DENSITIES.values())):
        print(f"  {density:<6} {', '.join(name for name in DENSITIES if DENSITIES[name] == density)}")
    return DONE
