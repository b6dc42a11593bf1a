# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects whose motion is bounded: skins, morph targets and promises."""

import numpy as np
import pytest

import lodestone
from conftest import Mesh, cube, sphere


def test_a_skin_is_posed_where_it_is_near():
    ball, post = sphere(60), sphere(6, 0.1)
    joints = (ball.vertices[:, 2:] > 0).astype(int)
    skin = lodestone.Skin(ball.vertices, joints, np.ones_like(joints, dtype=float), joint_count=2)
    detector = lodestone.Detector(mode="certified")
    detector.add(skin, ball.faces), detector.add(post)
    for z in (5.0, 0.5, 0.95):
        matrices = np.stack([np.eye(4), np.eye(4)])
        matrices[:, 2, 3] = [-2, z]
        skin.set_joints(matrices)
        posed = ball.vertices + np.where(joints, [0, 0, z], [0, 0, -2.0])
        assert np.allclose(skin.pose(), posed)
        frame = detector.detect()
        expected = lodestone.find_collisions(Mesh(skin.pose(), ball.faces), post)
        assert frame.collides == expected.collides and np.array_equal(frame.faces, expected.faces)
    assert frame.statistics["vertices_read"] < len(ball.vertices)
    with pytest.raises(lodestone.BadArgument):
        skin.set_joints(np.zeros((3, 4, 4)))
    with pytest.raises(lodestone.BadArgument, match="matrix 1 has a number that is not finite"):
        skin.set_joints([np.eye(4), np.full((4, 4), np.nan)])
    with pytest.raises(lodestone.BadArgument, match="use set_frame|come from a skin"):
        detector.set_vertices(0, ball.vertices)


def test_a_visitor_may_look_at_a_skin_but_not_move_it():
    box = cube()
    skin = lodestone.Skin(box.vertices, np.zeros((8, 1), int), np.ones((8, 1)))
    detector = lodestone.Detector()
    detector.add(skin, box.faces, name="box"), detector.add(sphere())
    seen = []
    detector.visit(0, 1, lambda a, b: seen.append((len(skin.pose()), len(detector), detector.name(0), 1 in detector)))
    assert set(seen) == {(8, 2, "box", True)}
    with pytest.raises(lodestone.BadArgument, match="a visitor changed a skin"):
        detector.visit(0, 1, lambda a, b: skin.set_joints([np.eye(4)]))
    skin.set_joints([np.eye(4)])
    assert detector.detect().collides


def test_morph_targets_move_a_skin():
    box = cube()
    skin = lodestone.Skin(box.vertices, np.zeros((8, 1), int), np.ones((8, 1)), targets=[np.full((8, 3), 2.0)])
    skin.set_weights([0.5])
    assert np.array_equal(skin.pose(), box.vertices + 1) and skin.target_count == 1
    with pytest.raises(lodestone.BadArgument):
        skin.set_weights([1, 2])


@pytest.mark.parametrize("name", ["hand", "face", "body"])
def test_a_character_that_was_added_stands_in_its_first_frame(scenes, name):
    character = lodestone.read_animation(scenes.parent / "characters" / f"{name}.glb")
    needle = 1e-3 * np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]), [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]]
    places = character[0][:: len(character[0]) // 20]
    found = []
    for mode in ("exact", "certified"):
        detector = lodestone.Detector(mode=mode)
        detector.add(character)
        for place in places:
            detector.add(needle[0] - 2e-4 + place, needle[1])
        found.append([pair.faces.tolist() for pair in detector.detect().pairs if pair.a == 0 and pair.collides])
        assert np.abs(detector.vertices(0) - character[0]).max() < 1e-12
    assert found[0] == found[1] and len(found[0]) > 10


def test_promises_save_reading_and_broken_ones_are_noticed():
    detector = lodestone.Detector(mode="certified")
    a, b = sphere(60), sphere(60).moved(20)
    detector.add(a), detector.add(b)
    promise = lodestone.DisplacementPromise()
    detector.promise(0, promise)
    detector.promise(1, promise)
    detector.detect()
    broken, rows = np.eye(4), np.eye(4)
    broken[3, 3] = np.nan
    rows[3, :3] = [20, 0, 0]  # a translation as it stands where points are rows
    for frame, text in [(rows, "the last row of frame must be 0, 0, 0, 1"), (broken, "frame has a number that is not"),
                        (np.eye(3), "frame must have the shape")]:
        with pytest.raises(lodestone.BadArgument, match=text):
            promise.move(0.5, frame=frame)
    with pytest.raises(lodestone.BadArgument, match="one per region"):
        promise.move([[0.5]])
    promise.move(0.5)
    a.vertices += [0.25, 0, 0]
    frame = detector.detect()
    assert not frame.collides and frame.statistics["vertices_read"] == 0
    promise.move(12)
    a.vertices += [18.5, 0, 0]  # farther than promised
    frame = detector.detect()
    assert frame.collides and frame.statistics["violations"] > 0
    strict = lodestone.Detector(mode="certified", throw_if_broken=True)
    c, d = sphere(60), sphere(60).moved(2.5)
    strict.add(c), strict.add(d)
    stretch = lodestone.StretchPromise(1.0)
    strict.promise(0, stretch)
    strict.detect()
    c.vertices *= 2
    with pytest.raises(lodestone.BrokenBound):
        strict.detect()
    with pytest.raises(lodestone.BadArgument, match="certified"):
        exact = lodestone.Detector()
        exact.add(cube())
        exact.promise(0, lodestone.LipschitzPromise(1.0))
    with pytest.raises(TypeError):
        detector.promise(0, "nothing moves")


def test_a_box_promise_asks_a_function():
    a, b = sphere(60), sphere(60).moved(20)
    shift = np.zeros(3)
    asked = []

    def box(region, rest_box):
        asked.append(region)
        return rest_box + shift

    start = a.vertices.copy()
    for threads, regions in (1, 0), (1, 4), (2, 4):
        detector = lodestone.Detector(mode="certified", threads=threads, particles=regions)
        detector.add(a), detector.add(b)
        detector.promise(0, lodestone.BoxPromise(box))
        assert not detector.detect().collides
        for shift[0] in (5, 18.5):
            a.vertices[:] = start + shift
            asked.clear()
            frame = detector.detect()
            assert asked and frame.statistics["violations"] == 0
        assert frame.faces.tolist() == lodestone.find_collisions(a, b).faces.tolist() != []
        if regions > 0:
            assert None in asked and set(asked) <= {None, 0, 1, 2, 3} and len(set(asked)) > 2
        else:
            assert set(asked) == {0}
        a.vertices[:] = start + [18.7, 0, 0]  # not where the function says
        frame = detector.detect()
        assert frame.statistics["violations"] > 0
        assert frame.faces.tolist() == lodestone.find_collisions(a, b).faces.tolist()
        a.vertices[:] = start
        shift[0] = 0


@pytest.mark.parametrize("box, error", [
    (lambda region, rest_box: 1 / 0, ZeroDivisionError),
    (lambda region, rest_box: rest_box[0], lodestone.BadArgument),
    (lambda region, rest_box: rest_box[::-1], lodestone.BadArgument),
    (lambda region, rest_box: "here", lodestone.BadArgument),
    (lambda: None, TypeError),
])
def test_a_box_promise_whose_function_fails_is_an_error_and_the_detector_goes_on(box, error):
    detector = lodestone.Detector(mode="certified")
    detector.add(sphere()), detector.add(sphere())
    bad = [False]
    promise = lodestone.BoxPromise(lambda region, rest_box: box(region, rest_box) if bad[0] else rest_box)
    detector.promise(0, promise)
    collides = detector.detect().collides
    bad[0] = True
    with pytest.raises(error):
        detector.detect()
    bad[0] = False
    assert detector.detect().collides == collides
    with pytest.raises(TypeError):
        lodestone.BoxPromise(7)


def test_joints_out_of_all_proportion_are_refused():
    ball = sphere(4)
    joints = np.zeros((len(ball.vertices), 2), dtype=np.uint32)
    joints[0, 1] = 2**32 - 1  # as some files mark that there is none
    weights = np.tile([1.0, 0.0], (len(ball.vertices), 1))
    with pytest.raises(lodestone.BadArgument, match="joints names joint 4294967295"):
        lodestone.Skin(ball.vertices, joints, weights)
    joints[0, 1] = 5
    lodestone.Skin(ball.vertices, joints, weights)
