"""Metric threads by designation: diameters as ISO 724 and GOST 24705 print them, limits as ISO 965-2 and DIN 13 do."""

from __future__ import annotations

import pytest

from geometry.base.errors import ParameterError
from geometry.solids.metric_threads import MetricThread
from parts.keys.threads import thread_of

# d2, d1 of ISO 724 and d3 of GOST 24705
PRINTED = {
    "M3": (2.675, 2.459, 2.387), "M8": (7.188, 6.647, 6.466), "M8x1": (7.350, 6.917, 6.773),
    "M10": (9.026, 8.376, 8.160), "M12": (10.863, 10.106, 9.853), "M16": (14.701, 13.835, 13.546),
    "M20": (18.376, 17.294, 16.933), "M20x1.5": (19.026, 18.376, 18.160), "M24": (22.051, 20.752, 20.319),
    "M64": (60.103, 57.505, 56.639),
}  # fmt: skip
# d and d2 of class 6g, greatest and least
LIMITS = {
    "M1.6": (1.581, 1.496, 1.354, 1.291), "M3": (2.980, 2.874, 2.655, 2.580), "M5": (4.976, 4.826, 4.456, 4.361),
    "M6x0.75": (5.978, 5.838, 5.491, 5.391), "M8": (7.972, 7.760, 7.160, 7.042), "M8x1": (7.974, 7.794, 7.324, 7.212),
    "M10": (9.968, 9.732, 8.994, 8.862), "M10x1": (9.974, 9.794, 9.324, 9.212),
    "M12": (11.966, 11.701, 10.829, 10.679), "M16": (15.962, 15.682, 14.663, 14.503),
    "M20": (19.958, 19.623, 18.334, 18.164), "M24": (23.952, 23.577, 22.003, 21.803),
    "M30": (29.947, 29.522, 27.674, 27.462), "M36": (35.940, 35.465, 33.342, 33.118),
    "M48": (47.929, 47.399, 44.681, 44.431),
}  # fmt: skip


@pytest.mark.parametrize("name", PRINTED)
def test_diameters_are_those_of_the_tables(name: str) -> None:
    thread = thread_of(name)
    found = thread.pitch_diameter, thread.minor_diameter, thread.root_diameter
    assert found == pytest.approx(PRINTED[name], abs=0.00051)


@pytest.mark.parametrize("name", LIMITS)
def test_limits_of_6g_are_those_of_the_tables(name: str) -> None:
    limits = thread_of(name).limits()
    assert limits is not None
    assert (*limits.major[::-1], *limits.pitch[::-1]) == pytest.approx(LIMITS[name], abs=0.00051)
    # of 6h they begin at the nominal sizes and are as wide
    beside = thread_of(f"{name}-6h").limits()
    assert beside is not None
    assert beside.major[1] == thread_of(name).diameter
    assert beside.tolerances == limits.tolerances


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("M8", MetricThread(8.0, 1.25, True, "6g")),
        ("M8x1.25", MetricThread(8.0, 1.25, True, "6g")),
        ("m8X1", MetricThread(8.0, 1.0, False, "6g")),
        # Cyrillic letters, a decimal comma, blanks, GOST's place of LH
        ("\u041c20 \u0445 1,5 - 8g", MetricThread(20.0, 1.5, False, "8g")),
        ("M20x1.5-6g-LH", MetricThread(20.0, 1.5, False, "6g", True)),
        ("M20x1.5LH-6g", MetricThread(20.0, 1.5, False, "6g", True)),
        ("M20\u00d72-LH", MetricThread(20.0, 2.0, False, "6g", True)),
        ("M1.4", MetricThread(1.4, 0.3, True, "6h")),
        ("M10-5g6g", MetricThread(10.0, 1.5, True, "5g6g")),
    ],
)
def test_designations_are_read(text: str, meant: MetricThread) -> None:
    assert thread_of(text) == meant


@pytest.mark.parametrize(
    ("text", "code", "near"),
    [
        ("8", "no_such_thread", None),
        ("G1/2", "no_such_thread", None),
        ("M20LH-6g-LH", "no_such_thread", None),
        ("M8-6g-LHx", "no_such_thread", None),
        ("M13", "no_thread_of_diameter", "M12"),
        ("M8.2x1", "no_thread_of_diameter", "M8"),
        ("M15.3", "no_thread_of_diameter", "M15x1.5"),
        ("M8x1.5", "no_such_thread_pitch", "M8"),
        ("M8x0.9", "no_such_thread_pitch", "M8x1"),
        ("M15", "no_such_thread_pitch", "M15x1.5"),
        ("M8-6H", "no_such_thread_class", "M8"),
        ("M8x1-2g", "no_such_thread_class", "M8x1"),
    ],
)
def test_others_are_refused_with_one_that_works(text: str, code: str, near: str | None) -> None:
    with pytest.raises(ParameterError) as refusal:
        thread_of(text)
    assert refusal.value.code == code
    cure = refusal.value.nearest
    assert (cure and cure.value) == near
    if near is not None:
        assert thread_of(near)


def test_a_class_whose_limits_are_not_held_has_none() -> None:
    assert thread_of("M8-8g").limits() is None
    assert thread_of("M200x3").limits() is None
