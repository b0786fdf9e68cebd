"""``higherpair calc ratio``: numbers of teeth for a wanted ratio, by one pair of gears or by two in a row."""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.gears.pairs.ratios import teeth_for
from parts.base.texts import N_, message
from parts.keys.base import mm
from parts.pages.inputs import calculation, exact
from parts.pages.page import Sheet, table_of

TOPIC = "ratio"
# shares, percent, at which a ratio near the wanted one is sought
_NEAR = (1, 3, 10, 40, 90)
_RATIO = Meta(ge=1e-4, le=1e4, description="wanted ratio: turns of the first wheel for one of the last", examples=[3.2])
_STAGES = Meta(ge=1, le=2, description="pairs in a row")
_TOLERANCE = Meta(ge=0, le=50, description="how far the ratio may be off", extra={"unit": "%"})
_COAXIAL = Meta(description="two stages of one distance: the last shaft in line with the first")


class RatioKeys(Struct, kw_only=True, forbid_unknown_fields=True):
    """Keys of the topic."""

    ratio: Annotated[float, _RATIO]
    stages: Annotated[int, _STAGES] = 1
    coaxial: Annotated[bool, _COAXIAL] = False
    ratio_tolerance_percent: Annotated[float, _TOLERANCE] = 0.5
    least_teeth: Annotated[int, Meta(ge=3, le=300, description="least number of teeth of any wheel")] = 12
    most_teeth: Annotated[int, Meta(ge=3, le=300, description="greatest number of teeth of any wheel")] = 120
    module: Annotated[float, mm("module of all wheels, for their distances", least=0.01, most=1000)] = 1.0


@calculation(TOPIC, RatioKeys)
def sheet(keys: RatioKeys) -> Sheet:
    """The sets found, and the smallest of them step by step."""
    if keys.least_teeth > keys.most_teeth:
        raise ParameterError("least_teeth", keys.least_teeth, "above_most_teeth", Nearest(keys.most_teeth, "at_most"))
    if keys.coaxial and keys.stages == 1:
        raise ParameterError("coaxial", True, "one_pair_coaxial", Nearest(False))
    found = _sets(keys, keys.ratio_tolerance_percent, keys.stages)
    if not found:
        two_have = keys.stages == 1 and _sets(keys, keys.ratio_tolerance_percent, 2)
        code = "no_pair_for_ratio" if two_have else "no_teeth_for_ratio"
        raise ParameterError("ratio", keys.ratio, code, lambda: _near(keys))
    page = Sheet(TOPIC, N_("Numbers of teeth for a ratio"))
    page.section("Wanted")
    page.add("wanted_ratio", keys.ratio, given=True, symbol="u_0", key="u_0")
    page.told(ratio_tolerance_percent=keys.ratio_tolerance_percent)
    page.told(least_teeth=keys.least_teeth, most_teeth=keys.most_teeth, module=keys.module)
    teeth = found[0]
    page.section(N_("The set of fewest teeth"))
    for wheel, number in enumerate(teeth, 1):
        page.add("number_of_teeth", number, gear=wheel)
    formula = "{z2} / {z1} * {z4} / {z3}" if keys.stages == 2 else "{z2} / {z1}"
    page.add("gear_ratio", _ratio(teeth), formula)
    page.add("ratio_off_percent", _off(keys, teeth), "100 * ({u} / {u_0} - 1)")
    for first in range(1, 2 * keys.stages, 2):
        wheels = f"{first}-{first + 1}"
        formula = f"{{m}} * ({{z{first}}} + {{z{first + 1}}}) / 2"
        value = _distance(keys, teeth, first)
        page.add("reference_centre_distance", value, formula, of=message("mesh {wheels}", wheels=wheels))
    heads = [(f"z_{k}", "") for k in range(1, len(teeth) + 1)]
    heads += [("u", ""), ("δu", "%"), *((f"a_{k}{k + 1}", "mm") for k in range(1, 2 * keys.stages, 2))]
    rows = [
        (*z, _ratio(z), _off(keys, z), *(_distance(keys, z, k) for k in range(1, 2 * keys.stages, 2))) for z in found
    ]
    page.tables.append(
        table_of("sets", N_("Sets, the fewest teeth first, each nearer than all with fewer"), heads, rows)
    )
    return page


def _sets(keys: RatioKeys, percent: float, stages: int) -> list[tuple[int, ...]]:
    limits = keys.least_teeth, keys.most_teeth
    return teeth_for(exact(keys.ratio), stages, *limits, percent / 100, coaxial=keys.coaxial)


def _near(keys: RatioKeys) -> Nearest | None:
    """The ratio nearest to the wanted one that has teeth."""
    found = next((sets for percent in _NEAR if (sets := _sets(keys, percent, keys.stages))), None)
    return Nearest(_ratio(found[-1])) if found else None


def _ratio(teeth: tuple[int, ...]) -> float:
    value = 1.0
    for first, second in zip(teeth[::2], teeth[1::2], strict=True):
        value *= second / first
    return value


def _off(keys: RatioKeys, teeth: tuple[int, ...]) -> float:
    return 100 * (_ratio(teeth) / keys.ratio - 1)


def _distance(keys: RatioKeys, teeth: tuple[int, ...], first: int) -> float:
    """a of the mesh that begins with that wheel, from 1 on."""
    return keys.module * (teeth[first - 1] + teeth[first]) / 2
