"""One export of a scene as it is asked for, with all that its files are made from."""

from __future__ import annotations

from exporters.production.jobs import Job
from geometry.base.errors import Cure, GeometryError, Nearest, OffsetError, ParameterError
from geometry.base.record import Record
from geometry.plane.offset_region import OffsetRegion
from parts.base.part import Part
from parts.base.reasons import reason
from parts.base.refusal import SceneError, placed
from parts.base.texts import filled
from parts.scene.formats import Form
from parts.scene.load import ExportSpec, SceneFile
from parts.scene.placing import Placing


class Request(Record):
    """An export, ``where`` the scene from ``source`` asks for it, and the scene's parts as they are made and placed."""

    scene: SceneFile
    placing: Placing
    parts: dict[str, Part]
    export: ExportSpec
    where: str
    source: str

    @property
    def wanted(self) -> list[str]:
        """The parts that it names, all of the scene by default."""
        return self.export.parts or list(self.parts)

    @property
    def title(self) -> str:
        """Of the scene, or its name."""
        return self.scene.scene.title or self.scene.name

    @property
    def language(self) -> str:
        """In which its files speak."""
        return self.scene.scene.language

    @property
    def stem(self) -> str:
        """What the names of files of several parts begin with."""
        return f"{self.scene.name}.{self.export.name or self.export.purpose}"

    def refused(
        self, key: str, value: object, code: str, nearest: Cure = None, unit: str = "", **numbers: object
    ) -> SceneError:
        """A refusal of one of its keys."""
        return SceneError(self.source, f"{self.where}.{key}", value, code, nearest, unit, **numbers)

    def section(self, part: Part, gap: float | None = None) -> OffsetRegion:
        """The exact section of a part with its kerf or offset; ``gap``: its board's, mm.

        Raises
        ------
        SceneError
            There is none, or none is left, in the key that asks for it.
        """
        export = self.export
        try:
            offset = export.kerf / 2 if export.kerf else export.offset
            if not (export.kind.is_solid or is_flat(part)):
                raise self.refused("parts", part.id, "no_flat_outline")
            return self._moved(part, offset, gap)
        except OffsetError as error:
            key, given, cure = "offset", export.offset, self._survived(error.nearest, gap)
            if export.kerf:
                key, given, cure = "kerf", export.kerf, cure and cure.scaled(2)
            why = filled(reason(error.code))
            raise self.refused(key, given, "of_part", cure, "mm", part=part.id, why=why) from error
        except ParameterError as error:
            raise placed(self.source, f"parts.{part.id}", error) from error
        except GeometryError as error:
            raise SceneError(self.source, f"parts.{part.id}", None, "no_outline", None, why=str(error)) from error

    def _moved(self, part: Part, offset: float, gap: float | None) -> OffsetRegion:
        return part.cut(offset, gap) if self.export.kind.form is Form.ARCS else part.section(offset)

    def _survived(self, found: Nearest | None, gap: float | None) -> Nearest | None:
        """An offset that one part survives, or the nearest one that all do."""
        for part in map(self.parts.__getitem__, self.wanted):
            if found is None or not isinstance(found.value, float):
                return found
            if not (self.export.kind.is_solid or is_flat(part)):
                continue
            try:
                self._moved(part, found.value, gap)
            except OffsetError as again:
                found = again.nearest
            except GeometryError:
                # what is wrong with it is told once the offset is right
                continue
        return found

    def job(self, part: Part, path: str = "") -> Job:
        """A part in a file of its own, or one of several in theirs.

        Raises
        ------
        SceneError
            It has no such section or solid, in the key that asks for it.
        """
        job = Job(part, self.export, self.section(part), path, self.where)
        try:
            _ = job.body if job.kind.is_solid else None
        except ParameterError as refusal:
            if refusal.name == "offset":
                told = {"part": part.id, "why": filled(reason(refusal.code), **refusal.numbers)}
                raise self.refused("offset", refusal.value, "of_part", refusal.nearest, "mm", **told) from refusal
            from parts.scene.checks import solid_refused

            raise solid_refused(part, refusal, self.source) from refusal
        return job


def is_flat(part: Part) -> bool:
    """Whether flat files can hold a part."""
    return part.made_by.has_outline or part.is_plate
