"""Pauses before another attempt, where what failed needs time to come back."""

FIRST_PAUSE_SECONDS, PAUSE_GROWTH, LONGEST_PAUSE_SECONDS = 2.0, 4, 60.0


def retry_delay_seconds(attempt: int) -> float:
    """How long to wait after attempt 1, 2, …: 2 s, 8 s, 32 s, at most a minute."""
    return float(min(FIRST_PAUSE_SECONDS * PAUSE_GROWTH ** (attempt - 1), LONGEST_PAUSE_SECONDS))
