"""The command `test`: everything that shows the kit works."""

from rich.console import Console

from raysteps.kit.building import BuildTree
from raysteps.kit.project import Project
from raysteps.upkeep.checks import Check, Report, run_checks
from raysteps.upkeep.compiler_cache import use_compiler_cache
from raysteps.upkeep.packages import CACHE, PAGES, WINDOW, install
from raysteps.upkeep.selftest_checks import grade_checks, python_checks, run_pytest
from raysteps.upkeep.selftest_programs import asan_checks, build, clang_checks, program_checks, same_pictures
from raysteps.upkeep.windows_checks import windows_checks

_SLOW = "pytest, hostile submissions and packages for other systems"


def _packages(project: Project) -> Report:
    """Before anything is configured; tests that need what cannot be had are skipped."""
    wanted = (*PAGES, *WINDOW)
    installed = install(wanted)
    install(CACHE)  # by itself: apt-get installs nothing of a list with an unknown package; it only saves time
    use_compiler_cache(project)
    return Report("passed") if installed else Report("skipped", f"install: {' '.join(wanted)}")


def selftest(project: Project, console: Console, *, full: bool) -> int:
    """All checks, or all that need no more than the basic tools."""
    tree = BuildTree(project, "dev", project.build / "dev", project.steps)
    checks = [Check("a browser and a window system for the tests", lambda: _packages(project))]
    checks += [Check("build everything, warnings are errors", lambda: build(tree, [])), *program_checks(tree)]
    checks.append(Check("all structures give the same picture", lambda: same_pictures(project, tree)))
    checks += grade_checks(project, console, full=full)
    checks += python_checks(project)
    if full:
        checks.append(Check(_SLOW, lambda: run_pytest(project, "slow")))
        checks += asan_checks(project) + clang_checks(project) + windows_checks(project, tree)
    else:
        more = Report("skipped", "run: ./raysteps test --full")
        names = (_SLOW, "sanitizers", "build everything with clang", "fuzz-readers for 60 s", "Windows")
        checks += [Check(name, lambda: more) for name in names]
    return run_checks(checks, console)
