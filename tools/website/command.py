"""The command `docs`: the documents as a site."""

import argparse
import shutil
import tempfile
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.cli.app import new_parser
from raysteps.common.errors import UsageError
from raysteps.common.files import usable_folder
from raysteps.course.project import Project
from raysteps.play.packages import registry_of
from raysteps.release.leaks import find_leaks
from raysteps.release.page_parts import is_page
from raysteps.release.secrets import gather
from raysteps.report.terminal import short_path
from tools.website.build import GALLERY, PLAY, SITE, build_site, check_tools, stage
from tools.website.documents import COMMANDS_PAGE, api_pages, bad_formulas, command_page, dead_links, documents
from tools.website.live_figures import LiveFigures, check_live, make_live_figures


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Where it goes, and what else comes along."""
    parser.add_argument("--out", type=Path, metavar="DIR", help="where index.html goes (build/site)")
    parser.add_argument("--gallery", type=Path, metavar="DIR", help="a gallery made before, to be part of the site")
    parser.add_argument("--play", type=Path, metavar="DIR", help="a students' page to work in, made before, likewise")
    parser.add_argument(
        "--live", action="store_true", help="handouts have live figures, which hold the reference's functions, compiled"
    )


def _check(project: Project, out: Path, arguments: argparse.Namespace) -> None:
    SITE.check(out)
    gallery: Path | None = arguments.gallery
    play: Path | None = arguments.play
    if arguments.live:
        check_live(project)
    if play is not None:
        if not is_page(play):
            raise UsageError(
                f"{play}: expected a page to work in; make one in a students' kit: ./raysteps play --out DIR"
            )
        leaks = find_leaks(gather(project), play)
        if leaks:
            raise UsageError(f"{play}: must not be published: {leaks[0]}")
    if gallery is not None and not (gallery / GALLERY.name).is_file():
        raise UsageError(
            f"{gallery}: expected a folder with {GALLERY.name} in it; make one with: ./raysteps gallery --out {gallery}"
        )


def _troubles(project: Project) -> list[str]:
    """What is wrong in the documents themselves."""
    written = documents(project)
    return [*dead_links(project.root, written), *bad_formulas(project.root, written)]


def _build(
    project: Project,
    out: Path,
    made_before: dict[Path, Path],
    pages: dict[Path, str],
    live: LiveFigures | None,
    console: Console,
) -> list[str]:
    """Builds beside its place, and puts it there when nothing is wrong. `made_before` says where pages are from."""
    usable_folder(out.parent)
    with tempfile.TemporaryDirectory(prefix=".site-", dir=out.parent, ignore_cleanup_errors=True) as name:
        work = Path(name)
        (work / "stage").mkdir()
        stage(project, work / "stage", pages, made_before, live)
        with console.status("building the site"):
            troubles = build_site(work / "stage", work / "site", work)
        for page, folder in made_before.items():
            shutil.copytree(folder, work / "site" / page.parent)
        if not troubles:
            SITE.put(work / "site", out)
    return troubles


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Builds all of it anew."""
    out: Path = (arguments.out or project.build / "site").absolute()
    _check(project, out, arguments)
    check_tools()
    troubles = _troubles(project)
    if not troubles:
        live = make_live_figures(project, registry_of(None), console.print) if arguments.live else None
        pages = {COMMANDS_PAGE: command_page(project, new_parser(project)), **api_pages(project)}
        asked = {GALLERY: arguments.gallery, PLAY: arguments.play}
        made_before = {page: folder for page, folder in asked.items() if folder is not None}
        troubles = _build(project, out, made_before, pages, live, console)
    for trouble in troubles:
        console.print(escape(trouble), highlight=False)
    if troubles:
        many = f"{len(troubles)} things" if len(troubles) > 1 else "one thing"
        console.print(f"no site was written: {many} to mend")
        return 1
    console.print(f"the site is in {escape(short_path(out / 'index.html'))}: open it in a browser, or serve its folder")
    return 0
