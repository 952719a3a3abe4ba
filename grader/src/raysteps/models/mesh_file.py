"""What a file of meshes and materials holds: OBJ with MTL, glTF, PLY, STL and OFF, read by trimesh."""

import io
import json
import logging
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import trimesh
from numpy.typing import NDArray
from PIL import Image
from trimesh.resolvers import FilePathResolver
from trimesh.visual.material import PBRMaterial, SimpleMaterial
from trimesh.visual.texture import TextureVisuals

from raysteps.common.errors import UsageError, reason
from raysteps.common.text import count, printable
from raysteps.images.noise import as_picture
from raysteps.models import ENDINGS
from raysteps.submission.encoding import decode
from raysteps.submission.entries import RejectedFile

EXPECTED = "expected a model: .obj, .gltf, .glb, .ply, .stl or .off"
Floats = NDArray[np.float64]

_GREY = np.full(3, 0.7)
_FARTHEST = 1e9  # as the readers of scenes have it
_LONGEST_SIDE = 8192  # of a texture, likewise
_LARGEST_FILE = 1 << 30
_PICTURES = (".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tga")
_TEXTS = (".obj", ".mtl", ".off", ".gltf")  # the others may be binary
_MAX_CORNERS = 1 << 24  # a scene counts them in single precision


@dataclass(frozen=True)
class Material:
    """What a surface makes of light; colours are linear, from 0 to 1."""

    color: Floats = field(default_factory=_GREY.copy)
    texture: Image.Image | None = None  # in place of the colour; bent by sRGB's curve
    ks: float = 0.0
    shine: float = 30.0
    metal_roughness: float | None = None  # alpha of GGX; None: no metal
    emission: Floats = field(default_factory=lambda: np.zeros(3))


@dataclass(frozen=True)
class MeshPart:
    """Triangles of one material, y up."""

    name: str
    positions: Floats  # (n, 3)
    normals: Floats | None  # (n, 3), of length 1 or 0
    uvs: Floats | None  # (n, 2), u to the right, v up
    triangles: NDArray[np.int64]  # (m, 3)
    material: Material


def srgb_to_linear(bent: Floats) -> Floats:
    """From sRGB to linear, both from 0 to 1 (IEC 61966-2-1)."""
    return np.where(bent <= 0.04045, bent / 12.92, ((bent + 0.055) / 1.055) ** 2.4)


def _parts_of(image: Image.Image) -> Floats:
    """(height, width, 3), from 0 to 1, as the file has it."""
    return np.asarray(image.convert("RGB"), dtype=np.float64) / 255


def mean_color(image: Image.Image) -> Floats:
    """What a texture looks like from far away, linear."""
    found: Floats = srgb_to_linear(_parts_of(image)).mean(axis=(0, 1))
    return found


def _rgb(value: Any) -> Floats:
    """What trimesh makes of a colour: bytes, or numbers from 0 to 1."""
    found = np.asarray(value)
    return (found[:3].astype(np.float64) / (255 if found.dtype.kind in "ui" else 1)).clip(0, 1)


def _tinted(image: Image.Image, factor: Floats) -> Image.Image:
    if (factor == 1).all():
        return image.convert("RGB")
    return Image.fromarray(as_picture(factor * srgb_to_linear(_parts_of(image))))


def _of_obj(material: SimpleMaterial) -> Material:
    """The light that MTL calls Kd, Ks, Ns, Ke and map_Kd."""
    words = material.kwargs.get("ke", ())
    emission = np.array([float(word) for word in words]) if len(words) == 3 else np.zeros(3)
    texture = None if material.image is None else material.image.convert("RGB")
    ks = float(_rgb(material.specular).mean()) if "ks" in material.kwargs else 0.0
    color = _rgb(material.diffuse) if "kd" in material.kwargs or texture is None else np.ones(3)
    return Material(color, texture, ks, max(float(material.glossiness), 1.0), None, emission.clip(0))


def _factor(value: float | None, texture: Image.Image | None, channel: int) -> float:
    """1 where the file says nothing, times what its texture has on average (glTF 2.0, 3.9.2)."""
    share = 1.0 if texture is None else float(_parts_of(texture)[..., channel].mean())
    return (1.0 if value is None else float(value)) * share


def _of_gltf(material: PBRMaterial) -> Material:
    """glTF 2.0, 3.9: metal is all or nothing here, and alpha of GGX the square of its roughness."""
    color = np.ones(3) if material.baseColorFactor is None else _rgb(material.baseColorFactor)
    texture = None if material.baseColorTexture is None else _tinted(material.baseColorTexture, color)
    both = material.metallicRoughnessTexture
    roughness = _factor(material.roughnessFactor, both, 1) ** 2
    glows = material.emissiveFactor is not None and material.emissiveTexture is None
    emission = np.array(material.emissiveFactor, dtype=np.float64) if glows else np.zeros(3)
    if _factor(material.metallicFactor, both, 2) >= 0.5:
        return Material(color if texture is None else mean_color(texture), metal_roughness=roughness, emission=emission)
    shine = float(np.clip(2 / max(roughness, 0.01) ** 2 - 2, 1, 1000))  # Blinn's exponent of the same width
    return Material(color, texture, 0.04, shine, None, emission)


def _material(mesh: trimesh.Trimesh, *, linear: bool) -> Material:
    visual = mesh.visual
    if isinstance(visual, TextureVisuals):
        if isinstance(visual.material, PBRMaterial):
            return _of_gltf(visual.material)
        return _of_obj(visual.material) if isinstance(visual.material, SimpleMaterial) else Material()
    if visual is None or not visual.defined:
        return Material()
    colors = np.asarray(visual.vertex_colors if visual.kind == "vertex" else visual.face_colors)[:, :3] / 255
    return Material((colors if linear else srgb_to_linear(colors)).mean(axis=0))


def _normals(mesh: trimesh.Trimesh, turn: Floats) -> Floats | None:
    """Those of the file; others are made of neighbours, and round what is meant to have edges."""
    if "vertex_normals" not in mesh._cache.cache:
        return None
    found = np.nan_to_num(np.asarray(mesh.vertex_normals, dtype=np.float64) @ np.linalg.inv(turn), posinf=0, neginf=0)
    lengths = np.linalg.norm(found, axis=1, keepdims=True)
    unit: Floats = np.divide(found, lengths, out=np.zeros_like(found), where=lengths > 0)
    return unit


def _part(path: Path, name: str, mesh: trimesh.Trimesh, place: Floats) -> MeshPart:
    """The mesh where a 4 x 4 matrix puts it."""
    where = path if name == path.name else f"{path}: {name}"
    turn = place[:3, :3]
    positions = np.asarray(mesh.vertices, dtype=np.float64) @ turn.T + place[:3, 3]
    triangles = np.asarray(mesh.faces, dtype=np.int64)
    if not (np.abs(positions) <= _FARTHEST).all():  # NaN is not, either
        at = int(np.argmin((np.abs(positions) <= _FARTHEST).all(axis=1)))
        raise UsageError(
            f"{where}: corner {at}: expected numbers within a thousand million of 0, found {positions[at]}"
        )
    if triangles.size and not (triangles.min() >= 0 and triangles.max() < len(positions)):
        raise UsageError(
            f"{where}: expected numbers of corners from 0 to {len(positions) - 1}, found "
            f"{triangles.min()} to {triangles.max()}"
        )
    uvs = mesh.visual.uv if isinstance(mesh.visual, TextureVisuals) else None
    fits = uvs is not None and len(uvs) == len(positions)
    places = np.nan_to_num(np.asarray(uvs, dtype=np.float64)[:, :2], posinf=0, neginf=0) if fits else None
    material = _material(mesh, linear=path.suffix.lower() in (".gltf", ".glb"))
    return MeshPart(name, positions, _normals(mesh, turn), places, triangles, material)


def _turned(part: MeshPart) -> MeshPart:
    """With y up instead of z."""
    turn = np.array([[1, 0, 0], [0, 0, 1], [0, -1, 0]], dtype=np.float64)
    normals = None if part.normals is None else part.normals @ turn.T
    return MeshPart(part.name, part.positions @ turn.T, normals, part.uvs, part.triangles, part.material)


def _check(path: Path, parts: Sequence[MeshPart]) -> None:
    corners = [part.positions[part.triangles.reshape(-1)] for part in parts]
    if sum(map(len, corners)) > _MAX_CORNERS:
        raise UsageError(f"{path}: expected at most {_MAX_CORNERS // 3} triangles, found {sum(map(len, corners)) // 3}")
    if not corners:
        raise UsageError(f"{path}: expected triangles, found none")
    every = np.concatenate(corners)
    if (every == every[0]).all():
        raise UsageError(f"{path}: expected triangles of some size, found a point")
    for part in parts:
        if part.material.texture and max(part.material.texture.size) > _LONGEST_SIDE:
            raise UsageError(f"{path}: {part.name}: expected a texture of at most {_LONGEST_SIDE} pixels a side")


def _plain(path: Path, data: bytes) -> bytes:
    """What is a text, in UTF-8 and with the line ends that trimesh knows."""
    if path.suffix.lower() not in _TEXTS:
        return data
    try:
        return decode(data).source
    except RejectedFile as error:
        raise UsageError(f"{path}: is no text, or a damaged one; {EXPECTED}") from error


class _CompanionFiles(FilePathResolver):
    """The files that a model names, from wherever it was written; what cannot be used is kept in mind, since trimesh
    goes on without it."""

    def __init__(self, model: Path) -> None:
        super().__init__(os.fspath(model), allow_anywhere=True)
        self.missing: list[str] = []
        self.broken: dict[str, str] = {}  # what each should be

    @property
    def notes(self) -> list[str]:
        return [
            *(f"{name}, which is not there" for name in self.missing),
            *(f"{name}, which is no {kind}, or only a part of one" for name, kind in self.broken.items()),
        ]

    def get(self, name: str) -> bytes:
        path = self.absolute(name.replace("\\", "/"))
        try:
            if not path.is_file() or path.stat().st_size > _LARGEST_FILE:  # no pipe, which may never end
                raise FileNotFoundError(name)
            data = path.read_bytes()
        except OSError:
            self.missing.append(name)
            raise
        is_picture = path.suffix.lower() in _PICTURES
        try:
            if not is_picture:
                return _plain(path, data)
            Image.open(io.BytesIO(data)).load()
        except Exception as error:  # Pillow's many, and what is no text
            self.broken[name] = "picture" if is_picture else "list of materials"
            raise FileNotFoundError(name) from error
        return data


class _Said(logging.Handler):
    """What trimesh warns of."""

    def __init__(self) -> None:
        super().__init__(logging.WARNING)
        self.lines: list[str] = []

    def emit(self, record: logging.LogRecord) -> None:
        self.lines.append(record.getMessage())


def _load(path: Path, beside: _CompanionFiles) -> list[MeshPart]:
    logger = logging.getLogger("trimesh")
    said = _Said()
    logger.addHandler(said)
    try:
        with io.BytesIO(_plain(path, path.read_bytes())) as file, np.errstate(all="ignore"):
            ending = path.suffix.lower().removeprefix(".")
            if ending == "gltf":
                json.load(file)  # where it is none, trimesh looks for another file
                file.seek(0)
            scene = trimesh.load_scene(file, file_type=ending, resolver=beside, process=False)
            parts = []
            for node in scene.graph.nodes_geometry:
                place, name = scene.graph[node]
                mesh = scene.geometry[name]
                if isinstance(mesh, trimesh.Trimesh) and len(mesh.faces):
                    parts.append(_part(path, str(name), mesh, place))
    finally:
        logger.removeHandler(said)
    packed = next((line for line in said.lines if "didn't decode" in line), None)
    if packed is not None:
        raise UsageError(f"{path}: expected a model that is not packed; save it without that. Found: {packed}")
    return parts


_NUMBERS = {"v": 3, "vn": 3, "vt": 1}  # of each line of an OBJ file, at least


def _wrong_line(path: Path) -> str:
    """Of an OBJ file that trimesh stumbled over: the first line that is wrong, and why; empty where none is."""
    text = _plain(path, path.read_bytes()).decode()
    if "\\\n" in text:  # a line that goes on in the next one
        return ""
    lines = [line.split() or [""] for line in text.split("\n")]
    corners = sum(line[0] == "v" for line in lines)
    for number, (kind, *words) in enumerate(lines, start=1):
        wanted = _NUMBERS.get(kind, 0)
        expected = f"{count(wanted, 'number')} after `{kind}`"
        try:
            is_right = len([float(word) for word in words[:wanted]]) == wanted
            if kind == "f":
                expected = f"numbers of corners from 1 to {corners}"
                is_right = all(1 <= abs(int(word.partition("/")[0])) <= corners for word in words)
        except ValueError:
            is_right = False
        if not is_right:
            return f"{path}:{number}: expected {expected}, found `{printable(' '.join([kind, *words])[:40])}`"
    return ""


def _fault(error: Exception) -> str:
    """What trimesh stumbled over, for the person whose file it is."""
    said = reason(error) if isinstance(error, OSError) else f"{type(error).__name__}: {error}"
    if isinstance(error, NotImplementedError):
        return f"expected glTF 2.0 where it is glTF; found: {error}"
    if "out of bounds" in said:
        return f"a face names a corner that is not there; found: {error}"
    return f"is no such model, or only a part of one; {EXPECTED}, found: {said}"


def read_model(path: Path, *, z_up: bool = False) -> tuple[list[MeshPart], list[str]]:
    """The parts of a model, and which files it asks for that cannot be used, and why."""
    if path.suffix.lower() not in ENDINGS:
        raise UsageError(f"{path}: {EXPECTED}")
    if not path.is_file():
        raise UsageError(f"{path}: is {'a folder' if path.is_dir() else 'not there'}; {EXPECTED}")
    beside = _CompanionFiles(path)
    try:
        parts = _load(path, beside)
    except UsageError:
        raise
    except Exception as error:  # trimesh lets pass whatever goes wrong in it with a broken file
        if beside.missing:
            raise UsageError(f"{path}: expected {beside.missing[0]} beside it, found nothing there") from error
        where = _wrong_line(path) if path.suffix.lower() == ".obj" else ""
        raise UsageError(where or f"{path}: {_fault(error)}") from error
    _check(path, parts)
    return [_turned(part) for part in parts] if z_up else parts, beside.notes
