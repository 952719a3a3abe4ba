"""What the program inspect writes of one pixel: these classes are the form raysteps/inspect/v1."""

from dataclasses import dataclass, field
from typing import Annotated, Literal, TypedDict

from msgspec import Meta

from raysteps.common.documents import OPTIONAL, Count

Number = int | float | Literal["inf", "-inf", "nan"]  # one that is not finite is a word
Triple = Annotated[list[Number], Meta(min_length=3, max_length=3)]
Byte = Annotated[int, Meta(ge=0, le=255)]
Accel = Literal["none", "boxes", "octree", "bvh"]
Role = Literal["eye", "shadow", "reflect", "refract", "internal"]
Way = Literal["reflect", "refract"]
Reason = Literal[
    "not-chosen", "not-tested", "box-missed", "not-visited", "not-listed",
    "no-overlap", "no-box", "no-bounds", "no-part",
]  # fmt: skip


@dataclass
class SearchCounts:
    """What a search cost."""

    box_tests: Count
    boxes_entered: Count
    candidates: Count
    surface_tests: Count
    unique_surfaces: Count


@dataclass
class BoxEvent:
    """A box that was asked; `enter` is None where it was missed."""

    min: Triple
    max: Triple
    enter: Number | None
    leave: Number | None
    level: int | None
    listed: int | None


@dataclass
class SurfaceEvent:
    """A surface that was tested; `distance` is None where it was missed."""

    surface: Count
    distance: Number | None
    boxes_before: Count


@dataclass
class Fill:
    """What a surface looks like."""

    color: Triple
    kd: Number
    ks: Number
    shine: Number
    transmittance: Number
    index: Number


@dataclass
class Hit:
    """What the search answered, and what functions of the steps make of it."""

    surface: int | None  # None where it is no surface of the scene
    kind: str
    distance: Number
    position: Triple
    point_at: Triple
    normal: Triple
    ray_direction: Triple
    from_outside: bool
    mirrored: Triple | None
    refracted: Triple | None
    fill: Fill


@dataclass
class Extent:
    """The corners of a box."""

    min: Triple
    max: Triple


@dataclass
class Missed:
    """A nearer surface that the search did not find."""

    surface: Count
    kind: str
    distance: Number
    reason: Reason
    box: Extent | None


@dataclass
class Start:
    """Where a shadow ray begins, and where it goes."""

    origin: Triple
    direction: Triple


@dataclass
class LightShare:
    """One light at a hit: its shadow rays, and the terms of its light."""

    light: Count
    lit: bool
    shadow_ray: Start | None
    to_light: Triple
    mirrored: Triple
    l_n: Number
    r_v: Number
    diffuse: Triple
    specular: Triple
    rays: list["Ray"]


@dataclass
class LampSample:
    """One sample of an area light at a hit, from step 12 on. No ray is sent for one that is black unshadowed."""

    lamp: Count
    shape: Literal["triangle", "sphere", "disk"]
    radiance: Triple
    lit: bool
    position: Triple
    normal: Triple
    pdf: Number  # by solid angle, per steradian as seen from the hit
    unshadowed: Triple  # what it brings to the hit where nothing stands between
    scatter_pdf: Number | None  # with which the path would go there; None before step 15, and where it brings nothing
    weight: Number | None  # of the two ways, by step 15
    brought: Triple
    rays: list["Ray"]

    @property
    def is_dark(self) -> bool:
        return not any(float(channel) > 0 for channel in self.unshadowed)


@dataclass
class Scattered:
    """Where a path goes on, and what light from there counts."""

    direction: Triple
    weight: Triple
    pdf: Number
    specular: bool


@dataclass
class PathStep:
    """What happened at a hit of a path, from step 13 on."""

    lamps: Triple | None  # what one sample of each lamp brought; None: nobody asked
    scatter: Scattered | None  # None: the path ends there


@dataclass
class Ray:
    """One ray, and all that comes of it."""

    role: Role
    depth: Count
    origin: Triple
    direction: Triple
    limit: Number | None
    any: bool | None
    counts: SearchCounts
    boxes: list[BoxEvent]
    tests: list[SurfaceEvent]
    hit: Hit | None
    missed: Missed | None
    lights: list[LightShare]
    direct: Triple | None
    transmitted: Triple | None
    local: Triple | None
    path: PathStep | None
    bounces: list["Ray"]
    color: Triple | None
    lamps: list[LampSample] = field(default_factory=list, metadata=OPTIONAL)
    lamps_beyond: Count = field(default=0, metadata=OPTIONAL)  # further samples, which are not kept

    @property
    def way(self) -> str:
        """The role; glass that mirrors inside does so where it would refract."""
        return "refract" if self.role == "internal" else self.role

    def bounces_of(self, way: Way) -> list["Ray"]:
        return [bounce for bounce in self.bounces if bounce.way == way]


@dataclass
class Pixel:
    """Its place in the picture."""

    x: Count
    y: Count


Camera = TypedDict(  # a dataclass has no field that is called `from`
    "Camera", {"from": Triple, "at": Triple, "up": Triple, "angle": Number, "width": Count, "height": Count}
)


@dataclass
class Frame:
    """Step 01's answer."""

    right: Triple
    up: Triple
    forward: Triple
    half_width: Number
    half_height: Number


@dataclass
class Light:
    """A light of the scene."""

    position: Triple
    color: Triple


@dataclass
class Structure:
    """What was built to search in."""

    boxes: Count
    references: Count


@dataclass
class RayCounts:
    """Rays of the pixel."""

    eye: Count
    shadow: Count
    reflect: Count
    refract: Count

    @property
    def all(self) -> int:
        return self.eye + self.shadow + self.reflect + self.refract


@dataclass
class LeftOut:
    """What was too much for the record."""

    rays: Count
    boxes: Count
    tests: Count


@dataclass
class NearSurface:
    """A surface near the rays, for pictures of them."""

    surface: Count
    kind: Literal["sphere", "hollow-sphere", "triangle", "smooth-triangle", "cone", "disk", "other"]
    points: list[Triple]
    radii: list[Number]
    color: Triple


@dataclass
class Record:
    """The life of one pixel."""

    schema: Literal["raysteps/inspect/v1"]
    scene: str
    surfaces: Count
    step: Annotated[int, Meta(ge=1, le=99)]
    view: Literal["color", "normals"]
    depth: Annotated[int, Meta(ge=1)]
    accel: Accel
    pixel: Pixel
    camera: Camera
    frame: Frame
    background: Triple
    lights: list[Light]
    structure: Structure
    ray: Ray
    endless: bool
    color: Triple | None
    mapped: Triple | None
    bytes: Annotated[list[Byte], Meta(min_length=3, max_length=3)] | None
    rays: RayCounts
    counts: SearchCounts
    left_out: LeftOut
    near: list[NearSurface]
    sample: Annotated[int, Meta(ge=1)] | None = field(default=None, metadata=OPTIONAL)  # nothing: the pixel's middle

    @property
    def is_of_part_two(self) -> bool:
        """Where step 10 shows the colour, as render/integrator.hpp says."""
        return 10 <= self.step < 20

    @property
    def follows_paths(self) -> bool:
        """Where light comes along paths, as render/integrator.hpp says."""
        return self.is_of_part_two and self.step >= 13
