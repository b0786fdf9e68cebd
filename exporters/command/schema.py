"""``higherpair schema``: the JSON Schema of scenes."""

from __future__ import annotations

from argparse import Namespace

from exporters.command.asked import DONE, check_free_place, show_page
from parts.scene.schema import scene_schema


def run(options: Namespace) -> int:
    """The exit code."""
    check_free_place(options)
    show_page(scene_schema(), options)
    return DONE
