"""Builds the kit for grading, into a folder named by its fingerprint."""

import json
import os
import shutil
import tempfile
import time
from pathlib import Path

from raysteps.common.errors import GraderFault
from raysteps.kit.assembly import Assembly
from raysteps.kit.building import release_tree, what_failed
from raysteps.kit.built_kit import BuiltKit, Say
from raysteps.kit.description import read_description
from raysteps.kit.fingerprint import fingerprint
from raysteps.kit.manifest import Step, read_all_steps, read_steps
from raysteps.kit.project import Project

_KEPT = 3
_IN_USE_SECONDS = 1800  # a class touches its kit for each submission


def build_kit(project: Project, say: Say = lambda text: None) -> BuiltKit:
    """The kit of the repository as it is now; built when there is none yet."""
    steps = read_steps(project)
    for _ in range(3):
        mark = fingerprint(project)
        folder = project.build / "kit" / mark
        if not (folder / "kit.json").is_file():
            say(f"building the framework{', the references' if project.has_reference else ''} and the tests")
            _build(project, steps, folder)
        if fingerprint(project) == mark:
            os.utime(folder)
            _forget_old(folder.parent)
            return _load(project, steps, folder)
    raise GraderFault("the kit's sources keep changing while it is built")


def _load(project: Project, steps: list[Step], folder: Path) -> BuiltKit:
    description = read_description(folder / "kit.json")
    table = json.loads((folder / "facts.json").read_text(encoding="utf-8"))
    tests = {step: {name: frozenset(tags) for name, tags in cases.items()} for step, cases in table["tests"].items()}
    mark = f"{folder.name} {description.compiler_version}"
    return BuiltKit(project, folder, mark, steps, description, tests, table["interpreter"])


def _forget_old(kits: Path) -> None:
    """Keeps the kits that were used last, and those that may be in use."""
    built = sorted((kit for kit in kits.iterdir() if (kit / "kit.json").is_file()), key=lambda kit: kit.stat().st_mtime)
    for kit in built[:-_KEPT]:
        if time.time() - kit.stat().st_mtime > _IN_USE_SECONDS:
            shutil.rmtree(kit, ignore_errors=True)


def _build(project: Project, steps: list[Step], folder: Path) -> None:
    folder.parent.mkdir(parents=True, exist_ok=True)
    tree = release_tree(project)
    with tree.locked(), tempfile.TemporaryDirectory(prefix=".new-", dir=folder.parent) as name:
        if (folder / "kit.json").is_file():
            return  # somebody else was faster
        outcome = tree.build(["kit"])
        if outcome.code != 0:
            raise GraderFault("the kit's own programs do not build:\n" + what_failed(outcome))
        for left in folder.parent.glob(".new-*"):  # by builds that were killed: this one has the lock
            if left != Path(name):
                shutil.rmtree(left, ignore_errors=True)
        new = Path(name) / "kit"
        new.mkdir()
        Assembly(project, read_all_steps(project), steps, new, read_description(tree.folder / "kit.json")).run()
        shutil.copyfile(tree.folder / "kit.json", new / "kit.json")
        shutil.rmtree(folder, ignore_errors=True)
        new.rename(folder)
