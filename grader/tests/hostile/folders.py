"""Submissions that are folders with more in them than text files can say."""

import os
from collections.abc import Callable, Mapping
from pathlib import Path

Maker = Callable[[Path, Mapping[str, str]], Path]

_STEP = Path("steps/07-tone-mapping")
_FILE = "tone_mapping.cpp"


def honest_sources(folder: Path) -> dict[str, bytes]:
    """What the folder holds before anything is done to it."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.cpp")}


def odd_names(folder: Path, facts: Mapping[str, str]) -> Path:
    touch = "touch${IFS}trace"
    names = [
        "-fplugin=x.so",
        "@file",
        "-o",
        "--specs=x",
        "-x",
        ";",
        f"$({touch})",
        f"`{touch}`",
        "a\nb",
        "a b",
        "*",
        "~",
    ]
    for name in names:
        for place in (folder, folder / _STEP):
            (place / name).write_text("-fplugin=x.so")
            (place / f"{name}.cpp").write_text("-fplugin=x.so")
    Path(os.fsdecode(os.fsencode(folder / _STEP) + b"/\xff\xfe\x1b[31m.cpp")).write_text("x")
    return folder


def odd_source_name(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / _STEP).mkdir(parents=True)
    (folder / _STEP / "tone_mapping (1).cpp").write_text("int x;\n")
    return folder


def links(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / _STEP).mkdir(parents=True)
    (folder / _STEP / _FILE).symlink_to(Path(facts["KIT"], "solutions", _STEP.name, _FILE))
    (folder / _FILE).symlink_to(facts["SECRET"])
    return folder


def link_to_a_folder(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / _STEP).symlink_to(Path(facts["KIT"], "solutions", _STEP.name))
    (folder / "all").symlink_to("/")
    (folder / "round").symlink_to(folder)
    return folder


def pipe(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / _STEP).mkdir(parents=True)
    os.mkfifo(folder / _STEP / _FILE)
    return folder


def binary_source(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / _STEP).mkdir(parents=True)
    (folder / _STEP / _FILE).write_bytes(b"int x;\n" + bytes(range(256)) * 20)
    return folder


def name_with_code(folder: Path, facts: Mapping[str, str]) -> Path:
    other = folder.with_name("=cmd|' calc'!A0<img src=x onerror=alert(1)>\x1b[31m\x9b31m\n\u202egpj")
    folder.rename(other)
    return other


def somebody_else(folder: Path, facts: Mapping[str, str]) -> Path:
    (folder / "Bob_Example_4711_bob").mkdir()
    return folder


FOLDERS: dict[str, Maker] = {
    make.__name__: make
    for make in (
        odd_names,
        odd_source_name,
        binary_source,
        links,
        link_to_a_folder,
        pipe,
        name_with_code,
        somebody_else,
    )
}
