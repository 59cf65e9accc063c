"""A running service under load: `python -m benchmarks.load`."""
