"""FLIP: where, and how much, a person who switches between two pictures would see them differ."""

import numpy as np
import numpy.typing as npt

Pixels = npt.NDArray[np.uint8]


def flip_map(reference: Pixels, mine: Pixels) -> Pixels | None:
    """For each pixel from 0, the same, to 255, as different as can be. None where the package is missing, as it is on
    some systems, or the sizes differ."""
    if reference.shape != mine.shape:
        return None
    try:
        from flip_evaluator import evaluate
    except ImportError:
        return None
    pair = [np.ascontiguousarray(pixels, dtype=np.float32) / 255 for pixels in (reference, mine)]
    errors, _, _ = evaluate(*pair, "LDR", inputsRGB=True, applyMagma=False, computeMeanError=False)
    gray: Pixels = np.rint(np.clip(errors[:, :, 0], 0, 1) * 255).astype(np.uint8)
    return gray
