"""Models from elsewhere: what is read of them, the scene around them, and what is said of broken ones."""

import json
import random
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import trimesh as typed_in_part
from PIL import Image
from rich.console import Console

from raysteps.cli.app import new_parser
from raysteps.cli.convert import as_scene, run
from raysteps.common.errors import UsageError
from raysteps.common.process import run as run_program
from raysteps.course.project import Project
from raysteps.course.settings import COURSE_VARIABLE
from raysteps.images.compare import read_ppm
from raysteps.models.mesh_file import MeshPart, read_model
from raysteps.models.scene_around import write_nff, write_pbrt
from raysteps.toolchain.kit_artifacts import BuiltKit

trimesh: Any = typed_in_part

# A square of two triangles with a texture, and one triangle in front of it that glows.
_OBJ = """mtllib two.mtl
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl cloth
f 1/1/1 2/2/1 3/3/1 4/4/1
usemtl lamp
f 1/1/1 2/2/1 3/3/1
"""
_MTL = (
    "newmtl cloth\nKd 1 1 1\nKs 0.5 0.5 0.5\nNs 40\nmap_Kd .\\pictures\\half.png\nnewmtl lamp\nKd 0 0.5 1\nKe 3 2 1\n"
)


@pytest.fixture
def obj(tmp_path: Path) -> Path:
    """As a program on Windows writes it."""
    picture = Image.new("RGB", (8, 8), (255, 0, 0))
    picture.paste((0, 0, 255), (0, 0, 8, 4))  # the upper half
    (tmp_path / "pictures").mkdir()
    picture.save(tmp_path / "pictures" / "half.png")
    (tmp_path / "two.mtl").write_text(_MTL, encoding="utf-8")
    path = tmp_path / "two.obj"
    path.write_text(_OBJ, encoding="utf-8")
    return path


def _glb(path: Path, **material: object) -> Path:
    """A box of 2 x 4 x 6, turned a quarter about z and moved along x."""
    box = trimesh.creation.box((2, 4, 6))
    box.visual = trimesh.visual.TextureVisuals(
        uv=np.zeros((len(box.vertices), 2)), material=trimesh.visual.material.PBRMaterial(**material)
    )
    scene = trimesh.Scene()
    place = trimesh.transformations.rotation_matrix(np.pi / 2, [0, 0, 1])
    place[0, 3] = 10
    scene.add_geometry(box, transform=place)
    path.write_bytes(scene.export(file_type="glb"))
    return path


def _parts(path: Path, *, z_up: bool = False) -> dict[str, MeshPart]:
    parts, missing = read_model(path, z_up=z_up)
    assert missing == []
    return {part.name: part for part in parts}


def test_materials_of_an_obj_file(obj: Path) -> None:
    cloth, lamp = sorted(read_model(obj)[0], key=lambda part: bool(part.material.emission.any()))
    assert len(cloth.triangles) == 2
    assert cloth.material.texture is not None
    assert cloth.material.texture.getpixel((0, 0)) == (0, 0, 255)
    assert cloth.material.ks == pytest.approx(0.5, abs=0.01)
    assert cloth.material.shine == 40
    assert cloth.normals is not None
    assert (cloth.normals == [0, 0, 1]).all()
    assert cloth.uvs is not None
    corner = next(i for i, place in enumerate(cloth.positions) if (place == [2, 2, 0]).all())
    assert (cloth.uvs[corner] == [1, 1]).all()
    assert lamp.material.emission.tolist() == [3, 2, 1]
    assert lamp.material.color == pytest.approx([0, 0.5, 1], abs=0.01)


def test_a_part_of_a_gltf_file_is_where_its_node_puts_it(tmp_path: Path) -> None:
    (part,) = _parts(_glb(tmp_path / "box.glb", baseColorFactor=[0.25, 0.5, 1.0, 1.0], metallicFactor=0.0)).values()
    assert np.ptp(part.positions, axis=0) == pytest.approx([4, 2, 6])
    assert part.positions.mean(axis=0) == pytest.approx([10, 0, 0])
    assert part.material.color == pytest.approx([0.25, 0.5, 1], abs=0.005)
    assert part.material.metal_roughness is None


def test_numbers_of_a_gltf_file_are_no_text(tmp_path: Path) -> None:
    """Whatever their first bytes are: those of the first number here are the mark of UTF-16."""
    numbers = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], dtype="<f4").tobytes()
    (tmp_path / "three.bin").write_bytes(b"\xff\xfe" + numbers[2:])
    document = {
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": len(numbers)}],
        "buffers": [{"uri": "three.bin", "byteLength": len(numbers)}],
    }
    path = tmp_path / "three.gltf"
    path.write_text(json.dumps(document), encoding="utf-8")
    assert len(read_model(path)[0][0].positions) == 3


def test_normals_turn_with_their_part(tmp_path: Path) -> None:
    """Across the surface still where a part is drawn out along one axis."""
    ball = trimesh.creation.icosphere(subdivisions=3)
    ball.vertex_normals = ball.vertices
    scene = trimesh.Scene()
    scene.add_geometry(ball, transform=np.diag([3.0, 1.0, 1.0, 1.0]))
    path = tmp_path / "egg.glb"
    path.write_bytes(scene.export(file_type="glb"))
    (part,) = _parts(path).values()
    assert part.normals is not None
    gradient = part.positions / [9, 1, 1]  # of x^2/9 + y^2 + z^2
    gradient /= np.linalg.norm(gradient, axis=1, keepdims=True)
    assert np.abs(part.normals - gradient).max() < 1e-5


def test_metal_keeps_its_colour_and_its_roughness_squared(tmp_path: Path) -> None:
    (part,) = _parts(_glb(tmp_path / "a.glb", baseColorFactor=[1.0, 0.8, 0.4, 1.0], roughnessFactor=0.5)).values()
    assert part.material.metal_roughness == pytest.approx(0.25)


def test_z_can_be_up(tmp_path: Path) -> None:
    path = tmp_path / "tall.stl"
    path.write_bytes(trimesh.creation.box((1, 2, 9)).export(file_type="stl"))
    (part,) = _parts(path, z_up=True).values()
    assert np.ptp(part.positions, axis=0) == pytest.approx([1, 9, 2])
    corner = part.positions[part.triangles[0]]
    across = np.cross(corner[1] - corner[0], corner[2] - corner[0])
    assert across @ corner.mean(axis=0) > 0, "turned, not mirrored: the outside stays outside"


def test_what_is_not_beside_the_model_is_named(obj: Path, capsys: pytest.CaptureFixture[str]) -> None:
    texture = obj.parent / "pictures" / "half.png"
    texture.write_bytes(texture.read_bytes()[:-30])
    parts, unusable = read_model(obj)
    assert unusable == [".\\pictures\\half.png, which is no picture, or only a part of one"]
    assert all(part.material.texture is None for part in parts)
    texture.unlink()
    parts, unusable = read_model(obj)
    assert unusable == [".\\pictures\\half.png, which is not there"]
    assert all(part.material.texture is None for part in parts)
    (obj.parent / "two.mtl").unlink()
    assert read_model(obj)[1] == ["two.mtl, which is not there"]


@pytest.mark.parametrize(
    ("name", "data", "said"),
    [
        ("a.fbx", b"", r"a\.fbx: expected a model: \.obj"),
        ("none.obj", None, r"none\.obj: is not there; expected a model"),
        ("a.ply", b"ply, or not", r"a\.ply: is no such model, or only a part of one"),
        ("a.obj", b"v 0 0 0\n", r"a\.obj: expected triangles, found none"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", r"a\.obj:4: expected numbers of corners from 1 to 3, found"),
        ("a.obj", b"v 0 0 0\nv 1 zero 0\nv 0 1 0\nf 1 2 3\n", r"a\.obj:2: expected 3 numbers after `v`, found `v 1 z"),
        ("a.obj", b"v 0 0 0\nv 1 0\nv 0 1 0\nf 1 2 3\n", r"a\.obj:2: expected 3 numbers after `v`, found `v 1 0`"),
        ("a.obj", b"v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 2 9\n", r"a\.obj: (?!.*`v 1)"),
        ("a.obj", b"\xff\xfev\xd8", r"a\.obj: is no text, or a damaged one; expected a model"),
        ("a.gltf", b'{"asset": {"version": "1.0"}}', r"a\.gltf: expected glTF 2\.0"),
        ("a.gltf", b'{"asset": {"version": "2.0"}, "buf', r"a\.gltf: is no such model, or only a part of one"),
        ("a.obj", b"v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", r"of some size, found a point"),
        ("a.obj", b"v nan 1 1\nv 1 2 1\nv 1 1 1\nf 1 2 3\n", r"corner \d+: expected numbers within a thousand million"),
        (
            "a.gltf",
            b'{"asset": {"version": "2.0"}, "buffers": [{"uri": "a.bin", "byteLength": 4}]}',
            r"expected a\.bin",
        ),
    ],
)
def test_what_is_no_model_says_why(tmp_path: Path, name: str, data: bytes | None, said: str) -> None:
    path = tmp_path / name
    if data is not None:
        path.write_bytes(data)
    with pytest.raises(UsageError, match=said):
        read_model(path)


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-8-sig", "latin-1"])
def test_texts_of_other_systems_are_read_as_they_are(obj: Path, encoding: str) -> None:
    """As Windows has them, PowerShell above all, or with the line ends of an old Macintosh; MTL files as well."""
    for path, text in ((obj, _OBJ), (obj.parent / "two.mtl", _MTL)):
        path.write_bytes(f"# caf\u00e9\n{text}".replace("\n", "\r").encode(encoding))
    parts, unusable = read_model(obj)
    assert unusable == []
    assert sorted(part.material.texture is not None for part in parts) == [False, True]
    assert sum(len(part.triangles) for part in parts) == 3
    (obj.parent / "two.mtl").write_bytes(b"\xff\xfe\x00")
    assert read_model(obj)[1] == ["two.mtl, which is no list of materials, or only a part of one"]


def test_a_text_of_numbers_in_utf_16_is_read(tmp_path: Path) -> None:
    path = tmp_path / "box.off"
    path.write_bytes(trimesh.creation.box((1, 2, 3)).export(file_type="off").encode("utf-16"))
    assert len(read_model(path)[0][0].triangles) == 12


@pytest.mark.parametrize("ending", ["obj", "glb", "ply", "stl", "off"])
def test_damaged_files_are_read_or_refused(obj: Path, ending: str) -> None:
    """Cut off, or with bytes that are others: nothing but what a person is told comes out of it."""
    whole = obj.read_bytes()
    if ending == "glb":
        whole = _glb(obj.with_suffix(".glb"), metallicFactor=0.5).read_bytes()
    elif ending != "obj":
        whole = trimesh.creation.box((1, 2, 3)).export(file_type=ending)
        whole = whole.encode() if isinstance(whole, str) else whole
    path = obj.with_name(f"damaged.{ending}")
    seed = random.randrange(1 << 32)
    print(f"seed {seed}")
    chance = random.Random(seed)
    for _ in range(60):
        damaged = bytearray(whole[: chance.randrange(len(whole))] if chance.random() < 0.3 else whole)
        for _ in range(chance.randrange(6)):
            damaged[chance.randrange(len(damaged)) if damaged else 0 :][:1] = bytes([chance.randrange(256)])
            if damaged:
                damaged[chance.randrange(len(damaged))] = chance.randrange(256)
        path.write_bytes(damaged)
        try:
            parts, _ = read_model(path)
        except UsageError:
            continue
        write_nff(parts, path.with_suffix(".nff"))
        write_pbrt(parts, path.with_suffix(".pbrt"), textures="beside")


def _drawn(kit: BuiltKit, scene: Path, step: int) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]]:
    out = scene.with_suffix(".ppm")
    words = ["--step", str(step), "--size", "80x60", "--quiet"]
    outcome = run_program([kit.reference("raytrace"), scene, "-o", out, *words], seconds=60)
    assert outcome.code == 0, outcome.stderr
    return read_ppm(out).astype(np.float64)


def test_the_scene_of_part_two_shows_the_whole_model(whole_kit: BuiltKit, obj: Path) -> None:
    (obj.parent / "two.mtl").write_text(_MTL.replace("Ke 3 2 1\n", ""), encoding="utf-8")
    parts, _ = read_model(obj)
    cloth = [part for part in parts if part.material.texture is not None]
    path = obj.with_suffix(".pbrt")
    write_pbrt(cloth, path, textures="beside")
    assert (obj.parent / "two-1.png").is_file()
    picture = _drawn(whole_kit, path, 11)
    red, _, blue = np.moveaxis(picture, 2, 0)
    reddish, bluish = red > blue + 60, blue > red + 60
    assert reddish.sum() > 200
    assert bluish.sum() > 200
    assert np.argwhere(bluish)[:, 0].mean() < np.argwhere(reddish)[:, 0].mean(), "the upper half is blue"
    rows, columns = np.argwhere(reddish | bluish).T
    assert rows.min() > 0
    assert rows.max() < 59
    assert columns.min() > 0
    assert columns.max() < 79


def test_the_scene_of_part_one_has_the_mean_colour(kit: BuiltKit, obj: Path) -> None:
    parts, _ = read_model(obj)
    write_nff([part for part in parts if part.material.texture is not None], obj.with_suffix(".nff"))
    text = obj.with_suffix(".nff").read_text(encoding="utf-8")
    assert "f 0.5 0 0.5 " in text
    picture = _drawn(kit, obj.with_suffix(".nff"), 4)
    purple = (picture[..., 1] < 0.5 * picture[..., 0]) & (picture[..., 0] > 60)
    assert purple.sum() > 400


@pytest.mark.parametrize("size", [0.003, 7.0, 2e4])
def test_a_scene_is_as_large_as_shadows_need_it(tmp_path: Path, size: float) -> None:
    """Its acne threshold is 0.001 units."""
    path = tmp_path / "box.ply"
    path.write_bytes(trimesh.creation.box((size, size, size)).export(file_type="ply"))
    write_pbrt(read_model(path)[0], tmp_path / "box.pbrt", textures="beside")
    text = (tmp_path / "box.pbrt").read_text(encoding="utf-8")
    corners = np.array(text.split('"point3 P" [')[1].split("]")[0].split(), dtype=float).reshape(-1, 3)
    assert 1 <= np.linalg.norm(np.ptp(corners, axis=0)) <= 10
    digits = f"{size / np.ptp(corners[:, 0]):e}".split("e")[0]
    assert float(digits) == pytest.approx(1, rel=1e-4), "by a power of ten"


def test_without_textures_a_scene_is_one_file(obj: Path) -> None:
    write_pbrt(read_model(obj)[0], obj.with_suffix(".pbrt"), textures="none")
    text = obj.with_suffix(".pbrt").read_text(encoding="utf-8")
    assert '"rgb reflectance" [0.5 0 0.5]' in text
    assert "filename" not in text
    assert not list(obj.parent.glob("*.png"))


def test_with_textures_inside_a_scene_is_one_file_and_looks_the_same(whole_kit: BuiltKit, obj: Path) -> None:
    (obj.parent / "two.mtl").write_text(_MTL.replace("Ke 3 2 1\n", ""), encoding="utf-8")
    parts = read_model(obj)[0]
    parts += [replace(part, name="once more") for part in parts if part.material.texture is not None]
    write_pbrt(parts, obj.with_name("beside.pbrt"), textures="beside")
    (obj.parent / "alone").mkdir()
    alone = obj.parent / "alone" / "inside.pbrt"
    write_pbrt(parts, alone, textures="inside")
    assert [path.name for path in alone.parent.iterdir()] == ["inside.pbrt"]
    assert alone.read_text(encoding="utf-8").count("data:image/png;base64,") == 1, "one that two parts have stands once"
    beside = _drawn(whole_kit, obj.with_name("beside.pbrt"), 11)
    assert (_drawn(whole_kit, alone, 11) == beside).all()
    assert beside.std() > 20


def test_a_model_with_a_lamp_is_left_alone_with_it(obj: Path) -> None:
    write_pbrt(read_model(obj)[0], obj.with_suffix(".pbrt"), textures="beside")
    text = obj.with_suffix(".pbrt").read_text(encoding="utf-8")
    assert 'AreaLightSource "diffuse" "rgb L" [3 2 1]' in text
    assert "\nLightSource" not in text
    assert "# floor" not in text


@pytest.mark.parametrize("name", ["out.pbrt", "out.nff"])
def test_the_command_writes_the_scene_that_is_asked_for(project: Project, obj: Path, name: str) -> None:
    out = obj.with_name(name)
    console = Console(record=True, width=300)
    arguments = new_parser(project, "convert").parse_args(["convert", str(obj), "-o", str(out)])
    assert run(project, arguments, console) == 0
    said = console.export_text()
    assert "two.obj: 3 triangles of 2 materials" in said
    assert f"Scene: {out}" in said
    assert out.is_file()


def test_a_scene_to_write_has_a_name_that_says_what_it_is(project: Project, obj: Path) -> None:
    arguments = new_parser(project, "convert").parse_args(["convert", str(obj), "-o", "a.txt"])
    with pytest.raises(UsageError, match=r"a\.txt: expected the name of a scene to write, \.pbrt or \.nff"):
        run(project, arguments, Console())


def test_a_scene_that_has_no_textures_takes_no_word_about_them(project: Project, obj: Path) -> None:
    words = ["convert", str(obj), "-o", str(obj.with_suffix(".nff")), "--textures", "inside"]
    with pytest.raises(UsageError, match=r"--textures inside: expected SCENE\.pbrt; .+\.nff has mean colours"):
        run(project, new_parser(project, "convert").parse_args(words), Console())
    assert run(project, new_parser(project, "convert").parse_args(words[:4]), Console()) == 0


@pytest.mark.parametrize(("parts", "ending"), [("[1]", ".nff"), ("[1, 2]", ".pbrt")])
def test_other_commands_take_a_model_in_place_of_a_scene(
    project: Project, obj: Path, monkeypatch: pytest.MonkeyPatch, parts: str, ending: str
) -> None:
    course = obj.with_name("course.toml")
    course.write_text(f"parts = {parts}\n", encoding="utf-8")
    monkeypatch.setenv(COURSE_VARIABLE, str(course))
    found = Path(as_scene(project, str(obj)))
    assert found.is_relative_to(project.build / "models")
    assert found.suffix == ending, "part one has no textures"
    assert found.is_file()
    assert as_scene(project, "scenes/lessons/glass.nff") == "scenes/lessons/glass.nff"
    assert as_scene(project, "nowhere.obj") == "nowhere.obj"
