"""Roller chains: sizes by designation, of ISO 606 (series A and B; numbers of ANSI B29.1), of bicycles (081 to 085), of
motorcycles (415 to 630) and of GOST 13568.
"""

from __future__ import annotations

import re
from difflib import get_close_matches
from fractions import Fraction
from functools import cache

from geometry.base.record import Record, replace

# pitch p, roller diameter d1 (most), width between inner plates b1 (least), height of inner plates h2 (most),
# transverse pitch p_t (0: one strand only), mm; breaking load F_u of one strand, kN, and of two and three strands where
# those do not break at two and three of it
_ISO = """
04C 6.35 3.30 3.10 6.02 6.40 3.5
06C 9.525 5.08 4.68 9.05 10.13 7.9
05B 8 5.00 3.00 7.11 5.64 4.4 7.8 11.1
06B 9.525 6.35 5.72 8.26 10.24 8.9 16.9 24.9
08A 12.7 7.92 7.85 12.07 14.38 13.9
08B 12.7 8.51 7.75 11.81 13.92 17.8 31.1 44.5
081 12.7 7.75 3.30 9.91 0 8.0
082 12.7 7.75 2.38 9.91 0 0
083 12.7 7.75 4.88 10.30 0 11.6
084 12.7 7.75 4.88 11.15 0 15.6
085 12.7 7.77 6.25 9.91 0 6.7
10A 15.875 10.16 9.40 15.09 18.11 21.8
10B 15.875 10.16 9.65 14.73 16.59 22.2 44.5 66.7
12A 19.05 11.91 12.57 18.10 22.78 31.3
12B 19.05 12.07 11.68 16.13 19.46 28.9 57.8 86.7
16A 25.4 15.88 15.75 24.13 29.29 55.6
16B 25.4 15.88 17.02 21.08 31.88 60.0 106.0 160.0
20A 31.75 19.05 18.90 30.17 35.76 87.0
20B 31.75 19.05 19.56 26.42 36.45 95.0 170.0 250.0
24A 38.1 22.23 25.22 36.20 45.44 125.0
24B 38.1 25.40 25.40 33.40 48.36 160.0 280.0 425.0
28A 44.45 25.40 25.22 42.23 48.87 170.0
28B 44.45 27.94 30.99 37.08 59.56 200.0 360.0 530.0
32A 50.8 28.58 31.55 48.26 58.55 223.0
32B 50.8 29.21 30.99 42.29 58.55 250.0 450.0 670.0
36A 57.15 35.71 35.48 54.30 65.84 281.0
40A 63.5 39.68 37.85 60.33 71.55 347.0
40B 63.5 39.37 38.10 52.96 72.29 355.0 630.0 950.0
48A 76.2 47.63 47.35 72.39 87.83 500.0
48B 76.2 48.26 45.72 63.88 91.21 560.0 1000.0 1500.0
56B 88.9 53.98 53.34 77.85 106.60 850.0 1600.0 2240.0
64B 101.6 63.50 60.96 90.17 119.89 1120.0 2000.0 3000.0
72B 114.3 72.39 68.58 103.63 136.27 1400.0 2500.0 3750.0
"""
# of motorcycles (ISO 10190), whose plates and loads are their makers'
_MOTORCYCLES = """
415 12.7 7.77 4.68 0 0 0
420 12.7 7.77 6.25 0 0 0
428 12.7 8.51 7.85 0 0 0
520 15.875 10.16 6.25 0 0 0
525 15.875 10.16 7.85 0 0 0
530 15.875 10.16 9.40 0 0 0
630 19.05 11.91 9.40 0 0 0
"""
# the same, with GOST's letters in Latin; transverse pitches of the chains that have 2 and 3 strands, whose names tell
# the load of all
_GOST = """
PR-8-4.6 8 5.00 3.00 7.5 0 4.6
PR-9.525-9.1 9.525 6.35 5.72 8.5 0 9.1
PR-12.7-10-1 12.7 7.75 2.40 10.0 0 10.0
PR-12.7-9 12.7 7.75 3.30 10.0 0 9.0
PR-12.7-18.2-1 12.7 8.51 5.40 11.8 0 18.2
PR-12.7-18.2 12.7 8.51 7.75 11.8 13.92 18.2
PR-15.875-23-1 15.875 10.16 6.48 14.8 0 23.0
PR-15.875-23 15.875 10.16 9.65 14.8 16.59 23.0
PR-19.05-31.8 19.05 11.91 12.70 18.2 22.78 31.8
PR-25.4-60 25.4 15.88 15.88 24.2 29.29 60.0
PR-31.75-89 31.75 19.05 19.05 30.2 35.76 89.0
PR-38.1-127 38.1 22.23 25.40 36.2 45.44 127.0
PR-44.45-172.4 44.45 25.40 25.40 42.24 48.87 172.4
PR-50.8-227 50.8 28.58 31.75 48.3 58.55 227.0
PR-63.5-354 63.5 39.68 38.10 60.4 0 354.0
"""
# of GOST 13568-75, which had them wider than those of 64 and 96 kN that it has had from 1997 on, mm
_WIDER = {"2PR-19.05-72": 25.50, "3PR-19.05-108": 25.50}

# numbers of ANSI B29.1, whose chains are series A, and 085
_ANSI = {"25": "04C", "35": "06C", "41": "085", "40": "08A", "50": "10A", "60": "12A", "80": "16A", "100": "20A",
         "120": "24A", "140": "28A", "160": "32A", "180": "36A", "200": "40A", "240": "48A"}  # fmt: skip

_NUMBER = re.compile(r"\d+(?:\.\d+)?")
# a cross as it is typed, Cyrillic or the sign of multiplication; inches and spaces beside it
_CROSS = str.maketrans("\u0425\u00d7", "XX", ' "\u2033')


class Chain(Record):
    """A roller chain: pitch p, roller diameter d1, width between its inner plates b1, their height h2, mm.

    ``inner_width``, ``plate_height``: 0 where they are not known. ``transverse_pitch``: p_t from strand to strand, mm.
    ``loads``: F_u of one, two and three strands, kN; none where they are not known. ``thin``: one of 081 to 085.
    """

    pitch: float
    roller_diameter: float
    inner_width: float = 0.0
    plate_height: float = 0.0
    transverse_pitch: float = 0.0
    loads: tuple[float, ...] = ()
    strands: int = 1
    thin: bool = False

    @property
    def breaking_load(self) -> float:
        """F_u of all strands, kN; 0 where it is not known."""
        return self.loads[self.strands - 1] if self.loads else 0.0


@cache
def chains() -> dict[str, Chain]:
    """Every chain of one strand by its designation; ISO 606 tells the strands after a dash, GOST before the name."""
    found = {}
    for line in (_ISO + _MOTORCYCLES + _GOST).split("\n"):
        if line:
            name, *sizes = line.split()
            pitch, roller, inner, height, apart, load, *several = map(float, sizes)
            thin = name in ("081", "082", "083", "084", "085")
            loads = (load, *(several or (2 * load, 3 * load)))
            found[name] = Chain(pitch, roller, inner, height, apart, loads, thin=thin)
    return found


def chain_of(designation: str) -> Chain | None:
    """The chain of a designation: 08B, 08B-1, 16A-3, PR-12.7-18.2, 2PR-25.4-114, ANSI 40-2, RS40; None: there is none.

    Those of GOST may have Cyrillic letters, and commas in their numbers.
    """
    table, name = chains(), _plain(designation)
    if name in table:
        return table[name]
    if ansi := re.fullmatch(r"(?:ANSI|NO\.?|#|RS)?\s*(\d+)((?:-[123])?)", name):
        name = f"{_ANSI.get(ansi[1], ansi[1])}{ansi[2] or '-1'}"
    if (iso := re.fullmatch(r"(\w+)-([123])", name)) and iso[1] in table:
        return _stranded(table[iso[1]], int(iso[2]))
    if gost := re.fullmatch(r"([23])PR-([\d.]+)-(\d+(?:\.\d+)?)", name):
        of_pitch = (c for n, c in table.items() if n.startswith(f"PR-{gost[2]}-") and c.transverse_pitch)
        if found := _stranded(next(of_pitch, None), int(gost[1])):
            # the load in the name is that of all strands
            apart, load = _WIDER.get(name, found.transverse_pitch), float(gost[3])
            return replace(found, transverse_pitch=apart, loads=(load, load, load))
    return None


def _plain(designation: str) -> str:
    """As the table has it: GOST's letters in Latin, points in its numbers."""
    return designation.strip().upper().replace(",", ".").replace("\u041f\u0420", "PR")


def like_chain(designation: str) -> str | None:
    """The designation in the table that is most like another one, of the pitch that its number tells; None: none is."""
    name = _plain(designation)
    if (one := name.partition("-")[0]) in chains():
        return one
    if inches := re.fullmatch(r"(\d+(?:/[1-9]\d*)?)X(\d+/[1-9]\d*)", name.translate(_CROSS)):
        # as bicycles and motorcycles name them, 1/2x1/8: pitch and width, of series B and 081 to 085
        pitch, width = (25.4 * float(Fraction(side)) for side in inches.groups())
        same = [(n, c) for n, c in chains().items() if n[-1] != "A" and c.plate_height and abs(c.pitch - pitch) < 1e-6]
        if same:
            return min(same, key=lambda one: abs(one[1].inner_width - width))[0]
    numbers = {float(number) for number in _NUMBER.findall(name)}
    if not re.search(r"\d[ABC]|PR", name) and (ansi := next((n for n in _ANSI if float(n) in numbers), None)):
        # 40H and C40 are no 40A, of two inches and a half
        return f"ANSI {ansi}"
    names = [*chains(), *(f"{n}-{k}" for n in chains() if not n.startswith("PR") for k in (1, 2, 3))]
    names = [n for n in names if numbers & {*map(float, _NUMBER.findall(n)[:1])} and chain_of(n) is not None]
    found = get_close_matches(name, names, 1, 0.5)
    return found[0] if found else None


def _stranded(chain: Chain | None, strands: int) -> Chain | None:
    if chain is None or (strands > 1 and not chain.transverse_pitch):
        return None
    return replace(chain, strands=strands)
