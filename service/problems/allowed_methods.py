"""Which methods an address takes: for `Allow`, and for OPTIONS."""

import re
from functools import lru_cache

from fastapi import FastAPI

READING = frozenset({"GET", "HEAD"})


def allowed_methods(app: FastAPI, path: str) -> list[str]:
    """The methods of an address that there is; those of the page's own files are not in the OpenAPI document."""
    found = {
        method
        for pattern, methods in _methods_by_pattern(tuple(_described(app)))
        if pattern.fullmatch(path)
        for method in methods
    }
    found = found or set(READING)
    if "GET" in found:
        found.add("HEAD")
    return sorted(found | {"OPTIONS"})


def _described(app: FastAPI) -> list[tuple[str, tuple[str, ...]]]:
    return [(path, tuple(method.upper() for method in item)) for path, item in app.openapi()["paths"].items()]


@lru_cache(maxsize=4)
def _methods_by_pattern(
    described: tuple[tuple[str, tuple[str, ...]], ...],
) -> tuple[tuple[re.Pattern[str], tuple[str, ...]], ...]:
    return tuple(
        (re.compile("[^/]+".join(map(re.escape, re.split(r"\{\w+\}", path)))), methods) for path, methods in described
    )
