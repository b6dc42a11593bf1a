# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks of examples/python run, and show what they promise."""

import functools
import json

import numpy as np
import pytest

import lodestone
from conftest import root
from notebook_runner import run_notebook

notebooks = sorted((root / "examples" / "python").glob("*.ipynb"))


@functools.cache
def run_of(name):
    return run_notebook(root / "examples" / "python" / f"{name}.ipynb")


def test_there_are_three():
    assert [path.stem for path in notebooks] == ["blender_animation", "first_contact", "which_partition"]


@pytest.mark.parametrize("path", notebooks, ids=lambda path: path.stem)
def test_a_notebook_is_stored_without_outputs(path):
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        assert cell["metadata"] == {}
        assert cell["cell_type"] == "markdown" or (cell["outputs"] == [] and cell["execution_count"] is None)


@pytest.mark.parametrize("path", notebooks, ids=lambda path: path.stem)
def test_a_notebook_prints_and_ends_with_a_page(path):
    run = run_of(path.stem)
    assert len(run.printed.splitlines()) > 10
    assert run.shown[-1].startswith("<iframe srcdoc=") and "lodestone-data" in run.shown[-1]


def test_first_contact_is_where_they_begin_to_collide():
    names = run_of("first_contact").names
    teapot, ball, flown = names["teapot"], names["ball"], names["flown"]
    for length, collides in ((flown - 1e-6, False), (flown + 1e-6, True)):
        moved = (ball.vertices + [0, -length, 0], ball.faces)
        assert lodestone.find_collisions(teapot, moved).collides == collides
    free = ball.vertices + [0, -flown - 0.55, 0] + names["way_out"]
    assert not lodestone.find_collisions((free, ball.faces), teapot).collides


def test_partitions_are_compared_with_the_truth():
    names = run_of("which_partition").names
    assert 0 < sum(names["truth"]) < len(names["truth"])
    assert all(count <= sum(names["truth"]) for count in names["found"].values())
    assert set(names["found"]) == set(lodestone.strategies()) - {"sdf"}


def test_the_arm_intersects_from_a_right_angle_on_and_back():
    """It bends by 9 degrees per frame up to frame 19, and then moves back the same way."""
    names = run_of("blender_animation").names
    hits = names["hits"]
    assert np.allclose([names["angle"](n) for n in range(20)], 9 * np.arange(20), atol=0.1)
    counts = [len(frame.faces) for frame in names["found"]]
    assert counts == counts[::-1] and hits == list(range(hits[0], 39 - hits[0]))
