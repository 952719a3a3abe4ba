"""A scene under construction, and its text in NFF 3.1 (right-handed, y up)."""

from collections.abc import Sequence
from dataclasses import dataclass, field

from .vectors import Vec


@dataclass(frozen=True)
class Material:
    """The `f` line: diffuse colour, kd, ks, shine, T and index of refraction."""

    color: Vec
    kd: float = 0.8
    ks: float = 0.0
    shine: float = 1.0
    transmittance: float = 0.0
    index: float = 1.0


def number(value: float) -> str:
    """Five decimals without trailing zeros. Coarse enough to hide the last digit of a system's sine."""
    text = f"{value:.5f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def numbers(values: Sequence[float]) -> str:
    return " ".join(number(value) for value in values)


@dataclass
class Scene:
    """Collects lines. Set the camera first, then lights, then materials each followed by its surfaces."""

    lines: list[str] = field(default_factory=list)

    def camera(self, background: Vec, eye: Vec, target: Vec, angle: float = 45.0) -> None:
        self.lines += [f"b {numbers(background)}", "v", f"from {numbers(eye)}", f"at {numbers(target)}"]
        self.lines += ["up 0 1 0", f"angle {number(angle)}", "hither 0.01", "resolution 512 512"]

    def light(self, position: Vec, color: Vec | None = None) -> None:
        tail = "" if color is None else " " + numbers(color)
        self.lines.append(f"l {numbers(position)}{tail}")

    def material(self, fill: Material) -> None:
        values = (fill.kd, fill.ks, fill.shine, fill.transmittance, fill.index)
        self.lines.append(f"f {numbers(fill.color)} {numbers(values)}")

    def sphere(self, center: Vec, radius: float) -> None:
        self.lines.append(f"s {numbers(center)} {number(radius)}")

    def cylinder(self, base: Vec, apex: Vec, radius: float) -> None:
        self.lines += ["c", f"{numbers(base)} {number(radius)}", f"{numbers(apex)} {number(radius)}"]

    def polygon(self, corners: Sequence[Vec]) -> None:
        """Counter-clockwise as seen from the front."""
        self.lines.append(f"p {len(corners)}")
        self.lines += [numbers(corner) for corner in corners]

    def floor(self, half: float, height: float) -> None:
        """A square around the y axis that faces up."""
        corners = ((-half, half), (half, half), (half, -half), (-half, -half))
        self.polygon([(x, height, z) for x, z in corners])

    def text(self, title: str) -> str:
        return "\n".join([f"# {title}", *self.lines]) + "\n"
