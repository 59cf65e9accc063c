"""How seconds become samples: lengths that the authors count at 120 frames a second, at any other rate."""


def most_frames_per_sample(frame_rate: float) -> int:
    """The longest run of like frames that counts as one sample: 5 at 120 frames a second, as the authors have it."""
    return max(round(frame_rate / 24), 1)


def seconds_to_samples(seconds: float, count: int, duration: float) -> int:
    """So many seconds in samples, of which `count` take `duration` seconds; at least one."""
    return max(round(seconds * count / duration), 1)
