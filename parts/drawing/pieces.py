"""Pieces of a sheet: drawn each by itself with its words, then laid side by side on as few papers as hold them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record, replace
from parts.drawing.canvas import TEXT_HEIGHT, Box, Canvas
from parts.drawing.choice import PAPERS, blank
from parts.drawing.title_block import TITLE_BLOCK

# between pieces, and from the last line of one to its title, mm
_GAP, _TITLE_GAP = 9.0, 3.5
# what words about a piece take of it, mm, which does not grow with it, and caution in what would be held
_WORDS, _CAUTION = 40.0, 0.95
# papers tried for one sheet, where none is asked for
_ONE = ("A3", "A2")
# points of a curve by which its reach is told
_POINTS = 65


class Piece(Record, eq=False):
    """What is drawn together, in a place of its own, and the room that it takes, mm.

    ``key`` and ``value``: the key that makes it so large, which grows with it or, ``inverse``, against it.
    """

    canvas: Canvas
    room: Box
    key: str = ""
    value: float = 0.0
    inverse: bool = False


def reach(canvas: Canvas) -> Box:
    """The room of all that is on a canvas."""
    curves = (np.ravel(s.curve.point(np.linspace(*s.curve.domain, _POINTS))) for s in canvas.strokes)
    boxes = [Box(p.real.min(), p.imag.min(), p.real.max(), p.imag.max()) for p in curves]
    return Box.about([*boxes, *(text.box for text in canvas.texts)])


def titled(canvas: Canvas, *titles: str) -> Piece:
    """A piece with lines of its title above it."""
    room = reach(canvas)
    for number, title in enumerate(reversed(titles)):
        canvas.write(title, complex(room.left, room.high + _TITLE_GAP + number * 1.9 * TEXT_HEIGHT))
    return Piece(canvas, reach(canvas))


def laid(pieces: Sequence[Piece], paper: str | None) -> list[Canvas]:
    """Lying sheets of a paper with all pieces, in their order where as few then hold them as with the tallest or the
    largest first; the lower right corners are kept for title blocks. None: the smallest of which one sheet holds all,
    else A1.

    Raises
    ------
    ParameterError
        ``paper``: it does not hold one of them, with the least that does.
    """
    if paper is None:
        return next((one for name in _ONE if len(one := _kept(pieces, name)) == 1), None) or laid(pieces, "A1")
    orders = pieces, *(sorted(pieces, key=by) for by in (lambda p: -p.room.tall, lambda p: -p.room.wide * p.room.tall))
    pages = min((_packed(order, paper) for order in orders), key=len)
    for page in pages:
        _spread(page)
    return [page.canvas for page in pages]


def _kept(pieces: Sequence[Piece], paper: str) -> list[Canvas]:
    """The same, none where the paper is too small for one of them."""
    try:
        return laid(pieces, paper)
    except ParameterError:
        return []


def _packed(pieces: Sequence[Piece], paper: str) -> list[_Page]:
    """Sheets with pieces in their order, each where there is room first."""
    pages: list[_Page] = []
    for piece in pieces:
        size = complex(piece.room.wide, piece.room.tall)
        place = next((spot for page in pages if (spot := _spot(page, size))), None)
        if place is None:
            pages.append(_empty(paper))
            place = _spot(pages[-1], size)
        if place is None:
            raise _too_large(piece, paper)
        page, corner = place
        taken = Box(corner.real, corner.imag - size.imag - _GAP, corner.real + size.real + _GAP, corner.imag)
        page.free[:] = _left(page.free, taken)
        page.laid.append((piece, corner))
    return pages


class _Page(Record, eq=False):
    """A sheet, the largest rectangles that are free on it, and the pieces by their upper left corners, mm."""

    canvas: Canvas
    room: Box
    block: Box
    free: list[Box]
    laid: list[tuple[Piece, complex]]


def _spread(page: _Page) -> None:
    """All pieces on their sheet, drawn apart evenly as far as the room and the title block allow."""
    room, block, shares = page.room, page.block, [1.0, 1.0]
    # along first: what then stands above the title block is known
    for k in range(2):
        found = []
        for piece, corner in page.laid:
            off = (corner.real - room.left, room.high - corner.imag)[k]
            right = room.left + shares[0] * (corner.real - room.left) + piece.room.wide
            low = room.low if right + _GAP <= block.left else block.high + _GAP
            most = (room.wide - piece.room.wide, room.high - low - piece.room.tall)[k]
            if k == 0 and corner.imag - piece.room.tall - _GAP < block.high:
                most = block.left - _GAP - room.left - piece.room.wide
            found += [most / off] if off > 0 else []
        shares[k] = max(min(found, default=1.0), 1.0)
    for piece, corner in page.laid:
        left = room.left + shares[0] * (corner.real - room.left)
        top = room.high - shares[1] * (room.high - corner.imag)
        page.canvas.take(piece.canvas, complex(left - piece.room.left, top - piece.room.high))


def _too_large(piece: Piece, paper: str) -> ParameterError:
    """A piece that no empty sheet holds."""
    size = complex(piece.room.wide, piece.room.tall)
    if not piece.key:
        larger = next((name for name in PAPERS if _spot(_empty(name), size)), None)
        works = None if larger is None else Nearest(larger, "at_least")
        return ParameterError("paper", paper, "paper_too_small" if larger else "fits_no_paper", works)
    shares = (
        min((b.wide - _WORDS) / (size.real - _WORDS), (b.tall - _WORDS) / (size.imag - _WORDS))
        for b in _empty(paper).free
    )
    share = _CAUTION * max(shares)
    value = float(f"{piece.value / share if piece.inverse else piece.value * share:.2g}")
    works = Nearest(value, "at_least" if piece.inverse else "at_most")
    return ParameterError(
        piece.key, piece.value, "drawing_off_paper", works, wide=size.real, tall=size.imag, paper=paper
    )


def _empty(name: str) -> _Page:
    """A sheet without pieces, and the room of its title block."""
    canvas = blank(name, upright=name == "A4")
    (wide, tall), frame = TITLE_BLOCK, canvas.frame
    room, block = frame.grown(-_GAP), Box(frame.right - wide, frame.low, frame.right, frame.low + tall)
    return _Page(canvas, room, block, _left([room], block.grown(_GAP)), [])


def _spot(page: _Page, size: complex) -> tuple[_Page, complex] | None:
    """The upper left corner of the highest room, then the leftmost, for what is of a size."""
    held = [b for b in page.free if b.wide >= size.real and b.tall >= size.imag]
    if not held:
        return None
    best = max(held, key=lambda b: (b.high, -b.left))
    return page, complex(best.left, best.high)


def _left(free: Sequence[Box], taken: Box) -> list[Box]:
    """The largest rectangles that are left free."""
    cut: list[Box] = []
    for box in free:
        if not box.overlaps(taken):
            cut.append(box)
            continue
        sides = (
            replace(box, right=taken.left), replace(box, left=taken.right),
            replace(box, high=taken.low), replace(box, low=taken.high),
        )  # fmt: skip
        cut += [side for side in sides if side.wide > 0 and side.tall > 0]
    return [
        b for k, b in enumerate(cut) if not any(b.within(o) and (b != o or n < k) for n, o in enumerate(cut) if n != k)
    ]
