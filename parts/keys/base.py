"""Annotated types of scene keys: unit, range and meaning stand beside each key, once.

The annotations are the schema: validation, error texts and ``higherpair new`` all read them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import partial
from typing import Annotated, Any

from msgspec import Meta, Struct

from geometry.base.errors import Nearest, ParameterError
from geometry.base.tolerance import LEAST_LENGTH
from parts.base.fields import defaults_of, given_keys
from parts.base.part_keys import MaterialKeys

# the largest part, mm
MOST_LENGTH = 100_000.0


def size(
    unit: str,
    text: str,
    *,
    above: float | None = None,
    least: float | None = None,
    below: float | None = None,
    most: float | None = None,
    example: object = None,
    aside: bool = False,
    length: bool = True,
) -> Meta:
    """A key with a unit and a range; ``example``: for a scene to start from, of a key without a default.

    ``aside``: it may stand in place of others, so that ``new`` leaves it out of a table.
    A length above 0 is at least ``LEAST_LENGTH``: one that may be 0 is 0 or that much, unless it is no
    ``length`` of a part.
    """
    if unit == "mm" and above == 0:
        above, least = None, LEAST_LENGTH
    ends: dict[str, Any] = {"gt": above, "ge": least, "lt": below, "le": most}
    marks = {"unit": unit, "aside": aside, "length": length and unit in ("mm", "modules")}
    return Meta(**ends, description=text, examples=None if example is None else [example], extra=marks)


mm, degrees, in_modules = partial(size, "mm"), partial(size, "degrees"), partial(size, "modules")
# of a part or of a place on it
part_mm = partial(mm, most=MOST_LENGTH)


def start(value: object, *others: tuple[object, str]) -> Meta:
    """What a scene to start from sets, even where the key has a default.

    ``others``: values that would do as well, shown below it, each with what it is.
    """
    return Meta(examples=[value], extra={"start": True, "others": others})


# names become parts of file names; Windows keeps some for devices
IDENTIFIER = r"^[A-Za-z0-9][A-Za-z0-9_-]{0,63}\Z"
DEVICE_NAMES = {"con", "prn", "aux", "nul", *(f"{port}{n}" for port in ("com", "lpt") for n in range(1, 10))}
Identifier = Annotated[
    str,
    Meta(
        pattern=IDENTIFIER,
        description="part of the file's name where two exports share an ending; letters, digits, _, -",
    ),
]
FaceWidth = Annotated[float, mm("thickness of the part along its axis", least=0.01, most=10_000)]
BoreDiameter = Annotated[float, mm("round bore; 0 is none", least=0, most=MOST_LENGTH)]


def either(key: str, value: object, other: str, without: float | None = None) -> ParameterError:
    """A refusal of two keys that exclude each other; the refused one works as ``without``, None: left out."""
    return ParameterError(key, value, "either_key", Nearest(without), one=other, other=key.rpartition(".")[2])


def in_vain(keys: Any, names: Sequence[str], code: str = "needs_other", **told: Any) -> Iterator[ParameterError]:
    """The refusals of those of some keys that are not as by default and do nothing beside the others."""
    kind: type[Struct] = type(keys)
    given = given_keys(keys)
    for name in (name for name in names if name in given):
        shown = None if isinstance(given[name], Struct) else given[name]
        works = Nearest(None if code == "needs_other" else defaults_of(kind)[name])
        yield ParameterError(name, shown, code, works, **told)


def check_idle(idle: Iterable[ParameterError]) -> None:
    """Refuse the first of keys that do nothing."""
    for refusal in idle:
        raise refusal


def check_not_in_vain(keys: Any, names: Sequence[str], other: str) -> None:
    """Refuse those of some keys that are not as by default: they act only with another one, which is not given.

    Raises
    ------
    ParameterError
        Of the first such key.
    """
    check_idle(in_vain(keys, names, other=other))


class MadeKeys(MaterialKeys, kw_only=True):
    """Keys of every part whose thickness is a key too."""

    face_width: FaceWidth = 10.0
