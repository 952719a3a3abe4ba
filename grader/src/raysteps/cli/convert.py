"""The command `convert`: a model from elsewhere, as a scene that this kit draws; and how other commands take one."""

import argparse
import os
import sys
from pathlib import Path

from rich.console import Console
from rich.markup import escape

from raysteps.common.errors import UsageError
from raysteps.common.files import content_hash, refuse_to_write
from raysteps.common.text import count, print_plain
from raysteps.course.manifest import read_steps
from raysteps.course.project import Project, is_of_part_two
from raysteps.models import ENDINGS, TexturePlace

_MESHES = "11"  # the step from which on scenes have meshes and textures


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The model, and the scene."""
    parser.add_argument("model", type=Path, metavar="MODEL", help="a file that ends in " + ", ".join(ENDINGS))
    parser.add_argument(
        "-o",
        dest="out",
        type=Path,
        required=True,
        metavar="SCENE",
        help="SCENE.pbrt for part two, SCENE.nff for part one, which has mean colours for textures",
    )
    parser.add_argument("--up", choices=["y", "z"], default="y", help="which way is up in the model (y)")
    parser.add_argument(
        "--textures",
        choices=["beside", "inside", "none"],
        help="where the textures of SCENE.pbrt go: into files beside it (beside, the usual), into its text, as a "
        "graded scene needs it (inside), or nowhere: mean colours only (none)",
    )


def _write(model: Path, out: Path, *, z_up: bool, textures: TexturePlace) -> list[str]:
    from raysteps.models.mesh_file import read_model  # trimesh takes its time
    from raysteps.models.scene_around import write_nff, write_pbrt

    parts, unusable = read_model(model, z_up=z_up)
    if is_of_part_two(out):
        write_pbrt(parts, out, textures=textures)
    else:
        write_nff(parts, out)
    triangles = sum(len(part.triangles) for part in parts)
    notes = [f"{model}: it names {file}; it is drawn without" for file in unusable]
    return [*notes, f"{model.name}: {count(triangles, 'triangle')} of {count(len(parts), 'material')}"]


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """Writes the scene."""
    out: Path = arguments.out
    if out.suffix.lower() not in (".pbrt", ".nff") or out.is_dir():
        raise UsageError(f"{out}: expected the name of a scene to write, .pbrt or .nff")
    textures: TexturePlace | None = arguments.textures
    if not is_of_part_two(out) and textures is not None:
        raise UsageError(f"--textures {textures}: expected SCENE.pbrt; {out.name} has mean colours for textures")
    refuse_to_write(out)
    for note in _write(arguments.model, out, z_up=arguments.up == "z", textures=textures or "beside"):
        console.print(escape(note), highlight=False)
    print_plain(console, f"Scene: {os.fspath(out)}")
    return 0


def as_scene(project: Project, scene: str) -> str:
    """The scene itself; of a model, what it is converted into, in build/models."""
    path = Path(scene)
    if path.suffix.lower() not in ENDINGS or not path.is_file():
        return scene
    ending = ".pbrt" if any(step.number == _MESHES for step in read_steps(project)) else ".nff"
    folder = project.build / "models" / f"{path.stem}-{content_hash(os.fspath(path.resolve()).encode())[:8]}"
    out = folder / f"{path.stem}{ending}"
    for note in _write(path, out, z_up=False, textures="beside")[:-1]:
        print(f"raysteps: {note}", file=sys.stderr)
    return os.fspath(out)
