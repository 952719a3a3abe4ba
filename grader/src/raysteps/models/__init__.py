"""Models from elsewhere, made into scenes that this kit draws."""

from typing import Literal

ENDINGS = (".obj", ".gltf", ".glb", ".ply", ".stl", ".off")

TexturePlace = Literal["beside", "inside", "none"]
"""Where a scene has its textures: in files of their own, in its own text, or nowhere, but mean colours instead."""
