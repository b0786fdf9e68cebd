"""From a scene to its files: plan, build, report, read-back, convergence."""

import sys
from types import ModuleType
from typing import cast

# msgspec looks in typing_extensions for what typing has had since 3.11: to load that would be a thirtieth of a build
if not {"msgspec", "typing_extensions"} & {*sys.modules}:
    sys.modules["typing_extensions"] = cast(ModuleType, None)
    try:
        import msgspec  # noqa: F401
    finally:
        del sys.modules["typing_extensions"]
