#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks single lines of the library, and tells which of these mutants the tests notice.

Each mutant replaces one operator, constant or keyword of one line. It is built in a copy of the sources, and the tests
run until one fails: first those of the line's own folder, then those of the floors above. The sample depends on the
seed alone. Every result is appended to a file at once, so a run that was interrupted goes on where it ended.
"""
import argparse
import json
import pathlib
import random
import re
import resource
import shutil
import subprocess
import sys
import threading

# Floors from below; the tests of a floor notice what is broken on those below it.
FLOORS = ["mesh", "triangles", "volumes", "partition", "particles", "tree", "bounds", "filter", "queries", "detection"]
TESTS_ABOVE = ["queries", "detection", "threads", "contract", "io", "program"]

# What is replaced by what, outside of strings and comments.
RULES = [(re.compile(pattern), replacement) for pattern, replacement in [
    (r"(?<=[\w)\]] )<=(?= )", "<"), (r"(?<=[\w)\]] )>=(?= )", ">"), (r"(?<=[\w)\]] )<(?= )", "<="),
    (r"(?<=[\w)\]] )>(?= )", ">="), (r"(?<= )==(?= )", "!="), (r"(?<= )!=(?= )", "=="), (r"(?<= )&&(?= )", "||"),
    (r"(?<= )\|\|(?= )", "&&"), (r"(?<=[\w)\]] )\+(?= )", "-"), (r"(?<=[\w)\]] )-(?= )", "+"),
    (r"(?<=[\w)\]] )\*(?= )", "/"), (r"(?<=[\w)\]] )/(?= )", "*"), (r"(?<= )\+=(?= )", "-="), (r"(?<= )-=(?= )", "+="),
    (r"\btrue\b", "false"), (r"\bfalse\b", "true"), (r"\bstd::min\b", "std::max"), (r"\bstd::max\b", "std::min"),
    (r"\bcontinue;", "break;"), (r"\bbreak;", "continue;"), (r"(?<![\w.])0(?![\w.])", "1"),
    (r"(?<![\w.])1(?![\w.])", "2"), (r"(?<![\w.])([2-9]|\d\d+)(?![\w.])", r"(\1 + 1)"), (r"!(?=[a-z_(])", ""),
    (r"\.front\(\)", ".back()"), (r"\.back\(\)", ".front()"),
]]
# Lines whose mutants say nothing about behaviour.
SKIPPED = re.compile(r"^\s*(//|\*|#|template|using|static_assert|namespace|requires|concept|typedef|friend)|concept ")

MOST_MEMORY = 8 << 30  # bytes of a test program: a mutant may ask for any amount


def code_of(line):
    """The line without its comment and with blanked strings, of the same length up to the comment."""
    line = re.sub(r'"(\\.|[^"\\])*"', lambda text: " " * len(text.group()), line)
    return line.split("//")[0]


def mutants_of(root, file):
    for number, line in enumerate((root / file).read_text().splitlines()):
        code = code_of(line)
        if SKIPPED.search(code):
            continue
        for pattern, replacement in RULES:
            for match in pattern.finditer(code):
                changed = line[:match.start()] + match.expand(replacement) + line[match.end():]
                yield {"file": str(file), "line": number + 1, "from": line.strip(), "to": changed.strip(),
                       "changed": changed}


def library_files(root):
    files = [path.relative_to(root) for folder in ("include/lodestone", "src") for path in (root / folder).rglob("*")
             if path.suffix in (".h", ".cpp")]
    return sorted(path for path in files if folder_of(path) in FLOORS + ["io"])


def folder_of(file):
    parts = pathlib.PurePath(file).parts
    return parts[2] if parts[0] == "include" else parts[1]


def sample(root, count, seed):
    """One mutant of each of so many lines, from all lines that have one."""
    lines = {}
    for file in library_files(root):
        for mutant in mutants_of(root, file):
            lines.setdefault((mutant["file"], mutant["line"]), []).append(mutant)
    chosen = random.Random(seed)
    keys = sorted(lines)
    chosen.shuffle(keys)
    return [chosen.choice(lines[key]) for key in keys[:count]]


def programs_for(file):
    folder = folder_of(file)
    return [folder] + [name for name in TESTS_ABOVE if name != folder]


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


class Workplace:
    """A copy of the sources with a build folder of its own."""

    def __init__(self, root, folder):
        self.folder = folder
        if not (folder / "CMakePresets.json").exists():
            shutil.copytree(root, folder, ignore=shutil.ignore_patterns("build", "out", ".git"), dirs_exist_ok=True)
        self.build_folder = folder / "build" / "mutation"
        if not (self.build_folder / "build.ninja").exists():
            self.call(["cmake", "--preset", "mutation"], check=True)

    def call(self, command, check=False, **options):
        return subprocess.run(command, cwd=self.folder, check=check, **options, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True)

    def build(self, programs):
        return self.call(["ninja", "-C", str(self.build_folder), "-j", "1", *[f"{name}_tests" for name in programs],
                          *(["lodestone_program"] if "program" in programs else [])]).returncode == 0

    def test(self, program, seconds):
        """Whether the tests pass; a mutant that hangs does not."""
        try:
            return self.call([str(self.build_folder / "tests" / f"{program}_tests"), "--gtest_fail_fast",
                              "--gtest_brief=1"], timeout=seconds, preexec_fn=limit_memory).returncode == 0
        except subprocess.TimeoutExpired:
            return False

    def judge(self, mutant, seconds):
        """`caught by PROGRAM`, `does not compile`, or `survived`."""
        path = self.folder / mutant["file"]
        text = path.read_text()
        lines = text.split("\n")
        lines[mutant["line"] - 1] = mutant["changed"]
        path.write_text("\n".join(lines))
        try:
            for program in programs_for(mutant["file"]):
                if not self.build([program]):
                    return "does not compile"
                if not self.test(program, seconds):
                    return f"caught by {program}"
            return "survived"
        finally:
            path.write_text(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--lines", type=int, default=300, help="lines to break (default: 300)")
    parser.add_argument("--seed", type=int, default=1, help="of the sample (default: 1)")
    parser.add_argument("--workers", type=int, default=2, help="builds at a time (default: 2)")
    parser.add_argument("--seconds", type=int, default=600, help="limit of one test program (default: 600)")
    parser.add_argument("--most", type=int, default=10**9, help="stop after so many new results")
    parser.add_argument("--out", type=pathlib.Path, help="file of the results (default: build/mutation/results.jsonl)")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    work = root / "build" / "mutation"
    work.mkdir(parents=True, exist_ok=True)
    out = arguments.out or work / "results.jsonl"

    done = [json.loads(line) for line in out.read_text().splitlines()] if out.exists() else []
    known = {(result["file"], result["line"], result["to"]) for result in done}
    waiting = [mutant for mutant in sample(root, arguments.lines, arguments.seed)
               if (mutant["file"], mutant["line"], mutant["to"]) not in known][:arguments.most]
    lock = threading.Lock()

    def work_on(index):
        place = Workplace(root, work / f"copy_{index}")
        while True:
            with lock:
                if not waiting:
                    return
                mutant = waiting.pop(0)
            verdict = place.judge(mutant, arguments.seconds)
            result = {key: mutant[key] for key in ("file", "line", "from", "to")} | {"verdict": verdict}
            with lock:
                done.append(result)
                with out.open("a") as file:
                    file.write(json.dumps(result) + "\n")
                print(f"{verdict:24} {mutant['file']}:{mutant['line']}: {mutant['to']}", flush=True)

    threads = [threading.Thread(target=work_on, args=(index,)) for index in range(arguments.workers)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()

    caught = sum(result["verdict"].startswith("caught") for result in done)
    survived = sum(result["verdict"] == "survived" for result in done)
    if caught + survived > 0:
        print(f"{caught} of {caught + survived} mutants caught ({100 * caught / (caught + survived):.1f} %), "
              f"{len(done) - caught - survived} did not compile: {out}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
