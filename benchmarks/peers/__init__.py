"""Change point detection by others, in an environment of its own."""
