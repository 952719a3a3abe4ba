"""The road from a command to a student's program is short, and few files make a grade: a newcomer can read them."""

import json
import subprocess
import sys
from pathlib import Path

from sandboxes import sandbox_named

from raysteps.course.project import Project
from raysteps.toolchain.kit_artifacts import BuiltKit

_MAX_FILES, _MAX_FRAMES, _MAX_FILES_OF_ROAD = 60, 10, 8
_SCRIPT = """
import json, subprocess, sys, threading
from raysteps.cli.app import main

source, out, submission = sys.argv[1:]
files, roads, known = set(), [], set()

def ours(frame):
    while frame is not None:
        if frame.f_code.co_filename.startswith(source):
            yield frame.f_code
        frame = frame.f_back

def profile(frame, event, argument):
    code = frame.f_code
    if event == "call" and code.co_flags & 1 and code.co_filename.startswith(source) and code not in known:
        if not any(one.co_name == "<module>" for one in ours(frame)):  # importing is no grading
            known.add(code)
            files.add(code.co_filename)

start = subprocess.Popen.__init__
def started(self, words, *rest, **options):
    if any(str(word).startswith(("/in/1/raytrace", "/in/1/worker", "/in/1/test")) for word in words):
        road = list(ours(sys._getframe(1)))
        road += ours(sys._current_frames()[threading.main_thread().ident])
        roads.append((len(road), len({code.co_filename for code in road}), str(words[-1])))
    start(self, words, *rest, **options)
subprocess.Popen.__init__ = started
threading.setprofile(profile)
sys.setprofile(profile)
code = main(["grade", submission, "--only", "02", "--out", out])
sys.setprofile(None)
print(json.dumps({"code": code, "files": sorted(name for name in files if name.endswith(".py")), "roads": roads}))
"""


def test_ten_frames_to_a_students_program_and_sixty_files_for_a_grade(
    kit: BuiltKit, project: Project, tmp_path: Path
) -> None:
    sandbox_named("bubblewrap")  # the way through another is not the same
    source = project.root / "grader" / "src" / "raysteps"
    words = [sys.executable, "-c", _SCRIPT, str(source), str(tmp_path), str(project.samples / "complete")]
    for _ in range(2):  # once, so that what the reference answers is kept
        done = subprocess.run(words, capture_output=True, text=True, check=True)
    told = json.loads(done.stdout.splitlines()[-1])
    assert told["code"] == 0, done.stdout
    assert len(told["roads"]) > 5
    assert [road for road in told["roads"] if road[0] > _MAX_FRAMES or road[1] > _MAX_FILES_OF_ROAD] == []
    assert len(told["files"]) <= _MAX_FILES, told["files"]
