"""The forms a result comes in, and how a client says which: by the address's suffix, or by Accept."""

from collections.abc import Iterable

from pydantic import BaseModel

from caesura.formats.exports.export_table import EXPORTS, Export, exports_of
from caesura.formats.exports.game_engines import ENGINES
from caesura.service.problems.problem_response import RequestProblem
from caesura.service.results.byte_ranges import OCTETS


class ExportDocument(BaseModel):
    """A file made of a result: its address below the segmentation, its title, and what it is for."""

    path: str
    title: str
    description: str
    queued: bool
    """Whether a worker writes it when it is first asked for: the answer is 202 until then."""


class EngineDocument(BaseModel):
    """A program that imports clips, how to import there, and the choices of clips that suit it."""

    name: str
    title: str
    advice: str
    options: dict[str, str]


def engine_descriptions() -> tuple[EngineDocument, ...]:
    """All programs that are known."""
    return tuple(
        EngineDocument(name=engine.name, title=engine.title, advice=engine.advice, options=dict(engine.options))
        for engine in ENGINES
    )


def export_documents() -> tuple[ExportDocument, ...]:
    """All files that have an address of their own."""
    return tuple(
        ExportDocument(path=export.path, title=export.title, description=export.description, queued=export.queued)
        for export in EXPORTS
        if export.table == "segments"
    )


def export_by_suffix(stem: str, suffix: str) -> Export:
    """The file of an address that ends in `stem.suffix`."""
    exports = exports_of(stem)
    if suffix not in exports:
        raise RequestProblem(
            "not-found", f"There is no {stem}.{suffix[:20]}. There are: {_list_formats(exports.values())}."
        )
    return exports[suffix]


def export_by_table(export: Export, table: str) -> Export:
    """The file of the same address that holds another table."""
    exports = exports_of(export.stem, table)
    if export.suffix not in exports:
        raise RequestProblem("no-such-table", f"{export.suffix} has no table {table!r}; table=frames goes with csv.")
    return exports[export.suffix]


def export_by_accept(header: str) -> Export:
    """The form that an Accept header likes best (RFC 9110, section 12.5.1); JSON where anything will do."""
    exports = exports_of("result").values()
    wanted = [_quality(item) for item in header.split(",") if item.strip()] or [("*/*", 1.0)]
    best = max(exports, key=lambda export: _match_quality(export, wanted))
    if _match_quality(best, wanted) <= 0:
        raise RequestProblem(
            "not-acceptable", f"The result does not come as {header}. It comes as: {_list_formats(exports)}."
        )
    return best


def _quality(item: str) -> tuple[str, float]:
    media_type, *options = (piece.strip().lower() for piece in item.split(";"))
    quality = next((option[2:] for option in options if option.startswith("q=")), "1")
    try:
        return media_type, float(quality)
    except ValueError:
        return media_type, 0.0


def _match_quality(export: Export, wanted: list[tuple[str, float]]) -> float:
    """The quality of the most specific item that matches."""
    octets = [] if export.is_text else [OCTETS]
    for pattern in (export.media_type, *octets, export.media_type.split("/")[0] + "/*", "*/*"):
        for media_type, quality in wanted:
            if media_type == pattern:
                return quality
    return 0.0


def _list_formats(exports: Iterable[Export]) -> str:
    return ", ".join(f".{export.suffix} ({export.media_type})" for export in exports)
