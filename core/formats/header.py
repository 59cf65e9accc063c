"""What a file says of itself at its beginning. Light: no NumPy."""

from core.formats.sniffing import sniff

__all__ = ["sniff"]
