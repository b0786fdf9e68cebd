"""A part: a kind, its keys and the exact thing made of them, ready for every exporter."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Any, cast

from geometry.base.findings import Finding
from geometry.base.record import Record, replace
from parts.base.kind import Kind
from parts.base.materials import density_of, thickness_told
from parts.base.part_keys import MaterialKeys
from parts.base.schema import value_at
from parts.base.texts import told_in, words

if TYPE_CHECKING:
    import cadquery
    import trimesh

    from geometry.plane.offset_region import OffsetRegion
    from geometry.plane.profile import Profile
    from geometry.solids.body import Body
    from geometry.solids.faced import FacedBody
    from parts.base.kind import Report, Stock
    from parts.base.readback import Probe


class Part(Record, dict=True):
    """A part with one flat section for plane formats and one solid, lower face of its rim at z = 0.

    ``keys``: as the scene has them, ``thing``: what the kind has made of them and the scene's mates have left of it,
    ``language``: that of the scene.
    Everything else is asked of the kind, once, when somebody wants it.
    """

    id: str
    made_by: Kind[Any, Any]
    keys: MaterialKeys
    thing: Any
    language: str

    @property
    def kind(self) -> str:
        """The name of its kind."""
        return self.made_by.name

    @cached_property
    def section(self) -> Callable[[float], OffsetRegion]:
        """The exact flat section, every boundary moved so many mm out of the material."""
        return lru_cache(maxsize=8)(self._section)

    def _section(self, offset: float) -> OffsetRegion:
        made = self.made_by.section(self.keys, self.thing, offset)
        radii = {key: value_at(self.keys, f"{key}.corner_radius") or 0.0 for key in ("spokes", "bore")}
        left = [Finding(f"corners_of_{key}", offset, radius) for key, radius in radii.items() if 0 < radius < offset]
        return replace(made, findings=(*made.findings, *left)) if left else made

    @cached_property
    def cut(self) -> Callable[..., OffsetRegion]:
        """The section as it is cut, named where the part asks for it, or a board whose cuts are ``gap`` mm apart."""
        return lru_cache(maxsize=8)(self._cut)

    def _cut(self, offset: float, gap: float | None = None) -> OffsetRegion:
        label = self.keys.label
        if not (gap is not None if label is None else label):
            return self.section(offset)
        from geometry.plane.letters import unknown_letters
        from parts.solids import naming

        # a title in a script without letters here is left out
        names = (label if isinstance(label, str) else self.name, self.numbers, self.id)
        text = next(name for name in names if name and not unknown_letters(name))
        made = naming.named(self.section(offset), self.section(min(offset, 0.0)), text, gap or 0.0)
        strange = unknown_letters(names[0])
        told = (Finding("title_not_engraved", len(strange), 0.0),) if strange else ()
        wrong = self.made_by.wrong_numbers(self.keys, label) if isinstance(label, str) else ()
        return replace(made, findings=(*made.findings, *told, *wrong))

    @property
    def title(self) -> str | None:
        """What people call it, in the language of the scene."""
        return None if self.keys.title is None else told_in(self.language, self.keys.title)

    @property
    def designation(self) -> str | None:
        """Of its drawing."""
        return self.keys.designation

    @property
    def product_name(self) -> str | None:
        """What CAD shows of it: its position and title; the kernel takes a name without any ASCII letter for none."""
        if self.title is None:
            return None
        told = " ".join(str(word) for word in (self.keys.position, self.title) if word)
        return told if any("!" <= letter <= "~" for letter in told) else f"{told} ({self.id})"

    @property
    def description(self) -> str:
        """What a parts list says of it beside its title: designation or standard, and its title in other languages."""
        titles = self.keys.title
        others = titles.values() if isinstance(titles, dict) else ()
        told = (self.keys.designation or self.keys.standard, *(other for other in others if other != self.title))
        return "; ".join(filter(None, told))

    def called(self, instance: str) -> str:
        """What people call an instance of it: its title, and its number or, in brackets, its whole id beside it."""
        if self.title is None or instance == self.id:
            return self.title or instance
        number = instance.removeprefix(f"{self.id}_")
        return f"{self.title} {number}" if number.isdigit() else f"{self.title} ({instance})"

    @property
    def name(self) -> str:
        """Its title and its numbers, or its id."""
        return " ".join(filter(None, (self.title, self.numbers))) or self.id

    @property
    def numbers(self) -> str:
        """What its kind tells it by, as the scene's language writes numbers."""
        return words(self.language).decimal(self.made_by.numbers(self.keys))

    @cached_property
    def body(self) -> Callable[[float], Body | FacedBody]:
        """The exact solid, every boundary moved so many mm out of the material."""
        return lru_cache(maxsize=2)(self._body)

    def _body(self, offset: float) -> Body | FacedBody:
        holes = self.made_by.cross_holes(self.keys, self.thing)
        if not holes:
            return self.blank(offset)
        from geometry.solids.crossed import crossed_at

        return crossed_at(cast("Callable[[float], Body]", self.blank), holes, offset)

    @cached_property
    def blank(self) -> Callable[[float], Body | FacedBody]:
        """The solid without holes across its hub, as checks and drawings take it."""
        return lru_cache(maxsize=2)(self._blank)

    def _blank(self, offset: float) -> Body | FacedBody:
        self.made_by.stays(offset)
        return self.made_by.solid(self.keys, self.thing, offset)

    @cached_property
    def pitch_curve(self) -> Profile | None:
        """The closed path of a round follower's centre, where the part has one."""
        return self.made_by.pitch_curve(self.keys, self.thing)

    @cached_property
    def face_width(self) -> float:
        """Height of the rim, mm."""
        return self.made_by.height(self.keys, self.thing)

    @cached_property
    def is_plate(self) -> bool:
        """Whether the solid is its section, extruded."""
        return self.made_by.is_plate(self.keys, self.thing)

    @cached_property
    def report(self) -> Report:
        """Remarks and named results."""
        return self.made_by.report(self.keys, self.thing)

    @property
    def findings(self) -> tuple[Finding, ...]:
        """Remarks."""
        label, found = self.keys.label, self.report.findings
        if isinstance(label, str):
            found = (*found, *self.made_by.wrong_numbers(self.keys, label))
        told = thickness_told(self.material or "")
        if told is not None and self.is_plate and f"{told:.6g}" != f"{self.face_width:.6g}":
            found = (*found, Finding("material_tells_thickness", told, self.face_width))
        if self.is_plate and value_at(self.keys, "hub") is not None:
            found = (*found, Finding("hub_stands_nowhere", 0.0, 0.0))
        return found

    @property
    def flat_findings(self) -> tuple[Finding, ...]:
        """Remarks on each flat outline."""
        return self.report.flat_findings

    @property
    def circles(self) -> dict[str, float]:
        """Named diameters, mm."""
        return self.report.circles

    @property
    def quantities(self) -> dict[str, float]:
        """All other named results."""
        return self.report.quantities

    @property
    def material(self) -> str | None:
        """What it is made of, as typed."""
        return self.keys.material

    @property
    def colour(self) -> str | None:
        """Its colour in pictures."""
        return self.keys.colour

    @property
    def stock(self) -> Stock | None:
        """The rod or tube that it is cut from to length."""
        return self.made_by.stock(self.keys)

    @property
    def is_bought(self) -> bool:
        """Whether a standard tells it, by which it is bought."""
        return self.keys.standard is not None

    @property
    def density(self) -> float | None:
        """g/cm^3; None where the material is not known."""
        return self.keys.density or density_of(self.material)

    @cached_property
    def mass(self) -> float | None:
        """kg; None where the density is not known."""
        if self.density is None:
            return None
        return float(self.made_by.moments(self.body(0.0)).volume) * self.density / 1e6

    @cached_property
    def probes(self) -> tuple[Probe, ...]:
        """What every file of it must also do, as its kind says and the shape of its bore."""
        own = self.made_by.probes(self.keys, self.thing)
        of_bore = getattr(getattr(self.keys, "bore", None), "probes", None)
        return own if of_bore is None else (*own, *of_bore(self.made_by.middle(self.keys, self.thing)))

    def to_trimesh(self, tolerance: float = 0.01, offset: float = 0.0) -> trimesh.Trimesh:
        """A ``trimesh.Trimesh`` within ``tolerance`` mm of the exact solid."""
        import trimesh

        from parts.solids.mesh import body_mesh, mesh_outlines

        body = self.body(offset)
        mesh = body_mesh(body, mesh_outlines(body, tolerance, 0.0))
        return trimesh.Trimesh(mesh.vertices, mesh.triangles, process=False)

    def to_cadquery(self, tolerance: float = 1e-6, offset: float = 0.0) -> cadquery.Workplane:
        """A ``cadquery.Workplane`` that holds the solid, splines within ``tolerance`` mm; needs cadquery."""
        try:
            import cadquery
        except ImportError as error:
            text = 'to_cadquery needs cadquery: pip install ".[cad]" in the folder of higherpair'
            raise ImportError(text) from error
        from parts.solids.faces import solid_curves, solid_faces
        from parts.solids.kernel import solids_of
        from parts.solids.step_text import StepForm, StepPart, decimals, step_text

        body = self.body(offset)
        part = StepPart(self.id, solid_faces(body, solid_curves(body, tolerance)))
        (solid,) = solids_of(step_text(part, StepForm(decimals(tolerance))))
        return cadquery.Workplane("XY").newObject([cadquery.Solid(solid)])
