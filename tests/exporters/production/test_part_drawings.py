"""Working drawings of parts: dimensions off the files, what depends on what, words clear of lines, refusals by key."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import ezdxf
import pytest

from exporters.production.plan import plan_build
from parts.base.refusal import SceneError
from parts.scene.load import scene_from_dict
from tests.exporters.production.test_sheet_words import faults

GEAR: dict[str, Any] = {
    "kind": "spur_gear", "module": 2.0, "number_of_teeth": 40, "face_width": 20.0, "material": "steel",
    "face_chamfer": 1.0, "bore": {"shape": "keyway", "diameter": 20.0},
    "web": {"thickness": 8.0, "rim_diameter": 64.0}, "hub": {"diameter": 34.0, "above": 5.0},
    "holes": {"count": 4, "diameter": 9.0, "pitch_circle_diameter": 49.0},
}  # fmt: skip


def jobs(part: dict[str, Any], language: str = "en", **export: Any) -> list[Any]:
    raw = {
        "scene": {"language": language},
        "parts": {"p": part},
        "exports": [{"format": f, "purpose": "part", **export} for f in ("dxf", "svg")],
    }
    return list(plan_build(scene_from_dict(raw, "t", "t"), "t", [], []).sheets)


def sizes(file: Path) -> dict[str, float]:
    """Every dimension of a DXF by its words and number of its kind, measured by ezdxf at the scale of its style."""
    document = ezdxf.readfile(file)
    found: dict[str, float] = {}
    for entity in document.modelspace().query("DIMENSION"):
        value = float(entity.get_measurement()) * document.dimstyles.get(entity.dxf.dimstyle).dxf.dimlfac
        assert value == pytest.approx(entity.dxf.actual_measurement, abs=1e-6)
        found[f"{entity.dxf.text} {sum(key.startswith(entity.dxf.text + ' ') for key in found)}"] = value
    return found


def written(tmp_path: Path, part: dict[str, Any], language: str = "en", **export: Any) -> tuple[Path, Path]:
    files = []
    for job in jobs(part, language, **export):
        file = tmp_path / job.path
        job.write({}, file)
        assert job.verify(file, 0.0).failures == ()
        files.append(file)
    return files[0], files[1]


@pytest.mark.parametrize("language", ["en", "uk"])
def test_every_dimension_measures_the_model_and_no_word_stands_over_a_line(tmp_path: Path, language: str) -> None:
    dxf, svg = written(tmp_path, GEAR, language)
    assert faults(svg) == []
    # d_a = m (z + 2); DIN 6885: 6 x 2.8 for 20 mm
    wanted = [84.0, 20.0, 25.0, 64.0, 49.0, 34.0, 8.0, 6.0, 1.0, 20.0, 22.8, 6.0, 0.25, 9.0]
    assert sorted(sizes(dxf).values()) == pytest.approx(sorted(wanted), abs=1e-6)
    audit = ezdxf.readfile(dxf).audit()
    assert not audit.errors
    assert not audit.fixes


def test_a_kind_without_a_drawing_is_refused_by_key() -> None:
    belt = {"kind": "yoke_frame", "of": "q"}
    with pytest.raises(SceneError) as caught:
        jobs(belt, parts=["p"])
    assert caught.value.key
