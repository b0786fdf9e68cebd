"""``python -m exporters`` is the command ``higherpair``."""

import sys

from exporters.command.cli import run

sys.exit(run())
