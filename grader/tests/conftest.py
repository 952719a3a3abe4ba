"""What the tests share: the repository, its steps, and submissions made from the solutions."""

from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from read_documents import FOLDER, ReadDocuments

from raysteps.course.manifest import Step, kit_steps, read_steps
from raysteps.course.project import Project, here
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.course.stubs import stub_for, without_markers
from raysteps.toolchain.build_kit import build_kit
from raysteps.toolchain.kit_artifacts import BuiltKit

_LONG = ("slow", "xdist_group")  # the marks of what takes long

pytest_plugins = ["browser", "play_pages", "students_kit"]

Sources = dict[str, str]
MakeSubmission = Callable[[str, Sources], Path]


def pytest_configure(config: pytest.Config) -> None:
    """What is read is written down where `./raysteps test` wants to know it."""
    cache = getattr(config, "cache", None)
    if cache is not None and config.getini("cache_dir") != ".pytest_cache":
        config.pluginmanager.register(ReadDocuments(Path.cwd().parent, cache.mkdir(FOLDER)))


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """What takes longest begins first, so that no processor waits for it in the end: slow tests, then groups."""
    items.sort(key=lambda item: [item.get_closest_marker(mark) is None for mark in _LONG])


@pytest.fixture(scope="session", autouse=True)
def no_course(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """What an instructor has settled in the kit's course.toml is none of the tests' business."""
    empty = tmp_path_factory.mktemp("course") / "course.toml"
    empty.touch()
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(COURSE_VARIABLE, str(empty))
        yield


@pytest.fixture(scope="session")
def project() -> Project:
    return here()


@pytest.fixture(scope="session")
def whole_kit(project: Project) -> BuiltKit:
    """Built once for all tests, with the steps of all parts."""
    return build_kit(project, of_all_parts=True)


@pytest.fixture(scope="session")
def kit(whole_kit: BuiltKit, steps: list[Step]) -> BuiltKit:
    """Of part one."""
    return replace(whole_kit, steps=steps)


@pytest.fixture(scope="session")
def steps(project: Project) -> list[Step]:
    return read_steps(project)


@pytest.fixture(scope="session")
def solved(project: Project, steps: list[Step]) -> Sources:
    """Every step as a student would hand it in, by step id."""
    return {step.id: without_markers((project.solutions / step.path).read_text(encoding="utf-8")) for step in steps}


@pytest.fixture(scope="session")
def unsolved(project: Project, steps: list[Step]) -> Sources:
    return {step.id: stub_for(project, step) for step in steps}


@pytest.fixture
def fake_grader(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Processes that grade a class find `fake_grader`, which writes down what it does."""
    monkeypatch.setenv("PYTHONPATH", str(Path(__file__).parent / "helpers"))
    monkeypatch.setenv("FAKE_LOG", str(tmp_path / "log.txt"))


@pytest.fixture
def make_submission(tmp_path: Path, project: Project) -> MakeSubmission:
    """Writes sources to a folder of that name, as steps/NN-name/name.cpp."""

    def make(name: str, sources: Sources) -> Path:
        for step in kit_steps(project):
            if step.id in sources:
                path = tmp_path / name / "steps" / step.path
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(sources[step.id], encoding="utf-8")
        return tmp_path / name

    return make
