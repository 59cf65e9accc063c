"""The files that put Caesura on other machines agree with the code, as far as can be checked here."""

import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from caesura.service.commands.cli import main
from caesura.service.settings import ServiceSettings
from caesura.worker.queue.queues import QUEUES
from tests.docs.test_settings_table import variable

USER = 10001


@pytest.fixture(scope="module")
def objects(checkout: Path) -> dict[str, dict[str, Any]]:
    """The objects of the Kubernetes example, by kind and name."""
    documents = yaml.safe_load_all((checkout / "docs" / "kubernetes.yaml").read_text(encoding="utf-8"))
    return {f"{document['kind']} {document['metadata']['name']}": document for document in documents}


@pytest.fixture(scope="module")
def compose(checkout: Path) -> dict[str, Any]:
    """The services of docker-compose.yml, with what they share merged in."""
    services: dict[str, Any] = yaml.safe_load((checkout / "docker-compose.yml").read_text(encoding="utf-8"))["services"]
    return services


def pods(objects: dict[str, Any]) -> dict[str, Any]:
    return {name: found["spec"]["template"] for name, found in objects.items() if found["kind"] == "Deployment"}


def test_pods_run_as_a_number_on_a_root_that_cannot_be_written(objects: dict[str, Any]) -> None:
    """No root, no new privileges, no capabilities; what is written goes to volumes."""
    assert len(pods(objects)) == 2
    for pod in pods(objects).values():
        assert pod["spec"]["securityContext"]["runAsNonRoot"]
        assert pod["spec"]["securityContext"]["runAsUser"] == USER
        (container,) = pod["spec"]["containers"]
        guarded = {"readOnlyRootFilesystem": True, "allowPrivilegeEscalation": False, "capabilities": {"drop": ["ALL"]}}
        assert container["securityContext"] == guarded
        mounted = {mount["name"]: mount["mountPath"] for mount in container["volumeMounts"]}
        assert mounted == {"data": "/data", "tmp": "/tmp"}
        assert {volume["name"] for volume in pod["spec"]["volumes"]} == set(mounted)


def test_selectors_find_their_pods(objects: dict[str, Any]) -> None:
    """Deployments, the service and KEDA name what there is."""
    labels = {name: pod["metadata"]["labels"] for name, pod in pods(objects).items()}
    for name, found in labels.items():
        assert objects[name]["spec"]["selector"]["matchLabels"] == found
    assert objects["Service caesura"]["spec"]["selector"] == labels["Deployment caesura-web"]
    assert f"Deployment {objects['ScaledObject caesura-worker']['spec']['scaleTargetRef']['name']}" in labels


def test_keda_counts_the_list_that_rq_keeps(objects: dict[str, Any]) -> None:
    """The queue's own name for its list."""
    (trigger,) = objects["ScaledObject caesura-worker"]["spec"]["triggers"]
    assert trigger["metadata"]["listName"] == f"rq:queue:{QUEUES[0]}"


def test_workers_are_asked_whether_they_live(objects: dict[str, Any], compose: dict[str, Any]) -> None:
    """By `caesura worker --check`, which is there, in both files; the pod gets longer to end than its take."""
    spec = pods(objects)["Deployment caesura-worker"]["spec"]
    (worker,) = spec["containers"]
    check = ["caesura", "worker", "--check"]
    assert worker["livenessProbe"]["exec"]["command"] == worker["startupProbe"]["exec"]["command"] == check
    assert compose["worker"]["healthcheck"]["test"][1:] == check
    assert "worker" in main.commands
    (stop,) = (int(item["value"]) for item in worker["env"] if item["name"] == "CAESURA_STOP_SECONDS")
    assert stop < spec["terminationGracePeriodSeconds"]


def test_every_setting_is_one(checkout: Path) -> None:
    """No file sets what nobody reads."""
    known = {variable(name, field) for name, field in ServiceSettings.model_fields.items()}
    for name in ("docs/kubernetes.yaml", "docker-compose.yml", "Dockerfile"):
        used = set(re.findall(r"\b(CAESURA_[A-Z_]+)\b", (checkout / name).read_text(encoding="utf-8")))
        assert used <= known, f"{name}: {used - known}"


def test_compose_scales_workers_and_writes_only_to_its_volume(compose: dict[str, Any]) -> None:
    """No name and no port is fixed to a worker, so that there can be several; root cannot be written."""
    assert not {"container_name", "ports", "hostname"} & set(compose["worker"])
    for name in ("web", "worker"):
        assert compose[name]["read_only"] is True
        assert compose[name]["cap_drop"] == ["ALL"]
    assert compose["web"]["ports"] == ["127.0.0.1:8000:8000"]
    assert "noeviction" in compose["redis"]["command"]


def test_redis_wants_a_password(objects: dict[str, Any], compose: dict[str, Any], checkout: Path) -> None:
    """In both files and on the page; without one nothing starts, and no password stands in a file of this project."""
    demanded = re.compile(r"\$\{REDIS_PASSWORD:\?")
    command = compose["redis"]["command"]
    assert demanded.match(command[command.index("--requirepass") + 1])
    assert demanded.match(compose["redis"]["environment"]["REDIS_PASSWORD"])
    for name in ("web", "worker"):
        assert re.fullmatch(
            r"redis://:\$\{REDIS_PASSWORD:\?.*\}@redis:6379/0", compose[name]["environment"]["REDIS_URL"]
        )
    secret = objects["Secret caesura"]["stringData"]
    assert secret["REDIS_URL"].startswith(f"redis://:{secret['REDIS_PASSWORD']}@")
    (trigger,) = objects["ScaledObject caesura-worker"]["spec"]["triggers"]
    assert trigger["metadata"]["passwordFromEnv"] == "REDIS_PASSWORD"
    assert "REDIS_URL=redis://:" in (checkout / "docs" / "operations.md").read_text(encoding="utf-8")


def test_the_image_runs_as_the_same_number(checkout: Path) -> None:
    """The Dockerfile's user is a number, so that Kubernetes can see that it is not root."""
    text = (checkout / "Dockerfile").read_text(encoding="utf-8")
    assert re.search(rf"^USER {USER}:{USER}$", text, re.MULTILINE)
