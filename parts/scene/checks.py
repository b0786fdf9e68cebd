"""Mates of a scene: they join the parts that they are for, and their refusals are told in the keys of the scene."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from geometry.base.errors import GeometryError, Nearest, ParameterError
from geometry.base.nearest import kept, nearer, nearest
from parts.base.mate import TIP_ALONE, End, MateKeys, MateKind, Mating
from parts.base.part import Part
from parts.base.refusal import REMOVED, SceneError, placed
from parts.base.registry import KINDS
from parts.base.schema import as_typed, tried, unit_of, value_at
from parts.base.texts import message
from parts.mates.pairing import mated
from parts.mates.registry import MATES

if TYPE_CHECKING:
    from parts.base.part_keys import MaterialKeys
    from parts.scene.placing import Placing

# of the parts: their keys, what they are made from, and which part each instance is
Ends = Mapping[str, End[Any]]
PartOf = Mapping[str, str]


def joined(
    parts: Mapping[str, MaterialKeys],
    things: Mapping[str, Any],
    mates: Sequence[MateKeys],
    part_of: PartOf,
    source: str,
) -> tuple[dict[str, Any], list[Mating]]:
    """What the parts are made from, as a scene's mates want it, and the matings.

    Raises
    ------
    SceneError
        A mate joins other kinds of parts, or two parts that do not go together.
    """
    ends = {key: End(spec, things[key]) for key, spec in parts.items()}
    for number, mate in enumerate(mates, 1):
        kind, place = MATES[str(mate.__struct_config__.tag)], f"mates[{number}]"
        one, two = ends[part_of[mate.first]], ends[part_of[mate.second]]
        _check_kinds(kind, mate, (one.kind, two.kind), source, place)
        if kind.alone:
            _check_alone(mate, mates[: number - 1], source, place)
        try:
            kind.check(mate, one.keys, two.keys)
            mated(ends, [mate], part_of)
        except ParameterError as refusal:
            raise pair_refused(refusal, ends, mate, mates, part_of, source, place) from refusal
    try:
        final, matings = mated(ends, mates, part_of)
    except ParameterError as refusal:
        raise _refused_together(refusal, ends, mates, part_of, source) from refusal
    return {key: end.thing for key, end in final.items()}, matings


def _refused_together(
    refusal: ParameterError, ends: Ends, mates: Sequence[MateKeys], part_of: PartOf, source: str
) -> SceneError:
    """The refusal of mates of which each stands alone: by the backlash that alone is to blame, else by the first mate
    that does not stand beside those before it.
    """

    def alone(number: int, backlash: float) -> bool:
        changed = tried(mates[number], "normal_backlash", backlash)
        return bool(mated(ends, [*mates[:number], changed, *mates[number + 1 :]], part_of))

    def all_of_them(number: int, backlash: float) -> bool:
        return bool(mated(ends, _capped(mates, backlash), part_of))

    last = next(k for k in range(len(mates)) if not kept(lambda k: bool(mated(ends, mates[: k + 1], part_of)), k))
    asked = {k: _backlash(mate) for k, mate in enumerate(mates) if _backlash(mate)}
    for number in sorted(asked, key=asked.__getitem__, reverse=True):
        for stand in (all_of_them, alone):
            if kept(partial(stand, number), 0.0):
                cure = partial(nearest, partial(stand, number), asked[number], 0.0)
                gears = [part_of[mates[last].second]]
                wrong = ParameterError("normal_backlash", asked[number], "backlash_leaves_no_teeth", cure, gears=gears)
                return placed(source, f"mates[{number + 1}]", wrong, unit_of(type(mates[number]), wrong.name))
    bare = refusal.told_of(refusal.name, refusal.value, None)
    return pair_refused(bare, ends, mates[last], mates, part_of, source, f"mates[{last + 1}]")


def _backlash(mate: MateKeys) -> float:
    """What a mate asks for, mm; 0: nothing."""
    return getattr(mate, "normal_backlash", None) or 0.0


def _capped(mates: Sequence[MateKeys], most: float) -> list[MateKeys]:
    """The mates, none of which asks for more backlash than that, mm."""
    return [tried(mate, "normal_backlash", most) if _backlash(mate) > most else mate for mate in mates]


def _pointed(ends: Ends, mates: Sequence[MateKeys], part_of: PartOf) -> list[tuple[ParameterError, list[str]]]:
    """The refusals of mates whose backlash leaves no whole teeth of their two alone, with the gears."""
    found = []
    for mate in mates:
        try:
            mated(ends, [mate] if _backlash(mate) else [], part_of)
        except ParameterError as refusal:
            gears = refusal.numbers.get("gears")
            if refusal.code == "backlash_leaves_no_teeth" and isinstance(gears, list):
                two = enumerate((mate.first, mate.second), 1)
                found.append((refusal, [part_of[end] for k, end in two if k in gears]))
    return found


def _taken_by_all(
    refusals: Sequence[ParameterError], ends: Ends, mates: Sequence[MateKeys], part_of: PartOf
) -> Nearest | None:
    """The most backlash that all mates take, from the least of what each of the refused ones takes alone."""

    def stand(most: float) -> bool:
        return bool(mated(ends, _capped(mates, most), part_of))

    alone = [r.nearest.value for r in refusals if r.nearest is not None]
    least = min((value for value in alone if isinstance(value, float)), default=0.0)
    return Nearest(least, "at_most") if kept(stand, least) else nearest(stand, least, 0.0)


def check_fit(
    part: str, known: Ends, specs: Mapping[str, MaterialKeys], mates: Sequence[MateKeys], part_of: PartOf
) -> None:
    """Refuse a part that what is made of it, or one of its mates, does not take; each mate is held alone.

    A mate of other kinds of parts is left out: it is refused once all parts are made.

    ``known``: the part, and what has been made of the ``specs``.

    Raises
    ------
    ParameterError
        Under the part's key where that is to blame, else under that of a mate or with another part's name before it.
    GeometryError, SceneError
        Another part cannot be made.
    """
    ends = dict(known)

    def end_of(name: str) -> End[Any]:
        if name not in ends:
            spec = specs[name]
            try:
                ends[name] = End(spec, thing_of(name, spec, specs, mates, part_of))
            except ParameterError as refusal:
                raise refusal.renamed(f"{name}.{refusal.name}") from refusal
        return ends[name]

    for name, spec in specs.items():
        if value_at(spec, "of") == part:
            ends.pop(name, None)
            end_of(name)
    for mate in mates:
        pair = part_of[mate.first], part_of[mate.second]
        kind = MATES[str(mate.__struct_config__.tag)]
        if part not in pair or not _joins(kind, specs, pair):
            continue
        one, two = map(end_of, pair)
        try:
            kind.check(mate, one.keys, two.keys)
            mated(ends, [mate], part_of)
        except ParameterError as refusal:
            owner, _, key = refusal.name.partition(".")
            if owner == "mate":
                raise
            owner, key = (pair[0], key) if owner == "first" else (pair[1], refusal.name)
            told = refusal.renamed(key if owner == part else f"{owner}.{key}")
            if pair[0] != pair[1]:
                raise told from refusal

            def fits(value: float, mate: MateKeys = mate, spec: MaterialKeys = one.keys, key: str = key) -> bool:
                changed = tried(spec, key, value)
                end = End(changed, thing_of(part, changed, {**specs, part: changed}, mates, part_of))
                check_fit(part, {part: end}, {**specs, part: changed}, [mate], part_of)
                return True

            # what one of both would have to have, its twin has too
            raise nearer(told, fits) from refusal


def thing_of(
    part: str, keys: MaterialKeys, specs: Mapping[str, MaterialKeys], mates: Sequence[MateKeys], part_of: PartOf
) -> Any:
    """What a part's keys make; where its teeth are pointed alone, with the tip that its mates leave it.

    Raises
    ------
    ParameterError
        It cannot be; of teeth that are pointed beside the mates too the value with which they are not.
    """
    kind = KINDS[str(keys.__struct_config__.tag)]
    try:
        return kind.thing(keys, specs)
    except ParameterError as refusal:
        if refusal.code not in TIP_ALONE:
            raise
        name, tips = refusal.name, list[float]()
        for mate in mates:
            pair = part_of[mate.first], part_of[mate.second]
            if part in pair:
                with suppress(ParameterError):
                    other = specs[pair[pair[0] == part]]
                    tips += MATES[str(mate.__struct_config__.tag)].tip_beside(mate, keys, other)
        if not tips:
            raise
        try:
            return kind.thing(tried(keys, "tip_diameter", min(tips)), specs)
        except ParameterError as other:
            # what else is wrong with it, in a key that it has
            if other.code not in TIP_ALONE and other.name != "tip_diameter":
                raise

        def works(value: float) -> bool:
            return bool(thing_of(part, tried(keys, name, value), specs, mates, part_of))

        raise nearer(refusal, works) from refusal


def unlike(
    part: str, specs: Mapping[str, MaterialKeys], mates: Sequence[MateKeys], part_of: PartOf, source: str
) -> SceneError | None:
    """The refusal of a part that cannot be made in the key in which it differs from its mate, where that is the cure.

    None where its mates take its keys, or where the value that they want makes no part of it that they take.
    """
    keys = specs[part]
    for number, mate in enumerate(mates, 1):
        pair = [part_of[mate.first], part_of[mate.second]]
        kind = MATES[str(mate.__struct_config__.tag)]
        if part not in pair or not _joins(kind, specs, pair):
            continue
        # of two alike the second is told its key
        if type(specs[pair[0]]) is type(specs[pair[1]]):
            pair.sort(key=lambda name: name == part)
        other = specs[pair[1 - pair.index(part)]]
        try:
            kind.check(mate, specs[pair[0]], specs[pair[1]])
        except ParameterError as refusal:
            owner, _, key = refusal.name.rpartition(".")
            told, own = key, part == pair[0 if owner == "first" else 1]
            key = key if own else str(refusal.numbers.get("of", key))
            given, theirs = value_at(keys, key), refusal.nearest if own else Nearest(value_at(other, told))
            if owner not in ("", "first") or theirs is None or None in (given, theirs.value):
                continue

            def works(value: object, key: str = key) -> None:
                changed = {**specs, part: tried(keys, key, value)}
                end = End(changed[part], thing_of(part, changed[part], changed, mates, part_of))
                check_fit(part, {part: end}, changed, mates, part_of)

            if _holds(works, theirs.value):
                cured = ParameterError(key, given, refusal.code, theirs)
                return placed(source, f"mates[{number}]: parts.{part}", cured, unit_of(type(keys), key))
    return None


def _tell_of_all(
    told: SceneError, alone: Callable[[], Nearest | None], ends: Ends, mates: Sequence[MateKeys], part_of: PartOf
) -> None:
    """Tell a backlash that leaves no whole teeth with the gears of all mates of which that is so, and what all take.

    ``alone``: what one mate takes.
    """
    specs = {name: end.keys for name, end in ends.items()}
    pairs = [(m, MATES[str(m.__struct_config__.tag)], (part_of[m.first], part_of[m.second])) for m in mates]
    held = [m for m, kind, pair in pairs if _joins(kind, specs, pair)]
    pointed = _pointed(ends, held, part_of)
    # here gears have names
    told.numbers["gears"] = [*dict.fromkeys(gear for _, gears in pointed for gear in gears)]
    told.offer(lambda: _taken_by_all([one for one, _ in pointed], ends, held, part_of) or alone())


def pair_refused(
    refusal: ParameterError,
    ends: Ends,
    mate: MateKeys,
    mates: Sequence[MateKeys],
    part_of: PartOf,
    source: str,
    place: str,
) -> SceneError:
    """The refusal of a mate under the key of the scene, its own or that of a part; ``place``: where the mate stands.

    What it offers is tried once: a key of the mate on both parts, one of a part on all its ``mates``.
    """
    owner, _, key = refusal.name.partition(".")
    specs = {name: end.keys for name, end in ends.items()}
    if owner == "mate":
        told = placed(source, place, refusal.renamed(key), unit_of(type(mate), key))
        alone = partial(_tried, refusal, lambda value: mated(ends, [tried(mate, key, value)], part_of))
        told.offer(alone)
        if refusal.code == "backlash_leaves_no_teeth":
            _tell_of_all(told, alone, ends, mates, part_of)
        return told
    owner, key = ("first", key) if owner == "first" else ("second", refusal.name)
    part = part_of[mate.first if owner == "first" else mate.second]
    spec = ends[part].keys

    def works(value: object, held: Sequence[MateKeys]) -> None:
        changed = tried(spec, key, value)
        others = {**specs, part: changed}
        changed_end = End(changed, thing_of(part, changed, others, mates, part_of))
        check_fit(part, {**ends, part: changed_end}, others, held, part_of)

    given, theirs = refusal.value, getattr(ends[part_of[mate.first]].keys, key, None)
    alike = owner == "second" and theirs is not None and refusal.nearest == Nearest(theirs)

    def stands(first: str) -> None:
        elsewhere = [m for m in mates if part not in (part_of[m.first], part_of[m.second])]
        check_fit(first, ends, specs, elsewhere, part_of)

    if (
        alike
        and isinstance(given, int | float | str)
        and not (_holds(partial(works, held=[mate]), theirs) and _holds(stands, part_of[mate.first]))
    ):
        # what both have alike may be the first one's to change
        other = ParameterError(f"first.{key}", theirs, "not_that_of_mate", Nearest(given))
        turned = pair_refused(other, ends, mate, mates, part_of, source, place)
        if turned.nearest is not None:
            return turned
    if part_of[mate.first] == part_of[mate.second]:
        refusal = nearer(refusal, partial(_holds, partial(works, held=[mate])))
    told = placed(source, f"{place}: parts.{part}", refusal.renamed(key), unit_of(type(spec), key))
    told.offer(lambda: _tried(refusal, partial(works, held=[mate]), partial(works, held=mates)))
    found = refusal.nearest
    if owner == "second" and found is not None and found.side == "exactly" and told.nearest is None:
        # what the first tells of its mate may be wrong
        return unlike(part_of[mate.first], specs, mates, part_of, source) or told
    return told


def _tried(
    refusal: ParameterError, works: Callable[[Any], object], whole: Callable[[Any], object] | None = None
) -> Nearest | None:
    """What a refusal offers, tried; a limit that another one stops is sought on beyond it. None where none works.

    ``whole``: what that must do too, asked once.
    """
    found, given = refusal.nearest, refusal.value
    if found is not None and found.value is not None and not _holds(works, found.value):
        if found.side == "exactly" or not isinstance(found.value, float) or not isinstance(given, float):
            return None
        ends = (given + (found.value - given) * 2.0**k for k in range(1, 12))
        found = nearest(lambda value: _holds(works, value), given, ends)
    return found if found is None or whole is None or _holds(whole, found.value) else None


def _holds(works: Callable[[Any], object], value: object) -> bool:
    try:
        works(value)
    except (GeometryError, ArithmeticError, SceneError):
        return False
    return True


def _joins(kind: MateKind[Any, Any, Any], specs: Mapping[str, MaterialKeys], pair: Sequence[str]) -> bool:
    """Whether a mate is for the kinds of two parts, in this order."""
    return kind.joins is None or tuple(str(specs[name].__struct_config__.tag) for name in pair) in kind.joins


def _check_kinds(
    kind: MateKind[Any, Any, Any], mate: MateKeys, found: tuple[str, str], source: str, place: str
) -> None:
    """A mate joins the kinds of parts that it is for."""
    if kind.joins is None or found in kind.joins:
        return
    index = 0 if all(first != found[0] for first, _ in kind.joins) else 1
    key = ("first", "second")[index]
    # of many those that one of both is for
    near = [pair for pair in kind.joins if pair[0] == found[0] or pair[1] == found[1]] or kind.joins
    pairs = [message("{first} and {second}", first=a, second=b) for a, b in near]
    told: dict[str, Any] = {"found": found[index], "mate": kind.name, "joins": pairs}
    code = "mate_joins"
    if found[::-1] in kind.joins:
        code = "mate_joins_swapped"
    elif other := next((m.name for m in MATES.values() if m.joins and found in m.joins), None):
        code, told["other"] = "mate_joins_other", other
    raise SceneError(source, f"{place}.{key}", getattr(mate, key), code, **told)


def _check_alone(mate: MateKeys, before: Sequence[MateKeys], source: str, place: str) -> None:
    """No instance is in two mates of a kind that has its teeth alone."""
    for key, instance in (("first", mate.first), ("second", mate.second)):
        for number, other in enumerate(before, 1):
            if type(other) is type(mate) and instance in (other.first, other.second):
                raise SceneError(source, f"{place}.{key}", instance, "teeth_are_taken", other=f"mates[{number}]")


def check_solids(parts: Mapping[str, Part], source: str) -> None:
    """Refuse solids that do not exist, before they are held against each other.

    Raises
    ------
    SceneError
        In the key of the part.
    """
    for part in parts.values():
        try:
            part.blank(0.0)
        except ParameterError as refusal:
            raise solid_refused(part, refusal, source) from refusal


def solid_refused(part: Part, refusal: ParameterError, source: str) -> SceneError:
    """The refusal of a part's solid in the key that asks for it."""
    told = as_typed(part.keys, refusal)
    error = placed(source, f"parts.{part.id}", told, unit_of(type(part.keys), told.name))
    given = told.value
    if told.name.startswith("face_chamfer") and isinstance(given, float):

        def works(chamfer: float) -> bool:
            part.made_by.solid(tried(part.keys, told.name, chamfer), part.thing, 0.0)
            return True

        def cure() -> Nearest | None:
            """Its own margin; all of them where another one is narrower, or one number stands for both faces."""
            found = refusal.nearest if told is refusal else None
            if found is None or not isinstance(found.value, float):
                return nearest(works, given, 0.0)
            return found if kept(works, found.value) else nearest(works, found.value, 0.0)

        # with what the mates have left of the part
        error.offer(cure)
    return error


def check_workspace(poses: int | None, placing: Placing, source: str) -> None:
    """Refuse to hold a scene wherever its drives may stand where these do not tell where that is.

    Raises
    ------
    SceneError
        It has no drives, or something does not turn evenly with them.
    """
    if poses is None:
        return
    place = "checks.workspace"
    if placing.train is None:
        raise SceneError(source, place, poses, "workspace_needs_drives", REMOVED)
    from parts.scene.workspace import uneven

    if lying := sorted(placing.train.in_space):
        raise SceneError(source, place, poses, "workspace_of_upright", REMOVED, lying=lying[0])
    free = next((i.id for i in placing.instances if uneven(placing.train, i.id)), None)
    if free is not None:
        raise SceneError(source, place, poses, "workspace_of_turns", REMOVED, free=free)
