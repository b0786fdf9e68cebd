"""``higherpair calc``: a textbook calculation, step by step."""

from __future__ import annotations

import sys
from argparse import Namespace

from exporters.command.asked import DONE, FAILED, check_free_place, show_page
from exporters.documents.render import form_of
from exporters.documents.topics import calculate, keys_of_topic
from parts.base.readback import ReadError
from parts.base.texts import ENGLISH


def run(options: Namespace) -> int:
    """The exit code."""
    check_free_place(options)
    if options.keys:
        from exporters.command.new import topic_keys

        show_page(topic_keys(options.topic, *keys_of_topic(options.topic), options.language or ENGLISH), options)
        return DONE
    form = options.format or form_of(options.out)
    try:
        text = calculate(options.topic, options.words, form, options.language, force=options.force)
    except ReadError as error:
        print(f"higherpair: {error}", file=sys.stderr)
        return FAILED
    show_page(text, options)
    return DONE
