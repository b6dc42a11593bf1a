#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks single lines of the library, and tells which of these mutants the tests notice.

Each mutant changes one operator, constant or keyword of one line. The sample depends on the seed alone. One build holds
all of them, each behind a switch (switches.h), so that none needs a build of its own. A first run of all tests tells
which of them come to which mutant; each mutant is then tried by these until one fails. Every result is kept at once:
a run that was interrupted goes on where it ended.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

from mutants import Mutant, folder_of, sample, switched_text

PROGRAMS = ["mesh", "triangles", "volumes", "partition", "particles", "tree", "bounds", "filter", "queries", "detection",
            "contract", "threads", "io", "program"]
MOST_MEMORY, MOST_FILE = 8 << 30, 4 << 30  # bytes of a test: a mutant may ask for any amount
LONG = 2.0  # seconds; longer tests run by themselves, after the others


class Workplace:
    """A copy of the sources with the switches in it, and what is known of its tests."""

    def __init__(self, root, folder, spare):
        self.root, self.folder, self.spare = root, folder, spare
        self.copy, self.build_folder = folder / "copy", folder / "copy" / "build" / "mutation"

    def prepare(self, lines, seed):
        """Builds until everything compiles. Returns the mutants that do, at most so many."""
        kept = self.folder / "mutants.json"
        if not kept.exists():
            kept.write_text(json.dumps([dataclasses.asdict(mutant) for mutant in self.compile(lines, seed)], indent=1))
        return [Mutant(**record) for record in json.loads(kept.read_text())][:lines]

    def compile(self, lines, seed):
        chosen = {mutant.number: mutant for mutant in sample(self.root, lines + self.spare, seed)}
        shutil.rmtree(self.copy, ignore_errors=True)
        shutil.copytree(self.root, self.copy, symlinks=True, ignore=lambda folder, names: {
            "build", "out", ".git"} if pathlib.Path(folder) == self.root else set())
        self.originals = {mutant.file: (self.root / mutant.file).read_text() for mutant in chosen.values()}
        for file in self.originals:
            self.write(file, chosen.values())
        subprocess.run(["cmake", "--preset", "mutation"], cwd=self.copy, check=True, stdout=subprocess.DEVNULL)
        while (output := self.build()) is not None:
            wrong = blamed(output, chosen.values())
            if not wrong:
                sys.exit(f"the build fails for another reason:\n{output[-4000:]}")
            print(f"{len(wrong)} mutants do not compile", flush=True)
            files = {chosen.pop(number).file for number in wrong}
            for file in files:
                self.write(file, chosen.values())
        return chosen.values()

    def write(self, file, mutants):
        """Keeps the time of a file that was there: what has compiled with a mutant need not do so again without it."""
        path = self.copy / file
        before = path.stat()
        path.write_text(switched_text(self.copy, self.originals[file],
                                      [mutant for mutant in mutants if mutant.file == file]))
        os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))

    def build(self):
        """None, or what was printed if something did not compile."""
        done = subprocess.run(["ninja", "-C", str(self.build_folder), "-k", "0", "-j", os.environ.get("JOBS", "2"),
                               *[f"{name}_tests" for name in PROGRAMS], "lodestone_program"],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        return None if done.returncode == 0 else done.stdout

    def list_tests(self):
        """Name, program and filter of each test."""
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build_folder, check=True,
                                stdout=subprocess.PIPE, text=True)
        tests = []
        for test in json.loads(listed.stdout)["tests"]:
            command = test.get("command", [""])
            if command[0].endswith("_tests") and pathlib.Path(command[0]).exists():
                tests.append({"name": test["name"], "program": command[0],
                              "filter": command[1].removeprefix("--gtest_filter=")})
        return tests

    def run(self, program, filters, seconds, **variables):
        """Whether the tests pass in time."""
        with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as temporary:
            test = subprocess.Popen(
                [program, f"--gtest_filter={':'.join(filters)}", "--gtest_fail_fast", "--gtest_brief=1"],
                cwd=self.build_folder / "tests", env=os.environ | variables | {"TMPDIR": temporary}, preexec_fn=limit,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
            try:
                return test.wait(seconds) == 0
            except subprocess.TimeoutExpired:
                os.killpg(test.pid, signal.SIGKILL)  # with the programs that it has started
                test.wait()
                return False


def blamed(output, mutants):
    """The mutants on the lines that errors name; if they name none, those that anything printed names."""
    for pattern in (r"([\w./-]+):(\d+):\d+: error", r"([\w./-]+):(\d+):\d+"):
        places = {(match[1], int(match[2])) for match in re.finditer(pattern, output)}
        wrong = {mutant.number for mutant in mutants
                 if any(line == mutant.line and path.endswith(mutant.file) for path, line in places)}
        if wrong:
            return wrong
    return set()


def limit():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_FILE, MOST_FILE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # which is ignored by what a shell starts in the background


def each(items, workers, function):
    """Calls a function for all items, in so many threads."""
    items, lock = list(items), threading.Lock()

    def work():
        while True:
            with lock:
                if not items:
                    return
                item = items.pop(0)
            function(item)

    threads = [threading.Thread(target=work) for _ in range(workers)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


class Kept:
    """Records in a file of a line each, which grows from run to run."""

    def __init__(self, path):
        self.path, self.lock = path, threading.Lock()
        self.records = [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []

    def add(self, record):
        with self.lock:
            self.records.append(record)
            with self.path.open("a") as file:
                file.write(json.dumps(record) + "\n")


def measure(place, kept, workers):
    """Which mutants each test comes to, and how long it takes."""
    known = {record["name"] for record in kept.records}

    def measure_one(test):
        with tempfile.NamedTemporaryFile() as reached:
            begin = time.monotonic()
            passed = place.run(test["program"], [test["filter"]], 900, LODESTONE_REACHED=reached.name)
            seconds = time.monotonic() - begin
            numbers = sorted({int(line) for line in pathlib.Path(reached.name).read_text().split()})
        kept.add(test | {"passed": passed, "seconds": round(seconds, 3), "reached": numbers})

    each([test for test in place.list_tests() if test["name"] not in known], workers, measure_one)


def batches_for(mutant, tests):
    """The tests that come to the mutant, those of its own folder first: (program, filters, expected seconds)."""
    def order(test):
        program = test["name"].split(".")[0]
        return test["seconds"] > LONG, program != folder_of(mutant.file), PROGRAMS.index(program)

    batches = []
    for test in sorted((test for test in tests if test["passed"] and mutant.number in test["reached"]), key=order):
        last = batches[-1] if batches else None
        if last and last[0] == test["program"] and test["seconds"] <= LONG and last[2] + test["seconds"] < 20:
            last[1].append(test["filter"])
            last[2] += test["seconds"]
        else:
            batches.append([test["program"], [test["filter"]], test["seconds"]])
    return batches


def judge(place, mutant, tests, most_seconds):
    """How the mutant fared: a verdict, and the seconds that it took."""
    begin = time.monotonic()
    batches = batches_for(mutant, tests)
    if not batches:
        return "no test comes to it", 0
    for program, filters, expected in batches:
        if time.monotonic() - begin + expected > most_seconds:
            return "survived as long as it was tried", time.monotonic() - begin
        if not place.run(program, filters, 10 + 5 * expected, LODESTONE_MUTANT=str(mutant.number)):
            return f"caught by {pathlib.Path(program).name}", time.monotonic() - begin
    return "survived", time.monotonic() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lines", type=int, default=300, help="lines to break (default: 300)")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: 1)")
    parser.add_argument("--workers", type=int, default=2, help="tests at a time (default: 2)")
    parser.add_argument("--seconds", type=int, default=300, help="most seconds of tests for a mutant (default: 300)")
    parser.add_argument("--most", type=int, default=10**9, help="stop after so many new results")
    parser.add_argument("--out", type=pathlib.Path, help="folder of the results (default: build/mutation)")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    folder = arguments.out or root / "build" / "mutation"
    folder.mkdir(parents=True, exist_ok=True)

    place = Workplace(root, folder.resolve(), spare=arguments.lines // 3 + 10)
    mutants = place.prepare(arguments.lines, arguments.seed)
    tests = Kept(folder / "tests.jsonl")
    measure(place, tests, arguments.workers)
    for test in tests.records:
        if not test["passed"]:
            print(f"left out, for it fails without a mutant: {test['name']}")

    results = Kept(folder / "results.jsonl")
    known = {result["number"] for result in results.records}

    def judge_one(mutant):
        verdict, seconds = judge(place, mutant, tests.records, arguments.seconds)
        results.add({"number": mutant.number, "verdict": verdict, "seconds": round(seconds, 1), "mutant": str(mutant)})
        print(f"{verdict}: {mutant}", flush=True)

    each([mutant for mutant in mutants if mutant.number not in known][:arguments.most], arguments.workers, judge_one)
    caught = sum(result["verdict"].startswith("caught") for result in results.records)
    print(f"{caught} of {len(results.records)} mutants caught: {results.path}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
