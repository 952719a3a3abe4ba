"""The scene around a model: a camera that sees all of it, light, and a floor; as pbrt's format has it, or NFF."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from dataclasses import replace
from io import BytesIO
from itertools import zip_longest
from pathlib import Path

import numpy as np

from raysteps.common.files import write_out
from raysteps.models import TexturePlace
from raysteps.models.mesh_file import Floats, Material, MeshPart, mean_color

_WIDTH, _HEIGHT = 640, 480
_ANGLE = 35.0  # degrees, upright
_FROM = np.array([0.55, 0.4, 1.0]) / np.linalg.norm([0.55, 0.4, 1.0])
_MARGIN = 1.08
_LIGHTS = (  # where to, and how bright: the sun, and a little from the other side for the shadows
    (np.array([0.3, 1.0, 0.6]), np.array([0.8, 0.77, 0.71])),
    (np.array([-1.0, 0.6, 0.7]), np.array([0.16, 0.18, 0.22])),
)
_SKY = np.array([0.28, 0.35, 0.45])  # from step 13 on it lights, too
_IN_PART_ONE = 2.0  # so much brighter, since c / (c + 1) makes it darker
_FLOOR = Material(np.array([0.55, 0.53, 0.5]))


def _row(values: Floats) -> str:
    return " ".join(f"{value:.7g}" for value in values)


def _rows(values: Floats) -> str:
    return "\n".join(map(_row, values))


def _used(parts: Sequence[MeshPart]) -> Floats:
    """The corners of all triangles."""
    return np.concatenate([part.positions[part.triangles.reshape(-1)] for part in parts])


def _sized(parts: Sequence[MeshPart]) -> list[MeshPart]:
    """1 to 10 units large, by a power of ten: shadow rays start 0.001 off a surface."""
    corners = _used(parts)
    size = np.linalg.norm(np.ptp(corners, axis=0))
    return [replace(part, positions=part.positions * 10.0 ** -np.floor(np.log10(size))) for part in parts]


def _view(corners: Floats) -> tuple[Floats, Floats]:
    """From where to where: as near as all corners are seen."""
    center = (corners.min(axis=0) + corners.max(axis=0)) / 2
    right = np.cross([0, 1, 0], _FROM)
    right /= np.linalg.norm(right)
    across, up, near = np.stack([right, np.cross(_FROM, right), _FROM]) @ (corners - center).T
    slope = np.tan(np.radians(_ANGLE) / 2)
    far = np.max(near + np.maximum(np.abs(up), np.abs(across) * _HEIGHT / _WIDTH) / slope)
    return center + _MARGIN * far * _FROM, center


def _floor(corners: Floats) -> MeshPart:
    """A square below everything, ten times as wide; a little lower, so that it does not lie in another one."""
    low, high = corners.min(axis=0), corners.max(axis=0)
    size = float(np.linalg.norm(high - low))
    x, z = (low + high)[[0, 2]] / 2
    y = low[1] - 1e-3 * size
    positions = np.array([[x + 5 * size * i, y, z + 5 * size * k] for i, k in ((-1, 1), (1, 1), (1, -1), (-1, -1))])
    return MeshPart("floor", positions, None, None, np.array([[0, 1, 2], [0, 2, 3]]), _FLOOR)


def _all_of(parts: Sequence[MeshPart], corners: Floats) -> tuple[list[MeshPart], bool]:
    """What is drawn, and whether the model brings its own light; then it is left alone with it."""
    lit = any(part.material.emission.any() for part in parts)
    return [*parts, *([] if lit else [_floor(corners)])], lit


def _plain_color(part: MeshPart) -> Floats:
    """Without its texture."""
    material = part.material
    if material.texture is None or part.uvs is None:
        return material.color
    return mean_color(material.texture)


def _pbrt_material(part: MeshPart, texture: str | None) -> Iterator[str]:
    material = part.material
    if material.metal_roughness is not None:
        yield (
            f'Material "conductor" "rgb reflectance" [{_row(material.color)}] '
            f'"float roughness" {material.metal_roughness:.4g} "bool remaproughness" false'
        )
        return
    if texture is not None:
        reflectance = f'"texture reflectance" "{texture}"'
    else:
        reflectance = f'"rgb reflectance" [{_row(_plain_color(part))}]'
    if material.ks:
        yield f'Material "phong" {reflectance} "float ks" {min(material.ks, 1):.4g} "float shine" {material.shine:.4g}'
    else:
        yield f'Material "diffuse" {reflectance}'


def _pbrt_part(part: MeshPart, texture: str | None) -> Iterator[str]:
    yield f"\n# {' '.join(part.name.split())}\nAttributeBegin"
    if part.material.emission.any():
        yield f'AreaLightSource "diffuse" "rgb L" [{_row(part.material.emission)}]'
    yield from _pbrt_material(part, texture)
    yield f'Shape "trianglemesh" "point3 P" [\n{_rows(part.positions)}\n]'
    if part.normals is not None:
        yield f'"normal N" [\n{_rows(part.normals)}\n]'
    if part.uvs is not None and texture is not None:
        yield f'"point2 uv" [\n{_rows(part.uvs)}\n]'
    rows = "\n".join(" ".join(map(str, row)) for row in part.triangles.tolist())
    yield f'"integer indices" [\n{rows}\n]\nAttributeEnd'


def _pbrt_lines(parts: Sequence[MeshPart], textures: Sequence[str | None], files: dict[str, str]) -> Iterator[str]:
    corners = _used(parts)
    eye, center = _view(corners)
    drawn, lit = _all_of(parts, corners)
    yield "Scale -1 1 1"
    yield f"LookAt {_row(eye)}  {_row(center)}  0 1 0"
    yield f'Camera "perspective" "float fov" {_ANGLE:g}'
    yield f'Film "rgb" "integer xresolution" {_WIDTH} "integer yresolution" {_HEIGHT}'
    yield "WorldBegin"
    if not lit:
        for place, color in _LIGHTS:
            yield f'LightSource "distant" "point3 from" [{_row(place)}] "point3 to" [0 0 0] "rgb L" [{_row(color)}]'
        yield f'LightSource "infinite" "rgb L" [{_row(_SKY)}]'
    for name, file in files.items():
        yield f'Texture "{name}" "spectrum" "imagemap" "string filename" "{file}"'
    for part, texture in zip_longest(drawn, textures):  # the floor has none
        yield from _pbrt_part(part, texture)


def _textures_of(parts: Sequence[MeshPart], path: Path, where: TexturePlace) -> tuple[list[str | None], dict[str, str]]:
    """The name of each part's texture, and what stands for the file of each name: that of a PNG which is written beside
    the scene, or the PNG itself (RFC 2397)."""
    names: list[str | None] = []
    files: dict[bytes, str] = {}  # by what they hold: several parts may have the same
    for part in parts:
        image = part.material.texture
        if where == "none" or image is None or part.uvs is None:
            names.append(None)
            continue
        data = BytesIO()
        image.save(data, "PNG")
        png = data.getvalue()
        if png not in files:
            files[png] = f"data:image/png;base64,{b64encode(png).decode()}"
            if where == "beside":
                files[png] = f"{path.stem}-{len(files)}.png"
                write_out(path.with_name(files[png]), png)
        names.append(f"texture-{1 + list(files).index(png)}")
    return names, {f"texture-{number}": file for number, file in enumerate(files.values(), 1)}


def write_pbrt(parts: Sequence[MeshPart], path: Path, *, textures: TexturePlace) -> None:
    """The scene, and its textures where they are wanted."""
    parts = _sized(parts)
    lines = _pbrt_lines(parts, *_textures_of(parts, path, textures))
    write_out(path, ("\n".join(lines) + "\n").encode())


def _nff_lines(parts: Sequence[MeshPart]) -> Iterator[str]:
    corners = _used(parts)
    eye, center = _view(corners)
    yield f"b {_row(_IN_PART_ONE * _SKY)}"
    yield f"v\nfrom {_row(eye)}\nat {_row(center)}\nup 0 1 0\nangle {_ANGLE:g}\nhither 0"
    yield f"resolution {_WIDTH} {_HEIGHT}"
    far = np.linalg.norm(eye - center)
    for place, color in _LIGHTS:
        yield f"l {_row(center + 100 * far * place)} {_row(_IN_PART_ONE * color)}"
    for part in (*parts, _floor(corners)):
        material = part.material
        yield f"# {' '.join(part.name.split())}"
        mirrors = 0.5 if material.metal_roughness is not None else min(material.ks, 1.0)
        yield f"f {_row(_plain_color(part))} {1 - mirrors:.4g} {mirrors:.4g} {material.shine:.4g} 0 1"
        for triangle in part.triangles:
            corners = part.positions[triangle]
            if part.normals is None or not part.normals[triangle].any(axis=1).all():
                yield f"p 3\n{_rows(corners)}"
            else:
                yield f"pp 3\n{_rows(np.hstack([corners, part.normals[triangle]]))}"


def write_nff(parts: Sequence[MeshPart], path: Path) -> None:
    """For part one: every texture as the one colour that it has from far away."""
    write_out(path, ("\n".join(_nff_lines(_sized(parts))) + "\n").encode())
