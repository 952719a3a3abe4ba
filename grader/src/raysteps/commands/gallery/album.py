"""The pictures of the gallery as they travel in its page: each once, however often it is shown."""

import base64
import hashlib
import io

from PIL import Image

from raysteps.programs.pictures import Pixels


class Album:
    """Gives each picture a number. Steps that change nothing share one."""

    def __init__(self) -> None:
        self.sources: list[str] = []
        self._known: dict[bytes, int] = {}

    def add(self, pixels: Pixels) -> int:
        key = hashlib.sha256(repr(pixels.shape).encode() + pixels.tobytes()).digest()
        if key not in self._known:
            data = io.BytesIO()
            Image.fromarray(pixels).save(data, format="PNG", optimize=True)
            self._known[key] = len(self.sources)
            self.sources.append("data:image/png;base64," + base64.b64encode(data.getvalue()).decode("ascii"))
        return self._known[key]
