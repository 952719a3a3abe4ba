"""What a person types: one module for each command."""

import argparse
import math
import re

STUDENTS_KIT = "students_kit"  # a default of the parsers there: the project


def add_impl(parser: argparse.ArgumentParser) -> None:
    """`--impl`, where there is a reference to choose."""
    if parser.get_default(STUDENTS_KIT):
        parser.set_defaults(impl="mine")
    else:
        parser.add_argument("--impl", choices=["mine", "reference"], default="mine", help="whose steps (mine)")


def picture_size(least: int, most: int, example: str, word: str) -> str:
    """A type of argparse, once the first three are given: WxH, each side within these limits."""
    found = re.fullmatch(r"([0-9]{1,5})x([0-9]{1,5})", word)
    if found is None or not all(least <= int(side) <= most for side in found.groups()):
        raise argparse.ArgumentTypeError(f"{word}: expected WxH in pixels, each from {least} to {most}, like {example}")
    return word


def square_number(most: int, word: str) -> int:
    """Likewise: how many samples a pixel takes."""
    if not re.fullmatch(r"[0-9]{1,6}", word) or not 1 <= int(word) <= most or math.isqrt(int(word)) ** 2 != int(word):
        raise argparse.ArgumentTypeError(f"{word}: expected a square number from 1 to {most}, like 16")
    return int(word)


def port(word: str) -> int:
    if not (word.isascii() and word.isdigit() and int(word) <= 65535):
        raise argparse.ArgumentTypeError(f"{word}: expected a port from 1 to 65535, or 0 for any that is free")
    return int(word)
