#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fails, naming file and line, where a file includes something from a higher floor: check_floors.py SOURCE_FOLDER.

The floors are listed in src/floors.txt. Two more rules: the experiments stand above all floors, and within them
experiments/shared below the others; nothing in the library includes tests.
"""
import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"')
SUFFIXES = {".h", ".cpp", ".in"}


def read_floors(source):
    lines = (source / "src/floors.txt").read_text().splitlines()
    names = [line.strip() for line in lines if line.strip() and not line.startswith("#")]
    names += ["experiments/shared", "experiments"]
    return {name: height for height, name in enumerate(names)}


def floor_of(path, floors):
    """The floor of a file, given relative to the source folder; None for what stands outside (tests, examples)."""
    parts = path.parts
    if parts[0] == "include":
        inner = parts[2:]
    elif parts[0] == "src":
        inner = parts[1:]
    elif parts[0] == "experiments":
        return "experiments/shared" if parts[1] == "shared" else "experiments"
    else:
        return None
    if len(inner) == 1:
        return "front_door"
    folder = "/".join(inner[:-1])
    if folder not in floors:
        raise SystemExit(f"{path}: folder {folder} is no floor: add it to src/floors.txt, or move the file")
    return folder


def included_file(path, name, source):
    for folder in (path.parent, source / "include", source / "src", source / "experiments"):
        if (folder / name).is_file():
            return (folder / name).resolve().relative_to(source)
    return None


def upward_includes(source):
    floors = read_floors(source)
    files = [p for top in ("include", "src", "experiments") for p in sorted((source / top).rglob("*")) if p.suffix in SUFFIXES]
    used = set()
    arrows = []
    for path in files:
        own = floor_of(path.relative_to(source), floors)
        used.add(own)
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
            match = INCLUDE.match(line)
            target = match and included_file(path, match[1], source)
            if not target:
                continue
            other = floor_of(target, floors)
            if other is None or floors[other] > floors[own]:
                arrows.append(f"{path.relative_to(source)}:{number}: {own} includes {target} of {other or 'no floor'}, which lies above it")
    empty = [name for name in floors if name not in used]
    return arrows + [f"src/floors.txt: floor {name} holds no file" for name in empty], len(files)


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    wrong, files = upward_includes(source)
    if files == 0:
        raise SystemExit(f"{source}: no source file found")
    print("\n".join(wrong) if wrong else f"{files} files include downwards only")
    sys.exit(1 if wrong else 0)


main()
