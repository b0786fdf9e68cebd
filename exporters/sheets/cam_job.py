"""The sheets of a scene's cams: which parts, their calculation, and the picture of each."""

from __future__ import annotations

from exporters.calculations import cam as calculation
from exporters.sheets.cam import cam_sheet
from exporters.sheets.cam_picture import cam_picture
from exporters.sheets.verify import Expected
from geometry.cams.graphical import INTERVALS
from geometry.errors import ParameterError
from parts.cam import CamSpec, checked_cam
from parts.linkage_cam import LinkageCamSpec, checked_linkage_cam
from parts.scene import ExportSpec, SceneFile
from parts.schema import SceneError

# by these steps sections of the calculation are known that no sheet shows
_PAGE_ALONE = {"position_deg", "savvin_a"}
# the kinds of parts that the sheet draws
_DRAWN = " and ".join(str(kind.__struct_config__.tag) for kind in (CamSpec, LinkageCamSpec))


def cam_sheets(scene: SceneFile, export: ExportSpec, where: str, source: str) -> list[tuple[str, Expected]]:
    """One sheet of every cam that the export names, all cams by default, with the part's id.

    Raises
    ------
    SceneError
        The scene has no cam, a named part is none, or its tables fit no paper.
    """
    cams = [key for key, spec in scene.parts.items() if isinstance(spec, CamSpec | LinkageCamSpec)]
    for part in export.parts or []:
        if part not in cams:
            known = f"; cams: {', '.join(cams)}" if cams else ""
            raise SceneError(source, f"{where}.parts", part, f"draws {_DRAWN} only{known}")
    if not cams:
        raise SceneError(source, f"{where}.purpose", export.purpose, f"draws {_DRAWN} only; add one or remove it")
    intervals, found = export.intervals or INTERVALS, []
    for part in export.parts or cams:
        spec = scene.parts[part]
        more = {"part": part, "intervals": intervals, "speed_rpm": export.speed_rpm}
        table = calculation.table_from(scene, source, {k: v for k, v in more.items() if v is not None})
        linked = isinstance(spec, LinkageCamSpec)
        picture = cam_picture(
            checked_linkage_cam(spec) if linked else checked_cam(spec),
            intervals,
            None if linked else spec.least_transmission_angle_deg,
            spec.least_curvature_radius,
            scene.scene.language,
            export.speed_rpm,
        )
        page = calculation.sheet(table)
        # the position in numbers is for the page alone
        page.sections = [s for s in page.sections if not {x.name for x in s.steps} & _PAGE_ALONE]
        try:
            made = cam_sheet(part, picture, page, float(export.tolerance or 0.0))
        except ParameterError as error:
            raise SceneError(source, f"{where}.{error.name}", error.value, error.allowed) from error
        found.append((part, made))
    return found
