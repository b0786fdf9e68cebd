"""Colours of STEP files stand in one order, whatever order the kernel's addresses had."""

from __future__ import annotations

import itertools

from exporters.formats.step import _styles_in_order

HEAD = b"DATA;\n" + b"".join(b"#%d = MANIFOLD_SOLID_BREP('%c',#9);\n" % (n, 96 + n) for n in (1, 2, 3))
TAIL = b"ENDSEC;\nEND-ISO-10303-21;\n"
SHADES = {1: b"0.1,0.2,0.3", 2: b"0.4,0.5,0.6", 3: b"0.1,0.2,0.3"}


def written(order: tuple[int, ...], *, shared: bool) -> bytes:
    """A file as the kernel writes it; ``shared``: a shade that was met before is not written again."""
    lines, number, known = [], 10, {}
    for solid in order:
        root, item = number, number + 1
        lines.append(
            b"#%d = MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(\n    #%d),#9);\n" % (root, item)
        )
        shade = known.get(SHADES[solid]) if shared else None
        lines.append(b"#%d = STYLED_ITEM('color',(#%d),#%d);\n" % (item, shade or number + 2, solid))
        number += 2
        if shade is None:
            lines.append(b"#%d = COLOUR_RGB('',%s);\n" % (number, SHADES[solid]))
            known[SHADES[solid]] = number
            number += 1
    return HEAD + b"".join(lines) + TAIL


def test_every_order_gives_the_same_file() -> None:
    for shared in (False, True):
        files = {_styles_in_order(written(order, shared=shared)) for order in itertools.permutations((1, 2, 3))}
        assert len(files) == 1
        (text,) = files
        assert text.startswith(HEAD)
        assert text.endswith(TAIL)
        items = [line for line in text.splitlines() if b"STYLED_ITEM" in line]
        assert [line.rsplit(b"#", 1)[1] for line in items] == [b"1);", b"2);", b"3);"]
        assert text.count(b"COLOUR_RGB") == (2 if shared else 3)


def test_a_file_without_colours_stays() -> None:
    assert _styles_in_order(HEAD + TAIL) == HEAD + TAIL


def test_the_colour_of_each_solid_stays_its_own() -> None:
    text = _styles_in_order(written((3, 2, 1), shared=False)).decode()
    statements = dict(line.split(" = ", 1) for line in text.splitlines() if line.startswith("#"))
    for body in statements.values():
        if body.startswith("STYLED_ITEM"):
            shade, solid = body.split("(#")[1].split(")")[0], int(body.rsplit("#", 1)[1].rstrip(");"))
            assert SHADES[solid].decode() in statements[f"#{shade}"]
