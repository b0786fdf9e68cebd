"""What the CAD kernel may say of a file, by solids of its own: a cylinder and what is little wrong with it."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from exporters.verification.kernel import judged_by_kernel
from exporters.verification.verdict import Verdict
from parts.scene.load import make_parts, scene_from_toml
from parts.solids.kernel import has_kernel

pytestmark = pytest.mark.skipif(not has_kernel(), reason="the CAD kernel is an extra")

PIN = b'[parts.pin]\nkind = "pin"\ndiameter = 10.0\nlength = 20.0\n'


def cylinder(height: float = 20.0) -> Any:
    from OCP.BRepPrimAPI import BRepPrimAPI_MakeCylinder

    return BRepPrimAPI_MakeCylinder(5.0, height).Solid()


def joined_within(apart: float) -> Any:
    from OCP.ShapeFix import ShapeFix_ShapeTolerance

    made = cylinder()
    ShapeFix_ShapeTolerance().SetTolerance(made, apart)
    return made


def with_a_vertex_off_its_edges() -> Any:
    from OCP.BRep import BRep_Builder
    from OCP.gp import gp_Pnt
    from OCP.TopAbs import TopAbs_VERTEX
    from OCP.TopExp import TopExp_Explorer
    from OCP.TopoDS import TopoDS

    made = cylinder()
    vertex = TopoDS.Vertex_s(TopExp_Explorer(made, TopAbs_VERTEX).Current())
    BRep_Builder().UpdateVertex(vertex, gp_Pnt(5.0, 1.0, 0.0), 1e-7)
    return made


@pytest.mark.parametrize(("made", "words", "volume", "apart"), [
    (lambda: [cylinder()], [], 0.0, 1e-7),
    (lambda: [cylinder(), cylinder()],
     ["the kernel finds 2 solids instead of 1", "the kernel finds 3141.592653"], 1.0, 1e-7),
    (list,
     ["the kernel finds 0 solids instead of 1", "the kernel finds 0 mm^3 instead of 1570.79632679 mm^3"], -1.0, 0.0),
    (lambda: [joined_within(0.999e-6)], [], 0.0, 0.999e-6),
    (lambda: [cylinder(), joined_within(1.001e-6)],
     ["the kernel finds 2 ", "the kernel joins what stands 1e-06 mm apart", "the kernel finds 31"], 1.0, 1.001e-6),
    (lambda: [joined_within(2.346e-5)], ["the kernel joins what stands 2.35e-05 mm apart"], 0.0, 2.346e-5),
    (lambda: [with_a_vertex_off_its_edges()], ["the kernel calls a solid invalid"], 0.0, 1e-7),
    # 1e-8 of the volume beside what the walls within their declared error change
    *((lambda w=w: [cylinder(20 * (1 + w * 4e-8))], [], w * 4e-8, 1e-7) for w in (-0.98, 0.98)),
    *((lambda w=w: [cylinder(20 * (1 + w * 4e-8))], ["the kernel finds 1570.796"], w * 4e-8, 1e-7)
      for w in (-1.02, 1.02)),
])  # fmt: skip
def test_each_thing_is_told_by_its_words(
    made: Callable[[], list[Any]],
    words: list[str],
    volume: float,
    apart: float,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    solids = made()
    monkeypatch.setattr("exporters.verification.kernel.solids_of", lambda text: solids)
    (tmp_path / "pin.step").write_text("", encoding="ascii")
    body = make_parts(scene_from_toml(PIN, "s.toml", "s"), "s")[0]["pin"].body(0.0)
    found = judged_by_kernel(tmp_path / "pin.step", [body], Verdict({"volume_bound": 3e-8}, ("told before",)))
    wanted = ["told before", *words]
    assert [told[: len(word)] for told, word in zip(found.failures, wanted, strict=True)] == wanted
    assert found.measured == {
        "volume_bound": 3e-8, "kernel_volume_error": pytest.approx(volume, rel=1e-9, abs=1e-10),
        "kernel_tolerance": pytest.approx(apart, rel=1e-9),
    }  # fmt: skip
