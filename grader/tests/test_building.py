"""The build folder of the kit."""

from pathlib import Path

from raysteps.kit.building import BuildTree
from raysteps.kit.project import Project


def test_a_build_folder_of_another_clone_is_configured_anew(tmp_path: Path) -> None:
    project = Project(tmp_path / "clone")
    tree = BuildTree(project, "release", tmp_path / "clone" / "build", project.steps)
    (tree.folder / "CMakeFiles").mkdir(parents=True)
    cache = tree.folder / "CMakeCache.txt"
    (tree.folder / "build.ninja").touch()
    lines = f"RAYSTEPS_MINE_DIR:PATH={tree.mine}\nCMAKE_HOME_DIRECTORY:INTERNAL="
    cache.write_text(f"{lines}{project.root}\n")
    tree.forget_other_home()
    assert tree.is_configured()
    cache.write_text(f"{lines}/elsewhere\n")
    assert not tree.is_configured()
    tree.forget_other_home()
    assert not cache.exists()
    assert not (tree.folder / "CMakeFiles").exists()
