"""A zip of files that belong together: a glTF with its buffers, or one numbered OBJ or PLY for every frame."""
