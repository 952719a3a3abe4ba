"""Noise taken out of a picture by Open Image Denoise, where somebody has installed it: the kit does without."""

import importlib.util
import sys
from importlib import import_module

import numpy as np

from raysteps.common.errors import UsageError
from raysteps.images.compare import Pixels
from raysteps.images.noise import Light, as_picture

_LIBRARY, _VERSION = "pyoidn", "2.5.1.0"  # Open Image Denoise 2.5.1, and Python's way to it


def refuse_without_denoiser() -> None:
    """Told before anything is drawn."""
    if importlib.util.find_spec(_LIBRARY) is None:
        raise UsageError(
            "--denoise: Open Image Denoise is not installed, and the kit does without; get it (90 MB) with: "
            f"{sys.executable} -m pip install {_LIBRARY}=={_VERSION}"
        )


def denoised(light: Light) -> Pixels:
    """Of the mean light of each pixel, before filter and curve: a filter would share the noise with the neighbours, and
    then it looks like something that is there."""
    library = import_module(_LIBRARY)
    return as_picture(np.asarray(library.denoise(np.ascontiguousarray(light, dtype=np.float32), hdr=True), np.float64))
