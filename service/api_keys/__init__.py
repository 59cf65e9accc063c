"""Keys of the API: what a key is, and keys from a mounted file, and the keys in Redis."""
