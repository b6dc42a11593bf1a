# SPDX-License-Identifier: GPL-3.0-or-later
"""Rays and points: of one object, and rays among several."""

import numpy as np
import pytest

import lodestone
from conftest import cube


def test_rays_and_points():
    detector = lodestone.Detector()
    box = detector.add(cube(2))
    hit = detector.first_hit(box, [1, 0.5, -3], [0, 0, 2])
    assert hit["t"] == 1.5 and hit["point"].tolist() == [1, 0.5, 0]
    assert [h["point"][2] for h in detector.all_hits(box, [1, 0.5, -3], [0, 0, 1])] == [0, 2]
    assert detector.first_hit(box, [1, 0.5, -3], [0, 0, 1], length=2.5) is None
    origins = [[1, 0.5, -3], [9, 9, 9]]
    hits = detector.first_hits(box, origins, [0, 0, 1])
    assert hits["faces"].tolist()[1] == -1 and hits["t"].tolist() == [3, np.inf]
    assert hits["points"][0].tolist() == [1, 0.5, 0] and np.isnan(hits["points"][1]).all()
    nearest = detector.closest_point(box, [1, 0.75, -5])
    assert nearest["distance"] == 5 and nearest["point"].tolist() == [1, 0.75, 0]
    points = [[1, 0.75, -5], [1, 1, 1.5], [0, 1, 1]]
    assert detector.closest_points(box, points)["distances"].tolist() == [5, 0.5, 0]
    assert detector.point_sides(box, points).tolist() == [-1, 1, 0]
    assert detector.point_side(box, [1, 1, 1]) == "inside"
    with pytest.raises(lodestone.BadArgument):
        detector.first_hit(box, [0, 0, 0], [0, 0, 0])
    with pytest.raises(lodestone.BadArgument, match=r"origins must have the shape \(n, 3\)"):
        detector.first_hits(box, [0, 0, 0], [0, 0, 1])


def test_an_error_tells_which_of_many_rays_or_points_it_is_about():
    detector = lodestone.Detector()
    box = detector.add(cube())
    points = np.zeros((200, 3))
    points[150, 2] = np.nan
    for objects in (box, None):
        with pytest.raises(lodestone.BadArgument, match="^ray 150: the origin"):
            detector.first_hits(objects, points, [0, 0, 1])
    for ask in (detector.closest_points, detector.point_sides):
        with pytest.raises(lodestone.BadArgument, match="^point 150: the point"):
            ask(box, points)


def test_rays_among_objects():
    detector = lodestone.Detector()
    near, middle, far = (detector.add(cube(1).moved(0, 0, z)) for z in (2, 5, 8))
    ray = [0.5, 0.25, 0], [0, 0, 1]
    hit = detector.first_hit(None, *ray)
    assert hit["object"] == near and hit["t"] == 2 and hit["point"].tolist() == [0.5, 0.25, 2]
    assert hit["face"] == detector.first_hit(near, *ray)["face"]
    assert detector.first_hit(middle, *ray)["object"] == middle
    assert detector.first_hit([far, middle, far], *ray)["object"] == middle
    assert detector.first_hit((far,), *ray, length=7) is None and detector.first_hit([], *ray) is None
    hits = detector.first_hits(None, [[0.5, 0.25, 0], [9, 9, 0], [0.5, 0.25, 7]], [0, 0, 1])
    assert hits["objects"].tolist() == [near, -1, far] and hits["t"].tolist() == [2, np.inf, 1]
    assert detector.first_hits(near, [ray[0]], ray[1])["objects"].tolist() == [near]
    assert detector.first_hits([], [ray[0]], ray[1])["faces"].tolist() == [-1]
    with pytest.raises(lodestone.BadArgument, match="there is no object 3"):
        detector.first_hit([near, 3], *ray)
    with pytest.raises(TypeError):
        detector.first_hit("near", *ray)


def test_no_rays_or_points_get_no_answers():
    detector = lodestone.Detector()
    detector.add(cube())
    for nothing in ([], np.zeros((0, 3))):
        assert detector.first_hits(0, nothing, nothing)["faces"].shape == (0,)
        assert detector.first_hits(0, nothing, [0, 0, 1])["points"].shape == (0, 3)
        assert detector.closest_points(0, nothing)["points"].shape == (0, 3)
        assert detector.point_sides(0, nothing).shape == (0,)
    with pytest.raises(lodestone.BadArgument, match="origins must have the shape"):
        detector.first_hits(0, [1, 2], [])
