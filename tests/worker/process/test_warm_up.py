"""What is compiled before the workers are forked."""

import subprocess
import sys


def test_a_gltf_is_sampled_before_the_fork():
    """Numba's loops over keys, poses and streams are compiled: a job on a new machine does not wait for that."""
    script = (
        "from worker.warming import warm; warm(); "
        "from core.formats.gltf import kernels; from core.formats.gltf.posing import kernels as poses; "
        "from core.formats.gltf.meshopt.attributes import kernels as streams; "
        "print(*(bool(loop.signatures) for loop in (kernels.sample, poses.palette, streams.attributes)))"
    )
    told = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True, timeout=120)
    assert told.stdout.split() == ["True", "True", "True"]
