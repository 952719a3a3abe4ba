"""What the C++ programs accept, read from the text that they print for --help."""

import argparse
import re

from raysteps.kit.project import Project

_SOURCES = {"raytrace": "options.cpp", "inspect": "inspect_options.cpp", "view": "view_options.cpp"}
_OPTION = re.compile(r"^  (?:-\w, )?(--?[\w-]+)(?: (\S+))?(?=\s|$)", re.MULTILINE)


def usage(project: Project, program: str) -> str:
    """The text."""
    source = (project.root / "framework" / "apps" / _SOURCES[program]).read_text(encoding="utf-8")
    found = re.search(r'_usage = R"\((.*?)\)"', source, re.DOTALL)
    if found is None:
        raise ValueError(f"framework/apps/{_SOURCES[program]}: expected a constant k_..._usage")
    return found[1]


def usage_parser(project: Project, program: str) -> argparse.ArgumentParser:
    """Reads a scene and the program's options as the program does, but for the ranges of numbers."""
    parser = argparse.ArgumentParser(prog=program, allow_abbrev=False, add_help=False)
    parser.add_argument("scene", nargs="?")
    for option, value in _OPTION.findall(usage(project, program)):
        words = value.split("|")
        if not value:
            parser.add_argument(option, action="store_true")
        elif len(words) > 1:
            parser.add_argument(option, choices=words)
        elif value == "N":
            parser.add_argument(option, type=int)
        elif value == "WxH":
            parser.add_argument(option, type=_size)
        else:
            parser.add_argument(option)
    return parser


def _size(word: str) -> str:
    if not re.fullmatch(r"[1-9]\d*x[1-9]\d*", word):
        raise argparse.ArgumentTypeError(f"{word}: expected WxH")
    return word
