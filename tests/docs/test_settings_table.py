"""docs/operations.md lists every setting as the settings classes have it."""

import re
from pathlib import Path
from typing import Any

import pytest
from pydantic.fields import FieldInfo

from caesura.service.settings import ServiceSettings

TABLE = re.compile(r"<!-- settings: [^>]*-->\n(.*?)\n?<!-- end of settings -->", re.DOTALL)


def variable(name: str, field: FieldInfo) -> str:
    """The environment variable of a setting: its alias that is read first, else its name."""
    choices: Any = field.validation_alias
    return choices.choices[0] if choices else f"CAESURA_{name.upper()}"


def shown(field: FieldInfo) -> str:
    """The default as the table shows it."""
    value = field.get_default(call_default_factory=True)
    if isinstance(value, Path):
        return f"`~/{value.relative_to(Path.home())}`"
    if isinstance(value, int | float):
        return f"{value:g}" if value < 10_000 else f"{value:,.0f}"
    return f"`{value}`" if value else ""


def test_the_table_is_complete_and_true(checkout: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each row is a setting with its default and description."""
    monkeypatch.delenv("XDG_DATA_HOME", raising=False)
    rows = [
        f"| `{variable(name, field)}` | {shown(field)} | {field.description} |"
        for name, field in sorted(ServiceSettings.model_fields.items())
    ]
    expected = "\n".join(["| variable | default | what |", "|---|---|---|", *rows])
    found = TABLE.search((checkout / "docs" / "operations.md").read_text(encoding="utf-8"))
    assert found is not None
    assert found[1] == expected, f"the table should be:\n\n{expected}"
