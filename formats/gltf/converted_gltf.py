"""What another format becomes: a GLB, and what its reader assumed or left out."""

from dataclasses import dataclass

from caesura.core.segmentation_document import Notice


@dataclass(frozen=True)
class GltfConversion:
    """The same animation as a GLB, read by the one reader of glTF; `notices` are said beside that reader's."""

    glb: bytes | memoryview
    notices: tuple[Notice, ...] = ()
