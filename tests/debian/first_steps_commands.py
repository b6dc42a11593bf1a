#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Prints, as a script for Bash, what somebody does who follows a page of docs/first_steps.

    first_steps_commands.py PAGE

The script runs the commands of the page, writes the files that it shows, and runs its Python if the page installs the
package. It leaves out Blender, which opens a window.
"""

import pathlib
import re
import sys

page = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
installs_package = "pip install" in page
shown_file = re.compile(r"`([\w./]+)`:\n+$")  # a paragraph that ends with the name of a file

python = []
print("set -euxo pipefail")
print("apt-get update -qq")
for block in re.finditer(r"^```(\w*)\n(.*?)^```", page, re.S | re.M):
    language, text = block.groups()
    name = shown_file.search(page, 0, block.start())
    if language == "":
        for command in text.replace("\\\n", "").splitlines():
            if "--exit-code" in command:
                print(f"status=0; {command} || status=$?; [ $status = 1 ]")
            elif "blender" not in command:
                print(command)
    elif language == "cmake" and name:
        file = name.group(1)
        print(f"mkdir -p {file.rpartition('/')[0]}\ncat > {file} <<'END'\n{text}END")
    elif language == "python" and installs_package:
        python.append(text)
if python:
    print("env/bin/python - <<'END'\n" + "\n".join(python) + "END")
