#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Uses the installed Python package on two tetrahedra."""
import lodestone
import numpy

corners = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
faces = numpy.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])

for shift, collides in ((0.2, True), (2.0, False)):
    found = lodestone.find_collisions((corners, faces), (corners + [shift, 0.1, 0.1], faces))
    assert bool(found.collides) == collides, f"shifted by {shift}: {found}"

print("lodestone", lodestone.__version__, "in Python")
