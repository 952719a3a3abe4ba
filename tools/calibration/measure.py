"""Measures every correct solution and every known mistake on every picture, and finds each picture's limit."""

import hashlib
import math
import platform
import shutil
import tempfile
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from decimal import Decimal
from pathlib import Path
from threading import Lock
from typing import Literal

from raysteps.common.errors import GraderFault
from raysteps.common.files import write_bytes
from raysteps.common.process import run
from raysteps.common.text import printable
from raysteps.course.manifest import Step
from raysteps.course.project import Project
from raysteps.images.compare import compare
from raysteps.images.render import reference_picture, render
from raysteps.judge.hidden_scenes import hidden_scenes
from raysteps.judge.plan import read_plan
from raysteps.sandbox.limits_only import LimitsOnly
from raysteps.toolchain.compile import Compiled, Program, StudentBuild
from raysteps.toolchain.kit_artifacts import BuiltKit, ProgressCallback
from raysteps.toolchain.limits import StepLimits, limits_of
from tools.test_submissions import Entrant, mutants, right_ones

# Where the limit of a picture belongs: midway between the worst correct solution and the mildest mistake.

LEAST_MARGIN = 2.0
_LEAST_WRONG = 2.0  # pixels: so many may differ in a correct solution of which nobody has thought
_HANDFUL = 10.0  # pixels: a mistake that changes no more of a picture is not what the picture shows
_NOISE = 1.5  # factor by which other processors and compilers may move a limit


@dataclass(frozen=True)
class Share:
    """A share of wrong pixels, and whose it is."""

    value: float
    whose: str


@dataclass(frozen=True)
class LimitMargin:
    """What one picture can tell apart. `unseen` are mistakes that it hardly shows."""

    worst: Share
    mildest: Share | None
    unseen: tuple[str, ...]
    limit: float
    written: float

    @property
    def margin(self) -> float:
        """How many times worse the mildest mistake is than the worst correct solution."""
        return math.inf if self.mildest is None else self.mildest.value / self.worst.value

    @property
    def is_clear(self) -> bool:
        return self.margin >= LEAST_MARGIN

    @property
    def is_written(self) -> bool:
        """Whether the manifest says so, but for what differs from machine to machine."""
        apart = self.worst.value < self.written and (self.mildest is None or self.written < self.mildest.value)
        return apart and self.limit / _NOISE <= self.written <= self.limit * _NOISE

    @property
    def stands(self) -> float:
        """The limit that is in the manifest once it is written: one that is near enough stays."""
        return self.written if self.is_written else self.limit


def rounded(value: float) -> float:
    """To two digits that count."""
    return float(f"{value:.1e}")


def plain(value: float) -> str:
    """Without an exponent, as a manifest has it."""
    return f"{Decimal(repr(value)):f}"


def gate_between(
    correct: Mapping[str, float], mistakes: Mapping[str, Sequence[float]], pixels: int, written: float
) -> LimitMargin:
    """`correct`: the worst share of each; `mistakes`: one share for each seed, of which the least counts."""
    whose = max(correct, key=lambda name: correct[name])
    worst = Share(max(correct[whose], _LEAST_WRONG / pixels), whose if correct[whose] else "")
    least = {name: min(shares) for name, shares in mistakes.items()}
    seen = {name: share for name, share in least.items() if share > max(worst.value, _HANDFUL / pixels)}
    unseen = tuple(name for name in least if name not in seen)
    if not seen:
        return LimitMargin(worst, None, unseen, written if written > worst.value else rounded(4 * worst.value), written)
    mildest = min(seen, key=lambda name: seen[name])
    limit = rounded(math.sqrt(worst.value * seen[mildest]))
    return LimitMargin(worst, Share(seen[mildest], mildest), unseen, limit, written)


# The pictures of a step, visible and hidden, each with the limit that it is judged by.

PictureTable = Literal["images", "twins", "random_scenes"]


@dataclass(frozen=True)
class View:
    """One picture to make."""

    scene: Path
    args: tuple[str, ...]


@dataclass(frozen=True)
class LimitedPicture:
    """One max_wrong of a manifest, and the pictures that it judges: of a hidden scene, one for each seed."""

    step: str
    table: PictureTable
    name: str  # as the table has it: a twin is called like its picture
    max_wrong: float
    views: tuple[View, ...]

    @property
    def title(self) -> str:
        return f"{self.name}-twin" if self.table == "twins" else self.name

    def path(self, project: Project) -> Path:
        """Where the limit stands."""
        if self.table == "images":
            return project.steps / self.step / "step.toml"
        return project.solutions / self.step / "cases.toml"


def limited_pictures(project: Project, step: Step, seeds: range, folder: Path) -> list[LimitedPicture]:
    """The visible pictures, the twins and the made-up scenes, whose files are written into the folder."""
    limits = [
        LimitedPicture(step.id, "images", image.name, image.max_wrong, (View(project.root / image.scene, image.args),))
        for image in step.images
    ]
    plan = read_plan(project, step)
    if plan is None:
        return limits
    seeded = []
    for seed in seeds:
        scenes = []
        for scene in hidden_scenes(project, step, plan, seed):
            path = folder / f"{step.number}-{scene.name}-{seed}.nff"
            write_bytes(path, scene.nff.encode())
            scenes.append(View(path, scene.args))
        seeded.append(scenes)
    views = list(zip(*seeded, strict=True))
    for twin, of_twin in zip(plan.twins, views, strict=False):
        limits.append(LimitedPicture(step.id, "twins", twin.twin_of, twin.max_wrong, of_twin))
    for made_up, of_scene in zip(plan.random_scenes, views[len(plan.twins) :], strict=True):
        limits.append(LimitedPicture(step.id, "random_scenes", made_up.name, made_up.max_wrong, of_scene))
    noisy = {image.name for image in step.images if image.is_noisy}  # their limits are not of pixels
    return [limit for limit in limits if limit.name not in noisy]


# Compilers and settings under which every correct solution must give the same picture.

KIT = "the kit's own setting"
_COMPILERS = ("g++", "clang++")
_LEVELS = (("-O0",), ("-O2",), ("-O3", "-march=native"))
_CHOSEN_HERE = ("-O", "-march", "-mfma", "-ffp-contract", "-W")
_EVERY_COMPILER = ("-D", "-std=", "-fPIC", "-fno-lto", "-isysroot", "-arch")
_ONLY_GCC = ("-fno-gnu-unique",)  # its absence would give a step's helpers names that are shared by all libraries


@dataclass(frozen=True)
class Setting:
    """How the one file is compiled that is tried out; all else stays as the kit has it."""

    name: str
    compiler: str
    flags: tuple[str, ...]

    def applied(self, kit: BuiltKit) -> BuiltKit:
        """The kit, with another compiler for a student's file."""
        description = replace(kit.description, compiler=self.compiler, compile_flags=list(self.flags))
        return replace(kit, description=description)


def own_setting(kit: BuiltKit) -> Setting:
    """As students are graded."""
    return Setting(KIT, kit.description.compiler, tuple(kit.description.compile_flags))


def _is_clang(compiler: str) -> bool:
    said = run([compiler, "--version"], seconds=20)
    return "clang" in said.stdout.lower()


def _basic_flags(kit: BuiltKit, *, clang: bool) -> list[str]:
    """The kit's flags without those that vary, and without those that only another compiler knows."""
    given = kit.description.compile_flags
    if clang == ("clang" in kit.description.compiler_version.lower()):
        return [*(flag for flag in given if not flag.startswith(_CHOSEN_HERE)), "-w"]
    kept = [flag for flag in given if flag.startswith(_EVERY_COMPILER)]
    return [*kept, *(() if clang else _ONLY_GCC), "-w"]


def fused_flags(machine: str, cpu: str) -> tuple[str, ...] | None:
    """Those that let a compiler fuse a product and a sum; none where the processor cannot."""
    if machine.lower() in ("x86_64", "amd64"):
        return ("-mfma", "-ffp-contract=fast") if "fma" in cpu.split() else None
    return ("-ffp-contract=fast",) if machine.lower() in ("aarch64", "arm64") else None


def _cpu() -> str:
    try:
        return Path("/proc/cpuinfo").read_text(encoding="utf-8")
    except OSError:
        return ""


def all_settings(kit: BuiltKit, compilers: Sequence[str] = _COMPILERS) -> tuple[list[Setting], list[str]]:
    """Every compiler at every level, with and without FMA; and what was left out, and why."""
    fused = fused_flags(platform.machine(), _cpu())
    left_out = [] if fused else ["this processor has no FMA, or does not say so: settings with it were left out"]
    found = []
    for name in compilers:
        path = shutil.which(name)
        if path is None:
            left_out.append(f"{name} is not installed: its settings were left out")
            continue
        basic = _basic_flags(kit, clang=_is_clang(path))
        for level in _LEVELS:
            words = " ".join((name, *level))
            found.append(Setting(words, path, (*basic, *level, "-ffp-contract=off")))
            if fused:
                found.append(Setting(f"{words}, FMA", path, (*basic, *level, *fused)))
    return found, left_out


# Shares of wrong pixels: a source compiled in some setting, rendered, and compared with the reference.

_NO_PICTURE = 1.0


class PictureShares:
    """Renders the same binary once only: many settings give the same one. Used from several threads."""

    def __init__(self, kit: BuiltKit, step: Step, views: Sequence[View]) -> None:
        self._kit = kit
        self._step = step
        self._views = views
        self._known: dict[str, tuple[float, ...]] = {}
        self._lock = Lock()
        self._reference = [reference_picture(kit, view.scene, view.args) for view in views]

    @property
    def pixels(self) -> list[int]:
        """How many each picture has."""
        return [picture.shape[0] * picture.shape[1] for picture in self._reference]

    @property
    def binaries(self) -> int:
        """How many different ones were rendered."""
        return len(self._known)

    def shares(self, candidate: Entrant, setting: Setting) -> tuple[float, ...]:
        """One for each view; a program that makes no picture has every pixel wrong."""
        limits = limits_of(self._step, {})
        with tempfile.TemporaryDirectory(prefix="raysteps-") as name:
            build = StudentBuild(setting.applied(self._kit).in_one_process(), LimitsOnly(), Path(name))
            compiled = build.compile(self._step, candidate.source.encode(), limits)
            if compiled.binary is None:
                raise GraderFault(f"{self._step.id}: {candidate.name}, {setting.name}: {_said(compiled)}")
            key = hashlib.sha256(compiled.binary.read_bytes()).hexdigest()
            with self._lock:
                known = self._known.get(key)
            if known is None:
                known = self._render(build, compiled.binary, limits)
                with self._lock:
                    self._known[key] = known
        return known

    def _render(self, build: StudentBuild, binary: Path, limits: StepLimits) -> tuple[float, ...]:
        program, ran = build.program("raytrace", self._step, {self._step.number: binary}, limits)
        if program is None:
            raise GraderFault(f"{self._step.id} does not link: {printable(ran.outcome.stderr) if ran else ''}")
        shares: list[float] = []
        hung = False  # such a program is not asked for more
        for place in range(len(self._views)):
            share, hung = (_NO_PICTURE, True) if hung else self._share(program, place, limits)
            shares.append(share)
        return tuple(shares)

    def _share(self, program: Program, place: int, limits: StepLimits) -> tuple[float, bool]:
        view = self._views[place]
        rendered = render(LimitsOnly(), program, view.scene, view.args, limits.of_program())
        if rendered.pixels is None:
            return _NO_PICTURE, rendered.ran.hung
        return compare(rendered.pixels, self._reference[place], 0.0).wrong_share, False


def _said(compiled: Compiled) -> str:
    names = compiled.forbidden + compiled.missing + compiled.undefined + compiled.hidden
    if names:
        return f"names that do not fit: {', '.join(names)}"
    return "does not compile:\n" + printable(compiled.ran.outcome.stderr)[:2000]


def patient(step: Step) -> Step:
    """Without optimisation, and beside other work, a picture takes longer."""
    return replace(step, seconds=6 * step.seconds)


SEEDS = range(1, 4)
_EVERY = 25  # measurements between two lines of progress


@dataclass(frozen=True)
class CalibratedPicture:
    """One limit with what it is made from."""

    limited: LimitedPicture
    gate: LimitMargin


@dataclass(frozen=True)
class MeasuredShares:
    """One candidate in one setting, with a share for each picture."""

    candidate: Entrant
    setting: Setting
    shares: tuple[float, ...]


def counted(say: ProgressCallback, what: str, total: int) -> Callable[[], None]:
    """To be called after each of them; says how far it is now and then."""
    done = iter(range(1, total + 1))

    def one_more() -> None:
        number = next(done)
        if number % _EVERY == 0 or number == total:
            say(f"{what}: {number} of {total}")

    return one_more


def _measure(
    measuring: PictureShares, work: Sequence[tuple[Entrant, Setting]], jobs: int, say: ProgressCallback
) -> list[MeasuredShares]:
    one_more = counted(say, "measured", len(work))

    def one(item: tuple[Entrant, Setting]) -> MeasuredShares:
        measured = MeasuredShares(*item, measuring.shares(*item))
        one_more()
        return measured

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(one, work))


def _worst(measured: Sequence[MeasuredShares], views: slice) -> dict[str, float]:
    """Of each correct solution in each setting."""
    return {
        f"{one.candidate.name}, {one.setting.name}": max(one.shares[views])
        for one in measured
        if one.candidate.is_right
    }


def calibrate_step(
    kit: BuiltKit, step: Step, settings: Sequence[Setting], jobs: int, say: ProgressCallback
) -> list[CalibratedPicture]:
    """Correct solutions in every setting, mistakes as students are graded."""
    own = own_setting(kit)
    correct, mistaken = right_ones(kit.project, step), mutants(kit.project, step)
    work = [(one, own) for one in mistaken]
    work += [(one, setting) for one in correct for setting in (own, *settings)]
    with tempfile.TemporaryDirectory(prefix="raysteps-") as folder:
        limits = limited_pictures(kit.project, step, SEEDS, Path(folder))
        say(
            f"{step.id}: {len(correct)} correct solutions in {len(settings) + 1} settings and {len(mistaken)} mistakes "
            f"on {sum(len(limited.views) for limited in limits)} pictures"
        )
        measuring = PictureShares(kit, patient(step), [view for limited in limits for view in limited.views])
        measured = _measure(measuring, work, jobs, say)
        say(f"{step.id}: {measuring.binaries} different binaries")
    found, start = [], 0
    for limited in limits:
        views = slice(start, start + len(limited.views))
        mistakes = {one.candidate.name: one.shares[views] for one in measured if not one.candidate.is_right}
        pixels = min(measuring.pixels[views])
        found.append(
            CalibratedPicture(limited, gate_between(_worst(measured, views), mistakes, pixels, limited.max_wrong))
        )
        start = views.stop
    return found
