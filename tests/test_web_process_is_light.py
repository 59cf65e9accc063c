"""The web process streams bytes and serves what is stored; nothing numerical is ever loaded into it."""

import subprocess
import sys

HEAVY = ("numpy", "PIL", "numba", "scipy", "sklearn", "trimesh", "threadpoolctl")

PROGRAM = f"""
import sys
from caesura.service.app import create_app
from caesura.service.settings import ServiceSettings
create_app(ServiceSettings(data_dir="/nonexistent")).openapi()
import caesura.service.__main__
print([name for name in {HEAVY!r} if name in sys.modules])
"""


def test_the_service_loads_nothing_numerical(checkout):
    """In a fresh interpreter, with every route built: no NumPy, Numba, SciPy or scikit-learn."""
    loaded = subprocess.run([sys.executable, "-c", PROGRAM], cwd=checkout, capture_output=True, text=True, check=True)
    assert loaded.stdout.strip() == "[]"
