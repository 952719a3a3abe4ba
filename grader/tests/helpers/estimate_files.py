"""What `raytrace --estimates` writes, made by hand."""

import numpy as np

from raysteps.images.noise import Estimates


def bytes_of(estimates: Estimates) -> bytes:
    """A line, then six little-endian floats for each pixel."""
    width, height = estimates.size
    values = np.stack([estimates.mean, estimates.variance], axis=2).astype("<f4")
    return b"raysteps-estimates %d %d\n" % (width, height) + values.tobytes()
