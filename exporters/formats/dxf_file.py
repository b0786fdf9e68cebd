"""What all DXF files that ezdxf writes for us have in common: fixed dates and ids, one order, one line ending."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import ezdxf
from ezdxf.document import Drawing

_MILLIMETRES = 4


@contextmanager
def _fixed_metadata() -> Iterator[None]:
    """The same bytes at every run: ezdxf's dates and ids fixed while a file is written."""
    before = ezdxf.options.write_fixed_meta_data_for_testing
    ezdxf.options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        ezdxf.options.write_fixed_meta_data_for_testing = before


@_fixed_metadata()
def new_drawing() -> Drawing:
    """An empty drawing of release 2010 in mm, its numbers decimal; to be printed at its size."""
    drawing = ezdxf.new("R2010", setup=False, units=_MILLIMETRES)
    drawing.header["$LUNITS"] = 2
    drawing.header["$MEASUREMENT"] = 1
    # the scale at which LibreCAD prints: at 0 sheets stay empty
    drawing.header["$PSVPSCALE"] = 1.0
    return drawing


@_fixed_metadata()
def save(drawing: Drawing, file: Path) -> None:
    """Write a drawing with its own encoding."""
    # ezdxf takes the classes that a version needs out of a set, whose order differs from process to process
    drawing.classes.add_required_classes(drawing.dxfversion)
    drawing.classes.classes = dict(sorted(drawing.classes.classes.items()))
    # "\n" on every system, so that the bytes are the same there too
    with file.open("w", encoding=drawing.output_encoding, errors="dxfreplace", newline="\n") as stream:
        drawing.write(stream)
