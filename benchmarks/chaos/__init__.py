"""Everything is killed at random while takes are segmented: `python -m benchmarks.chaos`."""
