"""Many boxes at once, and which points lie in them."""

from collections.abc import Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

from raysteps.judge.numbers import Vector
from raysteps.judge.surface_points import Points

_Flags: TypeAlias = npt.NDArray[np.bool_]


class Boxes:
    """One array for each side of all of them."""

    def __init__(self, low: Sequence[Vector], high: Sequence[Vector]) -> None:
        self._low = np.array(low).T.copy()
        self._high = np.array(high).T.copy()

    def holding(self, points: Points, which: _Flags, margin: float) -> _Flags:
        """Of each point whether it lies in one of these boxes, grown by the margin."""
        low, high = self._low[:, which] - margin, self._high[:, which] + margin
        least, most = points.min(axis=0)[:, np.newaxis], points.max(axis=0)[:, np.newaxis]
        # Most boxes hold all points or are far from them, which is quickly seen.
        if ((low <= least) & (high >= most)).all(axis=0).any():
            return np.ones(len(points), dtype=np.bool_)
        near: _Flags = ((low <= most) & (high >= least)).all(axis=0)
        low, high = low[:, near], high[:, near]
        inside: _Flags = np.ones((len(points), low.shape[1]), dtype=np.bool_)
        for axis in range(3):
            along = points[:, axis : axis + 1]
            np.logical_and(inside, along >= low[axis], out=inside)
            np.logical_and(inside, along <= high[axis], out=inside)
        held: _Flags = np.any(inside, axis=1)
        return held
