"""What everything stands on: errors, tolerances, roots, series, angles and placements."""

import sys
from types import ModuleType
from typing import cast

# msgspec looks in typing_extensions for what typing has had since 3.11: to load it, and inspect with it, would be a
# twentieth of a build
if not {"msgspec", "typing_extensions"} & {*sys.modules}:
    sys.modules["typing_extensions"] = cast(ModuleType, None)
    try:
        import msgspec  # noqa: F401
    finally:
        del sys.modules["typing_extensions"]
