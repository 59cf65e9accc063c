"""Whose request it is, and whether it may be made."""
