"""The figures of a comparison as a table: the mean of each method over the takes, and each take where asked."""

from collections.abc import Iterator, Sequence

from caesura.service.commands.comparison.measurement import Figures, MeasuredMethod
from caesura.worker.control_characters import escape_control_characters

HEAD = (
    f"{'method':<22}  {'takes':>5}  {'accuracy':>8}  {'Eq. 6':>6}  {'F1 0.5 s':>8}"
    f"  {'untold':>8}  {'Eq. 6':>6}  {'F1 0.5 s':>8}  {'K exact':>8}  {'seconds':>8}  {'MB':>8}"
)


def comparison_table(measured: Sequence[MeasuredMethod], *, each: bool) -> str:
    """Accuracy, error and F1 of the cuts, told K and then told nothing; where a method refuses takes, of the rest."""
    lines = [*_takes(measured)] if each else []
    methods = dict.fromkeys(one.method for one in measured)
    lines += [HEAD, *(_row(method, [one for one in measured if one.method == method]) for method in methods)]
    return "\n".join(map(escape_control_characters, lines))


def _takes(measured: Sequence[MeasuredMethod]) -> Iterator[str]:
    for take in dict.fromkeys(one.take for one in measured):
        yield from (take, HEAD)
        yield from (_row(one.method, [one]) for one in measured if one.take == take)
        yield ""


def _row(method: str, rows: Sequence[MeasuredMethod]) -> str:
    done = [one for one in rows if one.told is not None]
    if not done:
        return f"{method:<22}  {rows[0].refused}"
    told, untold = _figures([one.told for one in done]), _figures([one.untold for one in done])
    exact = [one.untold.exact for one in done if one.untold is not None]
    count = f"{sum(exact)} of {len(exact)}" if exact else "-"
    seconds, megabytes = _mean([one.seconds for one in done]), _mean([one.megabytes for one in done])
    return f"{method:<22}  {len(done):>5}  {told}  {untold}  {count:>8}  {seconds:8.2f}  {megabytes:8.1f}"


def _figures(figures: Sequence[Figures | None]) -> str:
    known = [one for one in figures if one is not None]
    if not known:
        return f"{'-':>8}  {'-':>6}  {'-':>8}"
    accuracy, error, f1 = (_mean([getattr(one, name) for one in known]) for name in ("accuracy", "error", "f1"))
    return f"{accuracy:8.3f}  {error:6.3f}  {f1:8.3f}"


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)
