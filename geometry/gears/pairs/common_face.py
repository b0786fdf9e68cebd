"""The face that two helical mates have in common: overlap and total contact ratio, and which findings follow."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from geometry.base.findings import Finding
from geometry.base.record import Record
from geometry.gears.teeth.helix import Helix

if TYPE_CHECKING:
    from collections.abc import Sequence

_SPUR = Helix()
# below which a ratio's shortage is rounding
_ROUNDING = 1e-9


class CommonFace(Record):
    """Face width that both mates have at one height, mm, and the first one's helix; straight teeth overlap by 0."""

    helix: Helix = _SPUR
    normal_module: float = 1.0
    width: float = 0.0

    @property
    def overlap_ratio(self) -> float:
        """eps_beta, of each half of double helical teeth."""
        from geometry.gears.teeth.transverse import overlap_ratio

        width = self.width / 2 if self.helix.double else self.width
        return overlap_ratio(max(width, 0.0), self.helix.angle, self.normal_module)

    def turn(self, teeth: int, height: float) -> float:
        """How far the first's teeth are turned at a height above its lower face, rad; ``teeth``: its number."""
        if self.helix.double:
            # both halves meet at one height: herringbones at unlike heights do not mesh anyway
            return 0.0
        return 2 * math.sin(self.helix.signed_angle) * height / (self.normal_module * teeth)

    def quantities(self, effective_contact_ratio: float) -> dict[str, Any]:
        """Overlap and total contact ratio of helical teeth; nothing for straight ones."""
        if self.helix.angle == 0:
            return {}
        overlap = self.overlap_ratio
        return {
            "common_face_width": self.width,
            "overlap_ratio": overlap,
            "total_contact_ratio": effective_contact_ratio + overlap,
        }

    def findings(self, found: Sequence[Finding], effective_contact_ratio: float) -> tuple[Finding, ...]:
        """The pair's findings, with the total contact ratio of helical teeth in place of the transverse one."""
        if self.helix.angle == 0:
            return tuple(found)
        kept = tuple(f for f in found if f.code != "contact_ratio")
        if len(kept) == len(found):
            return kept
        total = effective_contact_ratio + self.overlap_ratio
        if total >= 1 - _ROUNDING:
            return (*kept, Finding("transverse_contact_ratio", effective_contact_ratio, total))
        return (*kept, Finding("total_contact_ratio", total, 1.0))


STRAIGHT = CommonFace()
