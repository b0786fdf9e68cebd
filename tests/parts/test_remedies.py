"""Whatever a refusal of a gear, ring or rack offers works when it is fed back: wild but finite keys, all together."""

from __future__ import annotations

import re
from typing import Any

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from geometry.errors import ParameterError
from parts.cutter_keys import CutterTable
from parts.rack import RackSpec, checked_rack_part
from parts.ring_gear import RingGearSpec, RoundedRootTable, checked_ring_gear
from parts.spur_gear import RackTable, ReliefTable, SpurGearSpec, checked_spur_gear

CHECKS = {"spur_gear": checked_spur_gear, "ring_gear": checked_ring_gear, "rack": checked_rack_part}
OFFERED = re.compile(
    r"(?:at most|at least|above|;) (-?\d[\d.e+-]*)(?: mm| degrees)?,? (?:teeth work|works|fits|does|leaves)"
)


def fed_back(spec: Any, refused: ParameterError) -> Any:
    """The spec with what the refusal offers: a number for its key, or keys put back, tables left out."""
    if together := re.search(r"; with (.*) it works$", refused.allowed):
        for item in together[1].split(", "):
            name, sign, value = item.removeprefix("no ").partition(" = ")
            owner = spec
            for part in name.split(".")[:-1]:
                owner = getattr(owner, part)
            field = next(f for f in msgspec.structs.fields(owner) if f.name == name.rpartition(".")[2])
            spec = with_value(spec, name, value if sign else field.default)
        return spec
    offer = OFFERED.search(refused.allowed)
    assert offer, str(refused)
    return with_value(spec, refused.name, offer[1])


def with_value(spec: Any, name: str, value: Any) -> Any:
    """The spec with a key changed; text becomes a number of the kind that stands there."""
    head, _, rest = name.partition(".")
    old = getattr(spec, head)
    if rest:
        new = with_value(old, rest, value)
    elif isinstance(value, str) and name not in ("basic_rack", "hand"):
        new = round(float(value)) if isinstance(old, int) else float(value)
    else:
        new = value
    return msgspec.structs.replace(spec, **{head: new})


def first_offer_works(spec: Any) -> bool:
    """Whether a spec is refused, and then only once."""
    check = CHECKS[spec.__struct_config__.tag]
    try:
        check(spec)
    except ParameterError as refused:
        mended = fed_back(spec, refused)
        assert mended != spec
        try:
            check(mended)
        except ParameterError as again:
            raise AssertionError(f"{spec}\n{refused}\n{again}") from again
        return True
    return False


SINGLE = {
    "cutter of 3 teeth": (SpurGearSpec(2.0, 20, cutter=CutterTable(3)), "cutter.number_of_teeth"),
    "cutter far worn": (SpurGearSpec(2.0, 20, cutter=CutterTable(25, -5.0)), "cutter.profile_shift_coefficient"),
    "a ring's cutter of 3 teeth": (RingGearSpec(2.0, 60, cutter=CutterTable(3)), "cutter.number_of_teeth"),
    "a ring's cutter far worn": (RingGearSpec(2.0, 60, cutter=CutterTable(25, -5.0)), "cutter.profile_shift"),
    "rack addendum of a gear": (SpurGearSpec(2.0, 20, basic_rack=RackTable(3.0)), "basic_rack.addendum"),
    "rack addendum": (RackSpec(2.0, 20, basic_rack=RackTable(3.0)), "basic_rack.addendum"),
    "clearance of a wide rack": (RackSpec(2.0, 20, 30.0, RackTable(1.4, 1.0)), "basic_rack."),
    "root and rounding of a ring": (RingGearSpec(10.0, 40, rounded_root=RoundedRootTable(3.0, 1.5, False)), "rounded"),
    "tooth and rim of a small ring": (RingGearSpec(2.0, 5, outer_diameter=20.0), "number_of_teeth"),
    "rack beside a cutter": (
        SpurGearSpec(2.0, 30, basic_rack=RackTable(0.8, 0.3), cutter=CutterTable(25)),
        "basic_rack.tip_clearance_coefficient",
    ),
    "rack rounding beside a cutter": (
        SpurGearSpec(2.0, 30, basic_rack=RackTable(0.8, 0.25, 0.2), cutter=CutterTable(25)),
        "basic_rack.tip_radius_coefficient",
    ),
    "few teeth, thinned and chamfered": (SpurGearSpec(2.0, 3, tip_chamfer=1.6, circumferential_thinning=3.6), ""),
}


@pytest.mark.parametrize(("spec", "key"), SINGLE.values(), ids=SINGLE.keys())
def test_the_first_remedy_works(spec: Any, key: str) -> None:
    assert first_offer_works(spec)
    with pytest.raises(ParameterError) as refused:
        CHECKS[spec.__struct_config__.tag](spec)
    assert refused.value.name.startswith(key)


def test_a_key_that_nobody_set_is_not_to_blame() -> None:
    """The addendum of a cutter stands at its default; the three teeth are what was asked for."""
    with pytest.raises(ParameterError) as refused:
        checked_spur_gear(SpurGearSpec(2.0, 20, cutter=CutterTable(3)))
    assert refused.value.value == 3
    with pytest.raises(ParameterError):
        checked_spur_gear(SpurGearSpec(2.0, 20, cutter=CutterTable(4)))


def shares(most: float) -> st.SearchStrategy[float]:
    return st.one_of(st.just(0.0), st.floats(0, most).map(lambda v: round(v, 3)))


def both_ways(most: float) -> st.SearchStrategy[float]:
    return st.one_of(st.just(0.0), st.floats(-1, 1), st.floats(-most, most)).map(lambda v: round(v, 3))


modules = st.sampled_from([0.01, 0.3, 2.0, 10.0, 300.0])
angles = st.one_of(st.just(20.0), st.floats(5, 40).map(lambda v: round(v, 2)))
teeth = st.sampled_from([4, 5, 8, 12, 17, 23, 40, 100, 1000])
racks = st.one_of(
    st.sampled_from(["ISO 53 A", "ISO 53 D"]),
    st.builds(RackTable, st.floats(0.1, 3), st.floats(0, 1), st.one_of(st.none(), st.floats(0, 2))),
)
cutters = st.builds(
    CutterTable, st.sampled_from([3, 5, 10, 20, 25, 50, 100, 3000]), both_ways(5), st.floats(0.1, 3), st.floats(0, 2),
    st.booleans(),
)  # fmt: skip


@st.composite
def wild(draw: st.DrawFn, kind: str) -> Any:
    """Keys in their ranges, each for itself."""
    m, z = draw(modules), draw(teeth)
    keys: dict[str, Any] = {
        "module": m, "number_of_teeth": min(z, 500) if kind == "rack" else z, "pressure_angle_deg": draw(angles),
        "circumferential_thinning": draw(shares(2)) * m,
        "helix_angle_deg": draw(st.one_of(st.just(0.0), both_ways(60))),
    }  # fmt: skip
    keys[draw(st.sampled_from(["tip_chamfer", "tip_rounding"]))] = draw(shares(1)) * m
    if kind == "rack":
        return RackSpec(**keys, basic_rack=draw(racks), body_height=draw(st.sampled_from([None, 0.01 * m, 9 * m])))
    keys["profile_shift_coefficient"] = draw(both_ways(10))
    if draw(st.booleans()):
        keys["thinning_method"] = "deeper_cut"
    keys["tip_diameter"] = draw(st.one_of(st.none(), st.floats(-3, 5).map(lambda v: m * (z + v))))
    if kind == "ring_gear":
        root = draw(st.sampled_from(["", "cutter", "rounded_root"]))
        keys["addendum_coefficient"] = draw(st.sampled_from([1.0, 0.1, 0.8, 3.0]))
        keys["outer_diameter"] = draw(st.one_of(st.none(), st.floats(-3, 15).map(lambda v: m * (z + v))))
        tables = {"cutter": cutters, "rounded_root": st.builds(RoundedRootTable, st.floats(0.1, 3), st.floats(0, 2))}
        return RingGearSpec(**keys, **({root: draw(tables[root])} if root else {}))
    keys["bore_diameter"] = draw(shares(1.2)) * m * z
    cut = draw(st.sampled_from(["basic_rack", "cutter", "tip_relief"]))
    tables = {"basic_rack": racks, "cutter": cutters,
              "tip_relief": st.builds(ReliefTable, st.floats(0, 0.3), st.floats(0.01, 3))}  # fmt: skip
    return SpurGearSpec(**keys, **{cut: draw(tables[cut])})


@pytest.mark.parametrize("kind", CHECKS)
@given(data=st.data())
@settings(max_examples=4, deadline=None)
def test_any_first_remedy_works(kind: str, data: st.DataObject) -> None:
    first_offer_works(data.draw(wild(kind)))


@pytest.mark.heavy
@pytest.mark.parametrize("kind", CHECKS)
@given(data=st.data())
@settings(max_examples=300, deadline=None)
def test_any_first_remedy_works_at_length(kind: str, data: st.DataObject) -> None:
    first_offer_works(data.draw(wild(kind)))


def test_a_basic_rack_beside_a_cutter_gives_the_addendum_and_says_so() -> None:
    from exporters.words import finding_text
    from parts.spur_gear import spur_gear_part

    found = {}
    for rack in ("ISO 53 A", "ISO 53 D", RackTable(0.8)):
        spec = SpurGearSpec(2.0, 30, basic_rack=rack, cutter=CutterTable(25))  # type: ignore[arg-type]
        part = spur_gear_part("p", spec, checked_spur_gear(spec))
        found[str(rack)[:10]] = part
    plain, clearance, stub = found.values()
    assert [f.code for f in plain.findings] == []
    assert clearance.circles == plain.circles
    assert stub.circles["root_diameter"] == plain.circles["root_diameter"]
    assert stub.circles["tip_diameter"] == pytest.approx(60 + 2 * 0.8 * 2)
    for part in (clearance, stub):
        remark = next(f for f in part.findings if f.code == "cutter_makes_root")
        assert remark.limit == part.circles["root_diameter"]
        assert finding_text("en", remark)
        assert finding_text("uk", remark)
