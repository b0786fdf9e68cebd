"""``higherpair check``: contact and interference of the pairs of a scene."""

from __future__ import annotations

from argparse import Namespace
from typing import Any

from exporters.command.asked import DONE, FAILED, WRONG_INPUT, each, language_of_command, print_json, quoted, scene_of
from exporters.command.tables import part_notes
from exporters.production.check import scene_checks
from exporters.production.check_lines import check_lines, has_bad_verdict, names_of
from parts.base.texts import words
from parts.scene.checks import check_solids, check_workspace
from parts.scene.load import in_keys_of_file, make_parts
from parts.scene.placing import place
from parts.scene.scene_file import SceneFile


def run(options: Namespace) -> int:
    """The exit code."""

    def checked(address: str) -> tuple[dict[str, Any], SceneFile, dict[str, str], list[str]]:
        scene = scene_of(address, options)
        with in_keys_of_file(scene.origins):
            parts, matings = make_parts(scene, address)
            placing = place(scene.instances, scene.drives, parts, matings, address)
            check_solids(parts, address)
            check_workspace(scene.checks.workspace, placing, address)
        asked, names = scene.checks, names_of(scene.instances, parts)
        checks = scene_checks(
            placing, parts, scene.drives, scene.scene.language, contact=True, transmission=asked.transmission_error,
            workspace=asked.workspace, steps=scene.steps, names=names,
        )  # fmt: skip
        return checks, scene, names, part_notes(parts.values(), words(scene.scene.language))

    found, refused = each(quoted(options.scenes), checked, lambda: language_of_command(options))
    if options.json:
        print_json(options.scenes, [checks for checks, *_ in found])
    for checks, scene, names, notes in found:
        if options.json or (options.quiet and not has_bad_verdict(checks)):
            continue
        language = scene.scene.language
        title = [] if len(options.scenes) == 1 else [f"{scene.name}:"]
        lines = check_lines(checks, language, names)
        if options.steps:
            from exporters.production.order import steps_told

            lines += steps_told(scene.steps, names, language)
        lines = lines or [words(language).text("no mates; no solids run into each other")]
        print("\n".join(title + lines + notes))
    return FAILED if any(has_bad_verdict(checks) for checks, *_ in found) else WRONG_INPUT if refused else DONE
