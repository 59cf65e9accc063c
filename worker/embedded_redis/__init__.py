"""A Redis-compatible server of our own: the server, and the folder that it serves."""
