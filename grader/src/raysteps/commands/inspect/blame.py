"""Which function a difference points to."""

from raysteps.commands.inspect.values import CLOSE, Record, Vector, as_float, brief, dot, length, minus, same_direction

_FARTHEST_START = 0.011  # what the contracts allow is 0.01
_LEAST_START = 2e-4  # the contracts name 0.001
_SAME_START = 1e-4
_OWN = {"sphere": "Sphere", "triangle": "Triangle", "smooth-triangle": "Triangle"}
_SEARCH = {
    "none": ("closest_hit", "closest_hit"),
    "boxes": ("closest_hit", "closest_hit"),
    "octree": ("closest_hit_in", "any_hit_in"),
    "bvh": ("closest_hit_in_bvh", "any_hit_in_bvh"),
}
_SPACE = {"no-bounds": "bounds_of", "no-part": "split"}
_BUILD = {"none": "closest_hit", "boxes": "split", "octree": "build_octree", "bvh": "build_bvh"}


def intersect_of(kind: str) -> str:
    """The step's function that meets a surface of this kind; nothing for one that the framework meets."""
    return f"{_OWN[kind]}::intersect" if kind in _OWN else ""


def lost_by(missed: Record, accel: str, *, shadow: bool) -> str:
    """Why a surface was not found, although its own intersect finds it."""
    reason = missed["reason"]
    if reason == "box-missed":
        return "Box::clip"
    if reason == "no-overlap":
        return f"{_OWN[missed['kind']]}::overlaps" if missed["kind"] in _OWN else _BUILD[accel]
    if reason in _SPACE:
        return _SPACE[reason]
    if reason in ("not-listed", "no-box"):
        return _BUILD[accel]
    return _SEARCH[accel][shadow]


def _answer(ray: Record, surface: int) -> tuple[bool, float | None]:
    """Whether the ray asked the surface, and at which distance it was hit."""
    for test in ray["tests"]:
        if test["surface"] == surface:
            return True, None if test["distance"] is None else as_float(test["distance"])
    return False, None


def _changed_on_the_way(ray: Record) -> bool:
    """Whether the search gave a hit that no surface had answered."""
    hit = ray["hit"]
    if hit is None:
        return False
    if hit["surface"] is None:
        return True
    asked, distance = _answer(ray, hit["surface"])
    return asked and (distance is None or abs(distance - as_float(hit["distance"])) > CLOSE * max(1.0, distance))


def blame_hit(mine: Record, reference: Record, accel: str) -> str:
    """The same ray meets another surface, or none, or at another distance."""
    shadow = mine["role"] == "shadow"
    if mine["missed"] is not None:
        return lost_by(mine["missed"], accel, shadow=shadow)
    if _changed_on_the_way(mine):
        return _SEARCH[accel][shadow]
    nearest = reference["hit"]
    own = mine["hit"]
    too_far = own is None or (nearest is not None and as_float(own["distance"]) >= as_float(nearest["distance"]))
    culprit = nearest if too_far and nearest is not None else own
    return intersect_of(culprit["kind"]) if culprit is not None else ""


def start_problem(ray: Record, hit: Record, side: int) -> str:
    """What is wrong with where a ray begins; `side`: 1 where the normal points to, -1 behind the surface."""
    away = minus(ray["origin"], hit["position"])
    height = dot(away, hit["normal"])
    if not length(away) <= _FARTHEST_START:
        return f"it begins {length(away):.3g} away from the hit, and 0.01 is the most that the contract allows"
    if height * side < -1e-6:
        return "it begins on the wrong side of the surface"
    if height * side < _LEAST_START:
        return "it begins on the surface itself, or hardly off it, so that rounding decides what it meets"
    return ""


def _nearer(hit: Record | None, limit: object) -> bool:
    """Whether the hit lies before the light."""
    return hit is not None and (not isinstance(limit, int | float) or as_float(hit["distance"]) < limit)


def blame_shadow(mine: Record, reference: Record, hit: Record, accel: str, *, lit: bool) -> tuple[str, str]:
    """A shadow ray that points to the light, but has another answer: the function, and why."""
    problem = start_problem(mine, hit, 1)
    if problem:
        return "shadow_ray", problem
    apart = length(minus(mine["origin"], reference["origin"]))
    if apart > _SAME_START and mine["missed"] is None:
        return "shadow_ray", f"it begins {apart:.2g} away from the reference's, and that decides whether it gets past"
    if lit:  # the reference's is blocked
        if mine["hit"] is not None:
            return "is_lit", "your ray met something, too"
        if mine["missed"] is not None or _nearer(reference["hit"], mine["limit"]):
            return blame_hit(mine, reference, accel) or "is_lit", ""
        return "is_lit", "your ray asked for nearer hits only"
    if mine["hit"] is None and mine["any"]:
        return _SEARCH[accel][1], "the search says that something is near, though no surface that it tested is"
    if mine["hit"] is None:
        return "is_lit", "your ray met nothing, either"
    if not _nearer(mine["hit"], reference["limit"]):
        return "is_lit", f"that is behind the light, which is {brief(reference['limit'])} away"
    return blame_hit(mine, reference, accel) or "is_lit", ""


def blame_bounce(mine: Record, own: Vector | None, theirs: Vector | None, whole: str, part: str) -> str:
    """A bounced ray has another direction: `part` computes it, `whole` makes the ray."""
    if own is None or theirs is None:
        return whole if own is theirs else part
    return whole if same_direction(own, theirs) else part
