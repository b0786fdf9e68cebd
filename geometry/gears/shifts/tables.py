"""Shift coefficients as tables give them: Kudryavtsev's (practicum, appendices А to Г), table 2.1 of the guidelines,
and the recommendations of GOST 16532-70.

Values stand in thousandths as printed; cells that a scan has broken are mended and listed in ``MENDED``: within a
column the equalising shift Delta y = x1 + x2 - y is one number (that of table А or Б), which fixes the sum, and the
neighbours fix the split. ``DOUBTED`` cells stand as printed.
"""

from __future__ import annotations

import re
from functools import cache

from geometry.base.errors import Nearest, ParameterError
from geometry.base.record import Record

# table А.1: Delta y from z1 = 10 on, for 2 >= u > 1
_TABLE_A = """
10: 110 127 145 160 175 190 202 215 227 239 250 257 265 272 278 285 292 298 303 308 315 319 323 328 332 335
    338 341 341 344 347 350 351 352 353
"""
# table Б.1: Delta y / x1 from z1 = 10 on, for 5 >= u > 2
_TABLE_B = """
10: 150/590 160/660 170/730 180/800 190/860 200/920 210/980 220/1040 230/1100 240/1160 250/1220 250/1270
    250/1310 250/1350 250/1390 250/1430 250/1470 250/1510 250/1550 250/1590 250/1630 250/1670 250/1710
    250/1740 250/1770 250/1810 250/1850 250/1880 250/1920 250/1960
"""
# table В.1: for each z1 the pairs x1/x2 from z2 = z1 on, for 2 >= u >= 1
_TABLE_V = """
11: 395/395 432/372 464/354 490/341 513/330 534/322 551/317 568/312 584/308 601/303 617/299 630/297
12: 444/444 479/423 515/400 543/386 566/376 589/365 609/358 626/353 646/345 663/341 679/337 693/334 706/333
13: 486/486 524/462 557/443 588/426 614/414 636/405 659/394 676/389 694/384 714/376 730/372 745/369 758/368
    773/365
14: 528/528 565/506 600/485 631/468 661/452 686/441 706/433 726/426 745/419 763/414 780/409 796/405 813/400
    826/399 840/397
15: 571/571 609/547 644/526 677/508 706/492 731/481 754/472 775/463 792/458 813/449 830/445 848/440 862/438
    881/431 894/430 908/426
16: 608/608 644/586 678/566 716/542 744/528 766/519 793/507 815/497 834/491 854/483 869/480 892/470 907/467
    921/465 936/462 951/459 967/455
17: 646/646 683/624 720/601 756/580 781/568 809/554 833/543 856/534 878/525 898/517 916/511 936/504 952/500
    968/496 981/494 999/490 1014/487 1030/483
18: 684/684 723/658 756/639 792/617 814/609 849/588 871/579 898/566 916/561 937/552 958/543 976/537 994/532
    1011/528 1026/525 1041/522 1059/516 1072/515
"""
# table Г.1: for each z2 the first z1 and x2 from there on, for 5 >= u >= 2; its caption says x1
_TABLE_G = """
20: 10: 397 381 364
25: 10: 458 442 425 409 401
30: 10: 517 501 486 471 463 458 451 445
35: 10: 571 556 542 528 522 518 512 505 499 493
40: 10: 625 610 596 582 577 575 569 564 560 553 547 509 481
45: 10: 673 661 648 635 632 628 624 620 616 611 606 566 538 508 481
50: 10: 721 709 696 689 684 682 677 674 671 667 662 623 594 564 535
55: 11: 754 745 734 732 731 728 727 722 720 716 677 647 618 588
60: 12: 789 782 780 779 778 777 773 772 769 729 697 668 636
65: 13: 822 825 826 827 825 823 821 820 778 748 719 687
70: 14: 866 870 872 874 871 869 868 828 797 768 736
75: 15: 909 914 917 920 919 916 876 846 816 786
80: 16: 954 957 961 962 965 925 891 859 828
"""
# guidelines, table 2.1: z1/z2 and x1/x2 for least wear
_GUIDELINES = {
    (9, 10): (0.560, 0.516),
    (9, 11): (0.570, 0.546),
    (9, 12): (0.580, 0.561),
    (10, 10): (0.540, 0.540),
    (10, 11): (0.549, 0.535),
    (10, 12): (0.558, 0.522),
    (11, 11): (0.522, 0.522),
    (11, 12): (0.531, 0.516),
    (12, 12): (0.504, 0.504),
}


class Mended(Record):
    """A broken cell of tables В.1 (x1, x2) or Г.1 (x2 alone): what is printed and what stands here."""

    table: str
    first_teeth: int
    second_teeth: int
    printed: tuple[float, ...]
    right: tuple[float, ...]


MENDED = (
    Mended("В.1", 11, 16, (0.534, 0.392), (0.534, 0.322)),
    Mended("В.1", 12, 23, (0.673, 0.334), (0.693, 0.334)),
    Mended("В.1", 14, 14, (0.525, 0.525), (0.528, 0.528)),
    Mended("В.1", 16, 26, (0.860, 0.480), (0.869, 0.480)),
    Mended("В.1", 17, 33, (0.951, 0.459), (1.014, 0.487)),
    Mended("В.1", 17, 34, (0.967, 0.455), (1.030, 0.483)),
    Mended("Г.1", 12, 45, (0.618,), (0.648,)),
    Mended("Г.1", 22, 80, (0.991,), (0.891,)),
)


class TableShift(Record):
    """x1 and x2 of a table; ``tip_shortening`` is its Delta y, None where it has none.

    ``table`` names it; ``mended`` is the printed cell that was put right, if it was; ``between`` the z2 of the two
    rows between which x2 was interpolated.
    """

    first: float
    second: float
    tip_shortening: float | None
    table: str
    mended: Mended | None = None
    between: tuple[int, int] | None = None


def kudryavtsev(first_teeth: int, second_teeth: int) -> TableShift:
    """Kudryavtsev's shifts for an external pair, z1 <= z2; practicum, appendices А to Г.

    Up to u = 2 tables В.1 and А.1; beyond, up to 5, x1 and Delta y from Б.1 and x2 from Г.1, linear between its rows.
    Both are headed for u = 2 too: there Г.1 has what В.1 has not.

    Raises
    ------
    ParameterError
        The pair is not in the tables; names the nearest number of teeth that is.
    """
    _check_order(first_teeth, second_teeth)
    return (_from_v if _is_of_v(first_teeth, second_teeth) else _from_g)(first_teeth, second_teeth)


def shortening_table(first_teeth: int, second_teeth: int) -> str:
    """The practicum's table that has Delta y of a pair, z1 <= z2."""
    return "А.1" if _is_of_v(first_teeth, second_teeth) else "Б.1"


def _is_of_v(first_teeth: int, second_teeth: int) -> bool:
    return second_teeth < 2 * first_teeth or (first_teeth, second_teeth) in _table_v()


def guidelines(first_teeth: int, second_teeth: int) -> TableShift:
    """Shifts for least wear; guidelines on the coursework, table 2.1.

    Raises
    ------
    ParameterError
        The pair is not in the table.
    """
    _check_order(first_teeth, second_teeth)
    if (first_teeth, second_teeth) not in _GUIDELINES:
        nearest = min(_GUIDELINES, key=lambda pair: abs(pair[0] - first_teeth) + abs(pair[1] - second_teeth))
        raise _not_there("2.1", first_teeth, second_teeth, nearest)
    return TableShift(*_GUIDELINES[first_teeth, second_teeth], None, "2.1")


def gost_16532(first_teeth: int, second_teeth: int, *, kinematic: bool = False) -> tuple[TableShift, ...]:
    """Shifts that GOST 16532-70 recommends for spur pairs whose centre distance is free, the plainest first.

    Power drives: 0 / 0 from z1 = 21; 0.3 / -0.3 for z1 14 to 20 and u >= 3.5; 0.5 / 0.5 for z1 10 to 30.
    Kinematic drives: 0 / 0 from z1 = 17; 0.3 / -0.3 for z1 12 to 16 and z2 >= 22.

    Raises
    ------
    ParameterError
        None of the rules holds.
    """
    _check_order(first_teeth, second_teeth)
    if kinematic:
        rules = [(first_teeth >= 17, (0.0, 0.0)), (12 <= first_teeth <= 16 and second_teeth >= 22, (0.3, -0.3))]
    else:
        rules = [
            (first_teeth >= 21, (0.0, 0.0)),
            (14 <= first_teeth <= 20 and second_teeth >= 3.5 * first_teeth, (0.3, -0.3)),
            (10 <= first_teeth <= 30, (0.5, 0.5)),
        ]
    found = tuple(TableShift(*shifts, None, "GOST 16532-70") for holds, shifts in rules if holds)
    if not found and kinematic and first_teeth >= 12:
        least = Nearest(22, "at_least")
        raise ParameterError(
            "second.number_of_teeth",
            second_teeth,
            "no_recommendation_with",
            least,
            teeth=second_teeth,
            first=first_teeth,
        )
    if not found:
        least = Nearest(12 if kinematic else 10, "at_least")
        raise ParameterError("first.number_of_teeth", first_teeth, "no_recommendation", least, teeth=first_teeth)
    return found


def _from_v(first_teeth: int, second_teeth: int) -> TableShift:
    table = _table_v()
    if (first_teeth, second_teeth) not in table:
        raise _not_there("В.1", first_teeth, second_teeth, _nearest(list(table), first_teeth, second_teeth))
    shifts = table[first_teeth, second_teeth]
    return TableShift(*shifts, _table_a().get(first_teeth), "В.1", _mending("В.1", first_teeth, second_teeth))


def _from_g(first_teeth: int, second_teeth: int) -> TableShift:
    table, (shortening, first) = _table_g(), _table_b().get(first_teeth, (None, None))
    rows = sorted(z2 for z1, z2 in table if z1 == first_teeth)
    if first is None or not rows or not rows[0] <= second_teeth <= rows[-1] or second_teeth > 5 * first_teeth:
        fits = [pair for pair in table if 2 * pair[0] <= pair[1] <= 5 * pair[0]]
        raise _not_there("Г.1", first_teeth, second_teeth, _nearest(fits, first_teeth, second_teeth))
    if second_teeth in rows:
        mending = _mending("Г.1", first_teeth, second_teeth)
        return TableShift(first, table[first_teeth, second_teeth], shortening, "Г.1", mending)
    low = max(z2 for z2 in rows if z2 < second_teeth)
    high = min(z2 for z2 in rows if z2 > second_teeth)
    share = (second_teeth - low) / (high - low)
    second = (1 - share) * table[first_teeth, low] + share * table[first_teeth, high]
    return TableShift(first, second, shortening, "Г.1", None, (low, high))


def _check_order(first_teeth: int, second_teeth: int) -> None:
    if first_teeth > second_teeth:
        most = Nearest(second_teeth, "at_most")
        raise ParameterError("first.number_of_teeth", first_teeth, "tables_take_smaller_first", most)


def _nearest(pairs: list[tuple[int, int]], first_teeth: int, second_teeth: int) -> tuple[int, int]:
    return min(pairs, key=lambda pair: (abs(pair[0] - first_teeth) + abs(pair[1] - second_teeth), pair))


def _not_there(table: str, first_teeth: int, second_teeth: int, nearest: tuple[int, int]) -> ParameterError:
    pair, known = f"{first_teeth}/{second_teeth}", "/".join(map(str, nearest))
    return ParameterError("number_of_teeth", pair, "not_in_table", None, pair=pair, table=table, known=known)


def _mending(table: str, first_teeth: int, second_teeth: int) -> Mended | None:
    key = (table, first_teeth, second_teeth)
    return next((m for m in MENDED if (m.table, m.first_teeth, m.second_teeth) == key), None)


def _lines(text: str) -> list[list[str]]:
    """Cells of each table line; a line that begins with blanks continues the one before."""
    return [re.split(r":?\s+", line) for line in re.sub(r"\n\s+", " ", text.strip()).splitlines()]


def _shifts(cell: str) -> tuple[float, float]:
    one, two = cell.split("/")
    return int(one) / 1000, int(two) / 1000


@cache
def _table_a() -> dict[int, float]:
    first, *cells = _lines(_TABLE_A)[0]
    return {int(first) + i: int(cell) / 1000 for i, cell in enumerate(cells)}


@cache
def _table_b() -> dict[int, tuple[float, float]]:
    first, *cells = _lines(_TABLE_B)[0]
    return {int(first) + i: _shifts(cell) for i, cell in enumerate(cells)}


@cache
def _table_v() -> dict[tuple[int, int], tuple[float, float]]:
    return {
        (int(first), int(first) + i): _shifts(cell)
        for first, *cells in _lines(_TABLE_V)
        for i, cell in enumerate(cells)
    }


@cache
def _table_g() -> dict[tuple[int, int], float]:
    return {
        (int(first) + i, int(row)): int(cell) / 1000
        for row, first, *cells in _lines(_TABLE_G)
        for i, cell in enumerate(cells)
    }
