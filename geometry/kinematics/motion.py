"""Motions of a body in its plane: where its frame's origin is and how far it has turned, as Taylor series.

The common parameter t is time or the drive's angle (Savvin's "common parameter"); plane points are complex.
"""

from __future__ import annotations

from geometry.base.series import Series

# Taylor coefficients of the origin (complex, mm) and of the angle alpha (rad)
Pose = tuple[Series, Series]
