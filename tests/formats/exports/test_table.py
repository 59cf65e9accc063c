"""The table of exports names what is there."""

from caesura.formats.exports.export_table import EXPORTS, exports_of


def test_every_export_has_a_writer_and_an_address_of_its_own() -> None:
    """No two share a place, and the function of each is found."""
    assert len({(export.path, export.table) for export in EXPORTS}) == len(EXPORTS)
    assert all(callable(export._load()) for export in EXPORTS)


def test_a_worker_makes_what_needs_arrays() -> None:
    """The web process answers with the others at once."""
    assert {export.path for export in EXPORTS if export.queued} == {"clips", "keyframes", "result.npz", "plot.png"}
    assert exports_of("result", "frames")["csv"].file_ending("text/csv") == ".frames.csv"
