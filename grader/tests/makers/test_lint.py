"""What reads the kit's code without running it."""

import json
from pathlib import Path

from tools.lint import _each_once


def test_clang_tidy_reads_what_only_the_page_compiles(tmp_path: Path) -> None:
    apps, web = tmp_path / "framework" / "apps", tmp_path / "framework" / "web"
    for path in (apps / "raytrace.cpp", web / "main.cpp", web / "exceptions.cpp"):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    known = {"directory": "/b", "file": f"{apps}/raytrace.cpp", "command": f"c++ -Ia -c {apps}/raytrace.cpp"}
    (tmp_path / "compile_commands.json").write_text(json.dumps([known, known]))
    found = json.loads((_each_once(tmp_path, tmp_path) / "compile_commands.json").read_text())
    assert [entry["file"] for entry in found] == [f"{apps}/raytrace.cpp", f"{web}/main.cpp"]
    assert found[0] == known
    assert found[1]["command"] == f"c++ -Ia -c {web}/main.cpp -Wno-unknown-attributes"
