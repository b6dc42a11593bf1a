# SPDX-License-Identifier: GPL-3.0-or-later
"""The Python in the documentation runs, and prints what it says; so do the commands of the first steps.

The blocks of a page run in order, in one namespace and in an empty folder with the repository's data. Where lines say
what is printed, `# -> ...`, these are all that the block prints.
"""

import contextlib
import io
import re
import shlex
import subprocess

import pytest

import lodestone
from conftest import cube, root, sphere

first_steps = sorted((root / "docs" / "first_steps").glob("*.md"))
pages = [root / "README.md", root / "python" / "README.md", root / "docs" / "python.md", *first_steps]


def names_for(page):
    """What a page takes for granted."""
    if page.name != "README.md":
        return {}
    a, b = cube(), cube().moved(0.5, 0.25, 0.125)
    return {"vertices_a": a.vertices, "faces_a": a.faces, "vertices_b": b.vertices, "faces_b": b.faces,
            "vertices": a.vertices, "faces": a.faces, "ball_mesh": sphere().moved(1.5),
            "simulation": [a.vertices + [0.1 * t, 0, 0] for t in range(5)]}


def blocks_of(page, language):
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"^```(\w*)\n(.*?)^```", text, re.S | re.M)
    return [(text.count("\n", 0, block.start()) + 1, block.group(2)) for block in found if block.group(1) == language]


def test_every_count_is_explained():
    text = (root / "docs" / "python.md").read_text(encoding="utf-8")
    counts = dict(lodestone.find_collisions(cube(), cube()).frame.statistics)
    seconds = counts.pop("seconds")
    assert len(counts) + len(seconds) > 20
    assert [name for name in [*counts, *seconds] if f"`{name}`" not in text] == []


@pytest.fixture
def folder(tmp_path, monkeypatch):
    (tmp_path / "data").symlink_to(root / "data")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_pages_have_python():
    assert len(first_steps) == 5 and sum(bool(blocks_of(page, "python")) for page in pages) >= 4


@pytest.mark.parametrize("page", pages, ids=lambda page: str(page.relative_to(root)))
def test_the_python_of_a_page_runs_and_prints_what_it_says(page, folder):
    names = names_for(page)
    for line, block in blocks_of(page, "python"):
        place = f"{page.relative_to(root)}:{line}"
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(block, place, "exec"), names)
        told = re.findall(r"# -> (.*)", block)
        assert not told or told == printed.getvalue().splitlines(), place


@pytest.mark.parametrize("page", first_steps, ids=lambda page: page.name)
def test_the_commands_of_the_first_steps_run(page, folder, program):
    """Those of the program, but for experiments, which take longer."""
    for line, block in blocks_of(page, ""):
        for command in block.replace("\\\n", "").splitlines():
            words = shlex.split(command, comments=True)
            if not words or words[0] != "build/release/lodestone" or "experiment" in words:
                continue
            run = subprocess.run([program, *words[1:]], capture_output=True, text=True)
            expected = 1 if "--exit-code" in words else 0
            assert run.returncode == expected, f"{page.name}:{line}: {command}\n{run.stderr}"


def test_the_calls_and_options_in_the_tables_of_the_manual_are_those_that_exist():
    text = (root / "docs" / "python.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| .*\|$", text, re.M)
    calls = {name for row in rows for name in re.findall(r"`(\w+)\(", row)}
    assert len(calls) > 25
    assert not {name for name in calls if not hasattr(lodestone, name) and not hasattr(lodestone.Detector, name)}
    section = re.search(r"^## Modes and options\n(.*?)^## ", text, re.S | re.M).group(1)
    options = set(re.findall(r"^\| `(\w+)(?:=\w+)?` \|", section, re.M))
    with pytest.raises(TypeError) as error:
        lodestone.Detector(no_such_option=1)
    assert options | {"mode"} == set(str(error.value).split("there are ")[1].split(", "))
