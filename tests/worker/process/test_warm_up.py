"""What is compiled before the workers are forked."""

import subprocess
import sys


def test_a_gltf_is_sampled_before_the_fork():
    """Numba's loops over keys, poses and streams are compiled: a job on a new machine does not wait for that."""
    script = (
        "from caesura.worker.process.warm_up import warm_up; warm_up(); "
        "from caesura.formats.kernels.keyframe_sampling import sample_tracks; "
        "from caesura.formats.kernels.posing import skin_morphed_vertices, skin_vertices; "
        "from caesura.formats.kernels.meshopt_attributes import decode_attributes; "
        "print(*(bool(k.signatures) for k in (sample_tracks, skin_vertices, skin_morphed_vertices, decode_attributes)))"
    )
    told = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True, timeout=120)
    assert told.stdout.split() == ["True"] * 4
