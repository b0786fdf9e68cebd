"""Plates read back: beside being an assembly in its places, all of it on the bed, each piece clear of the others."""

from __future__ import annotations

import numpy as np

from exporters.formats.read_assembly import ReadAssembly
from exporters.verification.verdict import Verdict
from parts.base.texts import N_, unless
from parts.keys.boards import BedSpec


def on_bed(found: ReadAssembly, bed: BedSpec, declared: float, verdict: Verdict) -> Verdict:
    """A good verdict with where the file's own vertices stand, each within the declared error, mm."""
    import shapely

    hulls, failures = [], list[str]()
    reach = np.array([bed.width, bed.depth, bed.height])
    edge = np.array([bed.margin, bed.margin, 0.0])
    least, most = np.full(3, np.inf), np.full(3, -np.inf)
    for name, index, place, _ in found.occurrences:
        # a piece repeats its corners: those of its faces are all that there are
        corners = found.prototypes[index].part.faces().reshape(-1, 3) @ place[:, :3].T + place[:, 3]
        low, high = corners.min(axis=0), corners.max(axis=0)
        least, most = np.minimum(least, low), np.maximum(most, high)
        beside = np.any(low < edge - declared) or np.any(high > reach - edge + declared)
        failures += unless(not beside, "{name} does not lie on the bed", name=name)
        plane = np.unique(corners[:, 0] + 1j * corners[:, 1])
        hulls.append(shapely.MultiPoint(np.column_stack([plane.real, plane.imag])).convex_hull)
    measured = {"least_margin": float(min(least[:2].min(), (reach - most)[:2].min())), "height": float(most[2])}
    one, two = shapely.STRtree(hulls).query(np.array(hulls, dtype=object), predicate="dwithin", distance=bed.gap + 1.0)
    for a, b in zip(one.tolist(), two.tolist(), strict=True):
        if a < b:
            gap = float(shapely.distance(hulls[a], hulls[b]))
            measured["least_gap"] = min(gap, measured.get("least_gap", gap))
            names, other = (found.occurrences[k].name for k in (a, b))
            told = N_("{names} and {other} stand {gap:.6g} mm apart instead of {wanted:g}")
            failures += unless(gap >= bed.gap - declared, told, names=names, other=other, gap=gap, wanted=bed.gap)
    return verdict.also(failures, measured)
