"""One export of a scene as it is asked for, with all that its files are made from."""

from __future__ import annotations

from functools import partial

from exporters.production.jobs import Job
from geometry.base.errors import Cure, GeometryError, Nearest, OffsetError, ParameterError
from geometry.base.nearest import nearest
from geometry.base.record import Record
from geometry.plane.offset_region import OffsetRegion
from parts.base.offers import MOST_OFFERS
from parts.base.part import Part
from parts.base.refusal import SceneError, explained, placed
from parts.base.schema import value_at
from parts.scene.formats import Form
from parts.scene.placing import Placing
from parts.scene.scene_file import ExportSpec, SceneFile

# so near to the last offset that holds a search of costly solids may end, part of it
_SHARE = 8e-4


class Request(Record):
    """An export, ``where`` the scene from ``source`` asks for it, and the scene's parts as they are made and placed.

    ``is_whole``: the command has left none of the parts out that the scene wants.
    """

    scene: SceneFile
    placing: Placing
    parts: dict[str, Part]
    export: ExportSpec
    where: str
    source: str
    is_whole: bool = True

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

    @property
    def offset(self) -> float:
        """Of its outlines out of the material, mm."""
        return self.export.kerf / 2 if self.export.kerf else self.export.offset

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
        try:
            if not (self.export.kind.is_solid or is_flat(part)):
                raise self.refused("parts", part.id, "no_flat_outline")
            return self._moved(part, self.offset, gap)
        except ParameterError as error:
            if self._blames_offset(part, error):
                raise self._offset_refused(part, error, gap) from error
            raise placed(self.source, f"parts.{part.id}", error) from error
        except GeometryError as error:
            raise SceneError(self.source, f"parts.{part.id}", None, "no_outline", None, why=str(error)) from error

    def _moved(self, part: Part, offset: float, gap: float | None) -> OffsetRegion:
        return part.cut(offset, gap) if self.export.kind.form is Form.ARCS else part.section(offset)

    def _blames_offset(self, part: Part, error: ParameterError) -> bool:
        """Whether a refusal is of the offset: by its name, or of what no key of the part says."""
        return error.name == "offset" or (self.offset != 0 and value_at(part.keys, error.name) is None)

    def _offset_refused(self, part: Part, error: ParameterError, gap: float | None = None) -> SceneError:
        """The refusal of an offset that a part does not survive, in the key that asks for it."""
        key, factor = ("kerf", 2.0) if self.export.kerf else ("offset", 1.0)
        # without what it offers itself
        bare = ParameterError(error.name, error.value, error.code, None, **error.numbers)
        told = {"part": part.id, "why": explained(placed("", "", bare))}

        def cure() -> Nearest | None:
            found = self._survived(error.nearest if error.name == "offset" else Nearest(self.offset), gap)
            return found if found is None or factor == 1 else found.scaled(factor)

        return self.refused(key, factor * self.offset, "of_part", cure, "mm", **told)

    def _survived(self, found: Nearest | None, gap: float | None) -> Nearest | None:
        """An offset that one part survives, or the nearest one that all do, with the solids that files hold."""

        def whole(offset: float, part: Part) -> bool:
            section = self._moved(part, offset, gap)
            return not self.export.kind.is_solid or bool(Job(part, self.export, section, "", self.where).body)

        for part in map(self.parts.__getitem__, self.wanted):
            for _ in range(MOST_OFFERS):
                if found is None or not isinstance(given := found.value, float):
                    return found
                if not (self.export.kind.is_solid or is_flat(part)):
                    break
                try:
                    whole(given, part)
                    break
                except OffsetError as again:
                    found = again.nearest
                except GeometryError:
                    # another key of it, or what is wrong with it is told once the offset is right
                    found = nearest(partial(whole, part=part), given, 0.0, share=_SHARE) or found
                    break
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
            if self._blames_offset(part, refusal):
                raise self._offset_refused(part, refusal) from refusal
            from parts.scene.checks import solid_refused

            raise solid_refused(part, refusal, self.source) from refusal
        return job


def is_flat(part: Part) -> bool:
    """Whether flat files can hold a part."""
    return part.made_by.has_outline or part.is_plate
