"""A scene whose name has a blank, typed without quotes, is one refusal that tells it; others are refused one by one."""

from pathlib import Path

import pytest

from exporters.command.cli import main
from tests.exporters.making import write_scene

GEAR = {"kind": "spur_gear", "module": 2.0, "number_of_teeth": 20, "face_width": 8.0}


@pytest.mark.parametrize("command", ["build", "check"])
def test_a_name_without_quotes_is_told_whole(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    scene = write_scene(tmp_path / "my gear.toml", {"g": GEAR}, [{"format": "dxf"}])

    def told(*words: str) -> list[str]:
        assert main([command, *words]) == 2
        return capsys.readouterr().err.splitlines()

    (line,) = told("my", "gear.toml")
    assert line.endswith('a name with blanks stands in quotes; did you mean "my gear.toml"?')
    (line,) = told("practicum", "pair")
    assert line.endswith("did you mean practicum_pair?")
    assert len(told("nothing", "here")) == 2
    # one of them is there
    scene.rename(tmp_path / "gear.toml")
    assert len(told("my", "gear.toml")) == 1
