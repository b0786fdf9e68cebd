"""The frames of laser DXF files, written by ezdxf: ``python -m tests.oracles.dxf_frame`` makes them anew.

A frame is an empty drawing in mm with slots where our writer puts its numbers, layers and polylines; its first line
is the first free handle.
"""

from __future__ import annotations

import io
import re
from pathlib import Path

import ezdxf

# what ezdxf 1.4.5 writes; another release may set its header differently
MADE_BY = "1.4.5"
_BOX = (-987654.25, -876543.25, 987654.25, 876543.25)


def frame(version: str) -> str:
    """The frame of a DXF version, "R2000" or "R12"."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        drawing = ezdxf.new(version, setup=False, units=4)
        drawing.header["$LUNITS"] = 2
        if version != "R12":
            drawing.header["$MEASUREMENT"] = 1
            drawing.header["$PSVPSCALE"] = 1.0
        drawing.modelspace().reset_extents((*_BOX[:2], 0.0), (*_BOX[2:], 0.0))
        drawing.classes.add_required_classes(drawing.dxfversion)
        drawing.classes.classes = dict(sorted(drawing.classes.classes.items()))
        stream = io.StringIO()
        drawing.write(stream)
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before
    text = stream.getvalue()
    for number, slot in zip(_BOX, ("left", "low", "right", "high"), strict=True):
        text = text.replace(f"\n{number}\n", f"\n<<{slot}>>\n")
    seed = re.search(r"\$HANDSEED\n  5\n([0-9A-F]+)\n", text)
    assert seed is not None
    text = text[: seed.start(1)] + "<<seed>>" + text[seed.end(1) :]
    text = _filled(text, r"  0\nTABLE\n  2\nLAYER\n(?:(?!ENDTAB).|\n)*? 70\n()\d+()\n", "<<layer count>>")
    text = _filled(text, r"  0\nTABLE\n  2\nLAYER\n(?:(?!ENDTAB).|\n)*?()()  0\nENDTAB\n", "<<layers>>")
    text = _filled(text, r"  2\nENTITIES\n()()  0\nENDSEC\n", "<<entities>>")
    return f"{seed[1]}\n{text}"


def _filled(text: str, pattern: str, slot: str) -> str:
    """The text with ``slot`` in place of what lies between a pattern's two empty groups."""
    found = re.search(pattern, text)
    assert found is not None, slot
    return text[: found.start(1)] + slot + text[found.start(2) :]


if __name__ == "__main__":
    import exporters.formats.laser_dxf

    folder = Path(exporters.formats.laser_dxf.__file__).parent / "frames"
    for name in exporters.formats.laser_dxf.VERSIONS:
        (folder / f"{name}.dxf").write_text(frame(name), encoding="ascii", newline="\n")
