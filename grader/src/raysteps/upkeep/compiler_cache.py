"""Tests build many copies of the kit. What was compiled for one is taken for the next."""

import os
import shutil

from raysteps.kit.project import Project


def use_compiler_cache(project: Project) -> None:
    """From here on, in this process and in those that it starts; in a folder of its own. Without ccache nothing is
    different but the time. Another launcher that somebody chose stays."""
    if shutil.which("ccache"):
        os.environ.setdefault("CMAKE_CXX_COMPILER_LAUNCHER", "ccache")
        os.environ["CCACHE_DIR"] = str(project.build / "ccache")
        os.environ["CCACHE_NOHASHDIR"] = "1"
