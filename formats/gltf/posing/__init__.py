"""From sampled keys to vertices: nodes, skeleton, skins, then morphing and skinning block by block."""
