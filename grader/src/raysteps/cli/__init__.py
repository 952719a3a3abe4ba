"""What a person types: one module for each command."""

import argparse

STUDENTS_KIT = "students_kit"  # a default of the parsers there: the project


def add_impl(parser: argparse.ArgumentParser) -> None:
    """`--impl`, where there is a reference to choose."""
    if parser.get_default(STUDENTS_KIT):
        parser.set_defaults(impl="mine")
    else:
        parser.add_argument("--impl", choices=["mine", "reference"], default="mine", help="whose steps (mine)")
