"""The key of a metric thread on a shaft: its designation, as M8, M8x1 or M20x1.5-6g-LH."""

from __future__ import annotations

import re
from functools import cache
from typing import Annotated

from msgspec import Meta

from geometry.base.errors import Nearest, ParameterError
from geometry.solids.metric_threads import MetricThread
from parts.base.lookalikes import in_latin
from parts.base.psv import rows_of

# classes of external threads of ISO 965-1 and GOST 16093; the usual one, up to a diameter that one
_CLASSES = ("3h4h", "4g", "4h", "5g6g", "5h4h", "5h6h", "6d", "6e", "6f", "6g", "6h", "7e6e", "7g6g", "7h6h", "8g",
            "8h", "9g8g")  # fmt: skip
_USUAL, _SMALL, _OF_SMALL = "6g", 1.4, "6h"
_NUMBER = r"(\d+(?:\.\d+)?)"
_DESIGNATION = re.compile(rf"[Mm]{_NUMBER}(?:x{_NUMBER})?(-?LH)?(?:-(?!LH)(\w+))?(-?LH)?")
# signs of multiplication, decimal commas, minus and dashes
_SIGNS = str.maketrans("X\u00d7*,\u2212\u2013\u2014", "xxx.---")

Thread = Annotated[
    str,
    Meta(
        description="designation of a metric thread by ISO 261 (GOST 8724): M8, M8x1, M20x1.5-6g-LH; default: the"
        " coarse pitch, class 6g (6h up to M1.4), right-hand",
        examples=["M12"],
    ),
]


@cache
def _pitches() -> dict[float, tuple[float | None, tuple[float, ...]]]:
    """The coarse pitch and all pitches of each diameter, mm."""
    found = dict[float, tuple[float | None, tuple[float, ...]]]()
    for diameters, coarse, fine in rows_of(__file__, "thread_pitches"):
        pitches = tuple(map(float, [*coarse.split(), *fine.split()]))
        found |= {float(diameter): (pitches[0] if coarse else None, pitches) for diameter in diameters.split()}
    return found


def thread_of(text: str) -> MetricThread:
    """The thread of a designation.

    Raises
    ------
    ParameterError
        ``thread``: it is none, or the standards have no such diameter, pitch or class.
    """
    found = _DESIGNATION.fullmatch(in_latin("".join(text.split())).translate(_SIGNS))
    if found is None or (found[3] and found[5]):
        raise ParameterError("thread", text, "no_such_thread")
    diameter, left = float(found[1]), bool(found[3] or found[5])
    if diameter not in _pitches():
        near = min(_pitches(), key=lambda size: abs(size - diameter))
        meant = _named(near, _pitches()[near][1][0])
        raise ParameterError("thread", text, "no_thread_of_diameter", Nearest(meant, "meant"))
    coarse, pitches = _pitches()[diameter]
    pitch = coarse if found[2] is None else float(found[2])
    if pitch not in pitches:
        near = min(pitches, key=lambda size: abs(size - (pitch or size)))
        told = ", ".join(f"{size:g}" for size in pitches)
        cure = Nearest(_named(diameter, near))
        raise ParameterError("thread", text, "no_such_thread_pitch", cure, diameter=f"{diameter:g}", pitches=told)
    tolerance = found[4] or (_OF_SMALL if diameter <= _SMALL else _USUAL)
    if tolerance not in _CLASSES:
        raise ParameterError(
            "thread", text, "no_such_thread_class", Nearest(_named(diameter, pitch)), known=", ".join(_CLASSES)
        )
    return MetricThread(diameter, pitch, pitch == coarse, tolerance, left)


def _named(diameter: float, pitch: float) -> str:
    """The shortest designation of a thread of the usual class."""
    return f"M{diameter:g}" + ("" if pitch == _pitches()[diameter][0] else f"x{pitch:g}")


def thread_words(thread: MetricThread, pitch: str) -> str:
    """What follows M and the diameter in a designation, its pitch as it is told."""
    return ("" if thread.coarse else f"\u00d7{pitch}") + f"-{thread.tolerance}" + ("-LH" if thread.left else "")
