# SPDX-License-Identifier: GPL-3.0-or-later
"""Builds the Python package with CMake.

The build folder is build/python; LODESTONE_BUILD_FOLDER names another one, in which the module may be built already.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

root = pathlib.Path(__file__).parent.resolve()
header = (root / "include" / "lodestone" / "version.h").read_text()
version = ".".join(re.search(rf"LODESTONE_VERSION_{part} (\d+)", header)[1] for part in ("MAJOR", "MINOR", "PATCH"))


class Build_with_cmake(build_ext):
    def build_extension(self, extension):
        folder = pathlib.Path(os.environ.get("LODESTONE_BUILD_FOLDER", root / "build" / "python"))
        if not (folder / "build.ninja").exists():
            subprocess.run(
                ["cmake", "-S", root, "-B", folder, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
                 "-D", "CMAKE_UNITY_BUILD=ON", "-D", "LODESTONE_BUILD_PYTHON=ON", "-D", "LODESTONE_BUILD_PROGRAM=OFF",
                 "-D", "LODESTONE_BUILD_TESTS=OFF"],
                check=True,
            )
        jobs = os.environ.get("JOBS", "2")  # compiling CGAL takes up to a gigabyte of memory per job
        subprocess.run(["cmake", "--build", folder, "--parallel", jobs, "--target", "lodestone_python"], check=True)
        target = pathlib.Path(self.get_ext_fullpath(extension.name))
        target.parent.mkdir(parents=True, exist_ok=True)
        built = folder / "python" / "lodestone" / ("_lodestone" + sysconfig.get_config_var("EXT_SUFFIX"))
        if not built.exists():
            raise SystemExit(f"{built} is missing: the module is built for /usr/bin/python3, not for {sys.executable}")
        shutil.copy2(built, target)


setup(
    name="lodestone",
    version=version,
    description="Collision detection for triangle meshes that deform",
    long_description=(root / "python" / "README.md").read_text(),
    long_description_content_type="text/markdown",
    license="GPL-3.0-or-later",
    python_requires=">=3.9",
    install_requires=["numpy"],
    package_dir={"": "python"},
    packages=["lodestone"],
    package_data={"lodestone": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("lodestone._lodestone", sources=[])],
    cmdclass={"build_ext": Build_with_cmake},
)
