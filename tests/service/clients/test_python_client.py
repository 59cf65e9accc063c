"""A client that openapi-python-client generates with plain defaults goes the whole journey."""

import io
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest


@pytest.fixture(scope="module")
def package(description, tmp_path_factory):
    """The generated package, imported; the generator leaves nothing of the document out."""
    folder = tmp_path_factory.mktemp("generated")
    run = subprocess.run(
        [Path(sys.executable).parent / "openapi-python-client", "generate", "--path", description, "--meta", "none",
         "--output-path", folder / "generated_caesura", "--overwrite"],
        check=True, capture_output=True, text=True, cwd=folder,
        env={"PATH": str(Path(sys.executable).parent), "PYTHONUTF8": "1"},
    )  # fmt: skip
    assert "Warning" not in run.stdout + run.stderr, run.stdout + run.stderr
    sys.path.insert(0, str(folder))
    yield "generated_caesura"
    sys.path.remove(str(folder))


@pytest.fixture
def ask(package, service):
    """Calls an operation by its name, as `ask("results", "get_result_csv", id)`; answers what the client read."""
    client = import_module(package).Client(service.url, timeout=60)

    def ask(tag, operation, *place, status=200, **given):
        answer = import_module(f"{package}.api.{tag}.{operation}").sync_detailed(*place, client=client, **given)
        assert answer.status_code == status, answer.content[:500]
        return answer.parsed

    with client:
        yield ask


@pytest.fixture
def models(package):
    return import_module(f"{package}.models")


def test_the_journey_with_plain_defaults(ask, models, package, nodding):
    """Upload, wait, the result in every form, revise, clips, delete: each answer is of the type that it should be."""
    types = import_module(f"{package}.types")
    content = nodding("journey").read_bytes()
    form = models.UploadForm(file=[types.File(io.BytesIO(content), "journey.glb")])
    animation = ask("animations", "upload_animation", body=form, status=201)
    assert isinstance(animation, models.AnimationDocument)
    assert (animation.name, animation.takes[0].frames) == ("journey.glb", 240)
    known = ask("animations", "upload_animation", body=types.File(io.BytesIO(content)), name="journey.glb")
    assert known.id == animation.id

    request = models.SegmentationRequest(animation=animation.id)
    status = ask("segmentations", "create_segmentation", body=request, prefer="wait=30")
    assert status.status == "done"
    assert ask("segmentations", "get_segmentation", status.id, prefer="wait=1").segments == status.segments
    assert "event: status" in ask("segmentations", "follow_segmentation", status.id)
    listed = ask("segmentations", "list_segmentations", animation=animation.id).segmentations
    assert [one.id for one in listed] == [status.id]

    document = ask("results", "get_result", status.id)
    assert isinstance(document, models.SegmentationDocument)
    assert ask("results", "get_result_json", status.id) == document
    assert document.frames == document.segments[-1].end == 240
    assert ask("results", "get_result_csv", status.id).startswith("name,motion,start,end")
    npz = np.load(ask("results", "get_result_npz", status.id, prefer="wait=30").payload)
    assert npz["labels"].shape == (240,)
    assert ask("results", "get_result_vtt", status.id).startswith("WEBVTT")
    assert "<ANNOTATION_DOCUMENT" in ask("results", "get_result_eaf", status.id)
    assert b"<svg" in ask("results", "get_plot_svg", status.id).payload.read()
    assert ask("results", "get_plot_png", status.id, prefer="wait=30").payload.read(4) == b"\x89PNG"
    assert ask("results", "get_viewer", status.id).frames == 240
    assert ask("results", "get_viewer_model", status.id).payload.read(4) == b"glTF"

    edit = models.Edit(start=0, end=240, motion=0, name="all")
    revision = models.RevisionRequest(segments=[edit], note="one motion")
    kept = ask("revisions", "create_revision", status.id, body=revision, if_match='"0"', status=201)
    assert kept.segments[0].name == "all"
    assert len(ask("revisions", "list_revisions", status.id).revisions) == 2
    assert ask("revisions", "get_revision", status.id, "latest").revision == 1

    assert ask("clips", "get_clip_plan", status.id, revision="1").clips[0].motion == "all"
    assert ask("clips", "get_clips", status.id, revision="1", prefer="wait=30").payload.read(4) == b"glTF"
    assert ask("clips", "get_key_frames", status.id, prefer="wait=30").payload.read(4) == b"glTF"
    assert ask("animations", "download_animation", animation.id).payload.read() == content

    ask("segmentations", "delete_segmentation", status.id, status=204)
    ask("animations", "delete_animation", animation.id, status=204)
    gone = ask("animations", "get_animation", animation.id, status=404)
    assert isinstance(gone, models.Problem)
    assert gone.code == "not-found"


def test_parameters_go_with_a_file_and_with_a_form(ask, models, package, nodding):
    """In the query beside a raw body, in the form beside its files; an empty form is refused with a problem."""
    types = import_module(f"{package}.types")
    content = nodding("with-parameters").read_bytes()
    raw = ask("segmentations", "create_segmentation", body=types.File(io.BytesIO(content)), motions=2, prefer="wait=30")
    file = types.File(io.BytesIO(content))
    form = models.SegmentationForm(file=[file], motions=2, trim=False)
    again = ask("segmentations", "create_segmentation", body=form, prefer="wait=30")
    assert raw.id == again.id
    assert again.parameters["motions"] == 2


def test_probes_and_tables_are_read(ask, models):
    """What the service says of itself."""
    assert ask("health", "check_health").status == "ok"
    assert ask("health", "check_readiness").status == "ready"
    assert "caesura_requests_total" in ask("health", "get_metrics")
    assert ask("about", "list_methods").default
    assert ask("about", "list_formats").formats[0].suffixes
    assert ask("about", "list_exports").exports
    assert ask("about", "get_limits").max_upload_bytes
