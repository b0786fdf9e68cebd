"""What lies on each board and plate of a build, whatever the formats of its files."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, TypeAlias, TypeGuard

from parts.drawing.names import caption_name

if TYPE_CHECKING:
    from exporters.production.boards import BoardJob
    from exporters.production.jobs import AssemblyJob
    from exporters.production.plan import Plan
    from exporters.production.plates import PlateJob
    from parts.base.texts import Words

    LaidJob: TypeAlias = BoardJob | PlateJob


def laid_jobs(plan: Plan) -> dict[str, list[LaidJob]]:
    """The jobs of each board and plate, one for each format, by the name of their files without its ending."""
    found: dict[str, list[LaidJob]] = {}
    for job in plan.assemblies:
        if _is_laid(job):
            found.setdefault(job.path.rpartition(".")[0], []).append(job)
    return found


def _is_laid(job: AssemblyJob | BoardJob) -> TypeGuard[LaidJob]:
    return job.export.is_laid


def lying_on(job: LaidJob, told: Words) -> dict[str, str]:
    """For each part on a board or plate how many of it lie there, and its name, as a language writes numbers."""
    counts = Counter(piece.part for piece in job.pieces)
    named = {m.part.id: " ".join(filter(None, (caption_name(m.part), m.part.numbers))) for m in job.members}
    return {part: told.decimal(f"{counts[part]} × {name}") for part, name in named.items()}
