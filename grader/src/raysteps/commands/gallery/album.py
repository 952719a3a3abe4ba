"""The pictures of the gallery as they travel in its page: each once, however often it is shown."""

import hashlib

from raysteps.pages.picture_data import pixel_data
from raysteps.programs.pictures import Pixels


class Album:
    """Gives each picture a number. Steps that change nothing share one."""

    def __init__(self) -> None:
        self.sources: list[str] = []
        self._known: dict[bytes, int] = {}

    def add(self, pixels: Pixels) -> int:
        key = hashlib.sha256(repr(pixels.shape).encode() + pixels.tobytes()).digest()
        if key not in self._known:
            self._known[key] = len(self.sources)
            self.sources.append(pixel_data(pixels).src)
        return self._known[key]
