"""Find the motions in a 3D animation: arrays and buffers in, frozen values out.

The package itself loads nothing: `core.errors`, `core.limits`, `core.parameters`, `core.document` and
`core.formats.header` are light (no NumPy) and serve the web process; everything else is numerics.
"""
