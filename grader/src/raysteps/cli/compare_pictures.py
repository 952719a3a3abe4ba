"""The command `compare`: two pictures, pixel by pixel."""

import argparse
from pathlib import Path

from rich.console import Console

from raysteps.common.errors import UsageError, reason
from raysteps.common.files import PNG_SIGNATURE
from raysteps.common.text import print_plain
from raysteps.course.project import Project
from raysteps.images.compare import (
    TOLERANCE,
    PictureError,
    Pixels,
    difference,
    pixel_differences,
    read_png,
    read_ppm,
    widest,
    write_png,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Two pictures, and where their difference goes."""
    parser.add_argument("mine", type=Path, metavar="MINE", help="a picture, .png or .ppm")
    parser.add_argument("reference", type=Path, metavar="REFERENCE", help="another one of the same size")
    parser.add_argument("-o", dest="out", type=Path, metavar="FILE.png", help="the difference, 8 times as bright")


_EXPECTED = "expected a picture as `./raysteps render` writes it, .png or .ppm"


def _read(path: Path) -> Pixels:
    if not path.is_file():
        what = "is a folder" if path.is_dir() else "is not there"
        raise UsageError(f"{path}: {what}; {_EXPECTED}")
    try:
        with path.open("rb") as file:
            start = file.read(4)
    except OSError as error:
        raise UsageError(f"{path}: cannot be read: {reason(error)}; {_EXPECTED}") from error
    is_png = start == PNG_SIGNATURE[:4]  # the rest shows damage
    if start and not is_png and start[:1] != b"P":
        raise UsageError(f"{path}: is neither a PNG nor a PPM; {_EXPECTED}")
    try:
        return (read_png if is_png else read_ppm)(path)
    except PictureError as error:
        raise UsageError(f"{path}: {error}; {_EXPECTED}") from error
    except (OSError, ValueError) as error:  # in the words of a library
        raise UsageError(f"{path}: is only a part of a PNG, or a damaged one; {_EXPECTED}") from error


def run(project: Project, arguments: argparse.Namespace, console: Console) -> int:
    """0 when no channel of any pixel differs by more than rounding, else 1."""
    if arguments.out is not None and arguments.out.suffix.lower() != ".png":
        raise UsageError(f"{arguments.out}: the difference is written as .png; expected a name such as gap.png")
    mine, reference = _read(arguments.mine), _read(arguments.reference)
    if mine.shape != reference.shape:
        sizes = [f"{pixels.shape[1]}x{pixels.shape[0]}" for pixels in (mine, reference)]
        raise UsageError(f"{arguments.mine}: is {sizes[0]} pixels, and the other {sizes[1]}; expected one size")
    gap = pixel_differences(mine, reference)
    wrong = int((gap > TOLERANCE).sum())
    console.print(f"{wrong} of {gap.size} pixels ({wrong / gap.size:.2%}) differ by more than {TOLERANCE} of 255.")
    if gap.any():
        x, y = widest(gap)
        colors = f"{tuple(mine[y, x].tolist())} and {tuple(reference[y, x].tolist())}"
        console.print(f"The largest difference is at x={x}, y={y}: {colors}.", highlight=False)
    if arguments.out is not None:
        try:
            write_png(difference(mine, reference), arguments.out)
        except OSError as error:
            raise UsageError(f"{arguments.out}: cannot be written: {reason(error)}") from error
        print_plain(console, f"Difference: {arguments.out}")
    return 1 if wrong else 0
