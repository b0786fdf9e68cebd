"""The solid of a wheel: toothed rim, web, hub, holes and 45 degree face chamfers, as one exact body."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial
from itertools import pairwise
from typing import TYPE_CHECKING

from geometry.base.both import both
from geometry.base.errors import GeometryError, OffsetError, ParameterError, limit, rounded
from geometry.base.nearest import nearest
from geometry.base.record import Record
from geometry.base.tolerance import LEAST_SEGMENT_MM
from geometry.curves.curve import Curve, end_point, start_point
from geometry.plane.profile import Label, Profile, Region, circle
from geometry.solids.hub_holes import HubHoles, least_wall

if TYPE_CHECKING:
    # a flat section asks for the shape of a wheel, not for its solid
    from geometry.solids.body import Body, BodyBuilder, Twist
    from geometry.solids.cross_holes import CrossHole

# writes teeth into a body moved by an offset, mm: its lower and upper loop
Rim = Callable[["BodyBuilder", float], tuple[int, int]]
# of a short piece, at least this share stays
_KEPT_SHARE = 0.1
# diameters of steps differ by this much at least, mm: thinner ones are mistakes of the keyboard
_LEAST_STEP = 0.05
# lower steps and chamfers are none, walls between chamfers no lower, mm
_LEAST_HEIGHT = 1e-3
# a height that is told works, though its sums round
_ROUNDING = 1e-6
# depths of a chamfer that differ by rounding only have one section, mm
_DEPTH_DIGITS = 12


class Web(Record):
    """The thin disk between rim and hub: axial thickness, inner diameter of the rim, mm.

    ``shift``: how far its middle stands above the middle of the face width.
    """

    thickness: float
    rim_diameter: float
    shift: float = 0.0


class Hub(Record):
    """The hub: its diameter, and how far it stands out below and above the faces of the rim, mm.

    ``set_screws``: the holes across it, where it stands out farther.
    """

    diameter: float
    below: float = 0.0
    above: float = 0.0
    set_screws: tuple[CrossHole, ...] = ()


class Levels(Record):
    """Both ends of rim, web and hub along the axis, mm."""

    rim: tuple[float, float]
    web: tuple[float, float]
    hub: tuple[float, float]

    @property
    def recessed(self) -> tuple[bool, bool]:
        """Below and above: whether the web lies deeper than the rim."""
        return both(web != rim for web, rim in zip(self.web, self.rim, strict=True))

    @property
    def stepped(self) -> tuple[bool, bool]:
        """Below and above: whether the hub stands out of the web."""
        return both(hub != web for hub, web in zip(self.hub, self.web, strict=True))


class WheelShape(Record):
    """What turns the section of a wheel into a solid, lengths in mm; lower face of the rim at z = 0.

    ``chamfer_below``, ``chamfer_above``: axial and radial height of the 45 degree chamfer along every edge of
    the end faces (below, it takes the elephant foot of a print). ``twist``: of helical teeth; the chamfers of their
    faces stand upright, over and under the section where the helix ends.
    """

    face_width: float
    web: Web | None = None
    hub: Hub | None = None
    chamfer_below: float = 0.0
    chamfer_above: float = 0.0
    twist: Twist | None = None

    @property
    def is_plate(self) -> bool:
        """Whether the wheel is its section and nothing else; so it is where a hub stands out nowhere."""
        hub = self.hub is not None and (self.hub.below or self.hub.above)
        return not (self.web or hub or self.chamfer_below or self.chamfer_above)

    @property
    def levels(self) -> Levels:
        """Where rim, web and hub begin and end; what differs by a step that no file shows is one."""
        width, web, hub = self.face_width, self.web, self.hub
        middle = width / 2 + (web.shift if web else 0.0)
        half = (web.thickness if web else width) / 2
        disk = _snapped(middle - half, 0.0), _snapped(middle + half, width)
        return Levels(
            (0.0, width), disk, (_snapped(-hub.below, 0.0), _snapped(width + hub.above, width)) if hub else disk
        )

    def covered(self, tip_radius: float) -> tuple[bool, bool]:
        """Below and above: whether the hub is a flange over the ends of the teeth, which have no chamfer there."""
        wide = self.hub is not None and self.hub.diameter / 2 > tip_radius
        return both(wide and stepped for stepped in self.levels.stepped)

    def rim_chamfers(self, tip_radius: float) -> tuple[float, float]:
        """Heights of the chamfers of the teeth below and above, mm."""
        below, above = self.covered(tip_radius)
        return 0.0 if below else self.chamfer_below, 0.0 if above else self.chamfer_above


# a boundary moved ``offset`` mm out of the material and then cut ``depth`` mm into it, segment for segment
Boundary = Callable[[float, float], Profile]


class WheelSections(Record):
    """The boundaries of a wheel's section. A cut keeps sharp corners, so that chamfer faces meet in edges."""

    outline: Boundary
    root_radius: float
    core: HubHoles
    bore: Boundary | None
    holes: tuple[Boundary, ...] = ()
    # a ring's: its teeth stand in the bore
    toothed_bore: bool = False
    # the walls of what is not one outline from face to face, moved; gives the loops at both faces
    rim: Rim | None = None
    # beyond it a hub covers the ends of the teeth
    tip_radius: float = math.inf


def wheel_sections(outline: Boundary, root_radius: float, holes: HubHoles) -> WheelSections:
    """The boundaries of a wheel: its outline, which stays outside ``root_radius`` mm, and its holes."""

    @cache
    def cut(offset: float, depth: float) -> tuple[Profile, ...]:
        # an offset inwards has rounded the corners already: they stay round
        return holes.profiles(offset - depth) if offset < 0 or depth == 0 else holes.widened(depth).profiles(offset)

    def hole(index: int) -> Boundary:
        return lambda offset, depth: cut(offset, depth)[index]

    boundaries = tuple(hole(i) for i in range(holes.number))
    first = 0 if holes.bore is None else 1
    return WheelSections(outline, root_radius, holes, boundaries[0] if first else None, boundaries[first:])


def wheel_body(shape: WheelShape, sections: WheelSections, offset: float = 0.0) -> Body:
    """The exact solid of a wheel, every upright wall moved ``offset`` mm out of the material.

    Raises
    ------
    ParameterError
        A dimension leaves no solid; names its key and the nearest value that works.
    """
    from geometry.solids.body import plate

    _check_heights(shape)
    if shape.is_plate and sections.rim is None:
        holes = [s(offset, 0.0) for s in ((sections.bore,) if sections.bore else ()) + sections.holes]
        outline = sections.outline(offset, 0.0)
        toothed = holes[0] if sections.toothed_bore else outline
        return plate(Region(outline, tuple(holes)), 0.0, shape.face_width, shape.twist, toothed=toothed)
    _check_faces(shape, sections.root_radius, sections.core, offset)
    _check_chamfers(shape, sections.root_radius, sections.core, offset)
    return _Wheel(shape, sections, offset).body()


def _check_heights(shape: WheelShape) -> None:
    """The axial dimensions fit each other."""
    width, web = shape.face_width, shape.web
    if web is not None:
        if web.thickness > width:
            raise ParameterError("web.thickness", web.thickness, "thicker_than_face", limit(width, math.inf))
        play = (width - web.thickness) / 2
        if abs(web.shift) > play:
            raise ParameterError.beyond("web.shift", web.shift, "web_out_of_rim", math.copysign(play, web.shift))


def _check_chamfers(shape: WheelShape, root_radius: float, holes: HubHoles, offset: float) -> None:
    """Chamfers leave some wall between them, and with the offset an end face between every two boundaries."""
    _check_wall(shape.face_width, (shape.chamfer_below, shape.chamfer_above), "outline")
    depths, at = (shape.chamfer_below, shape.chamfer_above), shape.levels
    for side, depth, stepped, recessed in zip(("below", "above"), depths, at.stepped, at.recessed, strict=True):
        leaves = partial(_leaves_faces, shape, root_radius, holes, offset, beside_hub=stepped and not recessed)
        if not leaves(depth):
            cure = partial(nearest, leaves, depth, 0.0)
            raise ParameterError(f"face_chamfer.{side}", depth, "leaves_no_face_between_edges", cure)


def _check_wall(height: float, cuts: tuple[float, float], who: str) -> None:
    """Chamfers leave some upright wall of a boundary: an edge alone touches nothing, and no file holds a lower wall."""
    if any(cuts) and height - sum(cuts) < (1 - _ROUNDING) * _LEAST_HEIGHT:
        key = "below" if cuts[0] >= cuts[1] else "above"
        code = "chamfers_meet" if all(cuts) else f"chamfer_higher_than_{who}"
        most = limit(max(0.0, height - min(cuts) - _LEAST_HEIGHT), math.inf)
        raise ParameterError(f"face_chamfer.{key}", max(cuts), code, most)


class _Wheel:
    """Builds one wheel; z values of both sides in mm, side 0 below and side 1 above."""

    def __init__(self, shape: WheelShape, sections: WheelSections, offset: float) -> None:
        from geometry.solids.body import BodyBuilder, Twist

        self.upright = Twist()
        self.sections, self.offset, self.twist = sections, offset, shape.twist
        web, hub, at = shape.web, shape.hub, shape.levels
        self.rim, self.web, self.hub = at.rim, at.web, at.hub
        self.chamfer = (_snapped(shape.chamfer_below, 0.0), _snapped(shape.chamfer_above, 0.0))
        self.hub_circle = circle(hub.diameter / 2 + offset, Label.HUB) if hub else None
        recess = web is not None and self.web != self.rim
        self.rim_circle = circle(web.rim_diameter / 2 - offset, Label.RIM, hole=True) if web and recess else None
        self.recessed, self.stepped = at.recessed, at.stepped
        self.covered = shape.covered(sections.tip_radius)
        self.made = BodyBuilder()
        self.holes: list[tuple[int, int]] = []

    def body(self) -> Body:
        """Walls first, then the caps of both sides."""
        whole = both(not recessed for recessed in self.recessed)
        around, within = (None, self.twist) if self.sections.toothed_bore else (self.twist, None)
        if self.sections.rim is not None:
            outline = self.sections.rim(self.made, self.offset)
        else:
            free = both(not covered for covered in self.covered)
            outline = self._run(self.sections.outline, self.rim, free, "outline", around)
        self.holes = [self._run(hole, self.web, whole, "hole") for hole in self.sections.holes]
        bore = None
        if self.sections.bore is not None:
            # a bore that ends in the floor of a recess has no chamfer there
            ends = both(stepped or flush for stepped, flush in zip(self.stepped, whole, strict=True))
            who = "outline" if self.sections.toothed_bore else "bore"
            bore = self._run(self.sections.bore, self.hub, ends, who, within)
        for side in (0, 1):
            self._side(side, outline[side], None if bore is None else bore[side])
        return self.made.body()

    def _side(self, side: int, outline: int, bore: int | None) -> None:
        """The caps of one side, and the walls of rim and hub that stand between them."""
        up = side == 1
        inside = [] if bore is None else [bore]
        if self.stepped[side]:
            assert self.hub_circle is not None
            foot, end = self._step(self.hub_circle, side, self.web[side], self.hub[side])
            self.made.cap(end, inside, up=up)
            if self.covered[side]:
                self.made.cap(foot, [outline], up=not up)
                return
            inside = [foot]
        inside += [hole[side] for hole in self.holes]
        if self.recessed[side]:
            assert self.rim_circle is not None
            foot, end = self._step(self.rim_circle, side, self.web[side], self.rim[side])
            self.made.cap(foot, inside, up=up)
            inside = [end]
        self.made.cap(outline, inside, up=up)

    def _step(self, profile: Profile, side: int, near: float, far: float) -> tuple[int, int]:
        """The wall of a circle from the web to an end face, chamfered there: loops at the web and at the end."""
        arc = profile.period[0].curve
        radius, hole = abs(complex(arc.point(0.0))), profile is self.rim_circle

        def moved(offset: float, depth: float) -> Profile:
            if depth == 0:
                return profile
            return circle(radius + depth if hole else radius - depth, profile.period[0].label, hole=hole)

        heights = (near, far) if side == 1 else (far, near)
        ends = self._run(moved, heights, (side == 0, side == 1), "rim" if hole else "hub")
        return ends[1 - side], ends[side]

    def _run(
        self,
        profile: Boundary,
        heights: tuple[float, float],
        chamfered: tuple[bool, bool],
        who: str,
        twist: Twist | None = None,
    ) -> tuple[int, int]:
        """The walls of one boundary from its lower to its upper end; returns the loops at both ends."""
        whole = profile(self.offset, 0.0)
        below_cut, above_cut = (c if flag else 0.0 for c, flag in zip(self.chamfer, chamfered, strict=True))
        cuts = (below_cut, above_cut)
        _check_wall(heights[1] - heights[0], cuts, who)
        stations = [(whole, *s) for s in (twist or self.upright).stations(*heights, cuts)]
        if cuts[0] > 0:
            stations.insert(0, (inset_of(profile, self.offset, cuts[0], "below", who), heights[0], *stations[0][2:]))
        if cuts[1] > 0:
            inset = stations[0][0] if cuts[1] == cuts[0] else inset_of(profile, self.offset, cuts[1], "above", who)
            stations.append((inset, heights[1], *stations[-1][2:]))
        loops = [self.made.loop(*station) for station in stations]
        at = cache(partial(profile, self.offset))

        def below(z: float) -> Profile:
            return at(round(heights[0] + cuts[0] - z, _DEPTH_DIGITS))

        def above(z: float) -> Profile:
            return at(round(z - heights[1] + cuts[1], _DEPTH_DIGITS))

        last = len(loops) - 2
        for index, (lower, upper) in enumerate(pairwise(loops)):
            chamfer = below if index == 0 and cuts[0] > 0 else above if index == last and cuts[1] > 0 else None
            self.made.wall(lower, upper, chamfer)
        return loops[0], loops[-1]


def _snapped(z: float, face: float) -> float:
    """A height, or the face that it meets but for a step that no file shows."""
    return face if abs(z - face) <= _LEAST_HEIGHT else z


def inset_of(profile: Boundary, offset: float, chamfer: float, side: str, who: str) -> Profile:
    """A boundary moved ``chamfer`` mm into the material, segment for segment that of the whole boundary."""
    before = profile(offset, 0.0).period
    whole = [s.label for s in before]
    if offset > 0:
        raise ParameterError.beyond("offset", offset, "offset_rounds_chamfered_edges", 0.0)

    def attempt(depth: float) -> Profile | None:
        try:
            inset = profile(offset, depth)
        except GeometryError:
            return None
        if [s.label for s in inset.period] != whole:
            return None
        return inset if all(_keeps(a.curve, b.curve) for a, b in zip(before, inset.period, strict=True)) else None

    found = attempt(chamfer)
    if found is not None:
        return found
    cure = partial(nearest, lambda depth: attempt(depth) is not None, chamfer, 0.0)
    raise ParameterError(f"face_chamfer.{side}", chamfer, f"chamfer_leaves_nothing_of_{who}", cure)


def check_wheel(
    shape: WheelShape,
    root_diameter: float,
    holes: HubHoles,
    edge: str = "root_circle",
    tip_diameter: float = math.inf,
) -> None:
    """Refuse a shape whose diameters do not fit between bore, holes and root circle; chamfers the body refuses.

    ``edge``: what ends the faces in place of the root circle, as the codes of refusals have it; ``tip_diameter``:
    beyond which a hub may cover the ends of all teeth, mm.

    Raises
    ------
    ParameterError
        Names the key and the nearest value that works.
    """
    web, hub = shape.web, shape.hub
    inner, outer = (2 * r for r in holes.beside_bore())
    if hub is not None:
        covers = web is None and hub.below + hub.above > 0
        most, flange = root_diameter - _LEAST_STEP, math.inf
        if covers and tip_diameter < math.inf:
            flange = rounded(tip_diameter + _LEAST_STEP, up=True, digits=4)
        if most < hub.diameter < flange < math.inf:
            numbers = {"diameter": root_diameter, "flange": flange}
            raise ParameterError("hub.diameter", hub.diameter, "reaches_teeth", limit(most, hub.diameter), **numbers)
        high = math.inf if hub.diameter >= flange else root_diameter
        _between("hub.diameter", hub.diameter, (2 * holes.bore_reach, "bore"), (high, edge))
        _between("hub.diameter", hub.diameter, (0.0, ""), (inner, "holes"))
    if web is not None:
        core = (hub.diameter, "hub") if hub else (2 * holes.bore_reach, "bore")
        _between("web.rim_diameter", web.rim_diameter, core, (root_diameter, "root_circle"))
        _between("web.rim_diameter", web.rim_diameter, (outer, "holes"), (math.inf, ""))
    _check_heights(shape)
    if hub is not None and hub.set_screws:
        from geometry.solids.cross_holes import check_cross_holes

        above, width = hub.above >= hub.below, shape.face_width
        ends = (width, width + hub.above) if above else (0.0, -hub.below)
        chamfer = shape.chamfer_above if above else shape.chamfer_below
        check_cross_holes(hub.set_screws, holes.bore, ends, chamfer, least_wall(hub.diameter / 2))
    if not _leaves_faces(shape, root_diameter / 2, holes, 0.0, 0.0):
        # whatever stands beside a hub or a rim was refused above
        key = "holes" if holes.round_holes else "spokes" if holes.spokes else "bore_diameter"
        raise ParameterError(key, None, "leaves_no_face_between_edges")


def _check_faces(shape: WheelShape, root_radius: float, holes: HubHoles, offset: float) -> None:
    """An offset leaves an end face between every two boundaries."""

    def fits(moved: float) -> bool:
        return _leaves_faces(shape, root_radius, holes, moved, 0.0)

    if not fits(offset):
        raise ParameterError("offset", offset, "leaves_no_face_between_edges", partial(nearest, fits, offset, 0.0))


def _leaves_faces(
    shape: WheelShape, root_radius: float, holes: HubHoles, offset: float, depth: float, *, beside_hub: bool = False
) -> bool:
    """Whether every ring of the end faces, and the floor of a recess, keeps some width; one ``beside_hub`` too."""
    inset = depth - offset
    try:
        wide = holes.widened(max(inset, 0.0))
    except OffsetError:
        return False
    inner, outer = wide.beside_bore()
    rings = [(max(wide.bore_reach, outer), root_radius - inset)]
    if shape.hub is not None:
        rings += [(wide.bore_reach, shape.hub.diameter / 2 - inset), (shape.hub.diameter / 2 + offset, inner)]
        if beside_hub and shape.hub.diameter / 2 < root_radius:
            rings.append((shape.hub.diameter / 2 + offset, root_radius - inset))
    if shape.web is not None:
        core = shape.hub.diameter / 2 + offset if shape.hub else wide.bore_reach
        rings += [
            (shape.web.rim_diameter / 2 + inset, root_radius - inset),
            (core, shape.web.rim_diameter / 2 - offset),
            (outer, shape.web.rim_diameter / 2 - offset),
        ]
    # a ring that is no face at all (a hub as wide as what it stands on) was refused before
    least = least_wall(root_radius) if depth > 0 or offset != 0 else 0.0
    return all(low + least < high for low, high in rings)


def _keeps(whole: Curve, inset: Curve) -> bool:
    """Whether a boundary's piece keeps some length at the edge of a chamfer: what is less is lost to rounding."""
    before, after = (abs(end_point(c) - start_point(c)) for c in (whole, inset))
    return after >= min(LEAST_SEGMENT_MM, _KEPT_SHARE * before)


def _between(key: str, value: float, low: tuple[float, str], high: tuple[float, str]) -> None:
    least, most = low[0] + _LEAST_STEP, high[0] - _LEAST_STEP
    if low[0] > 0 and value < least:
        raise ParameterError.beyond(key, value, f"within_{low[1]}", least, diameter=low[0])
    if value > most:
        raise ParameterError.beyond(key, value, f"reaches_{high[1]}", most, diameter=high[0])
