"""What students type most often starts at once: it imports nothing that only other commands need."""

import subprocess
import sys

import pytest

pytestmark = pytest.mark.portable

_SLOW = {"difflib", "jinja2", "jsonschema", "numpy", "PIL", "subprocess", "raysteps.results.model"}
_SCRIPT = """
import sys
from raysteps.cli.app import main
main(sys.argv[1:])
print(*sys.modules, file=sys.stderr)
"""


@pytest.mark.parametrize("words", [["list"], ["next"], ["hint", "01"]])
def test_what_only_reads_a_few_files_loads_few_modules(words: list[str]) -> None:
    done = subprocess.run([sys.executable, "-c", _SCRIPT, *words], capture_output=True, text=True, check=True)
    assert _SLOW & set(done.stderr.split()) == set()


@pytest.mark.parametrize("command", ["desk", "play"])
def test_other_pages_load_nothing_of_watch(command: str) -> None:
    script = f"import sys, raysteps.cli.{command}; print(*sys.modules)"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert "raysteps.common.local_server" in done.stdout.split()
    assert not [name for name in done.stdout.split() if name.startswith("raysteps.watch")]
