"""The input formats as the API and the page describe them."""

from html import escape

from pydantic import BaseModel, Field

from caesura.formats.input_formats import INPUT_FORMATS, InputFormat


class FormatDocument(BaseModel):
    """A kind of file that is read, whatever its name: formats are told by the first bytes."""

    name: str
    title: str
    suffixes: tuple[str, ...] = Field(description="how names of such files end")
    companion: str | None = Field(description="how the name ends of the file that must come with it")
    description: str


def format_documents() -> tuple[FormatDocument, ...]:
    """All formats, in the order in which they are tried."""
    return tuple(
        FormatDocument(
            name=known.name,
            title=known.title,
            suffixes=known.suffixes,
            companion=known.companion.suffix if known.companion else None,
            description=known.description,
        )
        for known in INPUT_FORMATS.values()
    )


def list_formats_as_html() -> str:
    """What the page says of files that can be dropped on it."""
    return ", ".join(map(_as_html, INPUT_FORMATS.values()))


def _as_html(known: InputFormat) -> str:
    suffixes = ", ".join(f"<code>{escape(suffix)}</code>" for suffix in known.suffixes)
    return (
        f"{suffixes} with its <code class='beside'>{escape(known.companion.suffix)}</code>"
        if known.companion
        else suffixes
    )
