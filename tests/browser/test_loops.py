"""Loops: played on the page, exported, and played by three.js without a jump."""

import base64
import io
import json
import re
import struct
from pathlib import Path

import numpy as np
import pytest
from playwright.sync_api import Page, expect

from tests.browser.journeys import opened, saved, seen_once
from tests.browser.test_export_panel import downloaded, take_names

pytestmark = pytest.mark.timeout(240)

PLAYED = """async ([base64, name, rate]) => {
    const [three, { GLTFLoader }] = await Promise.all([import('three'), import('three/addons/loaders/GLTFLoader.js')]);
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const gltf = await new GLTFLoader().parseAsync(bytes.buffer, '');
    const renderer = new three.WebGLRenderer({ canvas: document.createElement('canvas'), preserveDrawingBuffer: true });
    renderer.setSize(160, 160, false);
    const scene = new three.Scene();
    scene.add(gltf.scene, new three.HemisphereLight(0xffffff, 0x444444, 3));
    const box = new three.Box3().setFromObject(gltf.scene);
    const camera = new three.PerspectiveCamera(40, 1, 0.01, 1000);
    const middle = box.getCenter(new three.Vector3());
    const far = box.getSize(new three.Vector3()).length();
    camera.position.copy(middle).add(new three.Vector3(1, 0.4, 1).multiplyScalar(far));
    camera.lookAt(middle);
    const clip = three.AnimationClip.findByName(gltf.animations, name);
    const mixer = new three.AnimationMixer(gltf.scene);
    mixer.clipAction(clip).play();
    const gl = renderer.getContext();
    const frames = Math.round(clip.duration * rate);
    const pictures = [];
    const step = clip.duration / frames;
    for (let frame = 0; frame < 2 * frames; frame++) {
        renderer.render(scene, camera);
        const data = new Uint8Array(160 * 160 * 4);
        gl.readPixels(0, 0, 160, 160, gl.RGBA, gl.UNSIGNED_BYTE, data);
        pictures.push(data);
        mixer.update(step);
    }
    const apart = (one, other) => one.reduce((sum, value, i) => sum + Math.abs(value - other[i]), 0) / one.length;
    const steps = pictures.slice(1).map((picture, i) => apart(picture, pictures[i]));
    return { frames, steps, first: pictures[0].reduce((sum, value) => sum + value, 0) };
}"""


@pytest.fixture(scope="module")
def result(kept_page: Page, own: Path) -> Page:
    """The result of our own figure, wide enough for all tools."""
    kept_page.set_viewport_size({"width": 1400, "height": 800})
    opened(kept_page, own)
    return kept_page


def test_the_loop_of_a_segment_says_how_well_it_closes_and_plays(result: Page) -> None:
    """A press plays it round and round; another stops it."""
    result.locator("#segments .segment").first.click()
    loop = result.locator("#play-loop")
    expect(loop).to_contain_text("good match")
    loop.click()
    expect(loop).to_have_attribute("aria-pressed", "true")
    result.wait_for_timeout(2500)  # as long as it takes to run out of it
    seen: set[int] = set()
    frame = result.locator("#frame")
    seen_once(result, lambda: seen.add(int(frame.input_value())), lambda _: len(seen) > 7)
    assert len(seen) > 7
    assert max(seen) - min(seen) < 100
    loop.click()
    expect(loop).to_have_attribute("aria-pressed", "false")


def test_the_panel_exports_the_best_loops(result: Page, tmp_path: Path) -> None:
    """Their names and scores are shown before; the file has the clips; three.js plays them without a jump."""
    result.locator("#export-open").click()
    form = result.locator("#export-form")
    form.locator("[name=loop]").select_option("auto")
    form.locator("[name=loop_blend_seconds]").fill("0.2")
    form.locator("[name=in_place]").check()
    expect(result.locator("#export-names .match").first).to_contain_text("good")
    names = [name for name in result.locator("#export-names .name").all_text_contents() if name.endswith("-loop")]
    saved = downloaded(result, "#export-save", tmp_path)
    result.locator("#export-close").click()
    assert set(names) <= set(take_names(saved.read_bytes()))
    for name in names[:2]:
        played = result.evaluate(PLAYED, [base64.b64encode(saved.read_bytes()).decode(), name, 30])
        steps, frames = np.array(played["steps"]), played["frames"]
        assert steps.max() > 0.05, "something moves"
        assert steps[frames - 1] <= 2 * np.median(steps), (name, steps[frames - 2 : frames + 1])


def test_a_marked_segment_is_saved_as_its_loop(result: Page, tmp_path: Path) -> None:
    """One click marks it, one saves it."""
    result.locator("#segments .segment").first.click()
    result.locator("#flag-loop").click()
    glb = downloaded(result, "#one-clip", tmp_path).read_bytes()
    assert take_names(glb) == ["A_01-loop"]
    (length,) = struct.unpack_from("<I", io.BytesIO(glb).getbuffer(), 12)
    extras = json.loads(glb[20 : 20 + length])["animations"][0]["extras"]["caesura"]
    assert extras["loop"]["match"] == "good"
    result.keyboard.press("Control+z")


def test_a_part_of_a_segment_has_a_loop_of_its_own(result: Page) -> None:
    """Split in the middle of its loop, each part is offered one that lies within it."""
    here = f"/v1/segmentations/{result.url.split('/view/')[1].split('#')[0]}/result.json"
    loop = result.request.get(here).json()["segments"][0]["best_loop"]
    result.locator("#frame").fill(str((loop["start"] + loop["end"]) // 2))
    result.locator("#frame").press("Enter")
    result.locator("#split").click()
    saved(result)
    parts = result.request.get(f"{here}?revision=latest").json()["segments"][:2]
    for index, part in enumerate(parts):
        found = part["best_loop"]
        assert part["start"] <= found["start"] < found["end"] <= part["end"]
        result.locator("#segments .segment").nth(index).click()
        text = re.compile(f"frames {found['start']} to {found['end']}[.]")
        expect(result.locator("#play-loop")).to_have_attribute("title", text)
