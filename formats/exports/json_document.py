"""The whole result as JSON."""

from caesura.core.segmentation_document import SegmentationDocument


def document_json(document: SegmentationDocument) -> str:
    """The segmentation document."""
    return document.model_dump_json()
