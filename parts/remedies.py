"""The last word of a refusal: a value that works when it is fed back, whichever key of the part it takes."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, get_args

import msgspec
from msgspec import Meta, Struct

from geometry.errors import GeometryError, ParameterError, at_least, at_most
from geometry.trial import is_trial, trial

# how refusals tell the value that works, and what of their text is to be taken off before another one is told
_OFFER = re.compile(
    r"(?:at most|at least|above|less than|;) (-?\d[\d.]*(?:e[+-]?\d+)?)(?: mm| degrees)?,? "
    r"(?:teeth work|works|fits|does|leaves)"
)
_OFFERED = re.compile(
    r"(?:; (?:at most|at least|above|less than|-?\d[\d.e+-]* (?:mm |degrees )?(?:teeth )?work"
    r"|a smaller|make it|change it|remove \w+)|\(numbers of).*$"
)
# tables that may be left out altogether, with what then takes their place
_OPTIONAL = (
    "cutter",
    "rounded_root",
    "tip_relief",
    "basic_rack",
    "web",
    "hub",
    "holes",
    "spokes",
    "bore",
    "face_chamfer",
)
# tables whose refusals name what was tried already (``hole_keys.with_remedy``)
_TRIED = ("bore", "holes", "spokes")
# keys that are changed only where nothing else helps
_TEETH = ("number_of_teeth",)
_LAST = ("pressure_angle_deg", "number_of_teeth", "module")

Path = tuple[str, ...]


def sure_remedy(spec: Any, refusal: ParameterError, builds: Callable[[Any], bool]) -> ParameterError:
    """The refusal itself if its number works when it is fed back, else one that names a value, or values, that do.

    ``builds``: whether a changed spec gives a part; it may raise geometry's errors.
    """

    if is_trial():
        return refusal

    def works(changed: Any) -> bool:
        try:
            with trial():
                return builds(changed)
        except (GeometryError, ArithmeticError):
            return False

    if refusal.name.partition(".")[0] in _TRIED and "works" in refusal.allowed:
        return refusal
    offer = _OFFER.search(refusal.allowed)
    path = tuple(refusal.name.split("."))
    if offer and has(spec, path) and works(changed(spec, path, _number(offer[1], value_at(spec, path)))):
        return refusal
    reason = _OFFERED.sub("", refusal.allowed).strip()
    keys = _candidates(spec, path)
    own = [k for k in keys if len(k) > 1 or k[0] not in _LAST]
    # the table that is to blame before all else: its keys, then the table itself
    blamed = [k for k in own if k == path or (len(path) > 1 and k[0] == path[0])]
    found = _one_key(spec, blamed, works) or _without(spec, path[0], works)
    found = found or _one_key(spec, [k for k in own if k not in blamed], works) or _resets(spec, works)
    found = found or _one_key(spec, [k for k in keys if k not in own], works) or _resets(spec, works, other_teeth=True)
    if found is None:
        return refusal
    key, text = found
    if key is None or ".".join(key) == refusal.name:
        return _told(refusal, refusal.name, refusal.value, f"{reason}; {text}")
    return _told(refusal, ".".join(key), value_at(spec, key), f"{refusal.name}: {reason}; {text}")


def _without(spec: Any, name: str, works: Callable[[Any], bool]) -> tuple[None, str] | None:
    """A table left out, if it can be and that does."""
    field = next((f for f in msgspec.structs.fields(spec) if f.name == name and name in _OPTIONAL), None)
    if field is None or field.default is msgspec.NODEFAULT or not isinstance(getattr(spec, name), Struct | list):
        return None
    return (None, f"with no {name} it works") if works(changed(spec, (name,), field.default)) else None


def _one_key(spec: Any, keys: list[Path], works: Callable[[Any], bool]) -> tuple[Path, str] | None:
    """The first of some keys of which a value works, and the words that say so."""
    for key in keys:
        found = _nearest(spec, key, value_at(spec, key), works)
        if found is not None:
            return key, f"{found}{_unit(spec, key)} works"
    return None


def _told(refusal: ParameterError, name: str, value: Any, text: str) -> ParameterError:
    kind = type(refusal)
    try:
        return kind(name, value, text)
    except TypeError:
        return ParameterError(name, value, text)


def value_at(spec: Any, path: Path) -> Any:
    """The value of a key, ``("cutter", "number_of_teeth")`` of a table; None where there is none."""
    for name in path:
        spec = getattr(spec, name, None)
    return spec


def has(spec: Any, path: Path) -> bool:
    """Whether a key holds a number that could be another one."""
    value = value_at(spec, path)
    return isinstance(value, int | float) and not isinstance(value, bool)


def changed(spec: Any, path: Path, value: Any) -> Any:
    """The spec with another value of one key."""
    name, *rest = path
    if rest:
        value = changed(getattr(spec, name), tuple(rest), value)
    return msgspec.structs.replace(spec, **{name: value})


def _number(text: str, like: Any) -> Any:
    return round(float(text)) if isinstance(like, int) else float(text)


def _field(spec: Any, path: Path) -> Any:
    owner = value_at(spec, path[:-1])
    return next(f for f in msgspec.structs.fields(owner) if f.name == path[-1])


def _meta(kind: Any) -> Meta | None:
    """The annotation of a key; that of its number where it may also be a table or nothing."""
    found = next((m for m in getattr(kind, "__metadata__", ()) if isinstance(m, Meta)), None)
    return found or next((m for a in get_args(kind) if (m := _meta(a)) is not None), None)


def _bounds(spec: Any, path: Path) -> tuple[float, float]:
    """The range of a key; an open end is taken a millionth inside."""
    meta = _meta(_field(spec, path).type)
    if meta is None:
        return -math.inf, math.inf
    low = float(meta.ge) if meta.ge is not None else float(meta.gt or 0) + 1e-6 if meta.gt is not None else -math.inf
    return low, float(meta.le) if meta.le is not None else math.inf


def _unit(spec: Any, path: Path) -> str:
    meta = _meta(_field(spec, path).type)
    unit = str((meta.extra or {}).get("unit", "")) if meta is not None else ""
    return f" {unit}" if unit in ("mm", "degrees") else ""


def _default(spec: Any, path: Path) -> Any:
    default = _field(spec, path).default
    return None if default is msgspec.NODEFAULT else default


def _keys(spec: Any, prefix: Path = ()) -> Iterator[Path]:
    """Every key that holds a number, those of tables too."""
    owner = value_at(spec, prefix)
    for field in msgspec.structs.fields(owner):
        path = (*prefix, field.name)
        value = getattr(owner, field.name)
        if isinstance(value, Struct):
            yield from _keys(spec, path)
        elif has(spec, path) and field.name not in ("face_width", "density"):
            yield path


def _candidates(spec: Any, blamed: Path) -> list[Path]:
    """Keys in the order in which a change is offered: what the user set before defaults, the blamed one first."""

    def rank(path: Path) -> tuple[bool, ...]:
        value = value_at(spec, path)
        usual, other = value == _default(spec, path), path != blamed
        return path[-1] in _LAST and len(path) == 1, usual, other, isinstance(value, int), path[:-1] != blamed[:-1]

    found = sorted(_keys(spec), key=rank)
    # a default that nobody set is worth changing only if it is to blame; the last ones can always be changed
    return [
        p for p in found if p == blamed or (len(p) == 1 and p[-1] in _LAST) or value_at(spec, p) != _default(spec, p)
    ]


def _nearest(spec: Any, path: Path, value: Any, works: Callable[[Any], bool]) -> str | None:
    """ "at most …" or "at least …" with a value of one key that works; None where none was found."""

    def good(tried: float) -> bool:
        return works(changed(spec, path, tried))

    low, high = _bounds(spec, path)
    if isinstance(value, int):
        whole = next((n for n in _whole_trials(value) if low <= n <= high and good(n)), None)
        return None if whole is None else f"at {'most' if whole < value else 'least'} {whole}"
    trials = _trials(value, _default(spec, path), low, high)
    found = next((v for v in trials if good(v)), None)
    if found is None:
        return None
    near, far = float(found), float(value)
    for _ in range(40):
        middle = (near + far) / 2
        near, far = (middle, far) if good(middle) else (near, middle)
    for digits in (4, 6, 9):
        text = at_most(near, digits) if near < value else at_least(near, digits)
        if low <= float(text) <= high and float(text) != value and good(float(text)):
            return f"at {'most' if near < value else 'least'} {text}"
    return f"at {'most' if near < value else 'least'} {near!r}" if "e" not in repr(near) else None


def _whole_trials(value: int) -> Iterator[int]:
    """Whole numbers ever farther from one."""
    for step in (*range(1, 17), *(round(16 * 1.4**k) for k in range(1, 20))):
        yield value + step
        yield value - step


def _trials(value: float, default: Any, low: float, high: float) -> Iterator[float]:
    """Values of a key from near to far: towards its default, then by shares of itself, then over its range."""
    usual = float(default) if isinstance(default, int | float) else 0.0
    for k in range(1, 11):
        yield value + (usual - value) * k / 10
    around = [value * (1 + s * k / 8) for k in range(1, 8) for s in (1, -1)]
    around += [value * 3.0 ** (s * k) for k in range(1, 8) for s in (1, -1)]
    if high - low <= 100:
        around += sorted((low + (high - low) * k / 20 for k in range(21)), key=lambda v: abs(v - value))
    yield from (v for v in around if low <= v <= high)


@dataclass(frozen=True, slots=True)
class _Reset:
    """A key or table that is put back to its default; ``label`` says so."""

    path: Path
    default: Any

    @property
    def label(self) -> str:
        name, value = ".".join(self.path), self.default
        shown = isinstance(value, int | float) and not isinstance(value, bool)
        return f"{name} = {value:g}" if shown else f"no {name}"


def _reset(spec: Any, resets: Sequence[_Reset]) -> Any:
    for item in resets:
        spec = changed(spec, item.path, item.default)
    return spec


def _resets(spec: Any, works: Callable[[Any], bool], *, other_teeth: bool = False) -> tuple[None, str] | None:
    """The fewest keys and tables, one if that does, that work when they are put back to their defaults.

    ``other_teeth``: with another number of teeth, where the gear of all defaults cannot have those it was given.
    """
    fields = {f.name: f.default for f in msgspec.structs.fields(spec) if f.default is not msgspec.NODEFAULT}
    tables = [_Reset((n,), fields[n]) for n in _OPTIONAL if n in fields and isinstance(getattr(spec, n), Struct | list)]
    keys = [_Reset(p, _default(spec, p)) for p in _keys(spec) if len(p) == 1 and p[0] in fields]
    nested = [p for p in _keys(spec) if len(p) > 1 and _field(spec, p).default is not msgspec.NODEFAULT]
    inner = [_Reset(p, _default(spec, p)) for p in nested]
    resets = [r for r in (*inner, *tables, *keys) if value_at(spec, r.path) != r.default]
    if not other_teeth:
        alone = next((r for r in resets if works(_reset(spec, [r]))), None)
        if alone is not None:
            return None, f"with {alone.label} it works"
    needed = [r for r in resets if len(r.path) == 1]
    if other_teeth:
        bare, (low, high) = _reset(spec, needed), _bounds(spec, _TEETH)
        tried = (n for n in _whole_trials(spec.number_of_teeth) if low <= n <= high)
        enough = next((n for n in tried if works(changed(bare, _TEETH, n))), None)
        needed += [] if enough is None else [_Reset(_TEETH, enough)]
    if not needed or not works(_reset(spec, needed)):
        return None
    for item in tuple(needed):
        fewer = [r for r in needed if r is not item]
        needed = fewer if works(_reset(spec, fewer)) else needed
    return None, f"with {', '.join(r.label for r in needed)} it works"
