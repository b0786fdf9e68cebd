"""The end of what ``higherpair new KIND`` prints: what a scene of several parts may add, with a mate of this kind."""

from __future__ import annotations

import msgspec

from exporters import new_examples
from parts.mates import GEAR_PAIRS, JOINS, MATES

_SHEET = """
## [[exports]]
## format = "sheet"                           # picture of meshing of every pair, DXF and SVG
## mate = 1                                   # only of this one{device}
## title_block = true                         # GOST 2.104, form 1; or {{ designation = "...", … }}"""
_CAM_SHEET = """
## [[exports]]
## format = "sheet"                           # diagrams and profile of the cam, DXF and SVG
## purpose = "cam"
## title_block = true                         # GOST 2.104, form 1; or {{ designation = "...", … }}"""
_TAIL = """
# With a second part, [parts.{other}]{meant}, the two can be {joined} and written as one assembly; remove both #:
## [[mates]]
## kind = "{mate}"{summary}
## first = "{first}"
## second = "{second}"{direction}
##
## [instances.second_{other}]{pad}# a part may stand more than once
## part = "{other}"
## at = [100.0, 0.0, 0.0]                     # mm; or let a mate place it
## rotation_deg = 0.0
##
## [[drives]]
## instance = "gear"
## turns = 1.0
##
## [checks]
## interference = true                        # contact and overlap through a whole pitch{transmission}
##
## [[exports]]
## format = "step"
## assembly = true                            # one file, named parts, true instances"""


def several(kind: str) -> list[str]:
    """Commented lines: the first kind of mate that joins this kind of part, a sheet where one applies."""
    mate, places = _mate_of(kind)
    spec = MATES[mate]
    other = "source" if kind in new_examples.OWNERS else "wheel"
    # of two equal kinds the part above is the first
    own = 0 if places is None else places.index(kind)
    meant = "" if places is None else f' of kind "{places[1 - own]}"'
    toothed = issubclass(spec, GEAR_PAIRS)
    turned = next((f.default for f in msgspec.structs.fields(spec) if f.encode_name == "direction_deg"), None)
    text = _TAIL.format(
        other=other,
        meant=meant,
        joined="put in mesh" if toothed else "joined",
        mate=mate,
        summary=f"{' ' * max(1, 34 - len(mate))}# see higherpair new {mate}",
        first=("gear", other)[own],
        second=(other, "gear")[own],
        direction="" if turned is None else f"\n## direction_deg = {turned}",
        pad=" " * max(1, 24 - len(other)),
        transmission="\n## transmission_error = true                  # how unevenly each mate runs, without load"
        if toothed
        else "",
    )
    sheet = ""
    if toothed:
        device = '; purpose = "generating": device TMM-42' if kind == "spur_gear" else ""
        sheet = "\n##" + _SHEET.format(device=device)
    elif kind == "cam":
        sheet = "\n##" + _CAM_SHEET.format()
    return (text + sheet).splitlines()


def _mate_of(kind: str) -> tuple[str, tuple[str, str] | None]:
    """The first kind of mate that joins a kind of part, and both its kinds; else the one that joins anything."""
    for mate, joined in JOINS.items():
        for places in joined or ():
            if kind in places:
                return mate, places
    return "fixed", None
