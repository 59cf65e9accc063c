"""Selects the take that a person names. Light: no NumPy."""

from caesura.core.errors import ParameterError

MOST_NAMES_SHOWN = 20

LONGEST = 100
"""Letters of a take's name; a name may be as long as its file, and is kept and sent with every answer."""


def take_name(given: object, place: int) -> str:
    """The name of a take, shortened where it is long; a take without one is called by its place."""
    if isinstance(given, str) and given:
        # A lone surrogate is legal in JSON and cannot be written as UTF-8.
        return shorten_name(given).encode("utf-8", "replace").decode("utf-8")
    return f"take {place}"


def shorten_name(name: str) -> str:
    """The beginning of a long name, with an ellipsis for the rest."""
    return name if len(name) <= LONGEST else f"{name[: LONGEST - 1]}…"


def select_take(names: list[str], wanted: str | int) -> int | None:
    """The place of the `wanted` take, None for the longest one.

    Raises `ParameterError`: `unknown-take`, or `ambiguous-take` with the places of a name that occurs twice.
    """
    if wanted == "longest":
        return None
    if isinstance(wanted, int):
        if 0 <= wanted < len(names):
            return wanted
        raise ParameterError("unknown-take", f"There is no take {wanted}. {_list_names(names)}", parameter="take")
    places = [place for place, name in enumerate(names) if name == shorten_name(wanted)]
    if not places:
        raise ParameterError(
            "unknown-take", f"There is no take {wanted[:80]!r}. {_list_names(names)}", parameter="take"
        )
    if len(places) > 1:
        numbers = ", ".join(map(str, places[:MOST_NAMES_SHOWN]))
        raise ParameterError(
            "ambiguous-take",
            f"{len(places)} takes are called {wanted[:80]!r}. Choose by number: {numbers}.",
            parameter="take",
        )
    return places[0]


def _list_names(names: list[str]) -> str:
    shown = ", ".join(f"{place} {name[:40]!r}" for place, name in enumerate(names[:MOST_NAMES_SHOWN]))
    more = f" and {len(names) - MOST_NAMES_SHOWN} more" if len(names) > MOST_NAMES_SHOWN else ""
    return f"The file has {shown}{more}."
