"""A zip of files that belong together: a glTF and its buffers, or one shape for every frame. Light: no NumPy."""

import re
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from typing import BinaryIO

from caesura.core.errors import BrokenContainer, InvalidModel, UnsupportedMedia
from caesura.core.limits import Limits
from caesura.formats.input_formats import MODEL_SUFFIXES
from caesura.formats.zip.archive import ZipArchive, check_member, malformed_zip

SHAPES = (".obj", ".ply")
NUMBER = re.compile(r"\d+")


class ZipMembers(ZipArchive):
    """The members of a zip by their exact names; nothing of it is ever written where a name says.

    Raises `BrokenContainer("malformed-zip")` or `LimitExceeded`, by the directory alone.
    """

    most_members = 20_000
    longest_directory = 4 * 2**20

    def __init__(self, file: BinaryIO, limits: Limits) -> None:
        with errors_as_zip():
            super().__init__(file, limits)

    def are_arrays(self) -> bool:
        """Whether it is an NPZ all the same, whose first member is something else, such as a note."""
        names = [name.lower() for name in self.members]
        return not any(name.endswith((*MODEL_SUFFIXES, *SHAPES)) for name in names) and any(
            name.endswith(".npy") for name in names
        )

    def model(self) -> str | None:
        """The one file that can be read alone or with others; None where there are shapes instead.

        Raises where there are several, or nothing.
        """
        models = [name for name in self.members if name.lower().endswith(MODEL_SUFFIXES)]
        if len(models) > 1:
            raise InvalidModel("ambiguous-upload", f"{len(models)} files of the zip are models. Send one at a time.")
        if not models and not self.shapes():
            raise UnsupportedMedia(
                "unsupported-media-type",
                f"The zip holds no animation. It may hold one {', '.join(MODEL_SUFFIXES)} with what lies beside it, "
                "numbered .obj or .ply files, or NumPy arrays.",
            )
        return models[0] if models else None

    def shapes(self) -> list[str]:
        """The OBJ or PLY files in the order of the numbers in their names; raises `mixed-frames` for both at once."""
        found = [name for name in self.members if name.lower().endswith(SHAPES)]
        if len({name.lower()[-4:] for name in found}) > 1:
            raise InvalidModel("varying-topology", "The zip holds OBJ and PLY files. Send frames of one kind.")
        return sorted(found, key=lambda name: (_number(name), name))

    def beside(self, model: str) -> dict[str, str]:
        """The other files in the folder of the model and below, by their names as the model calls them."""
        folder = model.rpartition("/")[0]
        start = len(folder) + 1 if folder else 0
        return {name[start:]: name for name in self.members if name != model and name.startswith(folder)}

    def _checked(self, limits: Limits) -> dict[str, zipfile.ZipInfo]:
        members: dict[str, zipfile.ZipInfo] = {}
        for info in self._zip.infolist():
            name = info.filename
            check_member(info)
            leads_out = name.startswith("/") or "\\" in name or ".." in name.split("/") or ":" in name
            if not name or name in members or leads_out:
                raise malformed_zip(f"has a member {name[:80]!r}, without a name, a path out of it or there twice")
            if not info.is_dir() and not name.startswith("__MACOSX/"):
                members[name] = info
        limits.check(
            "max_inflated_bytes", sum(info.file_size for info in members.values()), "Send fewer files at a time"
        )
        return members


@contextmanager
def errors_as_zip() -> Iterator[None]:
    """Say of a zip what is said of an archive of arrays."""
    try:
        yield
    except BrokenContainer as wrong:
        detail = wrong.detail.replace("Save it again with numpy.savez.", "Zip the files again.")
        raise BrokenContainer("malformed-zip", detail) from None


def nested_archive_error(name: str) -> UnsupportedMedia:
    """The refusal of an archive in a zip: there may be another one in it, without end."""
    return UnsupportedMedia("unsupported-media-type", f"{name[:80]!r} in the zip is a zip again. Send that one alone.")


def _number(name: str) -> int:
    """The last number in a name; -1 where there is none that counts frames."""
    found = NUMBER.findall(name.rpartition(".")[0])
    return int(found[-1]) if found and len(found[-1]) < 19 else -1
