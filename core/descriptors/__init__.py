"""What is measured on every frame: each a function of the vertices, with rigid motion cancelled."""
