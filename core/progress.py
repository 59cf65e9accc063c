"""How long work tells of itself, and how it is told to stop."""

from collections.abc import Callable

Progress = Callable[[str, float], None]
"""`progress(stage, fraction)`: the name of the running stage and how much of that stage is done, 0 to 1.

Called from the thread that called the core, between blocks and while it waits for one. It may raise: then no
further block is begun, and what it raised is what the caller sees.
"""


def ignore_progress(stage: str, fraction: float) -> None:
    """Nobody is watching."""
