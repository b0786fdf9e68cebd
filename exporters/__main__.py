"""``python -m exporters`` is the command ``higherpair``."""

import sys

from exporters.command.cli import main

sys.exit(main())
