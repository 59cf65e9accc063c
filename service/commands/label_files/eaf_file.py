"""The annotations of one tier of an EAF, as ELAN writes it.

Format: H. Sloetjes, P. Wittenburg, ELAN Annotation Format 3.0 (Max Planck Institute for Psycholinguistics). The XML
parser is told nothing but elements: a document type, where entities and external files would be named, is refused
before any of it is read.
"""

from dataclasses import dataclass, field
from xml.parsers import expat

from caesura.service.commands.label_files.timed_labels import MOST_INTERVALS, TimedLabels

MOST_LETTERS = 1000
"""Of one label."""
DEEPEST = 50
"""Elements within each other; an EAF has five."""


@dataclass
class _Reader:
    """What was read so far: the times of slots, and of each tier its annotations between slots."""

    slots: dict[str, float] = field(default_factory=dict)
    tiers: dict[str, list[tuple[str, str, str]]] = field(default_factory=dict)
    tier: list[tuple[str, str, str]] = field(default_factory=list)
    ends: tuple[str, str] | None = None
    value: list[str] | None = None
    depth: int = 0

    def start(self, name: str, attributes: dict[str, str]) -> None:
        """An element begins."""
        self.depth += 1
        if self.depth > DEEPEST:
            raise ValueError(f"it has more than {DEEPEST} elements within each other")
        if name == "HEADER" and attributes.get("TIME_UNITS", "milliseconds") != "milliseconds":
            raise ValueError("its times are not in milliseconds")
        if name == "TIME_SLOT" and "TIME_VALUE" in attributes:
            self.slots[attributes.get("TIME_SLOT_ID", "")] = int(attributes["TIME_VALUE"][:20]) / 1000
        elif name == "TIER":
            self.tier = self.tiers.setdefault(attributes.get("TIER_ID", ""), [])
        elif name == "ALIGNABLE_ANNOTATION":
            self.ends = (attributes.get("TIME_SLOT_REF1", ""), attributes.get("TIME_SLOT_REF2", ""))
        elif name == "ANNOTATION_VALUE" and self.ends:
            self.value = []
        if len(self.slots) > 4 * MOST_INTERVALS or len(self.tiers) > MOST_INTERVALS or len(self.tier) > MOST_INTERVALS:
            raise ValueError(f"it has more than {MOST_INTERVALS} annotations in a tier")

    def text(self, data: str) -> None:
        """Letters between elements."""
        if self.value is not None and sum(map(len, self.value)) < MOST_LETTERS:
            self.value.append(data)

    def end(self, name: str) -> None:
        """An element ends."""
        self.depth -= 1
        if name == "ALIGNABLE_ANNOTATION" and self.ends:
            self.tier.append((*self.ends, "".join(self.value or [])[:MOST_LETTERS].strip()))
            self.ends, self.value = None, None


def read_eaf_labels(content: bytes, tier: str | None = None) -> TimedLabels:
    """The annotations of the tier of this name, or of the first that has some; raises ValueError."""
    reader = _Reader()
    parser = expat.ParserCreate()
    parser.buffer_text = True  # else each line of a value is a call
    parser.StartElementHandler = reader.start
    parser.EndElementHandler = reader.end
    parser.CharacterDataHandler = reader.text
    parser.StartDoctypeDeclHandler = _refuse_document_type
    try:
        parser.Parse(content, True)
    except expat.ExpatError as wrong:
        raise ValueError(f"it is no XML that can be read: {wrong}") from None
    filled = {name: found for name, found in reader.tiers.items() if found}
    name = next(iter(filled), None) if tier is None else tier
    if name not in filled:
        listed = ", ".join(repr(known[:40]) for known in list(filled)[:20]) or "none"
        raise ValueError(f"it has no such tier with annotations that are aligned to time; it has {listed}")
    try:
        placed = tuple((reader.slots[start], reader.slots[end], label) for start, end, label in filled[name])
    except KeyError:
        raise ValueError(f"an annotation of the tier {name[:40]!r} begins or ends at no time") from None
    return TimedLabels("seconds", placed)


def _refuse_document_type(*_: object) -> None:
    raise ValueError("it declares a document type, which an EAF does not: entities and other files are not read")
