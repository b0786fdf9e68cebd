"""One export of a scene as it is asked for, with all that its files are made from."""

from __future__ import annotations

from geometry.base.errors import Cure
from geometry.base.record import Record
from parts.base.part import Part
from parts.base.refusal import SceneError
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

    def refused(self, key: str, value: object, code: str, nearest: Cure = None, **numbers: object) -> SceneError:
        """A refusal of one of its keys."""
        return SceneError(self.source, f"{self.where}.{key}", value, code, nearest, "", **numbers)
