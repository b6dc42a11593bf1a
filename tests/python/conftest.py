# SPDX-License-Identifier: GPL-3.0-or-later
"""Shapes for the tests of the Python package."""

import os
import pathlib

import numpy as np
import pytest

root = pathlib.Path(__file__).parents[2]


class Mesh:
    """Something with vertices and faces, as other libraries have it."""

    def __init__(self, vertices, faces):
        self.vertices = np.array(vertices, dtype=float)
        self.faces = np.array(faces)

    def moved(self, x, y=0.0, z=0.0):
        return Mesh(self.vertices + [x, y, z], self.faces)


def cube(size=1.0):
    """A closed cube with a corner in the origin, its faces counter-clockwise seen from outside."""
    vertices = [[size * (i & 1), size * (i >> 1 & 1), size * (i >> 2)] for i in range(8)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return Mesh(vertices, [t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))])


def sphere(rings=16, radius=1.0):
    """A closed sphere around the origin."""
    sectors = 2 * rings
    vertices = [[0, 0, radius]]
    for i in range(1, rings):
        polar = np.pi * i / rings
        for j in range(sectors):
            azimuth = 2 * np.pi * j / sectors
            vertices.append([radius * np.sin(polar) * np.cos(azimuth), radius * np.sin(polar) * np.sin(azimuth),
                             radius * np.cos(polar)])
    vertices.append([0, 0, -radius])
    at = lambda i, j: 1 + (i - 1) * sectors + j % sectors
    last = len(vertices) - 1
    faces = []
    for j in range(sectors):
        faces.append((0, at(1, j), at(1, j + 1)))
        for i in range(1, rings - 1):
            faces += [(at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1))]
        faces.append((at(rings - 1, j), last, at(rings - 1, j + 1)))
    return Mesh(vertices, faces)


@pytest.fixture
def scenes():
    return root / "data" / "scenes"


@pytest.fixture
def program():
    """The program of the same build."""
    path = os.environ.get("LODESTONE_PROGRAM")
    if not path:
        pytest.skip("LODESTONE_PROGRAM does not name the program")
    return path
