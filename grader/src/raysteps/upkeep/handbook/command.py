"""The command `dev mistakes`: makes docs/mistakes/, or tells what is out of date there."""

from pathlib import Path

from raysteps.common.files import write_if_changed
from raysteps.kit.built_kit import Say
from raysteps.kit.kit_building import build_kit
from raysteps.kit.project import Project
from raysteps.programs.pictures import Pixels
from raysteps.upkeep.handbook.exhibits import exhibits, references
from raysteps.upkeep.handbook.images import is_current, write_image
from raysteps.upkeep.handbook.pages import index_page, picture_path, step_page


def _contents(project: Project, say: Say) -> tuple[dict[Path, str], dict[Path, Pixels]]:
    """Texts and pictures by their paths."""
    kit = build_kit(project, say)
    folder = project.root / "docs" / "mistakes"
    every = [(step, exhibits(kit, step, say)) for step in kit.steps]
    texts = {folder / "README.md": index_page(every)}
    pictures: dict[Path, Pixels] = {}
    for step, shown in every:
        texts[folder / f"{step.id}.md"] = step_page(step, shown)
        right = references(kit, step)
        for exhibit in shown:
            if exhibit.picture is not None and exhibit.pixels is not None:
                pictures[folder / picture_path(step, f"right-{exhibit.picture}")] = right[exhibit.picture]
                pictures[folder / picture_path(step, exhibit.mutant.id)] = exhibit.pixels
    return texts, pictures


def out_of_date(project: Project, say: Say) -> list[str]:
    """Paths that are missing, old or no longer needed."""
    texts, pictures = _contents(project, say)
    folder = project.root / "docs" / "mistakes"
    old = [path for path, text in texts.items() if not path.is_file() or path.read_text("utf-8") != text]
    old += [path for path, pixels in pictures.items() if not is_current(path, pixels)]
    old += [path for path in folder.rglob("*.*") if path not in texts and path not in pictures]
    return sorted(path.relative_to(project.root).as_posix() for path in old)


def write(project: Project, say: Say) -> list[str]:
    """Makes what is out of date anew, removes what is not needed, and returns what changed."""
    texts, pictures = _contents(project, say)
    folder = project.root / "docs" / "mistakes"
    changed = [path for path, text in texts.items() if write_if_changed(path, text.encode())]
    for path, pixels in pictures.items():
        if not is_current(path, pixels):
            write_image(path, pixels)
            changed.append(path)
    for path in list(folder.rglob("*.*")):
        if path not in texts and path not in pictures:
            path.unlink()
            changed.append(path)
    return sorted(path.relative_to(project.root).as_posix() for path in changed)
