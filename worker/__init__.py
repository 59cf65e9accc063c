"""RQ workers: the only processes that load the numerics."""
