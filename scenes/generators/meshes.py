"""Curved bodies as meshes of few triangles, with normals and places in a texture, on a chequered floor: scenes of part
two, in pbrt's format (y up, and right-handed by a mirror)."""

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field

from .nff import number, numbers
from .vectors import Vec, add, cross, scale, sub, unit

_STEP = 1e-4
_Place = tuple[float, float]
_Body = Callable[[float, float], Vec]  # of u around and v along, both from 0 to 1


@dataclass
class MeshScene:
    """Collects lines."""

    lines: list[str] = field(default_factory=list)

    def view(
        self, eye: Vec, target: Vec, angle: float, background: Vec, lens: tuple[float, float] | None = None
    ) -> None:
        """`lens`: its radius, and the distance that is sharp."""
        self.lines += ["Scale -1 1 1", f"LookAt {numbers(eye)}  {numbers(target)}  0 1 0"]
        wide = f' "float lensradius" {number(lens[0])} "float focaldistance" {number(lens[1])}' if lens else ""
        self.lines += [f'Camera "perspective" "float fov" {number(angle)}{wide}']
        self.lines += ['Film "rgb" "integer xresolution" 512 "integer yresolution" 384', "WorldBegin"]
        self.lines.append(f'LightSource "infinite" "rgb L" [{numbers(background)}]')

    def light(self, position: Vec, color: Vec) -> None:
        self.lines.append(f'LightSource "point" "point3 from" [{numbers(position)}] "rgb I" [{numbers(color)}]')

    def lamp(self, light: str, *shape: str) -> None:
        self.lines += ["AttributeBegin", f'AreaLightSource "diffuse" {light}']
        self.lines += ['Material "diffuse" "rgb reflectance" [0 0 0]', *shape, "AttributeEnd"]

    def ball(self, material: str, middle: Vec, radius: float) -> None:
        self.lines += ["AttributeBegin", f"Material {material}", f"Translate {numbers(middle)}"]
        self.lines += [f'Shape "sphere" "float radius" {number(radius)}', "AttributeEnd"]

    def wall(self, start: tuple[float, float], end: tuple[float, float]) -> None:
        """From one place on the floor to another, 12 high."""
        (ax, az), (bx, bz) = start, end
        corners = [(ax, 0.0, az), (bx, 0.0, bz), (bx, 12.0, bz), (ax, 12.0, az)]
        places = "  ".join(numbers(corner) for corner in corners)
        self.lines += ['Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]', f'    "point3 P" [{places}]']

    def checks(self, name: str, often: tuple[float, float], first: Vec, second: Vec) -> None:
        self.lines.append(
            f'Texture "{name}" "spectrum" "checkerboard" "float uscale" {number(often[0])} "float vscale" '
            f'{number(often[1])} "rgb tex1" [{numbers(first)}] "rgb tex2" [{numbers(second)}]'
        )

    def floor(self, half: float) -> None:
        corners = [(-half, 0.0, half), (half, 0.0, half), (half, 0.0, -half), (-half, 0.0, -half)]
        self.mesh(corners, [(0.0, 1.0, 0.0)] * 4, [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)], [0, 1, 2, 0, 2, 3])

    def body(self, shape: _Body, around: int, along: int) -> None:
        """A grid of around x along squares, each of two triangles. The seam's corners are there twice, as u is 0 on one
        side of it and 1 on the other."""
        places = [(i / around, j / along) for j in range(along + 1) for i in range(around + 1)]
        rows = around + 1
        triangles: list[int] = []
        for j in range(along):
            for i in range(around):
                a = j * rows + i
                triangles += [a, a + 1, a + rows + 1, a, a + rows + 1, a + rows]
        self.mesh([shape(*uv) for uv in places], [_normal(shape, *uv) for uv in places], places, triangles)

    def mesh(self, positions: list[Vec], normals: list[Vec], uvs: list[_Place], indices: list[int]) -> None:
        self.lines += ['Shape "trianglemesh"', '    "point3 P" [']
        self.lines += [f"        {numbers(position)}" for position in positions]
        self.lines += ['    ] "normal N" [', *(f"        {numbers(normal)}" for normal in normals)]
        self.lines += ['    ] "point2 uv" [', *(f"        {numbers(uv)}" for uv in uvs), '    ] "integer indices" [']
        self.lines += [f"        {' '.join(map(str, indices[i : i + 12]))}" for i in range(0, len(indices), 12)]
        self.lines.append("    ]")

    def text(self, title: str) -> str:
        return "\n".join([f"# {title}", *self.lines]) + "\n"


def _normal(shape: _Body, u: float, v: float) -> Vec:
    around = sub(shape(u + _STEP, v), shape(u - _STEP, v))
    along = sub(shape(u, min(1.0, v + _STEP)), shape(u, max(0.0, v - _STEP)))
    return unit(cross(around, along))


def _turned(radius: float, height: float, u: float) -> Vec:
    angle = -2.0 * math.pi * u
    return (radius * math.cos(angle), height, radius * math.sin(angle))


def _scene(eye: Vec, target: Vec) -> MeshScene:
    scene = MeshScene()
    scene.view(eye, target, 36.0, (0.45, 0.55, 0.7))
    scene.light((4.0, 6.0, 5.0), (0.75, 0.72, 0.66))
    scene.light((-6.0, 5.0, 2.0), (0.25, 0.28, 0.34))
    scene.checks("floor", (64.0, 64.0), (0.75, 0.72, 0.66), (0.12, 0.14, 0.2))
    scene.lines.append('Material "diffuse" "texture reflectance" "floor"')
    scene.floor(32.0)
    return scene


def _vase(rng: random.Random, place: Vec) -> _Body:
    belly, neck = 0.75 + 0.1 * rng.random(), 0.28 + 0.05 * rng.random()

    def outline(u: float, v: float) -> Vec:
        bulge = math.sin(math.pi * min(1.0, 1.25 * v)) ** 2
        lip = max(0.0, v - 0.8) ** 2
        return add(place, _turned(neck + (belly - neck) * bulge + 5.0 * lip, 2.2 * v, u))

    return outline


def vase(size: int, rng: random.Random) -> MeshScene:
    """A vase of 4 size times 3 size squares."""
    scene = _scene((0.6, 2.6, 6.0), (0.0, 1.0, 0.0))
    scene.checks("glaze", (16.0, 12.0), (0.85, 0.82, 0.74), (0.1, 0.25, 0.55))
    scene.lines.append('Material "phong" "texture reflectance" "glaze" "float ks" 0.12 "float shine" 40')
    scene.body(_vase(rng, (0.0, 0.0, 0.0)), 4 * size, 3 * size)
    return scene


def knot(size: int, rng: random.Random) -> MeshScene:
    """A ring with waves on it, of 8 size times 3 size squares, and a plain one beside it."""
    waves, start = 7, rng.random()

    def ring(middle: Vec, wave: float) -> _Body:
        def place(u: float, v: float) -> Vec:
            tube = 0.42 * (1.0 + wave * math.sin(2.0 * math.pi * (waves * u + 2.0 * v + start)))
            angle = 2.0 * math.pi * v
            return add(middle, _turned(1.0 + tube * math.cos(angle), tube * math.sin(angle), u))

        return place

    scene = _scene((0.4, 4.2, 6.6), (0.1, 0.4, -0.4))
    scene.checks("skin", (32.0, 8.0), (0.8, 0.55, 0.2), (0.45, 0.1, 0.12))
    scene.lines.append('Material "diffuse" "texture reflectance" "skin"')
    scene.body(ring((-0.5, 0.6, 0.3), 0.3), 8 * size, 3 * size)
    scene.lines.append('Material "phong" "rgb reflectance" [0.5 0.62 0.6] "float ks" 0.25 "float shine" 60')
    scene.body(ring(add((1.6, 0.42, -2.2), scale((0.0, 1.0, 0.0), 0.05)), 0.0), 4 * size, 2 * size)
    return scene


_AS_IS = '"bool remaproughness" false'  # the roughness is that of GGX


def studio(size: int, rng: random.Random) -> MeshScene:
    """Something for each step of part two: a vase of 4 size times 3 size squares, balls of metal, glass and paint before
    a red and a white wall, below a bulb that is a point, a lamp that has a size, and a window."""
    scene = MeshScene()
    scene.view((0.0, 2.7, 9.2), (0.0, 0.95, 0.0), 30.0, (0.06, 0.07, 0.09), lens=(0.06, 8.9))
    scene.light((2.5, 5.0, 6.0), (0.4, 0.37, 0.32))
    scene.lamp('"rgb L" [2.2 1.95 1.6]', "Translate -0.6 6 2", "Rotate 90 1 0 0", 'Shape "disk" "float radius" 1.8')
    scene.lamp(
        '"rgb L" [2.2 2.7 3.6]',
        'Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]',
        '    "point3 P" [5.5 0.4 4.5  5.5 0.4 -1.5  5.5 4.4 -1.5  5.5 4.4 4.5]',
    )
    scene.checks("floor", (48.0, 48.0), (0.7, 0.66, 0.6), (0.16, 0.18, 0.22))
    scene.lines.append('Material "diffuse" "texture reflectance" "floor"')
    scene.floor(24.0)
    scene.lines.append('Material "diffuse" "rgb reflectance" [0.72 0.7 0.66]')
    scene.wall((-3.6, -4.0), (24.0, -4.0))
    scene.lines.append('Material "diffuse" "rgb reflectance" [0.66 0.14 0.1]')
    scene.wall((-3.6, 24.0), (-3.6, -4.0))
    scene.checks("glaze", (16.0, 12.0), (0.85, 0.82, 0.74), (0.1, 0.25, 0.55))
    scene.lines.append('Material "phong" "texture reflectance" "glaze" "float ks" 0.12 "float shine" 40')
    scene.body(_vase(rng, (-1.75, 0.0, -0.6)), 4 * size, 3 * size)
    gold, copper = '"spectrum eta" "metal-Au-eta"', '"spectrum eta" "metal-Cu-eta"'
    scene.ball(f'"conductor" {gold} "float roughness" 0.15 {_AS_IS}', (1.95, 0.85, -0.2), 0.85)
    scene.ball('"conductor" "rgb reflectance" [0.9 0.9 0.92] "float roughness" 0', (0.25, 1.2, -2.3), 1.2)
    scene.ball('"dielectric" "float eta" 1.5', (0.35, 0.65, 1.1), 0.65)
    scene.ball(f'"conductor" {copper} "float roughness" 0.3 {_AS_IS}', (1.5, 0.4, 1.7), 0.4)
    scene.ball('"diffuse" "rgb reflectance" [0.8 0.78 0.74]', (-1.9, 0.42, 1.35), 0.42)
    scene.ball('"diffuse" "rgb reflectance" [0.12 0.4 0.24]', (-0.75, 0.36, 1.9), 0.36)
    return scene
