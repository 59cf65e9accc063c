"""The page's modules in two files instead of a hundred, for a browser opens six connections and fetches them in turns.

Each module becomes a function that is called once, when the first module that imports it is evaluated: the order is
that of modules loaded one by one. What is joined is written as the page's modules are: names are imported and
exported where they are declared, one statement a line. Imports of libraries stay as they are.
"""

import re
from collections.abc import Iterator
from pathlib import Path

ENTRIES = ("app.js", "figure/scene.js")
"""The modules that are fetched. The second has what draws in 3D, and asks the first for what both need."""

IMPORT = re.compile(r"""^import (?:(?P<what>\{[^}]*\}|\* as \w+|\w+) from )?'(?P<source>[^']+)';\n""", re.MULTILINE)
LAZY = re.compile(r"""\bimport\('(?P<source>\.[^']+)'\)""")
EXPORT = re.compile(r"""^export (?=(?:async )?(?:function\*?|class|const) ?(?P<name>[\w$]+))""", re.MULTILINE)
UNKNOWN = re.compile(r"""^(?:import|export)\b.*""", re.MULTILINE)

FIRST = "const made = {};\nexport const use = (name) => (made[name] ??= modules[name]());\nexport const modules = {\n"


def join_modules(folder: Path, entry: str) -> str:
    """The module `entry` of a folder with every module that it imports, at once or later, but for other entries'.

    Raises `ValueError` for a circle of imports, and for a statement that is written otherwise.
    """
    first = list(_closure(folder, ENTRIES[0]))
    members = first if entry == ENTRIES[0] else [name for name in _closure(folder, entry) if name not in first]
    libraries: dict[str, str] = {}
    functions = "".join(_as_function(folder, name, entry, libraries) for name in members)
    imports = "".join(f"import * as {name} from '{source}';\n" for source, name in libraries.items())
    if entry == ENTRIES[0]:
        return f"{imports}{FIRST}{functions}}};\nuse('{entry}');\n"
    names = ", ".join(_exports(folder, entry))
    shared = f"import {{ modules, use }} from '{_relative(ENTRIES[0], entry)}';\n"
    return (
        f"{imports}{shared}Object.assign(modules, {{\n{functions}}});\nexport const {{ {names} }} = use('{entry}');\n"
    )


def _closure(folder: Path, entry: str, within: tuple[str, ...] = (), seen: set[str] | None = None) -> Iterator[str]:
    """The entry and every module below it, each once; those that `within` names are being evaluated."""
    seen = set() if seen is None else seen
    if entry in within:
        raise ValueError(f"{entry} imports itself by way of {' and '.join(within)}")
    if entry in seen:
        return
    seen.add(entry)
    text = _read(folder, entry)
    for name in _sources(IMPORT, text, entry):
        yield from _closure(folder, name, (*within, entry), seen)
    yield entry
    for name in _sources(LAZY, text, entry):
        if name not in ENTRIES:
            yield from _closure(folder, name, (), seen)


def _sources(pattern: re.Pattern[str], text: str, importer: str) -> list[str]:
    found = (match["source"] for match in pattern.finditer(text))
    return [_resolve(source, importer) for source in found if source.startswith(".")]


def _as_function(folder: Path, name: str, entry: str, libraries: dict[str, str]) -> str:
    """A module as a function of its name that answers what it exports."""

    def bind(match: re.Match[str]) -> str:
        what, source = match["what"], match["source"]
        if source.startswith("."):
            given = f"use('{_resolve(source, name)}')"
        else:
            given = libraries.setdefault(source, f"library{len(libraries)}")
        if what is None:
            return f"{given};\n"
        if what.startswith("{"):
            return f"const {what.replace(' as ', ': ')} = {given};\n"
        return f"const {what.removeprefix('* as ')} = {given}{'' if what.startswith('*') else '.default'};\n"

    def fetch(match: re.Match[str]) -> str:
        wanted = _resolve(match["source"], name)
        if wanted in ENTRIES:
            return f"import('{_relative(wanted, entry)}')"
        return f"Promise.resolve('{wanted}').then(use)"

    text = EXPORT.sub("", LAZY.sub(fetch, IMPORT.sub(bind, _read(folder, name))))
    unknown = UNKNOWN.search(text)
    if unknown:
        raise ValueError(f"{name}: {unknown[0]!r} cannot be joined")
    text = text.replace("import.meta.url", f"new URL('{_relative(name, entry)}', import.meta.url)")
    return f"'{name}'() {{\n{text}return {{ {', '.join(_exports(folder, name))} }};\n}},\n"


def _exports(folder: Path, name: str) -> list[str]:
    return [match["name"] for match in EXPORT.finditer(_read(folder, name))]


def _read(folder: Path, name: str) -> str:
    return (folder / name).read_text(encoding="utf-8")


def _resolve(source: str, importer: str) -> str:
    """The name of a module that another one imports by a relative path."""
    parts = importer.split("/")[:-1]
    for step in source.split("/"):
        if step == "..":
            parts.pop()
        elif step != ".":
            parts.append(step)
    return "/".join(parts)


def _relative(name: str, entry: str) -> str:
    """The path to a module from that of an entry."""
    return "./" + "../" * entry.count("/") + name
