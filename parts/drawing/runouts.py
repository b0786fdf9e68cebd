"""Runouts of a round part about its bore: the mark of the datum, and the frames of tolerances; GOST 2.308."""

from __future__ import annotations

from geometry.base.record import replace
from parts.drawing.working import Note, PartDrawing, Round, Size, Spot, Subject, View

# the sizes whose axis is the datum, the first that a drawing has; of splines the one that centres, which has a zone
_DATUMS = ("bore_diameter", "bore.across_flats", "spline.outer_diameter", "spline.inner_diameter", "outer_diameter")

# decimals of a tolerance, which stands as it is given
_DIGITS = 4


def with_runouts(drawing: PartDrawing, subject: Subject) -> tuple[PartDrawing, set[str]]:
    """The drawing with the runouts that are wished, and the keys of those; none where it has no datum."""
    main, wishes = drawing.views[0], subject.wishes
    places = {"tip_runout": main.rim, "face_runout": main.face}
    wished = {key: size for key in places if places[key] and (size := getattr(wishes, key)) is not None}
    sizes = list[Size | Round]()
    for view in drawing.views:
        sizes += view.sizes
        sizes += view.rounds
    found = [one for name in _DATUMS for one in sizes if one.name == name]
    if not wished or not found:
        return drawing, set()
    centred = [one for one in found if one.name.startswith("spline") and one.after]
    datum, letter = (centred or found)[0], _letter(drawing.views, subject)
    frames = [_frame(places[key], subject.say(size, _DIGITS), letter) for key, size in wished.items()]
    main, *others = (_marked(view, datum, letter) for view in drawing.views)
    return replace(drawing, views=(main.plus(notes=frames), *others)), {*wished}


def _letter(views: tuple[View, ...], subject: Subject) -> str:
    """The first letter that names no view."""
    taken = {cut.letter for view in views for cut in view.cuts}
    taken |= {note.text for view in views for note in view.notes if note.looks or note.is_letter}
    number = 0
    while subject.letter(number) in taken:
        number += 1
    return subject.letter(number)


def _marked(view: View, datum: Size | Round, letter: str) -> View:
    """A view whose size of the datum has its letter."""
    sizes = tuple(replace(one, datum=letter) if one is datum else one for one in view.sizes)
    rounds = tuple(replace(one, datum=letter) if one is datum else one for one in view.rounds)
    return replace(view, sizes=sizes, rounds=rounds)


def _frame(spots: tuple[Spot, ...], size: str, letter: str) -> Note:
    (at, free), *also = spots
    return Note(at, size, free=free, also=tuple(also), datum=letter)
