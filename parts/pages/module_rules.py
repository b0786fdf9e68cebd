"""Sizes of the power module (thesis): one table of rules, what each belongs to, how it follows, and why.

Names are those of ``DRIVERS`` and of the rules above; lengths in mm. ``r_``: radius, about the
axis of the part's own disk; ``z_``: height, 0 is the back of the disks, the front is up. ``CONDITIONS`` are lengths
that must be left; each names the driver that a refusal names. What has an ``orientation`` is of those alone: the wheels
of the thesis, idlers, or cranks.
"""

from __future__ import annotations

import ast
import math
from collections.abc import Mapping, Sequence
from functools import cache
from types import CodeType
from typing import TypeVar

from geometry.base.record import Record
from parts.base.texts import N_


class Rule(Record):
    """A size: its name, the positions of the parts list that have it, what it is made of, and why so."""

    name: str
    positions: tuple[int, ...]
    made_of: str
    reason: str
    orientation: str = ""


class Condition(Record):
    """What must be at least 0, the driver that is to blame where it is not, and what it is."""

    driver: str
    made_of: str
    reason: str
    orientation: str = ""


Of = TypeVar("Of", Rule, Condition)

# of the standard items: hole that a screw passes, diameter and height of its head
M4, M8, M10, M12, M14 = (4.5, 7.0, 2.8), (9.0, 13.0, 8.0), (11.0, 16.0, 10.0), (13.5, 18.0, 12.0), (15.0, 21.0, 14.0)

# what is given, with the thesis's numbers and what goes with them
DRIVERS: Mapping[str, float] = {
    "module": 3.0, "teeth_19": 96, "teeth_21": 144, "wheel_module": 2.0, "worm_module": 5.0, "worm_quotient": 10.0,
    "worm_teeth_25": 128, "worm_teeth_23": 106, "worm_wheel_width": 26.0, "worm_length": 120.0, "face_width": 25.0,
    "wheel_width": 15.0, "disk_thickness": 30.0, "axial_gap": 5.0, "clearance": 0.1, "ball": 8.0, "balls": 180,
    "platform_size": 260.0,
}  # fmt: skip

_R = Rule
RULES = (
    _R("arm", (2, 3), "module * (teeth_21 - teeth_19) / 2", N_("centre distance of ring and pinion without shifts")),
    _R("r_tip", (19,), "module * (teeth_19 / 2 + 1)", N_("tips of the pinion")),
    _R("r_root", (19,), "module * (teeth_19 / 2 - 1.25)", N_("roots of the pinion")),
    _R("r_space", (21,), "module * (teeth_21 / 2 + 1.25)", N_("roots of the ring")),
    _R("r_journal", (9,), "25", N_("the thread M45 of nut 47 and a shoulder")),
    _R("r_56", (3, 17, 19), "floor(r_root - 10)", N_("screws M12 within the pinion's roots, with a wall of 4")),
    _R("r_3", (3,), "ceil(max(r_tip, r_56 + 10 + ball / 2 + 4)) + 2",
       N_("beyond the pinion's tips, and a wall between the screws' recess and the ball groove")),
    _R("gap_race", (3, 20, 22, 30, 31, 33), "0.15 * ball", N_("half of the gap between the races: room for the cage")),
    _R("r_groove", (3, 5, 6, 20, 22), "0.52 * ball", N_("radius of the grooves: a ball touches at one point")),
    _R("h_groove", (3, 6, 22), "sqrt(r_groove ** 2 - (gap_race + r_groove - ball / 2) ** 2)",
       N_("half of a groove's width: its bottom touches the ball")),
    _R("e_quarter", (5, 20), "(r_groove - ball / 2) / sqrt(2)",
       N_("how far a quarter groove is set out, both ways: it touches the ball at 45 degrees")),
    _R("h_quarter", (5, 20), "sqrt(r_groove ** 2 - (gap_race + e_quarter) ** 2)", N_("height of a quarter groove")),
    _R("r_small", (30,), "r_3 + gap_race", N_("circle of the balls between disk 3 and disk 2")),
    _R("h_33", (33,), "3", N_("screws M4x6 hold by as much")),
    _R("seat_33", (2, 33), "h_33 + 3", N_("heads of the screws M4 lie below the face of the disk")),
    _R("r_33_in", (33,), "r_small + gap_race", N_("holds the balls, clear of the cage")),
    _R("r_33_out", (2, 33), "r_small + max(ball / 2 + 10, ball + 6)",
       N_("room for the screws M4 beside the ball race, and for the holes of the plugs 32")),
    _R("r_59", (33,), "r_small + ball / 2 + 5.6", N_("screws M4 in the middle of what lies on the disk")),
    _R("z_upper", (30,), "disk_thickness - seat_33 - ball / 2", N_("balls under the front ring 33")),
    _R("z_lower", (30,), "seat_33 + ball / 2", N_("balls on the rear ring 33")),
    _R("r_32", (2, 32), "r_small + ball / 2", N_("the bore that the balls run on, open where they come in")),
    _R("w_32", (2, 32), "ball + 0.4", N_("width of the hole: a ball goes through")),
    _R("h_32", (32,), "disk_thickness / 2 - seat_33 - 0.1", N_("from both faces each closes its half of the hole")),
    _R("gap_32", (32,), "0.1", N_("the end of a plug lies behind the track of the balls")),
    _R("r_8", (8,), "r_33_out + 3.5", N_("screws M4 beside ring 33")),
    _R("r_8_out", (8,), "r_8 + 3.5", N_("half a head of M4 beyond its screws")),
    _R("h_shield", (7, 8), "3", N_("screws M4x6 hold by as much")),
    _R("r_53", (2, 24), "ceil(arm + r_8 + 10)", N_("screws M8 outside of the eccentric bore and its shield")),
    _R("r_2", (2,), "r_53 + 9", N_("a wall of 5 beyond the screws")),
    _R("gap_21", (17, 19, 21), "max(axial_gap, 10)", N_("heads M8 of wheel 21 stand between it and the disk")),
    _R("h_24", (24,), "face_width + gap_21", N_("room for wheel 21 behind the disk")),
    _R("h_thread", (2,), "max(46 - h_24, seat_33 + 1)", N_("screws M8x45 of ring 24, and 1 mm before them")),
    _R("r_24_in", (24,), "r_53 - 10", N_("a wall of 5 within the screws")),
    _R("r_21_screws", (21, 22, 23), "ceil(r_space + 8.5)", N_("screws M8 outside of the teeth, with a wall of 4")),
    _R("r_21", (21, 22), "ceil(r_21_screws + 9.5)", N_("a wall of 5 beyond the screws")),
    _R("r_22_in", (22, 23), "ceil(r_space) + 1", N_("the pinion's tips stand free of it")),
    _R("r_25_in", (25,), "r_53 + 7.5", N_("heads M8 of the screws of 24 stand within it")),
    _R("r_41", (5, 24, 25), "r_25_in + 10", N_("bolts M8 with a wall of 5")),
    _R("r_24", (24,), "r_41 + 10", N_("a wall of 6 beyond the bolts")),
    _R("h_5", (5, 6), "2 * ball", N_("both guides end at one height; screws M8x25 hold by 9 mm")),
    _R("r_large", (31,), "ceil(r_41 + 7.5 + ball / 2)",
       N_("circle of the balls about disk 2 and about wheel 22: a wall of 3 between groove and screws")),
    _R("r_5", (5, 22), "r_large - gap_race", N_("inner race: the groove is half a ball but for the gap")),
    _R("r_20_in", (1, 6, 20), "r_large + gap_race", N_("outer race: quarter grooves, clear of the cage")),
    _R("r_20_screws", (20,), "r_large + ball / 2 + 7.5", N_("a wall of 3 between groove and screws")),
    _R("r_20", (20,), "r_20_screws + 9.5", N_("a wall of 5 beyond the screws")),
    _R("h_20", (20,), "1.5 * ball", N_("half a ball and a wall, so that the flange of 22 is clear of the heads 41")),
    _R("r_7_out", (7,), "r_large + ball / 2 + 17", N_("covers both guides and the gap between them")),
    _R("z_ball", (2, 5, 6, 31), "h_5 / 2", N_("the middle of guide 6")),
    _R("z_race", (2, 5), "z_ball - ball / 2",
       N_("disk 2 holds the balls from below, guide 5 from above: they come in before it")),
    _R("small_balls", (30, 61), "round(balls / 2 * r_small / (r_small + r_large))",
       N_("two rows of each circle share the balls of the list as the circles are long")),
    _R("large_balls", (31, 61), "balls // 2 - small_balls", N_("the rest, twice")),
    _R("r_7_in", (7,), "arm + r_8_out + 1.5", N_("clear of shield 8")),
    _R("z_1", (25, 26), "-h_24 - worm_wheel_width / 2", N_("middle of worm wheel 25, right behind ring 24")),
    _R("z_20", (20, 31), "-h_24 - worm_wheel_width - h_20", N_("balls of wheel 22, between both rings 20")),
    _R("h_seat", (1, 26, 27), "ceil(worm_module * (worm_quotient / 2 + 1)) + 1",
       N_("half of the tunnel through which the worm comes in")),
    _R("z_2", (23, 26), "z_20 - h_20 - 8 - axial_gap - h_seat - 8",
       N_("worm and its seat lie below the heads of the rings 20: so far are the worm wheels apart")),
    _R("z_23", (23,), "z_2 - worm_wheel_width / 2", N_("lower face of worm wheel 23")),
    _R("h_22", (22,), "-h_24 - z_23 - worm_wheel_width", N_("from wheel 21 to worm wheel 23")),
    _R("a_1", (26,), "worm_module * (worm_teeth_25 + worm_quotient) / 2", N_("centre distance, no shift")),
    _R("a_2", (26,), "worm_module * (worm_teeth_23 + worm_quotient) / 2", N_("centre distance, no shift")),
    _R("r_25", (25,), "worm_module * (worm_teeth_25 / 2 + 2)", N_("largest radius by GOST 19650, one start")),
    _R("r_23", (23,), "worm_module * (worm_teeth_23 / 2 + 2)", N_("largest radius by GOST 19650, one start")),
    _R("r_open", (1, 6), "max(r_25, r_20) + axial_gap / 2",
       N_("worm wheel 25 and all that disk 2 carries come in from the front")),
    _R("r_6_screws", (1, 6), "r_open + 8.5", N_("screws M8 with a wall of 4")),
    _R("r_6", (6,), "r_6_screws + 8.5", N_("half a head of M8 beyond its screws")),
    _R("h_12", (12,), "8", N_("screws M8x16 hold by as much")),
    _R("h_47", (9,), "12", N_("height of nut 47")),
    _R("z_11", (11,), "-h_24 - h_12 - 10 - wheel_width", N_("behind the heads of cover 12"), "thesis cranks"),
    _R("z_47", (9,), "z_11 - h_47", N_("behind what it clamps"), "thesis cranks"),
    _R("z_47", (9,), "-h_24 - h_12 - 10 - h_47",
       N_("behind the heads of cover 12: with ring 10 alone it holds the axle, wheel 11 has no room about it"),
       "idlers"),
    _R("r_neck", (9, 38, 39), "10", N_("necks on O1 and O3, as thick as axle 13: the links turn on them"), "idlers"),
    _R("r_end", (9, 11, 16, 39), "r_neck - 2", N_("wheels 11 and 16 sit on the ends of the necks, against a shoulder"),
       "idlers"),
    _R("h_38", (38,), "8", N_("links of both arms, which carry the idlers"), "idlers"),
    _R("r_38", (38,), "r_neck + clearance + 6", N_("a wall of 6 about the necks"), "idlers"),
    _R("play_36", (36, 38), "0.5", N_("of wheels and idlers between links and heads of pins"), "idlers"),
    _R("r_37", (37,), "5", N_("pins of the idlers"), "idlers"),
    _R("h_37", (37,), "3", N_("heads of the pins, which hold the idlers"), "idlers"),
    _R("z_38", (38,), "z_47 - axial_gap - h_38", N_("the link of arm O2O3 behind nut 47"), "idlers"),
    _R("z_11", (11,), "z_38 - play_36 - wheel_width", N_("behind that link"), "idlers"),
    _R("z_16", (16,), "z_11 - 2 * h_37 - axial_gap - wheel_width",
       N_("O3 passes over O1: heads of both pins between the two planes"), "idlers"),
    _R("z_38_rear", (38,), "z_16 - play_36 - h_38", N_("the link of arm O1O2 behind wheel 16"), "idlers"),
    _R("z_16", (16,), "z_11 - h_47 - axial_gap - 8 - wheel_width",
       N_("nut 47 passes over wheel 16 and its screws where O3 is near O1"), "thesis"),
    _R("h_14", (14,), "z_11 + wheel_width - z_16", N_("meshes with 16 and with 11, which stand in two planes"),
       "thesis idlers"),
    _R("r_wheel", (11, 14, 16), "arm / 2 + wheel_module", N_("tips of the wheels, whose mesh spans an arm"), "thesis"),
    _R("r_47", (9,), "min(35, arm - r_wheel - 1)",
       N_("nut M45 of GOST 11871, turned down where it would meet the tips of wheel 14 beside it"), "thesis"),
    _R("r_54", (16, 18), "arm / 2 - 1.25 * wheel_module - 8.5", N_("screws M8 within the teeth, with a wall of 4"),
       "thesis"),
    _R("h_54", (16,), "wheel_width", N_("screws M8x75 hold the whole wheel"), "thesis"),
    _R("r_47", (9,), "35", N_("nut M45 of GOST 11871"), "idlers"),
    _R("r_54", (18, 39), "25", N_("heads M8 about the neck"), "idlers"),
    _R("h_54", (39,), "8", N_("flange of the post under the heads of its screws"), "idlers"),
    _R("z_39", (39,), "z_38_rear - axial_gap - 8 - h_54", N_("heads of its screws are clear of the link"), "idlers"),
    _R("r_47", (9,), "35", N_("nut M45 of GOST 11871, in a recess of plate 11"), "cranks"),
    _R("h_11", (11,), "wheel_width + h_47 + 3", N_("nut 47 and the end of the axle stand within it"), "cranks"),
    _R("r_35", (35,), "5", N_("pins of the cranks"), "cranks"),
    _R("r_34", (34, 35), "r_35 + 4", N_("a wall of 4 about the pins"), "cranks"),
    _R("h_collar", (35,), "axial_gap - 0.5", N_("collars of the pins hold the cranks apart, with a play of 0.5"),
       "cranks"),
    _R("r_pivots", (11, 14, 16), "max(ceil((arm + 2 * r_34 + 1) / sqrt(3)), r_47 + 3 + r_35 + 5)",
       N_("three cranks pass each other in one plane; a wall of 5 to the recess of nut 47"), "cranks"),
    _R("r_11", (11, 16), "r_pivots + r_34", N_("a wall of 4 beyond the pins"), "cranks"),
    _R("r_13", (13, 14), "ceil(arm + r_11) + 1", N_("plate 11 and its cranks turn within guide 13"), "cranks"),
    _R("r_13_out", (13,), "r_13 + 8", N_("its wall"), "cranks"),
    _R("r_14_in", (14,), "r_pivots - r_34", N_("a wall of 4 within the pins"), "cranks"),
    _R("r_window", (13,), "r_journal + 26", N_("guide 13 lies about cover 12"), "cranks"),
    _R("h_13", (13,), "10", N_("its floor, clamped to the pinion by nut 46"), "cranks"),
    _R("r_13_step", (13,), "min(r_13_out, floor(r_root - 1))", N_("on the pinion it ends within the pinion's roots"),
       "cranks"),
    _R("gap_13", (13, 21), "min(axial_gap, h_13 / 2)",
       N_("beyond them it stands so far behind wheel 21, which turns past it"), "cranks"),
    _R("z_34", (34,), "z_11 - h_11 - axial_gap", N_("cranks between plate 11 and ring 14"), "cranks"),
    _R("z_14", (14,), "z_34 - axial_gap - wheel_width", N_("behind these cranks"), "cranks"),
    _R("z_34_rear", (34,), "z_14 - axial_gap - wheel_width", N_("cranks between ring 14 and plate 16"), "cranks"),
    _R("z_16", (16,), "z_34_rear - axial_gap - wheel_width", N_("behind these cranks"), "cranks"),
    _R("r_54", (16, 18), "25", N_("screws M8 within the pins, with a wall of 4"), "cranks"),
    _R("h_54", (16,), "wheel_width - 9", N_("heads of the screws M8 lie below the face of the plate"), "cranks"),
    _R("r_18", (18,), "r_54 + 8.5", N_("a wall of 4 beyond the screws")),
    _R("h_18", (18,), "75 - h_54 - 12", N_("screws M8x75 hold the body by 12 mm")),
    _R("z_boss", (1,), "z_16 - h_18", N_("what ring 18 stands on"), "thesis cranks"),
    _R("z_boss", (1,), "z_39 - h_18", N_("what ring 18 stands on"), "idlers"),
    _R("z_under", (1,), "min(z_boss - 12, z_16 - clearance - 19 - axial_gap)",
       N_("a boss of 12, and room for the head of the screw under axle 13, which goes about O1"), "thesis"),
    _R("z_under", (1,), "z_boss - 12", N_("a boss of 12 under ring 18"), "cranks idlers"),
    _R("z_floor", (1,), "min(z_23 - 8 - axial_gap, z_2 - h_seat - 4, z_under)",
       N_("clear of the heads behind wheel 23, and of the seat of worm II")),
    _R("h_floor", (1,), "30", N_("bolts M12x45 with their nuts")),
    _R("z_lip", (1,), "z_1 + h_seat + 4", N_("a wall of 4 over the seat of worm I")),
    _R("h_window", (1, 26, 27), "h_seat + 4", N_("half of the opening in the wall: worm and cover come in through it")),
    _R("h_cover", (1, 26), "h_seat + 8", N_("half of the seat of a cover: its tunnel, and a wall of 8")),
    _R("x_wheels", (1, 26), "max(beside(r_25 + axial_gap, a_1 - h_cover), beside(r_23 + axial_gap, a_2 - h_cover))",
       N_("where the seat of a cover is clear of both worm wheels")),
    _R("x_seat", (1, 26), "ceil(max(x_wheels, worm_length / 2 + 8))", N_("and of the thread and ring 28")),
    _R("r_worm_journal", (26, 27, 28), "floor(worm_module * (worm_quotient / 2 - 1.2) - 1)", N_("within the roots")),
    _R("h_end", (1, 26), "r_worm_journal + 9", N_("half of the far seat: the journal, and a wall of 9")),
    _R("x_far", (1, 26), "max(beside(r_25 + axial_gap, a_1 - h_end), beside(r_23 + axial_gap, a_2 - h_end))",
       N_("where the far seat is clear of both worm wheels")),
    _R("x_end", (1, 26), "ceil(max(x_far, worm_length / 2 + 4))", N_("and of the thread")),
    _R("w_seat", (1, 27), "30", N_("two set screws M8 over each cover")),
    _R("r_28", (28,), "r_worm_journal + 3", N_("its wall")),
    _R("z_rim", (23, 25), "min(worm_wheel_width / 2, beside(worm_module * (worm_quotient / 2 - 1), a_1 - r_25))",
       N_("where the rims of the worm wheels come nearest to the worms: at a face, or where the throat ends")),
    _R("x_rim", (26, 28), "max(chord_left(r_28, worm_module * (worm_quotient / 2 - 1), z_rim, a_1), "
       "chord_left(r_28, worm_module * (worm_quotient / 2 - 1), z_rim, a_2))",
       N_("how far along the worms their wheels reach to rings 28")),
    _R("half_room", (1,), "ceil(a_1 + h_seat + 8 + axial_gap)", N_("the seat of worm I stands clear of the wall")),
    _R("half", (1,), "half_room + 12", N_("wall of a casting")),
    _R("r_55", (4, 9), "r_journal + 11", N_("counterbores for M10 with a wall of 2.5 to the spigot")),
    _R("z_flange", (9,), "disk_thickness + 1", N_("turns over disk 3")),
    _R("h_4", (4,), "30", N_("heads of the screws M10x30 lie below its face, 19 under them")),
    _R("z_4", (4,), "z_flange + 12", N_("screws M10x30 hold the flange by 11 mm; over the heads of the shields")),
)  # fmt: skip

_C = Condition
CONDITIONS = (
    _C("teeth", "teeth_21 - teeth_19 - 1", N_("room of the pinion in the ring")),
    _C("teeth", "r_56 - 11 - 3 - arm - r_journal - clearance",
       N_("wall between the axle of the platform and the recess of disk 3")),
    _C("teeth", "arm - r_journal - clearance - 20 - 3", N_("wall between the axle of the platform and nut 46")),
    _C("teeth", "arm - r_journal - 25 - 15 - 1", N_("gap between cover 12 and the axle of the satellite"),
       "thesis idlers"),
    _C("teeth", "arm / 3 - 1.55 * wheel_module - 10 - clearance - 5", N_("wall of the wheels about their axles"),
       "idlers"),
    _C("teeth", "arm / 6 - 0.95 * wheel_module - r_37 - clearance - 2", N_("wall of the idlers about their pins"),
       "idlers"),
    _C("teeth", "arm - r_window - 10 - 5", N_("wall between the stud of guide 13 and its window"), "cranks"),
    _C("teeth", "r_13 - arm - r_window - 3", N_("wall between the window of guide 13 and its rim"), "cranks"),
    _C("teeth", "r_13_step - arm - r_window - 3", N_("wall between the window of guide 13 and its step"), "cranks"),
    _C("teeth", "r_22_in - arm - r_13_out - 2", N_("gap about guide 13 where it stands outermost"), "cranks"),
    _C("teeth", "r_24_in - r_21 - 1", N_("gap between wheel 21 and ring 24")),
    _C("teeth", "r_22_in - 2 * arm - r_wheel - 2", N_("gap about wheel 11 where it stands outermost"),
       "thesis"),
    _C("teeth", "worm_module * (worm_teeth_25 / 2 - 1.2) - r_20_screws - 8", N_("wall under the teeth of wheel 25")),
    _C("teeth", "worm_module * (worm_teeth_23 / 2 - 1.2) - r_21 - 2", N_("wall under the teeth of wheel 23")),
    _C("worm_teeth", "r_open - axial_gap / 2 - r_23",
       N_("gap about worm wheel 23 on its way in, where wheel 25 passes")),
    _C("disk_thickness", "z_upper - z_lower - 1.2 * ball - 0.2", N_("room for both rows of balls in disk 3")),
    _C("disk_thickness", "disk_thickness - 18 - 10", N_("floor of the recess of disk 3 over its nut")),
    _C("ball", "h_5 - 15", N_("height of guide 5 for its screws")),
    _C("ball", "25 - h_5 - 5", N_("thread of the screws of guide 5")),
    _C("ball", "45 - 2 * h_20 - 8", N_("thread of the screws of the rings 20")),
    _C("ball", "h_20 - ball / 2 - 7.3", N_("flange of 22 below the heads 41")),
    _C("balls", "2 * pi * r_small / max(small_balls, 1) - max(ball + 3, 1.3 * ball)",
       N_("room between two balls of the small circle")),
    _C("balls", "2 * pi * r_large / max(large_balls, 1) - max(ball + 3, 1.3 * ball)",
       N_("room between two balls of the large circle")),
    _C("wheel_module", "r_47 - 27", N_("face of nut 47"), "thesis"),
    _C("wheel_module", "r_54 - 4.5 - 7 ", N_("room for six screws in wheel 16"), "thesis"),
    _C("wheel_width", "h_18 - 5", N_("height of ring 18")),
    _C("wheel_width", "h_54 - 3", N_("floor of plate 16 under the heads of its screws"), "cranks"),
    _C("axial_gap", "axial_gap - 2", N_("collars of the pins 35"), "cranks"),
    _C("axial_gap", "axial_gap - 2.5", N_("the axle of the platform ends before the link behind nut 47"), "idlers"),
    _C("face_width", "45 - face_width - 8", N_("thread of the screws of wheel 21")),
    _C("face_width", "45 - h_24 - 8", N_("thread of the screws of ring 24")),
    _C("face_width", "disk_thickness - seat_33 - h_thread - 0.5", N_("wall over the screws of ring 24")),
    _C("face_width", "face_width - 18", N_("thread of the screws M12 in the pinion")),
    _C("worm_wheel_width", "45 - worm_wheel_width - 8", N_("thread of the screws of wheel 23")),
    _C("worm_wheel_width", "40 - worm_wheel_width - 8", N_("thread of the bolts of wheel 25")),
    _C("worm_wheel_width", "h_24 - (41 - worm_wheel_width) - (26 - h_5)", N_("floor between the recesses of ring 24")),
    _C("worm_wheel_width", "worm_wheel_width - (45 - 2 * h_20)", N_("thread of the rings 20 in wheel 25")),
    _C("axial_gap", "35 - (disk_thickness - 18) - gap_21 - 0.5 - 8", N_("thread of the screws M12 in the pinion")),
    _C("worm_module", "h_5 - 8 - 12 - z_lip", N_("lip of the body over worm I, for the screws of guide 6")),
    _C("worm_quotient", "worm_module * (worm_quotient - 7)",
       N_("diameter of the worms, seven modules: about thinner ones their wheels have no whole teeth")),
    _C("worm_length", "worm_length / 2 + 1 - x_rim", N_("ring 28 beside the worm wheel")),
    _C("worm_length", "half_room - x_seat - w_seat - 8", N_("cover of a worm within the walls of the body")),
    _C("worm_quotient", "sqrt((x_seat + 6) ** 2 + a_1 ** 2) - 6 - r_6_screws - 4",
       N_("wall between the screws of guide 6 and those of the cover of worm I")),
    _C("worm_module", "z_2 - h_seat - 12 - (z_floor - h_floor)",
       N_("set screws of worm II within the floor, through which they come in")),
    _C("worm_module", "half_room - r_6", N_("guide 6 on the lip of the body")),
    _C("worm_module", "a_2 - h_seat - 8 - r_21 - 2", N_("room between the seat of worm II and ring 22")),
    _C("worm_module", "r_worm_journal - 4 - 2", N_("end of the worm's shaft")),
    _C("platform_size", "platform_size / 2 - r_55 - 12", N_("edge of the platform beyond its screws")),
)  # fmt: skip


def _beside(reach: float, height: float) -> float:
    """Half the chord of a circle at a distance from its middle; 0 where that is outside of it."""
    return math.sqrt(max(reach**2 - height**2, 0.0))


def _chord_left(ring: float, throat: float, aside: float, distance: float) -> float:
    """Where a ring about a worm is clear of its wheel's throat, along the worm, in a plane so far from its axis."""
    reach, height = (distance - math.sqrt(max(r**2 - aside**2, 0.0)) for r in (throat, ring))
    return _beside(reach, height)


_KNOWN: Mapping[str, object] = {
    "ceil": lambda x: math.ceil(x - 1e-9), "floor": lambda x: math.floor(x + 1e-9), "max": max, "min": min,
    "round": round, "pi": math.pi, "sqrt": math.sqrt, "beside": _beside, "chord_left": _chord_left,
}  # fmt: skip


@cache
def _code(made_of: str) -> CodeType:
    return compile(ast.parse(made_of, mode="eval"), made_of, "eval")


def of_orientation(rows: Sequence[Of], orientation: str) -> list[Of]:
    """The rules or conditions of an orientation, and those of all."""
    return [row for row in rows if not row.orientation or orientation in row.orientation.split()]


def sizes(drivers: Mapping[str, float], orientation: str) -> dict[str, float]:
    """The drivers and every size by its name."""
    found = dict(drivers)
    for rule in of_orientation(RULES, orientation):
        found[rule.name] = valued(rule.made_of, found)
    return found


def valued(made_of: str, known: Mapping[str, float]) -> float:
    """What a rule or a condition comes to."""
    value: float = eval(_code(made_of), {"__builtins__": {}, **_KNOWN}, dict(known))
    return value
