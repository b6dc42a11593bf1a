#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Compares results of the program with recorded hashes: check_hashes.py PROGRAM [--all] [--only TEXT] [--record].

A hash is that of the bytes of frames.jsonl, for a scene and a mode, or of the coloured mesh of a partition. It is the
same for any number of threads, on any instruction set and from any compiler. The larger scenes are played in one way
only, and the largest in one mode, unless --all is given.

--record writes hashes.txt anew. Do so only where a change is meant to change results, and say so in the commit.
"""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parent
SCENES = TESTS.parent.parent / "data" / "scenes"
RECORD = TESTS / "hashes.txt"

USUAL_FRAMES = 6
FRAMES = {"bodies_20_5k": 3, "cloth_sphere_80k": 3, "spheres_50k": 3, "torus_knots_200k": 2, "spheres_500k": 2,
          "spheres_2m": 2}
LARGE = {"spheres_500k", "spheres_2m"}  # played in mode exact only, unless --all is given
MEDIUM = {"bodies_20_5k", "cloth_sphere_80k", "spheres_50k", "torus_knots_200k"}  # played in one way

CONTACTS = ["--contacts", "all", "--points", "--normals"]
ANSWERS = CONTACTS + ["--closest", "--containment", "--parting", "--patches"]
MODES = {
    "exact": ["--mode", "exact", *ANSWERS],
    "certified": ["--mode", "certified", *ANSWERS],
    "particles": ["--mode", "particles", *CONTACTS],
    "published": ["--mode", "particles", "--meetings", "0", *CONTACTS],
    "senin": ["--mode", "senin", *CONTACTS],
}
REGIONS = 20


def run(program, arguments, environment=None):
    result = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True,
                            env={**os.environ, **(environment or {})})
    if result.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, arguments))}: exit code {result.returncode}: {result.stderr}")


def hash_of(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()[:32]


def instruction_sets(program):
    """Those of this machine that the program has kernels for, the best one first."""
    refusal = subprocess.run([program, "info", SCENES / "inflate.json"], capture_output=True, text=True,
                             env={**os.environ, "LODESTONE_INSTRUCTION_SET": "?"})
    return re.search(r"expected (.*), found", refusal.stderr).group(1).split(" or ")


def strategies(program):
    text = subprocess.run([program, "partition", "--help"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  ([a-z_+]+) {2,}\S", text.split("Strategies:")[1].split("Exit codes:")[0], re.MULTILINE)


class Machine:
    """How a program is run: with so many threads, on an instruction set."""

    def __init__(self, threads=0, instructions=""):
        self.threads, self.instructions = threads, instructions

    def options(self):
        return ["--threads", self.threads] if self.threads else []

    def environment(self):
        chosen = {"LODESTONE_MOST_THREADS": str(self.threads)} if self.threads else {}
        if self.instructions:
            chosen["LODESTONE_INSTRUCTION_SET"] = self.instructions
        return chosen

    def __str__(self):
        return f"threads: {self.threads or 'default'}, instructions: {self.instructions or 'best'}"


class Results:
    """The program at work in a folder."""

    def __init__(self, program, folder):
        self.program, self.folder = program, pathlib.Path(folder)
        self.sets = instruction_sets(program)
        self.mesh = self.folder / "teapot.ply"
        run(program, ["convert", "shape:teapot", self.mesh, "--quiet"])
        for scene in SCENES.glob("*.json"):
            text = json.loads(scene.read_text())
            text["frames"] = FRAMES.get(scene.stem, USUAL_FRAMES)
            (self.folder / scene.name).write_text(json.dumps(text))

    def scenes(self):
        return sorted(path.stem for path in self.folder.glob("*.json"))

    def of_frames(self, scene, mode, machine, number):
        out = self.folder / f"out_{number}"
        run(self.program, ["detect", self.folder / f"{scene}.json", *MODES[mode], *machine.options(), "--quiet",
                           "--out", out], machine.environment())
        return hash_of(out / "frames.jsonl")

    def of_regions(self, strategy, machine, number):
        out = self.folder / f"regions_{number}.ply"
        threads = machine.options() if strategy == "lbg" else []
        run(self.program, ["partition", self.mesh, "--strategy", strategy, "--regions", REGIONS, *threads, "--quiet",
                           "--out", out], machine.environment())
        return hash_of(out)

    def machines(self, scene, all_of_them):
        """On which a scene is played: each number of threads and each instruction set, but not each with each."""
        threads = [1, 5, 2]
        machines = [Machine(threads[i % len(threads)], name) for i, name in enumerate(self.sets)]
        machines += [Machine(count, self.sets[0]) for count in threads[len(machines):]]
        return machines if all_of_them or scene not in LARGE | MEDIUM else machines[1:2]

    def tasks(self, all_of_them):
        """What is hashed: its name, and how to compute it, by machine."""
        for scene in self.scenes():
            for mode in MODES:
                if scene in LARGE and mode != "exact" and not all_of_them:
                    continue
                for machine in self.machines(scene, all_of_them):
                    yield f"{scene} {mode}", machine, lambda m, n, s=scene, o=mode: self.of_frames(s, o, m, n)
        for strategy in strategies(self.program):
            for machine in self.machines("", all_of_them) if strategy.startswith("lbg") else [Machine()]:
                yield f"teapot {strategy}", machine, lambda m, n, s=strategy: self.of_regions(s, m, n)


def read_record():
    if not RECORD.exists():
        return {}
    lines = [line.rsplit(" ", 1) for line in RECORD.read_text().splitlines() if not line.startswith("#")]
    return {name: value for name, value in lines}


def write_record(found):
    head = "# Hashes of results, written by check_hashes.py --record\n"
    RECORD.write_text(head + "".join(f"{name} {value}\n" for name, value in sorted(found.items())))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--all", action="store_true", help="all scenes in all modes and ways, which takes minutes")
    parser.add_argument("--only", default="", help="results whose names contain this text")
    parser.add_argument("--record", action="store_true", help="write the hashes anew")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        results = Results(arguments.program.resolve(), folder)
        tasks = [task for task in results.tasks(arguments.all or arguments.record) if arguments.only in task[0]]
        if arguments.record:
            tasks = list({task[0]: task for task in tasks}.values())  # each on one machine
        hashes = list(pool.map(lambda entry: entry[1][2](entry[1][1], entry[0]), enumerate(tasks)))
    expected = {} if arguments.record else read_record()
    wrong = 0
    for (name, machine, _), value in zip(tasks, hashes):
        if expected.setdefault(name, value if arguments.record else "nothing") != value:
            wrong += 1
            print(f"{name} ({machine}): expected {expected[name]}, found {value}", file=sys.stderr)
    sets = " ".join(results.sets)
    if wrong:
        raise SystemExit(f"{wrong} of {len(tasks)} runs differ ({sets})")
    if arguments.record:
        write_record(expected if not arguments.only else {**read_record(), **expected})
    print(f"{len(tasks)} runs of {len(set(name for name, _, _ in tasks))} hashes ({sets})")


if __name__ == "__main__":
    main()
