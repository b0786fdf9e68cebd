"""The sheets of a scene's cams: which parts, their calculation, and the picture of each."""

from __future__ import annotations

from exporters.production.request import Request
from geometry.cams.plane.graphical import INTERVALS
from parts.base.refusal import meant
from parts.base.registry import KINDS
from parts.cams.coupler_cam.part import LinkageCamSpec
from parts.cams.disk_cam import page as calculation
from parts.cams.disk_cam.part import CamSpec
from parts.cams.sheets.picture import cam_picture
from parts.cams.sheets.sheet import cam_sheet
from parts.drawing.choice import Asked
from parts.drawing.expected import Expected
from parts.drawing.names import caption_name

# by these steps sections of the calculation are known that no sheet shows
_PAGE_ALONE = {"position_deg", "savvin_a", "largest_roller_radius"}
# the kinds of parts that the sheet draws
_DRAWN = [str(kind.__struct_config__.tag) for kind in (CamSpec, LinkageCamSpec)]


def cam_sheets(wanted: Request, asked: Asked) -> list[tuple[str, Expected]]:
    """The sheets of every cam that the export names, all cams by default, with the part's id.

    Raises
    ------
    SceneError
        The scene has no cam, or a named part is none.
    """
    scene, export = wanted.scene, wanted.export
    cams = [key for key, spec in scene.parts.items() if isinstance(spec, CamSpec | LinkageCamSpec)]
    for part in export.parts or []:
        if part not in cams:
            code, told = "draws_only" if cams else "draws_only_what_is_not_here", {"kinds": _DRAWN, "known": cams}
            raise wanted.refused("parts", part, code, meant(part, cams), "", **told)
    if not cams:
        raise wanted.refused("purpose", export.purpose, "draws_only_what_is_not_here", kinds=_DRAWN)
    intervals, found = export.intervals or INTERVALS, []
    for part in export.parts or cams:
        spec = scene.parts[part]
        more = {"part": part, "intervals": intervals, "speed_rpm": export.speed_rpm}
        table = calculation.table_from(scene, wanted.source, {k: v for k, v in more.items() if v is not None})
        linked = isinstance(spec, LinkageCamSpec)
        picture = cam_picture(
            KINDS[spec.__struct_config__.tag].thing(spec, scene.parts),
            intervals,
            None if linked else spec.least_transmission_angle_deg,
            spec.least_curvature_radius,
            wanted.language,
            export.speed_rpm,
            None if linked else spec.least_return_transmission_angle_deg,
        )
        page = calculation.sheet(table)
        # the position in numbers is for the page alone
        page.sections = [s for s in page.sections if not {x.name for x in s.steps} & _PAGE_ALONE]
        made = cam_sheet(caption_name(wanted.parts[part]), picture, page, asked)
        found += [(part if len(made) == 1 else f"{part}.{k}", one) for k, one in enumerate(made, 1)]
    return found
