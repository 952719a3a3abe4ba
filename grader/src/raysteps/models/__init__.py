"""Models from elsewhere, made into scenes that this kit draws."""

ENDINGS = (".obj", ".gltf", ".glb", ".ply", ".stl", ".off")
