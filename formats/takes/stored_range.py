"""Which frames of a file lie between two seconds. Light: no NumPy."""


def stored_range(count: int, rate: float, start: float, end: float, handle: float = 0.0) -> tuple[int, int]:
    """The frames [first, last) from second `start` to second `end`, and `handle` seconds on either side, at least one.

    Of a file of `count` frames at `rate` a second. Ranges that share a second share no frame, and miss none.
    """
    more = round(handle * rate)
    first = min(max(round(rate * start) - more, 0), count - 1)
    return first, max(min(round(rate * end) + more, count), first + 1)
