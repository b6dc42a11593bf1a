#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks man page and completions against the help: check_man_page.py FOLDER PROGRAM.

Every option, command and value name of the help must stand in all three files, and groff must format the page
without a warning.
"""
import pathlib
import re
import shutil
import subprocess
import sys


def help_of(program, *words):
    return subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout


def options_in(text):
    return set(re.findall(r"^  (?:-\w,)?(--[\w-]+)", text, re.M))


def commands_in(text):
    return re.findall(r"^  (\w+) ", text.split("Subcommands:")[1].split("\n\n")[0], re.M)


def missing_words(words, text):
    return sorted(word for word in words if not re.search(rf"(?<![\w-]){re.escape(word)}(?![\w-])", text))


def warnings_of(page):
    if not shutil.which("groff"):
        return ""
    return subprocess.run(["groff", "-man", "-Tutf8", "-ww", "-z", page], capture_output=True, text=True).stderr


def main():
    folder, program = pathlib.Path(sys.argv[1]), sys.argv[2]
    commands = commands_in(help_of(program))
    options = options_in(help_of(program)).union(*(options_in(help_of(program, command)) for command in commands))
    if len(commands) < 5 or len(options) < 50:
        sys.exit(f"the help has only {len(commands)} commands and {len(options)} options")
    complaints = [warnings_of(folder / "lodestone.1")]
    for name in ("lodestone.1", "lodestone", "_lodestone"):
        text = (folder / name).read_text(encoding="utf-8").replace("\\-", "-").replace("\\fR", " ").replace("\\fB", " ")
        complaints += [f"{name} lacks {word}" for word in missing_words(options.union(commands), text)]
    complaints = [complaint for complaint in complaints if complaint]
    if complaints:
        sys.exit("\n".join(complaints))


main()
