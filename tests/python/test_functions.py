# SPDX-License-Identifier: GPL-3.0-or-later
"""The functions that keep nothing: one call, one answer."""

import numpy as np
import pytest

import lodestone
from conftest import Mesh, cube, sphere


def test_a_mesh_is_an_object_with_vertices_and_faces_or_a_tuple():
    a, b = cube(), cube().moved(0.5, 0.25, 0.125)
    expected = lodestone.find_collisions(a, b)
    assert expected.collides and expected.a == 0 and expected.b == 1
    again = lodestone.find_collisions((a.vertices, a.faces), (b.vertices.tolist(), b.faces.tolist()))
    assert np.array_equal(again.faces, expected.faces)
    with pytest.raises(lodestone.BadArgument, match="a must be a tuple of vertices and faces"):
        lodestone.find_collisions(7, b)
    with pytest.raises(lodestone.BadMesh):
        lodestone.find_collisions((a.vertices[:, :2], a.faces), b)


@pytest.mark.parametrize("vertices, faces, text", [
    (cube().vertices, cube().faces + 1, "face 2 refers to vertex 8 of 8"),
    (cube().vertices, cube().faces - 1, "face 0 refers to vertex -1"),
    (cube().vertices[:, :2], cube().faces, r"vertices must have the shape \(V, 3\), but have \(8, 2\)"),
])
def test_errors_of_arrays_name_the_mesh(vertices, faces, text):
    bad, good = (vertices, faces), cube()
    for arguments, name in [((bad, good), "a"), ((good, bad), "b")]:
        with pytest.raises(lodestone.BadMesh, match=f"^{name}: {text}"):
            lodestone.find_collisions(*arguments)
    with pytest.raises(lodestone.BadMesh, match=f"^the second argument: {text}"):
        lodestone.closest(good, bad)
    with pytest.raises(lodestone.BadMesh, match=f"^mesh: {text}"):
        lodestone.self_collisions(bad)
    with pytest.raises(lodestone.BadMesh, match=f"^zed: {text}"):
        lodestone.Detector().add(vertices, faces, name="zed")
    with pytest.raises(lodestone.BadMesh, match=f"^{text}"):
        lodestone.Detector().add(vertices, faces)


@pytest.mark.parametrize("options", [{}, {"tolerance": 0.1}, {"patches": True}, {"threads": 2}, {"most_contacts": 5},
                                     {"containment": True, "parting": True}])
def test_one_call_gives_what_a_detector_gives(options):
    a, b = sphere(), sphere(12).moved(1.2, 0.2)
    detector = lodestone.Detector(**options)
    detector.add(a), detector.add(b)
    kept, once = detector.detect().pairs[0], lodestone.find_collisions(a, b, **options)
    assert np.array_equal(kept.faces, once.faces)
    assert kept.near == once.near and kept.capped == once.capped and kept.containment == once.containment
    assert [p["contacts"].tolist() for p in kept.patches] == [p["contacts"].tolist() for p in once.patches]
    assert (kept.parting is None) == (once.parting is None)
    if kept.parting is not None:
        assert np.array_equal(kept.parting, once.parting)


def test_meshes_that_are_apart_are_a_pair_without_contacts():
    pair = lodestone.find_collisions(cube(), cube().moved(9), contact_points=True, contact_normals=True)
    assert not pair.collides and pair.faces.shape == (0, 2) and pair.points.shape == (0, 3)
    assert pair.segments.shape == (0, 2, 3) and pair.depths.shape == (0,)


def test_yes_or_no_lists_no_faces():
    pair = lodestone.find_collisions(cube(), sphere(), contacts="yes_no")
    assert pair.collides and len(pair.faces) == 0
    assert len(lodestone.find_collisions(cube(), sphere(), contacts="first").faces) == 1


def test_self_collisions_are_those_beyond_shared_vertices():
    assert not lodestone.self_collisions(sphere()).collides
    crossing = Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [1, -3, 0]], [[0, 1, 2], [3, 4, 5]])
    pair = lodestone.self_collisions(crossing)
    assert pair.collides and pair.faces.tolist() == [[0, 1]] and pair.a == pair.b == 0
    assert lodestone.self_collisions(crossing.vertices, crossing.faces).collides
    detector = lodestone.Detector()
    detector.add(crossing)
    assert detector.self_collisions(0).faces.tolist() == [[0, 1]]
    # Two faces that share an edge whose vertices are stored twice touch, unless these are one.
    twice = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [1, 0, 0], [0, -1, 1]], [[0, 1, 2], [4, 3, 5]])
    assert lodestone.self_collisions(twice).collides
    assert not lodestone.self_collisions(twice, file_vertex=[0, 1, 2, 0, 1, 5]).collides


def test_frames_and_pairs_are_true_if_they_collide():
    crossing = Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0], [1, 1, -1], [1, 1, 1], [1, -3, 0]], [[0, 1, 2], [3, 4, 5]])
    assert bool(lodestone.self_collisions(crossing)) is True and bool(lodestone.self_collisions(cube())) is False
    for shift, collides in [(0.5, True), (1.5, False), (9, False)]:  # with the tolerance, the second pair is near
        pair = lodestone.find_collisions(cube(), cube().moved(shift), tolerance=1)
        assert bool(pair) is pair.collides is collides
        assert pair.near is (shift < 2)
        detector = lodestone.Detector(tolerance=1)
        detector.add(cube()), detector.add(cube().moved(shift))
        frame = detector.detect()
        assert bool(frame) is frame.collides is collides
        assert all(bool(pair) is pair.collides for pair in frame.pairs)
        assert not detector.self_collisions(0)


def test_contacts_within_a_tolerance_tell_whether_they_intersect():
    a, b = sphere(), sphere().moved(1.9)
    intersecting = lodestone.find_collisions(a, b)
    assert intersecting.intersects.dtype == bool and intersecting.intersects.all()
    near = lodestone.find_collisions(a, b, tolerance=0.3, contact_normals=True)
    assert np.array_equal(near.faces[near.intersects], intersecting.faces) and len(near.faces) > len(intersecting.faces)
    assert np.array_equal(near.intersects, near.depths >= 0)
    assert not near.intersects.flags.writeable and np.array_equal(near.frame.intersects, near.intersects)
    for options in [{"contacts": "first"}, {"most_contacts": 1}]:
        first = lodestone.find_collisions(a, b, tolerance=0.3, **options)
        assert len(first.faces) == 1 and first.intersects.all()


@pytest.mark.parametrize("options, text", [
    ({"strategy": "voronoy"}, "voronoy"),
    ({"lbg_epsilon": -1.0}, "epsilon"),
    ({"normal_weight": -1.0}, "weights"),
    ({"normal_weight": float("nan")}, "weights"),
    ({"strategy": "kmeans++", "lbg_tolerance": float("nan")}, "tolerance"),
    ({"throw_if_broken": True}, "throw_if_broken needs the mode certified"),
    ({"close_seams": False}, "^close_seams needs the mode particles or senin$"),
    ({"least_particles": 30}, "^least_particles needs the mode particles or senin$"),
    ({"meetings": 0}, "^meetings needs the mode particles$"),
])
def test_options_are_checked_where_nothing_needs_them(options, text):
    for ask in [lambda: lodestone.find_collisions(cube(), cube().moved(1), **options),
                lambda: lodestone.self_collisions(cube(), **options), lambda: lodestone.Detector(**options)]:
        with pytest.raises(lodestone.BadArgument, match=text):
            ask()


def test_an_error_tells_which_of_two_meshes_it_is_about():
    broken = cube()
    broken.vertices[3, 1] = np.nan
    for a, b, name in [(broken, cube(), "object 0 \\({}\\)"), (cube(), broken, "object 1 \\({}\\)")]:
        first = a is broken
        with pytest.raises(lodestone.BadMesh, match="vertex 3 of " + name.format("a" if first else "b")):
            lodestone.find_collisions(a, b)
        with pytest.raises(lodestone.BadMesh, match=name.format(f"the {'first' if first else 'second'} argument")):
            lodestone.closest(a, b)


def test_masked_arrays_are_refused():
    masked = np.ma.masked_array(cube().vertices, mask=cube().vertices > 0)
    with pytest.raises(TypeError, match="masked"):
        lodestone.self_collisions((masked, cube().faces))


def test_closest_within_contains():
    assert lodestone.closest(cube(), cube().moved(3))["distance"] == 2
    assert lodestone.within(cube(), cube().moved(3), 2.5) and not lodestone.within(cube(), cube().moved(3), 2)
    assert lodestone.contains(cube(3), cube().moved(1, 1, 1)) and not lodestone.contains(cube(), cube(3))


def slices(vertices, faces, regions):
    return vertices[:, 2].argsort(kind="stable").argsort() * regions // len(vertices)


def test_a_strategy_can_be_a_function():
    ball = sphere(8, radius=3)
    seen = []

    def strategy(vertices, faces, regions):
        seen.append((vertices.copy(), faces.copy(), regions))
        return slices(vertices, faces, regions)

    divided = lodestone.partition(ball, strategy=strategy, regions=8, keep_islands=True)
    assert divided.strategy == "strategy" and divided.regions == 8
    assert sorted(np.bincount(divided.labels)) == sorted(np.bincount(slices(ball.vertices, None, 8)))
    vertices, faces, regions = seen.pop()
    assert np.array_equal(vertices, ball.vertices) and np.array_equal(faces, ball.faces) and regions == 8
    for mode in ("exact", "certified", "particles"):
        detector = lodestone.Detector(mode=mode, strategy=strategy, particles=8, keep_islands=True,
                                      threads=2)
        detector.add(ball), detector.add(ball.moved(0.5))
        assert detector.detect().collides
        assert np.array_equal(detector.regions(0), divided.labels)
        assert len(seen) == 2 and np.array_equal(seen[0][0], ball.vertices)
        seen.clear()
    assert lodestone.find_collisions(ball, ball.moved(0.5), mode="particles", strategy=strategy).collides


@pytest.mark.parametrize("option", [{"normal_weight": 2}, {"lbg_split": "multiplicative"}, {"lbg_epsilon": 0.1},
                                    {"lbg_tolerance": 0.1}, {"lbg_sample": 100}])
def test_settings_that_a_strategy_ignores_are_refused(option):
    name, = option
    ball = sphere(4)
    for strategy in ("grid", slices):
        for call in (lambda: lodestone.partition(ball, strategy=strategy, regions=2, **option),
                     lambda: lodestone.Detector(strategy=strategy, **option)):
            with pytest.raises(lodestone.BadArgument, match=f"{name} is for .*lbg.* ignores it"):
                call()
    assert lodestone.partition(ball, regions=2, **option).regions == 2
    with pytest.raises(lodestone.BadArgument, match="no partition strategy 'unknown'"):
        lodestone.partition(ball, strategy="unknown", regions=2, **option)


def test_threads_of_a_partition_are_refused_where_the_strategy_has_none():
    ball = sphere(4)
    for strategy in ("grid", slices):
        for threads in (1, 2):
            with pytest.raises(lodestone.BadArgument, match="threads is for .*lbg.* ignores it"):
                lodestone.partition(ball, strategy=strategy, regions=2, threads=threads)
        detector = lodestone.Detector(mode="particles", strategy=strategy, threads=2)  # which share frames
        detector.add(ball), detector.add(ball)
        assert detector.detect().collides


@pytest.mark.parametrize("mode", ["exact", "certified"])
@pytest.mark.parametrize("option", [{"strategy": "grid"}, {"strategy": slices}, {"seed": 3}, {"normal_weight": 2},
                                    {"keep_islands": True}, {"seed": 3}])
def test_a_strategy_or_a_setting_of_one_asks_for_regions(mode, option):
    def regions(**options):
        detector = lodestone.Detector(mode=mode, **options)
        detector.add(sphere()), detector.add(sphere().moved(0.5))
        detector.detect()
        return len(set(detector.regions(0)))

    assert regions() == 1
    assert 1 < regions(**option) <= (36 if "grid" in option.values() else 14)
    assert regions(particles=6, **option) != regions(**option)


@pytest.mark.parametrize("option", [{"strategy": "grid"}, {"strategy": slices}, {"normal_weight": 2},
                                    {"lbg_sample": 100}, {"keep_islands": True}])
def test_mode_senin_refuses_strategies_and_their_settings(option):
    name, = option
    with pytest.raises(lodestone.BadArgument, match=f"{name} is for the modes .* senin ignores it"):
        lodestone.Detector(mode="senin", **option)
    lodestone.Detector(mode="senin", seed=3)


def test_each_strategy_takes_the_settings_that_it_reads():
    ball = sphere(4)
    for strategy in ("lbg", "lbg_curvature", "kmeans++"):
        lodestone.partition(ball, strategy=strategy, regions=2, normal_weight=0.5)
    with pytest.raises(lodestone.BadArgument):
        lodestone.partition(ball, strategy="lbg_position", regions=2, normal_weight=0.5)
    for strategy in ("lbg", "lbg_position", "lbg_curvature", "kmeans++"):
        lodestone.partition(ball, strategy=strategy, regions=2, lbg_tolerance=0.01)
    with pytest.raises(lodestone.BadArgument):
        lodestone.partition(ball, strategy="kmeans++", regions=2, lbg_sample=0)


@pytest.mark.parametrize("strategy, error, text", [
    (lambda vertices, faces, regions: 1 / 0, ZeroDivisionError, ""),
    (lambda vertices, faces, regions: np.zeros(3, int), lodestone.BadArgument, ""),
    (lambda vertices, faces, regions: np.full(len(vertices), -1), lodestone.BadArgument, "labels of the strategy"),
    (lambda vertices, faces, regions: np.full(len(vertices), 0.5), lodestone.BadArgument, "integers"),
    (lambda vertices, faces, regions: None, lodestone.BadArgument, "integers"),
    (7, TypeError, "a name or a function"),
])
def test_a_strategy_that_fails_is_an_error(strategy, error, text):
    with pytest.raises(error, match=text):
        lodestone.partition(sphere(4), strategy=strategy, regions=4)
    with pytest.raises(error, match=text):
        lodestone.find_collisions(sphere(4), sphere(4), mode="particles", strategy=strategy)


@pytest.mark.parametrize("mode", ["exact", "particles"])
def test_a_detector_goes_on_after_its_strategy_has_failed(mode):
    fails = [True]

    def strategy(vertices, faces, regions):
        if fails[0]:
            detector.detect()
        return slices(vertices, faces, regions)

    detector = lodestone.Detector(mode=mode, strategy=strategy, particles=4)
    detector.add(sphere()), detector.add(sphere().moved(0.5))
    with pytest.raises(lodestone.BadArgument, match="must not call it"):
        detector.detect()
    fails[0] = False
    assert detector.detect().collides


def test_partitions_have_labels_particles_and_measures():
    ball = sphere(24)
    divided = lodestone.partition(ball.vertices, ball.faces, strategy="lbg", regions=16)
    assert divided.regions == 16 and set(divided.labels) == set(range(16)) and divided.strategy == "lbg"
    assert [divided.labels[p] for p in divided.particles] == list(range(16))
    assert divided.measures["parts_per_region"] >= 1 and 0 < divided.measures["distortion"] < 1
    finer = lodestone.partition(ball, regions=64)
    assert finer.measures["distortion"] < divided.measures["distortion"]
    assert np.array_equal(lodestone.partition(ball, regions=16, threads=2).labels, divided.labels)
    with pytest.raises(lodestone.BadArgument):
        lodestone.partition(ball, regions=0)
    with pytest.raises(lodestone.BadArgument, match="nothing"):
        lodestone.partition(ball, strategy="nothing")
    with pytest.raises(TypeError, match="there is no option colour"):
        lodestone.partition(ball, colour="red")


@pytest.mark.parametrize("strategy", sorted(lodestone.strategies()))
def test_every_strategy_divides_a_sphere(strategy):
    divided = lodestone.partition(sphere(12), strategy=strategy, regions=8)
    assert 1 <= divided.regions <= 16 and len(divided.labels) == len(sphere(12).vertices)
    assert lodestone.strategies()[strategy]
