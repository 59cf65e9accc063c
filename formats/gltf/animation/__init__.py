"""Takes of a glTF: their channels, the times of their keys, and their values at any time."""
