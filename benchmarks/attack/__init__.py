"""A running service under attack: `python -m benchmarks.attack`."""
