"""The pages of the documentation site that do not lie in docs/: mkdocs calls this (mkdocs.yml names it as a hook).

README.md is the home page; CHANGELOG.md, CONTRIBUTING.md and LICENSE lie beside docs/. The reference of Python is made
of the public names, and the page of the notebook by running it.
"""

import re
import tempfile
from pathlib import Path
from typing import Any

import nbclient
import nbformat
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

import caesura

ROOT = Path(__file__).resolve().parent.parent
BESIDE = {"README.md": "index.md"} | {name: name for name in ("CHANGELOG.md", "CONTRIBUTING.md", "LICENSE")}
"""Files beside docs/, and what they are called in the site."""
NOTEBOOK = "examples/notebook.ipynb"
SECONDS_FOR_A_CELL = 300
LIST_AFTER_TEXT = re.compile(r"(?m)^((?![-*#>|\s]|\d+\. ).+\n)(?=(?:-|\d+\.) )")
MORE_NAMES = (
    "caesura.core.segmentation_document.SegmentationDocument",
    "caesura.core.segmentation_document.Segment",
    "caesura.core.errors.InputError",
    "caesura.core.errors.ParameterError",
    "caesura.client.errors.ServiceProblem",
    "caesura.client.errors.Unreachable",
)
"""What public functions answer with and raise, beside the names of the package itself."""


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages."""
    made = {"reference.md": reference(), "notebook.md": notebook(ROOT / "docs" / NOTEBOOK)}
    for source, name in BESIDE.items():
        made[name] = (ROOT / source).read_text(encoding="utf-8")
    for name, content in made.items():
        files.append(File.generated(config, name, content=content))
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:  # noqa: ARG001  mkdocs' names
    """Links as they are in the site, and lists as this Markdown wants them: after an empty line."""
    if page.file.src_uri in BESIDE.values():
        markdown = re.sub(r"\]\(docs/", "](", markdown)
    for source, name in BESIDE.items():
        up = "../" * page.file.src_uri.count("/")
        markdown = markdown.replace(f"](../{up}{source}", f"]({up}{name}")
    parts = re.split(r"(?ms)(^```.*?^```)", markdown)
    return "".join(part if part.startswith("```") else LIST_AFTER_TEXT.sub(r"\1\n", part) for part in parts)


def reference() -> str:
    """A page with every public name."""
    homes = [f"{getattr(caesura, name).__module__}.{name}" for name in caesura.__all__]
    head = "# Python reference\n\nWhat `import caesura` offers, and what its functions answer with and raise.\n\n"
    return head + "".join(f"::: {name}\n\n" for name in [*homes, *MORE_NAMES])


def notebook(path: Path) -> str:
    """The cells of a notebook with what they show, run now."""
    book = nbformat.read(path, as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        about = {"metadata": {"path": folder}}
        nbclient.NotebookClient(book, timeout=SECONDS_FOR_A_CELL, resources=about).execute()
    shown = [cell.source if cell.cell_type == "markdown" else _code_cell(cell) for cell in book.cells]
    return "\n\n".join([*shown, f"[The notebook as a file]({NOTEBOOK})"])


def _code_cell(cell: Any) -> str:
    return "\n\n".join([f"```python\n{cell.source}\n```", *map(_output, cell.outputs)])


def _output(output: Any) -> str:
    data = output.get("data", {})
    if "text/html" in data:
        return f"<div>{re.sub(chr(10) + '+', chr(10), data['text/html'])}</div>"
    if "image/png" in data:
        return f'<img alt="What the cell draws" src="data:image/png;base64,{data["image/png"].strip()}">'
    return f"```text\n{data.get('text/plain', output.get('text', ''))}\n```"
