"""BVH (Biovision hierarchy): a skeleton and its motion as text, read as a glTF of the same skeleton."""
