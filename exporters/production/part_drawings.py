"""The working drawings of a scene's parts: which have one, what they are made of."""

from __future__ import annotations

from functools import partial
from importlib import import_module

from exporters.production.request import Request
from geometry.base.errors import ParameterError
from parts.base.reasons import reason
from parts.base.refusal import placed
from parts.base.registry import KINDS
from parts.base.schema import unit_of
from parts.base.texts import filled
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.part_sheet import Block, part_sheet
from parts.drawing.runouts import with_runouts
from parts.drawing.working import PartDrawing, Subject
from parts.keys.working import RUNOUTS, ZONES, WorkingTable, told_sizes
from parts.pages.data_table import draw_data_table, table_sizes
from parts.scene.data_tables import part_table


def part_drawings(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The drawings of the parts that the export names, of all that have one by default, with the part's id.

    Raises
    ------
    SceneError
        A named part's kind has no drawing, or no part has one.
    """
    parts, export = wanted.parts, wanted.export
    known = [key for key, part in parts.items() if part.made_by.drawing]
    for name in export.parts or []:
        if name not in known:
            raise wanted.refused("parts", name, "no_working_drawing", kind=parts[name].kind)
    if not known:
        kinds = [name for name, kind in KINDS.items() if kind.drawing]
        raise wanted.refused("purpose", export.purpose, "draws_only_what_is_not_here", kinds=kinds)
    found, runs, wishes = list[tuple[str, Expected]](), set[str](), export.drawing or WorkingTable()
    drawn = export.parts or known
    for name in drawn:
        part = parts[name]
        subject = Subject(part, wishes, asked.language)
        try:
            plain = import_module(str(part.made_by.drawing)).part_drawing(subject)
            table = part_table(part, wanted.scene, wanted.placing, parts)
        except ParameterError as error:
            raise placed(wanted.source, f"parts.{name}", error, unit_of(type(part.keys), error.name)) from error
        drawing, keys = with_runouts(plain, subject)
        runs |= keys
        _check_zones(drawing, wishes, wanted)
        blocks, language = list[Block](), asked.language
        for beside, wide, high in table_sizes(table, language) if table is not None else ():
            assert table is not None
            draw = partial(draw_data_table, table=table, language=language, beside=beside)
            blocks.append(Block((wide, high), draw))
        try:
            found.append((name, part_sheet(drawing, blocks, wishes.roughness, asked)))
        except ParameterError as error:
            if len(drawn) == 1:
                raise
            # of many, the one that has no room
            told = {"part": name, "why": filled(reason(error.code), **error.numbers)}
            raise ParameterError(error.name, error.value, "drawing_of_part", error.nearest, **told) from error
    for key in RUNOUTS:
        if wanted.is_whole and (size := getattr(wishes, key)) is not None and key not in runs:
            raise wanted.refused(f"drawing.{key}", size, "no_runout_here")
    return found


def _check_zones(drawing: PartDrawing, wishes: WorkingTable, wanted: Request) -> None:
    """Refuse a tolerance zone that is not told for the size at which it stands."""
    zones = {str(zone): key for key in ZONES if (zone := getattr(wishes, key))}
    for size in (size for view in drawing.views for size in view.sizes if size.after in zones):
        above, most = told_sizes(size.after)
        if not above < size.value <= most:
            where = f"drawing.{zones[size.after]}"
            raise wanted.refused(where, size.after, "zone_not_at_size", size=size.value, above=above, most=most)
