# SPDX-License-Identifier: GPL-3.0-or-later
"""pip builds a wheel that works without the source."""

import os
import subprocess
import sys

import pytest

from conftest import root


def test_a_wheel_is_small_and_can_be_installed(tmp_path):
    build = os.environ.get("LODESTONE_BUILD_FOLDER")
    if not build:
        pytest.skip("LODESTONE_BUILD_FOLDER does not name a build folder")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
    subprocess.run(pip + ["wheel", "--no-build-isolation", "--no-deps", "-w", tmp_path, root], check=True)
    (wheel,) = tmp_path.glob("lodestone-*.whl")
    assert wheel.stat().st_size < 10_000_000
    installed = tmp_path / "installed"
    subprocess.run(pip + ["install", "--no-deps", "--no-index", "--target", installed, wheel], check=True)
    script = (
        "import lodestone, numpy as np;"
        "v = np.eye(3); f = [[0, 1, 2]];"
        "assert lodestone.find_collisions((v, f), (v, f)).faces.tolist() == [[0, 0]];"
        "d = lodestone.Detector(); d.add(v, f); assert '<iframe' in d.detect().show()._repr_html_();"
        "print(lodestone.__file__)"
    )
    environment = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"} | {"PYTHONPATH": str(installed)}
    told = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, env=environment, check=True, capture_output=True,
                          text=True)
    assert told.stdout.startswith(str(installed))
    assert (installed / "lodestone" / "__init__.pyi").exists() and (installed / "lodestone" / "py.typed").exists()
