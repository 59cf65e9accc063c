"""From poses to vertices: the skeleton that moves a figure, and the figure moved by it."""
