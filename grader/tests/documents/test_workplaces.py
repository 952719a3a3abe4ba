"""What editors, containers and GitHub are told: every name in it is of something that exists."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from raysteps.cli.app import new_parser
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project

ROOT = Path(__file__).parents[3]
WORKFLOWS = (ROOT / ".github" / "workflows" / "kit.yml", ROOT / "course" / "github-workflow.yml")


def read(place: str) -> Any:
    return json.loads((ROOT / place).read_text(encoding="utf-8"))


def presets(kind: str) -> dict[str, dict[str, Any]]:
    return {preset["name"]: preset for preset in read("CMakePresets.json")[kind]}


def raysteps_commands() -> set[str]:
    actions = new_parser(Project(ROOT))._subparsers
    assert actions is not None
    return set(actions._group_actions[0].choices or ())


def targets() -> set[str]:
    numbers = [step.number for step in read_steps(Project(ROOT))]
    steps = {f"test-{kind}-{number}" for kind in ("isolated", "reference") for number in numbers}
    text = "".join(path.read_text(encoding="utf-8") for path in ROOT.glob("framework/**/*.cmake"))
    named = set(re.findall(r"raysteps_add_(?:raytrace|test)\(([a-z-]+)", text))
    return steps | named


def command_lines(task: dict[str, Any]) -> list[list[str]]:
    """On Linux and macOS, and on Windows where that differs."""
    return [[one["command"], *one["args"]] for one in (task, task.get("windows", task))]


TASKS = {task["label"]: task for task in read(".vscode/tasks.json")["tasks"]}
LAUNCHES = read(".vscode/launch.json")["configurations"]


@pytest.mark.parametrize("label", TASKS)
def test_a_task_runs_a_command_that_exists(label: str) -> None:
    task = TASKS[label]
    assert set(task.get("dependsOn", "").split("\n")) <= {"", *TASKS}
    for words in command_lines(task):
        if words[0] == "cmake":
            assert words[words.index("--preset") + 1] in presets("buildPresets")
            if "--target" in words:
                assert words[words.index("--target") + 1].replace("${input:step}", "01") in targets()
        else:
            start = 2 if words[0] == "python" else 1
            assert words[:start] in (["./raysteps"], ["python", "raysteps"])
            assert words[start] in raysteps_commands()


@pytest.mark.parametrize("launch", LAUNCHES, ids=[launch["name"] for launch in LAUNCHES])
def test_a_program_to_debug_is_built_before_with_a_preset(launch: dict[str, Any]) -> None:
    task = TASKS[launch["preLaunchTask"]]
    target = task["args"][task["args"].index("--target") + 1]
    folder = presets("configurePresets")["debug"]["binaryDir"].replace("${sourceDir}", "${workspaceFolder}")
    for program in (launch["program"], launch.get("windows", launch)["program"]):
        assert program.removesuffix(".exe") == f"{folder}/bin/{target}"
    for word in launch["args"]:
        assert not word.startswith("scenes/") or (ROOT / word).is_file()


@pytest.mark.parametrize("file", ["tasks", "launch"])
def test_steps_to_choose_from_are_all(file: str) -> None:
    inputs = {given["id"]: given for given in read(f".vscode/{file}.json")["inputs"]}
    assert inputs["step"]["options"] == [step.number for step in read_steps(Project(ROOT))]
    text = (ROOT / ".vscode" / f"{file}.json").read_text(encoding="utf-8")
    assert set(re.findall(r"\$\{input:(\w+)\}", text)) <= set(inputs)


def test_each_preset_can_be_built_and_lies_apart() -> None:
    configured = presets("configurePresets")
    assert set(presets("buildPresets")) == set(configured)
    assert {"release", "dev", "asan", "gcc", "clang", "msvc", "mingw"} <= set(configured)
    for name, preset in configured.items():
        assert preset["binaryDir"] == f"${{sourceDir}}/build/{name}"
        assert preset.get("inherits", name) in configured
        toolchain = preset.get("toolchainFile", "${sourceDir}/CMakeLists.txt")
        assert (ROOT / toolchain.replace("${sourceDir}/", "")).is_file()


@pytest.mark.parametrize("path", WORKFLOWS, ids=lambda path: path.name)
def test_a_workflow_pins_its_actions_and_names_what_exists(path: Path) -> None:
    workflow = yaml.safe_load(path.read_text(encoding="utf-8"))
    assert workflow["permissions"] == {"contents": "read"}
    for job in workflow["jobs"].values():
        assert not job["runs-on"].endswith("-latest")
        assert job["timeout-minutes"] <= 60
        for step in job["steps"]:
            assert "run" in step or re.fullmatch(r"[\w-]+/[\w-]+@v\d+(\.\d+)*", step["uses"])
            words = step.get("run", "").split()
            for preset in [words[at + 1] for at, word in enumerate(words) if word == "--preset"]:
                assert preset in presets("buildPresets")
            for program in re.findall(r"build/(\w+)/bin/([a-z-]+)(?:\.exe)?(?=\s|$)", step.get("run", "")):
                assert program[0] in presets("buildPresets")
                assert program[1] in targets()
            if "raysteps" in step.get("run", ""):
                assert words[1 + words.index(next(word for word in words if "raysteps" in word))] in raysteps_commands()


def test_the_container_has_what_the_kit_asks_for() -> None:
    container = read(".devcontainer/devcontainer.json")
    assert not container["image"].endswith(":latest")
    assert ":" in container["image"]
    installed = container["onCreateCommand"].split()
    needed = {
        "g++",
        "cmake",
        "ninja-build",
        "python3",
        "python3-venv",
        "libglm-dev",
        "libstb-dev",
        "catch2",
        "libhwy-dev",
        "bubblewrap",
    }
    assert needed <= set(installed)
    recommended = read(".vscode/extensions.json")["recommendations"]
    assert set(container["customizations"]["vscode"]["extensions"]) <= set(recommended)
