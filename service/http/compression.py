"""Answers are compressed, with zstd or gzip, where the client takes that and it makes them smaller.

Text is: JSON, CSV, plots. Files are not: they are packed already, and served by Range. Event streams are not either,
for an event must go out at once.
"""

from starlette_compress import CompressMiddleware, add_compress_type, remove_compress_type

from caesura.service.problems.problem_response import MEDIA_TYPE

__all__ = ["CompressMiddleware", "choose_compressed_types"]


def choose_compressed_types() -> None:
    """Have the library compress our kinds of text beside those that it knows."""
    for media_type in (MEDIA_TYPE, "text/csv", "text/x-eaf+xml"):
        add_compress_type(media_type)
    remove_compress_type("text/event-stream")
