"""Whether the tests of the window are skipped, or fail."""

from pathlib import Path

import pytest

from raysteps.common.errors import GraderFault
from tools.figures.renders import NoScreen, hidden_screen


def _open_files() -> list[Path]:
    return sorted(Path("/proc/self/fd").iterdir())


def _screen() -> None:
    with hidden_screen():
        raise AssertionError("there is a screen")


def test_without_xvfb_there_is_no_screen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(NoScreen, match="install xvfb"):
        _screen()


@pytest.mark.skipif(not Path("/proc/self/fd").is_dir(), reason="needs /proc")
@pytest.mark.parametrize("text", ["#!/bin/sh\nexit 1\n", "#!/no/such/program\n"])
def test_an_xvfb_that_does_not_start_is_a_fault(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    (tmp_path / "Xvfb").write_text(text)
    (tmp_path / "Xvfb").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path))
    before = _open_files()
    with pytest.raises(GraderFault, match="Xvfb does not start"):
        _screen()
    assert _open_files() == before
