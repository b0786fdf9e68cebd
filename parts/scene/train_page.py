"""``higherpair calc train`` of a scene: its mechanism in the words of the topic, wheels numbered as the sources do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from parts.base.refusal import SceneError
from parts.mates.pages.train import TrainKeys, sheet
from parts.mates.pages.train_model import ACROSS

if TYPE_CHECKING:
    from geometry.base.placement import Vector
    from geometry.kinematics.mechanism import Mechanism, Rolling
    from parts.scene.scene_file import SceneFile

__all__ = ["TrainKeys", "sheet", "table_from"]
_KINDS = ("external", "internal", "bevel")
# what a satellite meshes, how, and both numbers of teeth
Side = tuple[str, str, tuple[int, int]]


def table_from(scene: SceneFile, source: str, table: dict[str, Any]) -> dict[str, Any]:
    """The train of a scene, of equal satellites the first, changed by the keys of the command line."""
    from parts.scene.load import in_keys_of_file, make_parts
    from parts.scene.placing import place
    from parts.scene.train import scene_mechanism

    with in_keys_of_file(scene.origins):
        parts, matings = make_parts(scene, source)
        placing = place(scene.instances, scene.drives, parts, matings, source)
        stand = {one.id: one for one in placing.instances}
        held = [key for key, spec in scene.instances.items() if spec.held is True]
        axes = {key: one.axis for key, one in stand.items()}
        known = _Scene(scene_mechanism(stand, matings, held), axes)
    if not known.meshes:
        raise SceneError(source, "mates", None, "no_gear_pair")
    modules = {key: getattr(scene.parts[spec.part or key], "module", None) for key, spec in scene.instances.items()}
    found = known.table(modules, {drive.instance: drive.turns for drive in scene.drives if drive.travel is None})
    called = {key: spec.title or parts[str(spec.part)].called(key) for key, spec in scene.instances.items()}
    found["names"] = {name: called[key] for name, key in found["names"].items()}
    teeth = table.pop("teeth", {})
    return found | table | {"teeth": {**found["teeth"], **teeth} if isinstance(teeth, dict) else teeth}


class _Scene:
    """Bodies and meshes of a mechanism, without the satellites that stand beside equal ones."""

    def __init__(self, mechanism: Mechanism, axes: Mapping[str, Vector]) -> None:
        from geometry.kinematics.mechanism import FRAME, Revolute, Rolling, tree

        stands = tree(mechanism)
        self.body, self.axes = stands.body, axes
        self.held = {key for key in stands.order if stands.still(key)}
        self.carriers = {
            key: stands.body(joint.on)
            for key, joint in stands.supports.items()
            if isinstance(joint, Revolute) and stands.body(joint.on) != FRAME
        }
        # a worm or a crossed pair that a carrier moves is no matter of the guidelines
        rolling = [j for j in mechanism.joints if isinstance(j, Rolling)]
        self.meshes = [j for j in rolling if j.kind in _KINDS or (j.kind in ("worm", "crossed") and j.on == FRAME)]
        # the first of equal satellites does for all, and for those that mesh only some of its wheels
        kept: list[tuple[str, set[Side]]] = []
        twins: set[str] = set()
        sides = {key: set(self._sides(key)) for key in self.carriers}
        for key in sorted(sides, key=lambda k: -len(sides[k])):
            if any(self.carriers[key] == carrier and sides[key] <= known for carrier, known in kept):
                twins.add(key)
            kept.append((self.carriers[key], sides[key]))
        self.meshes = [m for m in self.meshes if not {self.body(m.first), self.body(m.second)} & twins]
        # axes about which turns are told: those of carriers, then of wheels
        ends = [key for mesh in self.meshes for key in (mesh.first, mesh.second)]
        self.ways = [axes[key] for key in (*self.carriers.values(), *ends, *axes)]

    def _sides(self, body: str) -> Iterator[Side]:
        """What a satellite meshes, and how."""
        for mesh in self.meshes:
            one, two = self.body(mesh.first), self.body(mesh.second)
            if body in (one, two):
                yield (two if body == one else one), mesh.kind, mesh.teeth

    def _numbered(self, drives: Iterable[str]) -> dict[str, str]:
        """Wheels by number on the way from the driver; the second rim of a satellite has the first one's, primed."""
        ends = [key for mesh in self.meshes for key in (mesh.first, mesh.second)]
        free = [k for k in ends if self.body(k) not in self.carriers and k not in self.held]
        starts = [key for key in drives if self.body(key) in map(self.body, ends)]
        names: dict[str, str] = {}
        rims: dict[str, str] = {}
        waiting, seen = [self.body(key) for key in reversed([*starts, *free, *ends])], set()
        while waiting:
            body = waiting.pop()
            if body in seen:
                continue
            seen.add(body)
            for mesh in self.meshes:
                one, two = mesh.first, mesh.second
                if body in (self.body(one), self.body(two)):
                    wheels = (one, two) if self.body(one) == body else (two, one)
                    for wheel in wheels:
                        self._name(wheel, names, rims)
                    waiting.append(self.body(wheels[1]))
        return names

    def _name(self, wheel: str, names: dict[str, str], rims: dict[str, str]) -> None:
        body = self.body(wheel)
        if wheel in names:
            return
        if body in rims:
            rims[body] += "'"
            names[wheel] = rims[body]
            return
        names[wheel] = str(1 + len([name for name in names.values() if not name.endswith("'")]))
        if body in self.carriers:
            rims[body] = names[wheel]

    def table(self, modules: dict[str, float | None], drives: Mapping[str, float]) -> dict[str, Any]:
        """The keys of the topic; ``names``: which instance each name stands for."""
        names = self._numbered(drives)
        carriers = list(dict.fromkeys(c for b, c in self.carriers.items() if b in map(self.body, names)))
        titles = {c: "H" if len(carriers) == 1 else f"H{k}" for k, c in enumerate(carriers, 1)}
        shafts: dict[str, list[str]] = {}
        for key, name in names.items():
            shafts.setdefault(self.body(key), []).append(name)
        for carrier, title in titles.items():
            shafts.setdefault(carrier, []).append(title)
        satellites = {
            title: ", ".join(shafts[b][0] for b, c in self.carriers.items() if c == carrier and b in shafts)
            for carrier, title in titles.items()
        }
        inputs = {
            shafts[self.body(key)][0]: self._counted(key) * turns
            for key, turns in drives.items()
            if self.body(key) in shafts
        }
        toothed = {key: z for mesh in self.meshes for key, z in zip((mesh.first, mesh.second), mesh.teeth, strict=True)}
        return {
            "teeth": {name: toothed[key] for key, name in names.items()},
            "meshes": ", ".join(self._words(mesh, names, modules) for mesh in self.meshes),
            "shafts": ", ".join("-".join(own) for own in shafts.values() if len(own) > 1),
            "carriers": satellites,
            "held": ", ".join(own[0] for body, own in shafts.items() if body in self.held),
            # of several drives the speeds are as their turns
            **({"speeds": inputs} if len(inputs) > 1 else {"driver": next(iter(inputs), "")}),
            "names": {name: key for key, name in names.items()} | {title: c for c, title in titles.items()},
        }

    def _words(self, mesh: Rolling, names: dict[str, str], modules: dict[str, float | None]) -> str:
        words = f"{names[mesh.first]}-{names[mesh.second]} {mesh.kind}"
        if mesh.kind in ACROSS:
            # neither the module of an outer end nor that of an axial section gives the force
            return words + {1: " +", -1: " -", 0: ""}[self._sense(mesh)]
        module = modules.get(mesh.first)
        return words + (f" {module:g}" if module else "")

    def _sense(self, mesh: Rolling) -> int:
        """Which way the second of a bevel, worm or crossed pair turns; 0 where the guidelines tell no sign."""
        moves = any(self.body(key) in self.carriers for key in (mesh.first, mesh.second))
        if not moves and not self.is_differential:
            return 0
        return (1 if mesh.ratio > 0 else -1) * self._counted(mesh.first) * self._counted(mesh.second)

    def _counted(self, key: str) -> int:
        """-1 where the axis of an instance points against the first that is parallel: all turns are told about that."""
        from geometry.kinematics.mechanism import parallel

        return next(sense for way in self.ways if (sense := parallel(self.axes[key], way)))

    @property
    def is_differential(self) -> bool:
        """Whether a carrier has no central wheel that is held."""
        central: dict[str, set[str]] = {}
        for mesh in self.meshes:
            one, two = self.body(mesh.first), self.body(mesh.second)
            for satellite, other in ((one, two), (two, one)):
                if satellite in self.carriers:
                    central.setdefault(self.carriers[satellite], set()).add(other)
        return any(carrier not in self.held and not wheels & self.held for carrier, wheels in central.items())
