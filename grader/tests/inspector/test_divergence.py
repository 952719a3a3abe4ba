"""`inspect --against reference` marks the right place for known mistakes, and none for other right solutions."""

from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from inspect_programs import Workshop, open_workshop

from raysteps.cli.inspect import InspectOptions, inspect
from raysteps.common.process import run
from raysteps.course.manifest import Step, read_all_steps
from raysteps.course.mutants import read_alternatives, read_mutants, reference_source
from raysteps.course.project import Project
from raysteps.images.compare import Pixels, read_ppm
from raysteps.inspector.divergence import find_divergence

_SIZE = ("--size", "64x48")
# step, mistake, scene; then the line that is marked, and the function that it points to
_MISTAKES = [
    ("01", "y-counts-up", "three-spheres", ("eye", "ray"), "primary_ray"),
    ("02", "radius-not-squared", "three-spheres", ("eye", "hit"), "Sphere::intersect"),
    ("02", "last-hit", "three-spheres", ("eye", "hit"), "closest_hit"),
    ("03", "coloured-highlight", "three-spheres", ("eye", "terms1"), "specular"),
    ("04", "no-threshold", "three-spheres", ("eye", "light1"), "shadow_ray"),
    ("04", "blocked-from-behind-the-light", "acne-corner", ("eye", "light1"), "is_lit"),
    ("05", "one-bounce-only", "three-spheres", ("eye", "reflect", "color"), "trace"),
    ("06", "sphere-by-its-centre", "many-spheres", ("eye", "hit"), "Sphere::overlaps"),
    ("07", "byte-cut-off", "overexposed", ("bytes",), "to_byte"),
    ("08", "snell-upside-down", "glass", ("eye", "refract", "ray"), "refract"),
]
# of step 12, whose samples may take other points than the reference's
_LAMP_MISTAKES = [
    ("cosine-forgotten", "sample_disk"),
    ("disk-not-turned", "sample_disk"),
    ("area-not-halved", "sample_triangle"),
    ("triangle-shines-back", "sample_triangle"),
    ("far-side", "sample_sphere"),
    ("sphere-normal-inwards", "sample_sphere"),
    ("surface-cosine-forgotten", "sampled_light"),
]
_ALTERNATIVES = [
    ("02", 8, "three-spheres"),
    ("04", 8, "acne-corner"),
    ("05", 8, "facing-mirrors"),
    ("08", 8, "glass"),
    ("12", 12, "soft-shadows"),
    ("12", 13, "soft-shadows"),
    ("12", 15, "plates"),
]
_PIXELS = [(x, y) for x in (9, 23, 31, 44, 58) for y in (14, 24, 37)]


@pytest.fixture(scope="module")
def workshop(project: Project, tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    return open_workshop(project, tmp_path_factory.mktemp("inspect"))


def _scene(project: Project, name: str) -> str:
    (found,) = (project.scenes / "lessons").glob(f"{name}.*")
    return str(found)


def _picture(program: Path, scene: str, step: Step, target: Path) -> Pixels:
    words: list[str | Path] = [program, scene, *_SIZE, "--step", str(step.index), "-o", target, "--quiet"]
    outcome = run(words, seconds=60)
    assert outcome.code == 0, outcome.stderr
    return read_ppm(target)


def _worst_pixel(mine: Pixels, reference: Pixels) -> tuple[int, int]:
    apart = np.abs(mine.astype(int) - reference.astype(int)).sum(axis=2)
    y, x = np.unravel_index(apart.argmax(), apart.shape)
    assert apart[y, x] > 0
    return int(x), int(y)


@pytest.mark.slow
def test_the_place_of_a_mistake_is_marked(project: Project, steps: list[Step], workshop: Workshop) -> None:
    def marked(case: tuple[str, str, str, tuple[str, ...], str]) -> tuple[object, ...]:
        number, mistake, lesson, _, _ = case
        (step,) = (step for step in steps if step.number == number)
        (mutant,) = (mutant for mutant in read_mutants(project, step) if mutant.id == mistake)
        name, scene = f"{number}-{mistake}", _scene(project, lesson)
        built = workshop.compile(step, mutant.applied(reference_source(project, step)), name)
        pictures = [
            _picture(program, scene, step, workshop.folder / f"{name}-{at}.ppm")
            for at, program in enumerate((workshop.link("raytrace", step, built, name), workshop.reference("raytrace")))
        ]
        x, y = _worst_pixel(pictures[0], pictures[1])
        options = InspectOptions(scene, str(x), str(y), step.index, _SIZE)
        mine = inspect(workshop.link("inspect", step, built, name), options).record
        reference = inspect(workshop.reference("inspect"), options).record
        assert mine is not None
        assert reference is not None
        assert mine.bytes == pictures[0][y, x].tolist()
        divergence = find_divergence(mine, reference)
        assert divergence is not None, name
        return (number, mistake, lesson, divergence.place, divergence.function)

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(marked, _MISTAKES)) == _MISTAKES


@pytest.mark.slow
@pytest.mark.parametrize(("number", "at", "lesson"), _ALTERNATIVES)
def test_another_right_solution_is_no_difference(
    project: Project, workshop: Workshop, number: str, at: int, lesson: str
) -> None:
    """`at`: the step that is drawn."""
    (step,) = (step for step in read_all_steps(project) if step.number == number)
    for alternative in read_alternatives(project, step)[: None if number == "12" else 1]:
        name = f"right-{number}-{at}-{alternative.name}"
        program = workshop.link("inspect", step, workshop.compile(step, alternative.source, name), name)
        for x, y in _PIXELS:
            options = InspectOptions(_scene(project, lesson), str(x), str(y), at, _SIZE)
            mine, reference = inspect(program, options).record, inspect(workshop.reference("inspect"), options).record
            assert mine is not None
            assert reference is not None
            assert find_divergence(mine, reference) is None, (alternative.name, x, y)


@pytest.mark.slow
def test_mistakes_in_samples_of_lamps_are_told(project: Project, workshop: Workshop) -> None:
    (step,) = (step for step in read_all_steps(project) if step.number == "12")
    mutants = {mutant.id: mutant for mutant in read_mutants(project, step)}

    def blamed(case: tuple[str, str]) -> tuple[str, str | None]:
        mistake, _ = case
        built = workshop.compile(step, mutants[mistake].applied(reference_source(project, step)), f"12-{mistake}")
        program = workshop.link("inspect", step, built, f"12-{mistake}")
        for x, y in _PIXELS:
            options = InspectOptions(_scene(project, "soft-shadows"), str(x), str(y), step.index, _SIZE)
            mine, reference = inspect(program, options).record, inspect(workshop.reference("inspect"), options).record
            assert mine is not None
            assert reference is not None
            divergence = find_divergence(mine, reference)
            if divergence is not None:
                return mistake, divergence.function
        return mistake, None

    with ThreadPoolExecutor(2) as pool:
        assert list(pool.map(blamed, _LAMP_MISTAKES)) == _LAMP_MISTAKES
