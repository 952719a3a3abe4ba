"""The commands `dev ...`, for those who maintain the kit."""

import argparse
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import get_args, get_type_hints

import msgspec
from rich.console import Console

from raysteps.classroom.leaderboard import Leaderboard
from raysteps.common.documents import former_keys
from raysteps.common.errors import UsageError
from raysteps.common.files import write_json
from raysteps.common.text import join_and
from raysteps.course.manifest import choose, kit_steps, read_all_steps
from raysteps.course.project import Project
from raysteps.course.stubs import outdated_stubs, write_stubs
from raysteps.desk.annotation_files import AnnotationFile
from raysteps.exports.similar_pairs import Similarity
from raysteps.inspector.model import Record
from raysteps.judge.counterexamples import CaseFile
from raysteps.report.terminal import progress
from raysteps.results.class_model import ClassResults
from raysteps.results.model import Results
from raysteps.toolchain.kit_artifacts import ProgressCallback
from raysteps.updater.release_list import Release
from tools import mistake_pages as handbook
from tools import new_step
from tools.bench.model import Numbers
from tools.calibration.calibrate import calibrate
from tools.calibration.error_rates import ErrorOptions, errors
from tools.grade_audit import IN_SANDBOX, check_truth
from tools.lint import LANGUAGES, TIDY, lint_checks, reformat
from tools.selftest.checks import run_checks
from tools.selftest.stamps import Stamps
from tools.test_submissions import outdated_samples, write_samples

# The command `dev schemas`: JSON schemas of the kit's documents, for programs of others; made from the classes that the
# kit reads them with.

DOCUMENTS: Mapping[str, type] = {
    "results": Results,
    "class": ClassResults,
    "leaderboard": Leaderboard,
    "similarity": Similarity,
    "annotations": AnnotationFile,
    "case": CaseFile,
    "inspect": Record,
    "release": Release,
    **{f"bench-{kind.name}": kind for kind in get_args(Numbers)},
}


def _classes(kind: object, known: set[type]) -> Iterator[type]:
    """The dataclasses that a type is made of."""
    if isinstance(kind, type) and is_dataclass(kind) and kind not in known:
        known.add(kind)
        yield kind
        for inner in get_type_hints(kind).values():
            yield from _classes(inner, known)
    for inner in get_args(kind):
        yield from _classes(inner, known)


def schema_of(kind: type) -> dict[str, object]:
    """No object of ours takes a key that it does not know, but for the list of a release. Required is what the kit
    always writes: all but what older kits did not. What only older kits wrote may be anything."""
    schema = msgspec.json.schema(kind)
    classes = list(_classes(kind, set()))
    optional = {(made.__name__, one.name) for made in classes for one in fields(made) if one.metadata}
    former = {made.__name__: former_keys(made) for made in classes}
    for name, form in schema["$defs"].items():
        if "properties" in form:
            form["additionalProperties"] = kind is Release
            form["required"] = [key for key in form["properties"] if (name, key) not in optional]
            form["properties"] |= {key: {"deprecated": True} for key in former.get(name, ())}
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def write_schemas(folder: Path) -> list[Path]:
    """NAME.schema.json of each document."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {folder / f"{name}.schema.json": kind for name, kind in DOCUMENTS.items()}
    for path, kind in paths.items():
        write_json(path, schema_of(kind))
    return list(paths)


# The commands `dev stubs`, `dev samples` and `dev mistakes`.


def stubs(project: Project, *, check: bool) -> int:
    """Makes the stubs, or tells which are out of date."""
    changed = (outdated_stubs if check else write_stubs)(project, kit_steps(project))
    return _tell(project, changed, [], "dev stubs", check=check)


def samples(project: Project, *, check: bool) -> int:
    """Makes the samples, or tells which are out of date."""
    changed = (outdated_samples if check else write_samples)(project, kit_steps(project))
    strays = _strays(project, [project.samples / name / "steps" for name in ("complete", "partial")], check=check)
    return _tell(project, changed, strays, "dev samples", check=check)


def mistakes(project: Project, say: ProgressCallback, *, check: bool) -> int:
    """Makes the pages of docs/mistakes/, or tells which are out of date."""
    changed = (handbook.out_of_date if check else handbook.write)(project, say)
    return _tell(project, [project.root / name for name in changed], [], "dev mistakes", check=check)


def _strays(project: Project, rooms: list[Path], *, check: bool) -> list[Path]:
    """What was made for steps that are gone; removed, unless it is only to be told."""
    known = {step.id for step in read_all_steps(project)}
    found = [path for room in rooms for path in sorted(room.glob("[0-9][0-9]-*")) if path.name not in known]
    for path in [] if check else found:
        shutil.rmtree(path)
    return found


def _tell(project: Project, changed: list[Path], strays: list[Path], command: str, *, check: bool) -> int:
    for path in changed:
        name = path.relative_to(project.root).as_posix()
        if check:
            print(f"{name} differs from what the solutions generate; ./raysteps {command} makes it anew")
        else:
            print(f"{name} written")
    for path in strays:
        name = path.relative_to(project.root).as_posix()
        print(f"{name} belongs to no step; ./raysteps {command} removes it" if check else f"{name} removed")
    return 1 if check and (changed or strays) else 0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Adds one command below `dev` for each thing to do."""
    commands = parser.add_subparsers(dest="what", required=True, metavar="WHAT")
    new_step.add_arguments(commands)
    for name, made in (
        ("stubs", "the stubs in steps/"),
        ("samples", "the samples in grader/samples/"),
    ):
        add = commands.add_parser(name, help=f"make {made} from the solutions")
        add.add_argument("--check", action="store_true", help="only tell what is out of date")
    add = commands.add_parser("mistakes", help="make docs/mistakes/ from the catalogue of mistakes")
    add.add_argument("--check", action="store_true", help="only tell what is out of date")
    add = commands.add_parser("calibrate", help="measure how many pixels of each picture may be wrong (15 minutes)")
    add.add_argument("--check", action="store_true", help="only tell which limits are out of date")
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="these steps only")
    add.add_argument("--marks", action="store_true", help="grade every correct solution in every setting instead")
    add = commands.add_parser("errors", help="how often the judge of part two calls right code wrong, and finds a bias")
    usual = ErrorOptions()
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="these steps only")
    words = f"of right solutions, over all steps ({usual.grades})"
    add.add_argument("--grades", type=int, default=usual.grades, metavar="N", help=words)
    words = f"seeds with which biased references are graded, too ({usual.planted})"
    add.add_argument("--planted", type=int, default=usual.planted, metavar="N", help=words)
    add.add_argument("--seed", type=int, default=usual.seed, metavar="N", help=f"the first one ({usual.seed})")
    words = "begin no further seed after so many"
    add.add_argument("--minutes", type=float, default=usual.minutes, metavar="N", help=words)
    add.add_argument("--docs", action="store_true", help="write the table of docs/judge.md")
    add = commands.add_parser(
        "check", help="grade stubs, references, known mistakes and alternatives, and judge the grades"
    )
    add.add_argument("--only", nargs="+", default=[], metavar="STEP", help="these steps only")
    add.add_argument("--pairs", type=int, default=0, metavar="N", help="also random pairs of mistakes in two steps")
    add.add_argument("--seed", type=int, default=1, metavar="N", help="of the hidden cases and of the pairs (1)")
    add.add_argument(
        "--in-sandbox",
        type=int,
        default=IN_SANDBOX,
        metavar="N",
        help=f"so many rounds also as submissions are graded, in boxes ({IN_SANDBOX}; 99 for all, half an hour)",
    )
    commands.add_parser("schemas", help="write JSON schemas of the kit's documents to build/schemas/")
    for name, said in (
        ("lint", "ask the linters and formatters what they would change"),
        ("format", "format the kit's own code, and mend what linters mend by themselves"),
    ):
        add = commands.add_parser(name, help=said)
        add.add_argument(
            "languages", nargs="*", metavar="LANGUAGE", help=f"of {', '.join(LANGUAGES)} (all of these), {TIDY}"
        )


def _chosen(languages: list[str]) -> tuple[str, ...]:
    unknown = [language for language in languages if language not in (*LANGUAGES, TIDY)]
    if unknown:
        raise UsageError(f"{join_and(unknown)}: expected {', '.join((*LANGUAGES, TIDY))}")
    return tuple(languages) or LANGUAGES


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Runs one of them."""
    match arguments.what:
        case "new":
            return new_step.run(project, arguments)
        case "lint" | "format":
            make = lint_checks if arguments.what == "lint" else reformat
            return run_checks(make(project, _chosen(arguments.languages)), console, Stamps(project, fresh=True))
        case "stubs":
            return stubs(project, check=arguments.check)
        case "samples":
            return samples(project, check=arguments.check)
        case "mistakes":
            with console.status("starting") as status:
                return mistakes(project, progress(console, status), check=arguments.check)
        case "schemas":
            for path in write_schemas(project.build / "schemas"):
                print(f"{path.relative_to(project.root).as_posix()} written")
            return 0
        case "calibrate":
            with console.status("starting") as status:
                say = progress(console, status)
                return calibrate(project, arguments.only, console, say, check=arguments.check, grades=arguments.marks)
        case "errors":
            numbers = (arguments.grades, arguments.planted, arguments.seed, arguments.minutes)
            with console.status("starting") as status:
                wished = ErrorOptions(*numbers, tuple(arguments.only), arguments.docs)
                return errors(project, wished, console, progress(console, status))
        case _:
            with console.status("starting") as status:
                say = progress(console, status)
                only, pairs, seed, boxed = arguments.only, arguments.pairs, arguments.seed, arguments.in_sandbox
                code = check_truth(project, console, say, only=only, pairs=pairs, seed=seed, in_sandbox=boxed)
            for step in choose(kit_steps(project), only):
                for line in new_step.sample_leftovers(project, step):
                    print(line)
            return code
