"""An S3-compatible store as tests have it: moto's server, a process of its own with its objects in memory."""

import signal
import socket
import subprocess
import sys
import time
from dataclasses import dataclass
from urllib.parse import urlsplit

import boto3
import httpx
from botocore.config import Config

BUCKET = "takes"


def free_port():
    """A port that nobody has just now."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@dataclass
class ObjectStore:
    """A running server with one empty bucket. `environment` is what the AWS tools, and obstore, read."""

    url: str
    process: subprocess.Popen

    @classmethod
    def start(cls, port=0):
        port = port or free_port()
        command = [sys.executable, "-m", "moto.server", "-H", "127.0.0.1", "-p", str(port)]
        quiet = subprocess.DEVNULL
        process = subprocess.Popen(command, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True)
        store = cls(f"http://127.0.0.1:{port}", process)
        store._until_it_answers()
        store.client().create_bucket(Bucket=BUCKET)
        return store

    def _until_it_answers(self):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            assert self.process.poll() is None, "the store ended"
            try:
                httpx.get(self.url, trust_env=False)
            except httpx.TransportError:
                time.sleep(0.02)
            else:
                return
        raise TimeoutError("the store did not answer")

    @property
    def environment(self):
        return {
            "AWS_ENDPOINT_URL": self.url,
            "AWS_ALLOW_HTTP": "true",
            "AWS_ACCESS_KEY_ID": "tests",
            "AWS_SECRET_ACCESS_KEY": "of the tests",
            "AWS_REGION": "us-east-1",
        }

    @property
    def port(self):
        return urlsplit(self.url).port

    def client(self):
        """Another program's view of it: Amazon's own library."""
        return boto3.client(
            "s3",
            endpoint_url=self.url,
            aws_access_key_id="tests",
            aws_secret_access_key="of the tests",
            region_name="us-east-1",
            config=Config(proxies={}, retries={"max_attempts": 0}),
        )

    def keys(self):
        """What it holds."""
        return [found["Key"] for found in self.client().list_objects_v2(Bucket=BUCKET).get("Contents", [])]

    def half_written(self):
        """Uploads in parts that nobody ended."""
        return self.client().list_multipart_uploads(Bucket=BUCKET).get("Uploads", [])

    def pause(self):
        """It answers nobody, as a host whose network is gone."""
        self.process.send_signal(signal.SIGSTOP)

    def resume(self):
        self.process.send_signal(signal.SIGCONT)

    def stop(self):
        self.process.kill()
        self.process.wait()
