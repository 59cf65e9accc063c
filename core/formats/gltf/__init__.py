"""glTF 2.0: the container, its accessors, sampling of animations, posing of meshes, and writing."""
