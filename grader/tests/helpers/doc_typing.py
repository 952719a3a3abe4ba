"""Types commands of the documents in a workshop, as a person would."""

import re
import shutil
import sys
from dataclasses import dataclass, field
from pathlib import Path

from doc_only_read import may_be_typed, why_not
from doc_terminal import Ending, Keys, typed_at
from doc_workshop import Workshop, copy_of
from typed_commands import Typed

from raysteps.cli.view import check_glfw
from raysteps.common.errors import UsageError
from raysteps.course.manifest import kit_steps
from raysteps.course.project import Project
from raysteps.toolchain.cmake import release_tree
from raysteps.toolchain.kit_artifacts import BuiltKit
from tools.figures.renders import hidden_screen

_AT = "https://github.com/course/checkout"
_CLASSROOM = {
    "CLASSROOM": "course",
    "ASSIGNMENT": "ray-tracer",
    "SUBMISSION_TAG": "submit/1",
    "COMMIT_URL": f"{_AT}/commit/1",
    "RELEASE_URL": f"{_AT}/releases/1",
}
_ENDINGS = {
    "grade": Ending(codes=(0, 1)),  # a part of a submission was not handed in
    "reset": Ending(Keys("[y/N]", "y\n", "is the stub again")),
    "watch": Ending(Keys("Passed", "q", "Stopped watching.")),
}
# What draws for half a minute, or for a whole one, draws small pictures here: who reads is to get beautiful ones.
_SMALL = {"finale": ("--size", "160x160", "--samples", "1"), "gallery": ("--size", "64x48")}
# What is done before makes no difference to these; but `release` refuses a folder that is there.
_SAME_ANSWER = {"demo", "inspect", "release", "render"}


def _matches(pattern: Path, here: Path) -> list[str]:
    if not any(sign in pattern.name for sign in "*?["):
        return []
    return sorted(str(pattern.parent / found.name) for found in (here / pattern.parent).glob(pattern.name))


def _can_view(project: Project) -> bool:
    try:
        check_glfw(release_tree(project))
    except UsageError:
        return False
    return shutil.which("Xvfb") is not None


@dataclass
class Typist:
    """Types commands, those that would only say the same again once."""

    workshop: Workshop
    built: BuiltKit
    said: dict[tuple[str, ...], str] = field(default_factory=dict)
    _course: dict[str, str] = field(default_factory=dict)

    def block(self, block: list[Typed]) -> dict[Typed, str]:
        """What the commands of a block printed, each in the folder where those before it lead. A handout of part two,
        and what takes its scenes, is read where a course has both parts."""
        here = self.workshop.kit.root
        later = block[0].document.parent.name in self._later_parts()
        scenes = any(word.endswith(".pbrt") for one in block for word in one.words)
        self._course = self._both_parts() if later or scenes else {}
        found = {}
        for one in block:
            if one.words[0] == "cd":
                here = (here / one.words[1]).resolve(strict=True)
            elif not why_not(one) and self._is_there(one.words[0]):
                assert may_be_typed(one), f"{one}: somebody else's program, which may do anything"
                try:
                    found[one] = self._answer(one, here)
                except AssertionError as wrong:
                    raise AssertionError(f"{one}: {wrong}") from wrong
        return found

    def _later_parts(self) -> set[str]:
        return {step.id for step in kit_steps(self.workshop.original) if step.is_in_part_two}

    def _both_parts(self) -> dict[str, str]:
        course = self.workshop.folder / "both-parts.toml"
        course.write_text("parts = [1, 2]\n", encoding="utf-8")
        return {"RAYSTEPS_COURSE": str(course)}

    def _is_there(self, program: str) -> bool:
        return "/" in program or program == "python" or shutil.which(program) is not None

    def _answer(self, one: Typed, here: Path) -> str:
        words = self._expanded(one.words, here)
        if words[:2] == ["python", "raysteps"]:
            words[:2] = ["./raysteps"]
        key = (str(here), *words)
        if key not in self.said or not _SAME_ANSWER.intersection(words[1:2]):
            self.said[key] = self._typed(words, here)
        return self.said[key]

    def _expanded(self, words: tuple[str, ...], here: Path) -> list[str]:
        """As a shell expands them, with a home and a /tmp of the workshop's own."""
        folder = str(self.workshop.folder)
        made: list[str] = []
        for word in words:
            own = re.sub("^~(?=/)|^(?=/tmp/)", lambda found: f"{folder}/home" if found[0] else folder, word)
            made += _matches(Path(own), here) or [own]
        return made

    def _typed(self, words: list[str], here: Path) -> str:
        if words[0] == "./raysteps":
            return self._raysteps(words[1:], here)
        if words[0] == "python":
            words = [sys.executable, *words[1:]]
        return self._run(words, here, here)

    def _raysteps(self, words: list[str], here: Path) -> str:
        name, package = words[0], here
        match name:
            case "dev":  # changes the kit, so that its programs would have to be built anew
                package = here = self._aside()
            case "update":
                package = here = self._students_kit(newer="--into" in words)
            case "inspect" | "view":
                package = self.workshop.original.root  # which has their programs
        if name in ("inspect", "render", "view") and "--impl" not in words:
            words = [*words, "--impl", "reference"]  # nobody knows what the steps are there, or has built the copy's
        if name in _SMALL and "--new" not in words:
            words = [*words, *_SMALL[name]]
        if words[:2] == ["grade", "grader/samples/complete"] and "--only" not in words:
            words = [*words, "--only", "1"]  # `demo` grades all of it
        start = [sys.executable, "-P", "-m", "raysteps"]
        if name == "view":
            if not _can_view(self.workshop.original):
                return ""
            words = words if "--screenshot" in words else [*words, "--screenshot", "view.ppm"]  # so that it ends
            with hidden_screen() as environment:
                on_screen = [f"{name}={environment[name]}" for name in ("DISPLAY", "LIBGL_ALWAYS_SOFTWARE")]
                return self._run(["env", *on_screen, *start, *words], here, package)
        ending = Ending() if words == ["watch"] else _ENDINGS.get(name)  # where all steps are done it says so and ends
        return self._run([*start, *words], here, package, ending)

    def _aside(self) -> Path:
        root = self.workshop.folder / "aside" / "kit"
        return root if root.is_dir() else copy_of(self.built, root).root

    def _students_kit(self, *, newer: bool) -> Path:
        """A release, and beside it a newer one, unpacked and as a zip."""
        folder = self.workshop.folder
        if not (folder / "course-2").is_dir():
            for name, steps in (("graphics-101", "1-4"), ("course-2", "1-5")):  # whatever was typed last
                words = ["release", "--out", f"../{name}", "--steps", steps, "--course", "Graphics 101"]
                self._raysteps(words, self.workshop.kit.root)
            shutil.copytree(folder / "graphics-101", folder / "my-repository")
            shutil.make_archive(str(folder / "course-2"), "zip", folder, "course-2")
        return folder / ("course-2" if newer else "graphics-101")

    def _run(self, words: list[str], here: Path, package: Path, ending: Ending | None = None) -> str:
        settings = {
            **_CLASSROOM,
            "CCACHE_BASEDIR": str(package),  # for the `cmake --build` that is typed: the copy shares it
            "CI": "1",  # so that no browser opens
            "COLUMNS": "120",
            "GITHUB_OUTPUT": str(self.workshop.folder / "output.txt"),
            "HOME": str(self.workshop.home),
            "PYTHONPATH": str(package / "grader" / "src"),
            **self._course,
        }
        start = ["env", "-u", "RAYSTEPS_COURSE", *(f"{name}={value}" for name, value in settings.items())]
        return typed_at([*start, *words], here, ending or Ending())
