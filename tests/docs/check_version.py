#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that what tells of the project names the version of version.h: check_version.py REPOSITORY."""
import pathlib
import re
import sys

# Files, and the line that names the version.
FILES = {
    "CITATION.cff": r"^version: (.*)$",
    "docs/install.md": r"liblodestone(\d+\.\d+)`|find_package\(lodestone (\d+\.\d+)",
    "tests/package/CMakeLists.txt": r"find_package\(lodestone (\d+\.\d+)",
    "tests/package/sibling/CMakeLists.txt": r"find_package\(lodestone (\d+\.\d+)",
}


def version_of(repository):
    header = (repository / "include/lodestone/version.h").read_text(encoding="utf-8")
    return ".".join(re.search(rf"^#define LODESTONE_VERSION_{part} (\d+)$", header, re.M)[1] for part in ("MAJOR", "MINOR", "PATCH"))


def main():
    repository = pathlib.Path(sys.argv[1])
    version = version_of(repository)
    complaints = []
    for name, line in FILES.items():
        file = repository / name
        found = re.findall(line, file.read_text(encoding="utf-8"), re.M)
        if not found:
            complaints.append(f"{name}: no version is found")
        for other in ("".join(groups) for groups in found):
            if not (version + ".").startswith(other + "."):
                complaints.append(f"{name}: version {other}, but version.h has {version}")
    if complaints:
        sys.exit("\n".join(complaints))


main()
