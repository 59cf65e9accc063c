"""The forms a result comes in, and how a client says which: by the address's suffix, or by Accept."""

from dataclasses import dataclass

from pydantic import BaseModel

from caesura.service.problems.status_table import Refusal


@dataclass(frozen=True)
class ResultFormat:
    """One form: the suffix that asks for it, its media type, what people call it and what it is for."""

    suffix: str
    media_type: str
    title: str
    description: str


RESULT_FORMATS = (
    ResultFormat("json", "application/json", "JSON", "the whole result"),
    ResultFormat("csv", "text/csv", "CSV", "one line for each segment"),
    ResultFormat("npz", "application/x-npz", "NPZ", "arrays for NumPy"),
    ResultFormat("vtt", "text/vtt", "VTT", "subtitles for a video"),
    ResultFormat("eaf", "text/x-eaf+xml", "EAF", "annotations for ELAN"),
)


PLOT_FORMATS = (
    ResultFormat("svg", "image/svg+xml", "Plot, SVG", "a figure for a paper"),
    ResultFormat("png", "image/png", "Plot, PNG", "the same as an image"),
)


class ExportDocument(BaseModel):
    """A file made of a result: its address below the segmentation, its title, and what it is for."""

    path: str
    title: str
    description: str
    queued: bool
    """Whether a worker writes it when it is first asked for: the answer is 202 until then."""


EXPORTS = (
    ExportDocument(path="clips", title="Clips", description="one animation for each segment", queued=True),
    ExportDocument(path="keyframes", title="Key-frames", description="one animation of the key poses", queued=True),
    *(
        ExportDocument(path=f"{stem}.{form.suffix}", title=form.title, description=form.description, queued=queued)
        for stem, forms, queued in (("result", RESULT_FORMATS, False), ("plot", PLOT_FORMATS, True))
        for form in forms
    ),
)


def format_by_suffix(suffix: str) -> ResultFormat:
    """The form of an address that ends in `result.suffix`."""
    return _called(suffix, RESULT_FORMATS, "result")


def plot_format_by_suffix(suffix: str) -> ResultFormat:
    """The form of an address that ends in `plot.suffix`."""
    return _called(suffix, PLOT_FORMATS, "plot")


def _called(suffix: str, forms: tuple[ResultFormat, ...], what: str) -> ResultFormat:
    for form in forms:
        if form.suffix == suffix:
            return form
    raise Refusal("not-found", f"There is no {what}.{suffix[:20]}. There are: {_listed(forms)}.")


def format_by_accept(header: str) -> ResultFormat:
    """The form that an Accept header likes best (RFC 9110, section 12.5.1); JSON where anything will do."""
    wanted = [_quality(item) for item in header.split(",") if item.strip()] or [("*/*", 1.0)]
    best = max(RESULT_FORMATS, key=lambda form: _liking(form, wanted))
    if _liking(best, wanted) <= 0:
        raise Refusal(
            "not-acceptable", f"The result does not come as {header}. It comes as: {_listed(RESULT_FORMATS)}."
        )
    return best


def _quality(item: str) -> tuple[str, float]:
    media_type, *options = (piece.strip().lower() for piece in item.split(";"))
    quality = next((option[2:] for option in options if option.startswith("q=")), "1")
    try:
        return media_type, float(quality)
    except ValueError:
        return media_type, 0.0


def _liking(form: ResultFormat, wanted: list[tuple[str, float]]) -> float:
    """The quality of the most specific item that matches."""
    for pattern in (form.media_type, form.media_type.split("/")[0] + "/*", "*/*"):
        for media_type, quality in wanted:
            if media_type == pattern:
                return quality
    return 0.0


def _listed(forms: tuple[ResultFormat, ...]) -> str:
    return ", ".join(f".{form.suffix} ({form.media_type})" for form in forms)
