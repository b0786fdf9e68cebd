"""``python -m exporters`` is the command ``higherpair``."""

import sys

from exporters.cli import main

sys.exit(main())
