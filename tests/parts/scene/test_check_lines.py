"""Lines of a check: what only belongs together is said once, whoever is wrong has a line of its own."""

from __future__ import annotations

from exporters.production.check_lines import caption_lines, check_lines


def _fixed(second: str, met: bool = True) -> dict[str, object]:
    high = {"met": met, "code": "height", "value": 3.0, "required": 2.0, "tolerance": 0.1}
    conditions = [] if met else [high]
    return {"kind": "fixed", "first": "disk", "second": second, "conditions": conditions}


def test_names_that_count_on_are_a_row() -> None:
    """Bolts and nuts in turns, a gap in the numbers, names without one, and one that is wrong."""
    names = ["bolt_1", "nut_1", "bolt_2", "nut_2", "bolt_3", "nut_4", "cover", "ring_09", "ring_10"]
    mates = [*map(_fixed, names), _fixed("bolt_4", met=False)]
    train = dict.fromkeys(["disk", *names], 2.0) | {"pin_1": 0.5, "pin_2": 0.5, "pin_3": 0.5, "pin_4": 0.25}
    checks = {"mates": mates, "drives": [{"instance": "disk", "train": train}]}
    assert check_lines(checks, "en") == [
        "disk - bolt_1 ... bolt_3, nut_1, nut_2, nut_4, cover, ring_09, ring_10: fixed to each other",
        "disk - bolt_4: fixed to each other",
        "BROKEN: bolt_4 stands 3 mm above disk, 2 mm is required",
        "drive disk, turns: disk = 2, pin_1 ... pin_3 = 0.5, pin_4 = 0.25",
    ]


def test_a_drive_tells_what_turns_and_what_slides() -> None:
    """A plate has travel alone: its line of turns had none."""
    drives = [{"instance": "wedge", "train": {}, "travel": {"wedge": -10.0}},
              {"instance": "gear", "train": {"gear": 0.5}, "travel": {"rack": 62.831853}}]  # fmt: skip
    assert check_lines({"drives": drives}, "en") == [
        "drive wedge, travel in mm: wedge = -10",
        "drive gear, turns: gear = 0.5",
        "drive gear, travel in mm: rack = 62.8319",
    ]


def test_what_was_held_all_over_says_over_what() -> None:
    """Nothing that can meet, and pairs that no drive moves against each other."""
    still = [("one", "two", ()), ("one", "three", ("disk",))]
    for tested, poses, told in (
        ([], 0, "solids wherever drives may stand: none can meet another"),
        (still, 2, "solids wherever drives may stand: 1 pair as they stand, 1 pair over disk; 2 poses"),
    ):
        found = {"workspace": {"tested": tested, "rest": {}, "poses": poses, "uncovered": [], "fits": []}}
        assert check_lines(found, "en") == [told]


def test_what_was_held_on_the_way_is_told() -> None:
    hidden = {"first": "one", "second": "two", "share": 0.25, "depth": 0.5}
    motion = {"pairs": 2, "tested": 1, "poses": 7, "uncovered": [hidden, hidden | {"depth": 0.125, "share": 1}]}
    assert check_lines({"motion": motion}, "en", {"two": "Two"}) == [
        "solids in motion: 2 pairs over the period of each; 7 poses checked, the rest repeats or lies apart",
        "note: one and Two were checked over 0.25 of their period",
        "note: between the poses checked one and Two may overlap by up to 0.5 mm, the most of 2 pairs",
    ]
    apart = {"motion": {"pairs": 1, "tested": 0, "poses": 0, "uncovered": []}}
    assert check_lines(apart, "en") == ["solids in motion: 1 pair; none can meet the other"]


def test_a_caption_has_its_drives_where_all_its_letters_have_room() -> None:
    """To the letter: with one letter less of room they are left out."""
    bad = {"kind": "cam_yoke", "first": "cam", "second": "yoke", "verdict": "clear", "lift": 1.0, "yoke_breadth": 2.0,
           "gap": 0.1, "tolerance": 1e-8}  # fmt: skip
    checks = {"mates": [bad | {"second": f"yoke_{n}"} for n in range(9)],
              "drives": [{"instance": "cam", "train": {"cam": 1.0}}]}  # fmt: skip
    told = ["CLEAR: 9 pairs", "drive cam, turns: cam = 1"]
    letters = sum(map(len, told))
    assert caption_lines(checks, "en", {}, letters) == told
    assert caption_lines(checks, "en", {}, letters - 1) == told[:1]


def test_a_caption_tells_what_is_not_well_and_counts_the_rest() -> None:
    told = {"kind": "cam_yoke", "first": "cam", "lift": 1.0, "yoke_breadth": 2.0, "gap": 0.1, "tolerance": 1e-8}
    mates = [told | {"second": f"yoke_{n}", "verdict": "overlap" if n == 7 else "clear"} for n in range(40)]
    few = {"mates": mates[:2]}
    assert caption_lines(few, "en", {}, 500) == check_lines(few, "en", brief=True)
    bad, rest = caption_lines({"mates": mates}, "en", {"yoke_7": "Yoke"}, 500)
    assert "Yoke" in bad
    assert "OVERLAP" in bad
    assert rest == "CLEAR: 39 pairs"
