"""What a cam's sheet shows: the cam, its numbered positions, the drawing's motion, and the scales of the diagrams."""

from __future__ import annotations

import math

import numpy as np

from geometry.base.record import Record
from geometry.cams.motion.follower_motion import PhaseKind
from geometry.cams.motion.guides import Oscillating, Translating
from geometry.cams.plane.disk import DiskCam
from geometry.cams.plane.graphical import GraphicalMotion, graphical_hindrance, graphical_motion
from geometry.cams.plane.synthesis import greatest_pressure_angle
from parts.base.texts import words
from parts.drawing.canvas import decimal, standard_scale
from parts.pages.page import unit_text

# parts of a turn, in intervals of a phase, where a table of points gives no phases
TURN_SHARE = 3


class Position(Record):
    """A numbered position of the follower: its number and the cam angle, rad."""

    number: int
    angle: float


class CamPicture(Record):
    """A cam and all that its sheet marks; ``gamma``: transmission angle of the tangents, rad, None of a flat swing.

    ``asked``: whether gamma is the scene's; otherwise it is the one that the cam reaches. ``gamma_back``: that of the
    return where it has one, rad.
    """

    cam: DiskCam
    intervals: int
    gamma: float | None
    asked: bool
    gamma_back: float | None
    least_curvature_radius: float
    positions: tuple[Position, ...]
    drawn: GraphicalMotion | None
    language: str
    speed_rpm: float | None = None

    @property
    def swings(self) -> bool:
        """Whether the follower oscillates: its motion is shown in degrees."""
        return self.cam.swings

    @property
    def unit(self) -> float:
        """What the motion's numbers are multiplied with to be shown: mm, or degrees for rad."""
        return 180 / math.pi if self.swings else 1.0

    @property
    def base_name(self) -> str:
        """The symbol of the base circle: the least radius of a cam whose follower starts from its lowest place."""
        return "R_{min}" if self.cam.motion.starts_lowest else "R_{b}"

    def axis_name(self, order: int) -> str:
        """The motion or one of its derivatives over the cam angle as an axis tells it, with its unit."""
        name = ("ψ" if self.swings else "S") + "'" * order
        unit = ("deg" if self.swings else "mm") + ("", "/rad", "/rad2")[order]
        return f"{name}, {unit_text(unit, words(self.language))}"

    def say(self, value: float, digits: int = 2) -> str:
        """A number in the sheet's language."""
        text = f"{value:.{digits}f}"
        return decimal(text.lstrip("-") if float(text) == 0 else text, self.language)


def cam_picture(
    cam: DiskCam,
    intervals: int,
    gamma_deg: float | None,
    least_curvature_radius: float,
    language: str,
    speed_rpm: float | None = None,
    gamma_back_deg: float | None = None,
) -> CamPicture:
    """The picture of a cam with ``intervals`` parts of each phase.

    Raises
    ------
    ParameterError
        The number of intervals is out of range.
    """
    drawn = None
    if graphical_hindrance(cam.motion) is None:
        drawn = graphical_motion(cam.motion, intervals)
    gamma = None if gamma_deg is None else math.radians(gamma_deg)
    if gamma is None and not cam.is_flat and cam.motion.moving_pieces(PhaseKind.RISE):
        gamma = math.pi / 2 - greatest_pressure_angle(cam, PhaseKind.RISE).value
        if not 0 < gamma < math.pi / 2:
            gamma = None
    if cam.is_flat:
        gamma = None if not isinstance(cam.mount, Translating) else math.pi / 4
    positions = _positions(cam, intervals)
    back = gamma if isinstance(cam.mount, Oscillating) else None
    if gamma_back_deg is not None and not cam.is_flat:
        back = math.radians(gamma_back_deg) if gamma_back_deg else None
    asked = gamma_deg is not None
    return CamPicture(cam, intervals, gamma, asked, back, least_curvature_radius, positions, drawn, language, speed_rpm)


def _positions(cam: DiskCam, intervals: int) -> tuple[Position, ...]:
    """0 to n: ends of the parts of each moving phase, and of each dwell."""
    phases = cam.motion.phases
    if not phases:
        count = TURN_SHARE * intervals
        return tuple(Position(k, 2 * math.pi * k / count) for k in range(count))
    found: list[Position] = []
    at = 0.0
    for index, phase in enumerate(phases):
        end = 2 * math.pi if index == len(phases) - 1 else at + phase.angle
        count = intervals if phase.law is not None else 1
        for k in range(count):
            found.append(Position(len(found), at + (end - at) * k / count))
        at = end
    return tuple(found)


class Scales(Record):
    """Scales of the diagrams by (4.1) to (4.4): rad, and mm (degrees), per rad^k, of one mm of paper.

    The pole distances follow: H_1 = mu_S / (mu_S' mu_phi), H_2 = mu_S' / (mu_S'' mu_phi), mm of paper.
    """

    phi_deg: float
    lift: float
    rate: float
    bend: float

    @property
    def phi(self) -> float:
        """mu_phi, rad/mm."""
        return math.radians(self.phi_deg)

    @property
    def poles(self) -> tuple[float, float]:
        """H_1 and H_2, mm."""
        return self.lift / (self.rate * self.phi), self.rate / (self.bend * self.phi)

    def of(self, order: int) -> float:
        """mu of S^(order)."""
        return (self.lift, self.rate, self.bend)[order]


def scales_of(picture: CamPicture, width: float, height: float) -> Scales:
    """Scales that keep a turn within ``width`` mm and every diagram within ``height`` mm."""
    found: list[float] = []
    for order in range(3):
        low, high = picture.cam.motion.extremes(order)
        reach = (max(high, 0.0) - min(low, 0.0)) * picture.unit
        found.append(standard_scale(reach / height) if reach > 0 else 1.0)
    return Scales(standard_scale(360.0 / width), *found)


def thinned(places: np.ndarray, least: float) -> list[bool]:
    """Which of rising places keep a name so that neighbours stand ``least`` mm apart."""
    kept, last = [], -math.inf
    for place in places.tolist():
        keep = place - last >= least
        kept.append(keep)
        last = place if keep else last
    return kept
