"""The page's modules are sent in two files, in which they do what they do one by one."""

import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from caesura.service.page.joined_modules import ENTRIES, join_modules

MODULES = {
    "app.js": """\
import * as shared from './parts/shared.js';
import { say } from './parts/shared.js';
say('app');
globalThis.address = new URL('./worker.js', import.meta.url).pathname.split('/').at(-1);
globalThis.seen = import('./parts/late.js').then(({ done }) => done(typeof shared.say));
""",
    "parts/late.js": """\
import {
  say as tell,
} from './shared.js';
tell('late');
export function done(word) { return tell(word); }
export const unused = async () => (await import('../figure/scene.js')).FigureScene;
""",
    "parts/shared.js": """\
const log = [];
export const say = (word) => { log.push(word); return log; };
say('shared');
""",
    "figure/scene.js": """\
import { say } from '../parts/shared.js';
import { $ } from './light.js';
export class FigureScene { words = say($); }
""",
    "figure/light.js": "export const $ = 'light';\n",
}
PAGE = """\
await import('./app.js');
const words = [...await globalThis.seen];
const { FigureScene } = await import('./figure/scene.js');
console.log(JSON.stringify([globalThis.address, words, new FigureScene().words]));
"""


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A page of a few modules."""
    return written(tmp_path / "viewer", MODULES)


@pytest.fixture
def seen(node: Path) -> Callable[[Path], object]:
    """What a page in a folder sees when it imports both entries."""

    def run(folder: Path) -> object:
        written(folder, {"page.mjs": PAGE, "package.json": '{"type": "module"}'})
        done = subprocess.run([node, folder / "page.mjs"], capture_output=True, text=True, check=True)
        return json.loads(done.stdout)

    return run


def written(folder: Path, files: dict[str, str]) -> Path:
    """A folder with these files in it."""
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_joined_modules_do_what_they_do_one_by_one(folder: Path, tmp_path: Path, seen) -> None:
    """In the same order, each once, what is imported later only then, and what both files use shared between them."""
    joined = written(tmp_path / "joined", {entry: join_modules(folder, entry) for entry in ENTRIES})
    once = ["shared", "app", "late", "function"]
    assert seen(folder) == seen(joined) == ["worker.js", once, [*once, "light"]]


def test_a_circle_and_an_unknown_statement_are_refused(folder: Path) -> None:
    """Both would fail in the browser alone, and later."""
    written(folder, {"parts/shared.js": "import './late.js';\n"})
    with pytest.raises(ValueError, match=r"parts/shared\.js imports itself by way of .*parts/late\.js"):
        join_modules(folder, "app.js")
    written(folder, {"parts/shared.js": "export default 1;\n"})
    with pytest.raises(ValueError, match="'export default 1;' cannot be joined"):
        join_modules(folder, "app.js")


def test_the_page_comes_in_two_files(idle) -> None:
    """Every module is in one of them, the modules that draw in the second; a browser that has them is sent nothing."""
    answers = [idle.http.get(f"/static/viewer/{entry}") for entry in ENTRIES]
    held = [re.findall(r"^'([^']+)'\(\) \{$", answer.text, re.MULTILINE) for answer in answers]
    assert "figure/scene.js" in held[1]
    assert "result_page.js" in held[0]
    assert not {*held[0]} & {*held[1]}
    assert "from 'three'" not in answers[0].text
    assert all(answer.headers["Content-Encoding"] == "gzip" for answer in answers)
    tag = answers[0].headers["ETag"]
    again = idle.http.get("/static/viewer/app.js", headers={"If-None-Match": tag})
    assert again.status_code == 304
    plain = idle.http.get("/static/viewer/app.js", headers={"Accept-Encoding": "identity"})
    assert plain.text == answers[0].text
