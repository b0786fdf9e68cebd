"""Transmission error of a mesh from the exact contact: how far the second body is from where involutes would have it.

At each drive angle the second body is moved against the driving flanks of the first until they just touch: a root of
the exact gap of that side. Where several pairs of teeth could touch, the one that is met first holds the others off.
The ideal is the contact of the main flanks (closed form), so that a pair of whole involutes has no error; relief,
broken tips, an undercut and a contact ratio below 1 have. Loads do not bend anything here: it is the unloaded,
quasi-static error of perfect gears.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from geometry.base.errors import ConvergenceError
from geometry.base.record import Record, replace
from geometry.curves.curve import Real
from geometry.gears.mesh.least_gap import ACCURACY
from geometry.gears.mesh.search import between, least_gaps

if TYPE_CHECKING:
    from geometry.gears.mesh.search import MeshSearch

_STEPS = 80
# so many times a gap is closed by one step at most, or an overlap opened
_FARTHEST, _BACK = 1.5, 4.0
# where corners graze the gap hardly changes: steps may always be as long as this part of the module
_GRAZING = 0.01
# extremes are looked for between the drive angles: so many times closer each round, until nothing gains this part of
# the error, or of the module
_CLOSER, _ROUNDS, _GAINED, _NOTHING = 16, 5, 2e-4, 1e-9
# angles of a pitch at which the closed form is asked whether main flanks could meet
_FINE = 4096


class TransmissionError(Record):
    """The error over one pitch of the first gear while it drives in one sense.

    ``sense``: +1 where the first gear turns counter-clockwise. ``drive_angles`` (n,) rad; ``errors`` (n,) mm along the
    line of action (arc on the second's base circle), positive where the second is ahead of the ideal. ``arm``: mm of
    that per unit of the second's motion: its base radius, or cos(alpha) of a rack. ``pitch``: the first gear's, rad.
    """

    sense: int
    drive_angles: tuple[float, ...]
    errors: tuple[float, ...]
    arm: float
    pitch: float

    @property
    def peak_to_peak(self) -> float:
        """mm along the line of action."""
        return max(self.errors) - min(self.errors)

    def over_face(self, overlap_ratio: float) -> TransmissionError:
        """That of helical teeth: of the sections along the face the one that is farthest ahead rules.

        ``overlap_ratio``: pitches that the face covers; from 1 on every section of the pitch is there at all times.
        Below, the curve is taken as straight between its drive angles: good to some thousandths of the section's.
        """
        if overlap_ratio <= 0 or len(self.errors) < 2:
            return self
        angles, errors = np.array(self.drive_angles), np.array(self.errors)
        face = min(overlap_ratio, 1.0) * self.pitch
        way = np.concatenate([angles + k * self.pitch for k in (-1, 0, 1, 2)])
        value = np.tile(errors, 4)
        starts = np.sort(np.mod(np.concatenate([angles, angles - face]), self.pitch))
        low, high = np.interp(starts, way, value), np.interp(starts + face, way, value)
        # between two starts both ends change evenly: where one takes over from the other is a start as well
        over, width = high - low, np.diff(starts)
        taken = np.flatnonzero(over[:-1] * over[1:] < 0)
        shares = over[taken] / (over[taken] - over[taken + 1])
        starts = np.sort(np.append(starts, starts[taken] + shares * width[taken]))
        ends = np.maximum(np.interp(starts, way, value), np.interp(starts + face, way, value))
        inside = (way >= starts[:, None]) & (way <= starts[:, None] + face)
        ruling = np.maximum(ends, np.where(inside, value, -np.inf).max(axis=1))
        return replace(self, drive_angles=tuple(starts.tolist()), errors=tuple(ruling.tolist()))


def transmission_errors(mesh: MeshSearch, overlap_ratio: float = 0.0) -> tuple[TransmissionError, TransmissionError]:
    """The errors of a mesh whose first gear drives counter-clockwise, and clockwise.

    ``overlap_ratio``: that of helical teeth, whose transverse section the mesh is.

    Raises
    ------
    ConvergenceError
        The bodies touch at no turn of the second that can be found.
    """
    found = []
    for sense, side in ((1, 1), (-1, 0)):
        angles, errors = _curve(mesh, side)
        one = TransmissionError(sense, tuple(angles.tolist()), tuple(errors.tolist()), mesh.arm, mesh.pitches[0])
        found.append(one.over_face(overlap_ratio))
    return found[0], found[1]


def _curve(mesh: MeshSearch, side: int) -> tuple[Real, Real]:
    """Drive angles and errors, more of them about the greatest and the least."""
    angles = mesh.drive_angles()
    closed = mesh.closed_form(angles)[:, side]
    # the main flanks' gap is the same at all drive angles
    ideal = float(closed[np.argmin(np.abs(closed))]) / mesh.arm
    ideal = ideal if np.isfinite(ideal) else 0.0
    angles = np.unique(np.concatenate([angles, _without_flanks(mesh, side, ideal)]))
    errors = _errors(mesh, angles, side, ideal, np.zeros(angles.shape))
    pitch, gaining = mesh.pitches[0], [1.0, -1.0]
    for _ in range(_ROUNDS):
        before = [float((k * errors).max()) for k in gaining]
        least = max(_GAINED * float(np.ptp(errors)), _NOTHING * mesh.module)
        if not gaining or np.ptp(errors) <= _NOTHING * mesh.module:
            break
        more = np.concatenate([between(angles, int((k * errors).argmax()), pitch, _CLOSER) for k in gaining])
        more = np.mod(more, pitch)
        near = np.interp(more, angles, errors, period=pitch)
        errors = np.concatenate([errors, _errors(mesh, more, side, ideal, near)])
        angles = np.concatenate([angles, more])
        order = np.argsort(angles, kind="stable")
        angles, errors = angles[order], errors[order]
        gaining = [k for k, was in zip(gaining, before, strict=True) if (k * errors).max() - was > least]
    return angles, errors


def _without_flanks(mesh: MeshSearch, side: int, ideal: float) -> Real:
    """Drive angles at the ends and in the middle of every stretch, however short, in which no main flanks meet."""
    step = mesh.pitches[0] / _FINE
    shift = ideal * (mesh.closing if side else -mesh.closing)
    angles = np.arange(_FINE, dtype=np.float64) * step
    lost = ~np.isfinite(mesh.closed_form(angles, shift)[:, side])
    if not lost.any() or lost.all():
        return np.zeros(0)
    starts = np.flatnonzero(lost & ~np.roll(lost, 1))
    ends = np.flatnonzero(lost & ~np.roll(lost, -1))
    ends = np.where(ends[0] < starts[0], np.append(ends[1:], ends[0] + _FINE), ends)
    return np.mod(np.concatenate([starts - 1, (starts + ends) / 2, ends + 1]) * step, mesh.pitches[0])


def _errors(mesh: MeshSearch, drive: Real, side: int, ideal: float, near: Real) -> Real:
    """mm by which the second is ahead of ``ideal`` (in the unit of its motion) where it just touches: (n,).

    ``near`` (n,): errors to begin with. Secants, kept between the last places that were apart and that overlapped.
    """
    # x grows as the second closes on the driving flanks: against the way that they drive it
    sign = mesh.closing if side else -mesh.closing
    x = ideal - near / mesh.arm
    low, high = np.full(drive.shape, -np.inf), np.full(drive.shape, np.inf)
    last, last_gap = x.copy(), np.zeros(drive.shape)
    enough = 4 * max(ACCURACY * mesh.module, mesh.half.rounding)
    rows, gap = np.arange(len(drive)), last_gap
    for step in range(_STEPS):
        gap = least_gaps(mesh, drive[rows], sign * x[rows]).gap[side::2]
        low[rows] = np.where(gap > 0, x[rows], low[rows])
        high[rows] = np.where(gap > 0, high[rows], x[rows])
        kept = (np.abs(gap) > enough) & ((high[rows] - low[rows]) * mesh.arm > enough)
        rows, gap = rows[kept], gap[kept]
        if not rows.size:
            return (ideal - x) * mesh.arm
        here, a, b = x[rows], low[rows], high[rows]
        # flanks that touch move with the arm; longer steps could carry a tooth past its mate
        following = here + gap / mesh.arm
        longest = np.maximum(np.where(gap > 0, _FARTHEST, _BACK) * np.abs(gap), _GRAZING * mesh.module)
        farthest = here + np.copysign(longest, gap) / mesh.arm
        if step:
            with np.errstate(invalid="ignore", divide="ignore"):
                secant = here - gap * (here - last[rows]) / (gap - last_gap[rows])
            following = np.where(np.isfinite(secant) & (step % 4 != 3), secant, following)
        both = np.isfinite(a) & np.isfinite(b)
        following = np.where(
            both, following, np.clip(following, np.minimum(here, farthest), np.maximum(here, farthest))
        )
        middle = np.where(both, (a + b) / 2, farthest)
        inside = (following > a) & (following < b)
        last[rows], last_gap[rows] = here, gap
        x[rows] = np.where(inside, following, middle)
    raise ConvergenceError("the turn at which the teeth touch", float(np.abs(gap).max()), _STEPS)
