"""The bytes that accessors lie in: buffers, from the file itself or sent beside it, and views of them."""

import base64
import binascii
from urllib.parse import unquote

from caesura.core.errors import InvalidModel
from caesura.formats.gltf.document import COMPRESSED, GltfDocument
from caesura.formats.gltf.json_object import JsonObject
from caesura.formats.gltf.meshopt.view import decode_view, decoded_size


class Buffers:
    """Bytes of every buffer view. Nothing outside the upload is ever opened, whatever a URI says."""

    def __init__(self, document: GltfDocument) -> None:
        self._document = document
        self._opened: dict[int, memoryview] = {}
        self._decoded: dict[int, memoryview] = {}
        for buffer in document.buffers:
            if "uri" in buffer and not _is_data(uri := buffer.text("uri")):
                _check_name(uri, buffer)

    def view(self, index: int) -> memoryview:
        """The bytes of one buffer view; raises `out-of-bounds` where its buffer is shorter.

        A compressed one is decoded once, whatever may lie beside it for those who cannot.
        """
        view = self._document.views[index]
        packed = view.extension(*sorted(COMPRESSED))
        if packed is None:
            return self._piece(view)
        if index not in self._decoded:
            self._document.budget.spend(decoded_size(view, packed), packed.pointer)
            self._decoded[index] = decode_view(packed, self._piece(packed))
        return self._decoded[index]

    def _piece(self, view: JsonObject) -> memoryview:
        number = view.index("buffer", len(self._document.buffers), "buffers")
        data = self.buffer(number)
        start = view.whole("byteOffset", 0, code="out-of-bounds")
        length = view.whole("byteLength", code="out-of-bounds")
        if start + length > len(data):
            raise view.refusal(f"The view ends at byte {start + length} of a buffer of {len(data)}.", "out-of-bounds")
        return data[start : start + length]

    def buffer(self, index: int) -> memoryview:
        """The bytes of one buffer, as long as it states; raises `external-resource` where they were not sent."""
        if index not in self._opened:
            self._opened[index] = self._open(index, self._document.buffers[index])
        return self._opened[index]

    def _open(self, index: int, buffer: JsonObject) -> memoryview:
        length = buffer.whole("byteLength", code="out-of-bounds")
        if "uri" not in buffer:
            data = self._binary(index, buffer)
        elif _is_data(uri := buffer.text("uri")):
            data = self._inline(uri, buffer)
        else:
            data = self._part(uri, buffer)
        if length > len(data):
            code = "invalid-data-uri" if "uri" in buffer and _is_data(buffer.text("uri")) else "out-of-bounds"
            raise buffer.refusal(f"The buffer has {len(data)} of the {length} bytes it states.", code)
        return data[:length]

    def _binary(self, index: int, buffer: JsonObject) -> memoryview:
        if index == 0 and self._document.binary is not None:
            return self._document.binary
        raise buffer.refusal("The buffer has neither a URI nor a binary chunk.", "out-of-bounds")

    def _inline(self, uri: str, buffer: JsonObject) -> memoryview:
        """A base64 data: URI (RFC 2397), its size known from its length before it is decoded.

        `+`, `/` and `=` may be written as %2B, %2F and %3D, as anything in a URI.
        """
        head, comma, text = uri.partition(",")
        if not comma or not head.lower().endswith(";base64"):
            raise buffer.refusal("The data: URI is not base64.", "invalid-data-uri", "uri")
        self._document.budget.spend(len(text) * 3 // 4, f"{buffer.pointer}/uri")
        try:
            return memoryview(base64.b64decode(unquote(text) if "%" in text else text, validate=True))
        except (binascii.Error, ValueError):
            raise buffer.refusal("The data: URI is not valid base64.", "invalid-data-uri", "uri") from None

    def _part(self, uri: str, buffer: JsonObject) -> memoryview:
        for name in (uri, unquote(uri)):
            if name in self._document.parts:
                return self._document.parts[name]
        raise _external(uri, buffer)


def _is_data(uri: str) -> bool:
    return uri[:5].lower() == "data:"


def _check_name(uri: str, buffer: JsonObject) -> None:
    """Raise for a URI that is no plain relative name, used or not."""
    plain = unquote(uri).replace("\\", "/")
    if ":" in plain or "\0" in plain or plain.startswith("/") or ".." in plain.split("/"):
        raise _external(uri, buffer)


def _external(uri: str, buffer: JsonObject) -> InvalidModel:
    return buffer.refusal(
        f"The data is in another file, {uri[:80]!r}, which was not sent. Send both in one request, under their exact "
        "names, or export as GLB.",
        "external-resource",
        "uri",
    )
