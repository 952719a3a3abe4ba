"""Which commands of the documents no test types, and why; and whose programs may be typed at all."""

from typed_commands import Typed

_TRUTH = "takes minutes; `test` grades all of it, `test --full` with pairs of mistakes too"
_FIGURES = "takes minutes; `test` does what --check does"
_IMAGE = "takes minutes, and needs an engine and a network; test_image has one that only listens"
_PLAY = "makes the page, which takes minutes, and ends when somebody ends it; test_play_page does"
_NIGHTLY = "goes on until Ctrl-C; test_nightly looks as often as it likes"
_FINALE = "draws for a minute; test_finale makes a small one"
_MODEL = "needs a model that somebody has; test_models makes such"
_DOWNLOAD = "needs the names of a platform's download; test_feedback_zips has such"

COMMANDS = {
    "./raysteps test": "is what runs the tests",
    "./raysteps test --full": "is what runs the tests",
    "./raysteps dev lint": "`test` asks the same",
    "./raysteps dev format": "`test` asks whether it would change anything",
    "./raysteps dev check": _TRUTH,
    "./raysteps dev check --only 02": _TRUTH,
    "./raysteps dev check --pairs 40": _TRUTH,
    "./raysteps dev check --only 20": "builds a kit with one more step, which takes minutes; test_new_step does so",
    "./raysteps dev calibrate": "takes 15 minutes; test_calibration measures one picture from end to end",
    "./raysteps dev errors": "takes minutes; test_error_rates grades with one seed",
    "./raysteps dev mistakes": "takes minutes; `test` does what --check does",
    "./raysteps figures": _FIGURES,
    "./raysteps figures --check": _FIGURES,
    "./raysteps finale": _FINALE,
    "./raysteps finale --name Ann Example": _FINALE,
    "./raysteps finale scenes/lessons/still-life.pbrt --samples 16": _FINALE,
    "./raysteps finale scenes/lessons/still-life.pbrt --samples 16 --denoise": _FINALE,
    "./raysteps inspect scenes/lessons/three-spheres.nff 40 16 --size 64x48 --step 4 --against reference": (
        "shows a mistake that somebody made; test_divergence makes such"
    ),
    "./raysteps grade-class --merge grades-ada grades-bob --out grades": (
        "needs copies that two people worked on; test_annotations merges such"
    ),
    "./raysteps render MODEL.obj -o model.png": _MODEL,
    "./raysteps convert MODEL.obj -o model.pbrt": _MODEL,
    "./raysteps convert MODEL.obj -o model.pbrt --textures inside": _MODEL,
    "./raysteps docs --live": "compiles the kit, which takes minutes; test_site_figures makes such a site",
    "./raysteps play": _PLAY,
    "./raysteps play --port 8000 --no-open": _PLAY,
    "./raysteps play --registry https://npm.example.edu": _PLAY,
    "./raysteps desk grades": "ends when somebody ends it; test_desk_command does",
    "./raysteps image --tag raysteps-grader": _IMAGE,
    "./raysteps image --tag raysteps-students --without-solutions --steps 1-4": _IMAGE,
    "./raysteps nightly submissions --out grades --roster students.csv --per-day 2": _NIGHTLY,
    "./raysteps nightly --git --out grades --roster students.csv": _NIGHTLY,
    "./raysteps grade-class submissions --out grades --roster students.csv --scheduler tcp://head:8786": (
        "needs a cluster; test_cluster has one"
    ),
    "./raysteps export mail --results grades --from Graphics 101 <graphics@example.edu> --send "
    "--smtp smtp.example.edu --user graphics": "needs a mail server; test_mail_sending has one",
    "./raysteps export moodle-feedback --results grades --out feedback.zip": _DOWNLOAD,
    "./raysteps export canvas-feedback --results grades --out feedback.zip": _DOWNLOAD,
}

SOMEBODY_ELSES = {
    "../.venv/bin/python": "runs a test; `test --full` runs all",
    ".venv/bin/dask": "starts a cluster; test_cluster does it",
    ".venv/bin/pip": "installs",
    ".venv/bin/pre-commit": "changes what git does",
    "brew": "installs",
    "docker": "takes minutes, and needs a network",
    "java": "JPlag is no part of the kit",
    "sbatch": "needs a cluster of Slurm",
    "winget": "installs",
    "wsl": "installs",
}

_HARMLESS = {"cd", "cmake", "cp", "mkdir", "sqlite3", "tar", "zip"}


def may_be_typed(one: Typed) -> bool:
    """Programs of the kit, and a few that do no more than their words say."""
    first, *rest = one.words
    is_python = first == "python" and rest[:1] in (["raysteps"], ["scenes/generate.py"])
    return is_python or first == "./raysteps" or first.startswith("build/") or first in _HARMLESS


def why_not(one: Typed) -> str:
    """Empty where the command is typed."""
    if one.is_synopsis:
        return "says what may be written"
    return COMMANDS.get(" ".join(one.words)) or SOMEBODY_ELSES.get(one.words[0], "")
