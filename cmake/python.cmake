# SPDX-License-Identifier: GPL-3.0-or-later
# Debian's own Python, whose extension modules are installed as packages.
find_program(LODESTONE_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
set(PYTHON_EXECUTABLE ${LODESTONE_PYTHON})
set(Python_EXECUTABLE ${LODESTONE_PYTHON})
set(PYBIND11_FINDPYTHON ON)
find_package(pybind11 2.10 CONFIG REQUIRED)
