"""The pictures of ``converge``: nothing runs off the page."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from pathlib import Path

import pytest

from exporters.production.plot import write_loglog

# the mean width of a letter of DejaVu Sans, the widest of the common fonts, by its size
_LETTER = 0.61 * 12


@pytest.mark.parametrize("count", [1, 40])
def test_the_key_and_the_title_stand_within_the_page(tmp_path: Path, count: int) -> None:
    name = "wheel root_fillet degree 7 splines 8.00"
    file = tmp_path / "p.svg"
    write_loglog(file, "помилка залежно від кількості частин; порядок у ключі " * 2, ("x", "y"),
                 [(f"{name} {i}", [1.0, 10.0], [1.0, 0.1]) for i in range(count)])  # fmt: skip
    root = ET.parse(file).getroot()
    width, height = float(root.attrib["width"]), float(root.attrib["height"])
    texts = [e for e in root.iter() if e.tag.endswith("text")]
    assert sum((e.text or "").startswith(name) for e in texts) == count
    for text in texts:
        assert float(text.attrib["x"]) + _LETTER * len(text.text or "") <= width, text.text
        assert float(text.attrib["y"]) <= height, text.text
