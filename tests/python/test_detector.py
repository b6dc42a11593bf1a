# SPDX-License-Identifier: GPL-3.0-or-later
"""The class Detector: how it reads arrays, and what it answers."""

import gc
import weakref
from decimal import Decimal

import numpy as np
import pytest

import lodestone
from conftest import Mesh, cube, sphere


def pairs_of(frame):
    return {(pair.a, pair.b): [tuple(faces) for faces in pair.faces] for pair in frame.pairs if pair.collides}


def test_an_array_is_read_where_it_is():
    detector = lodestone.Detector()
    a, b = cube(), cube().moved(5)
    detector.add(a), detector.add(b)
    assert not detector.detect().collides
    b.vertices -= [4.5, 0.5, 0.5]
    frame = detector.detect()
    assert frame.collides and frame.number == 2
    assert len(frame.faces) == len(lodestone.find_collisions(a, b).faces) > 0


@pytest.mark.parametrize("convert", [
    lambda v: v.astype(np.float32),
    lambda v: np.asfortranarray(v),
    lambda v: np.repeat(v, 2, axis=0)[::2],
    lambda v: np.hstack([v, v])[:, :3],
    lambda v: v[:, ::-1].copy()[:, ::-1],
    lambda v: np.frombuffer(bytearray(b"\0" + v.tobytes()), dtype=np.uint8)[1:].view(np.float64).reshape(-1, 3),
    lambda v: np.lib.format.open_memmap,
], ids=["float32", "fortran", "strided", "wide", "reversed", "bytes", "memmap"])
def test_floats_of_any_layout_are_read_by_every_query(convert, tmp_path):
    ball = sphere(8)
    ball.vertices = ball.vertices.astype(np.float32).astype(float)
    other = sphere(6).moved(5)
    given = convert(ball.vertices)
    if callable(given):
        given = np.lib.format.open_memmap(tmp_path / "v.npy", mode="w+", dtype=float, shape=ball.vertices.shape)
        given[:] = ball.vertices
    detector = lodestone.Detector()
    detector.add(given, ball.faces), detector.add(other)
    assert not detector.detect().collides
    given += 4.5
    moved = given.astype(float)
    expected = lodestone.find_collisions(Mesh(moved, ball.faces), other)
    assert [tuple(f) for f in detector.detect().faces] == [tuple(f) for f in expected.faces]


@pytest.mark.parametrize("vertices, faces", [
    (cube().vertices.tolist(), cube().faces.tolist()),
    (cube().vertices.astype(int), cube().faces.astype(np.uint8)),
    (cube().vertices.astype(">f8"), cube().faces.astype(np.uint64)),
    (cube().vertices.astype(np.longdouble), cube().faces.astype(">i4")),
    (cube().vertices, np.asfortranarray(cube().faces.astype(np.int16))),
])
def test_numbers_of_any_type_are_taken(vertices, faces):
    expected = lodestone.find_collisions(cube(), sphere())
    assert np.array_equal(lodestone.find_collisions((vertices, faces), sphere()).faces, expected.faces)
    detector = lodestone.Detector()
    detector.add(vertices, faces), detector.add(sphere())
    assert np.array_equal(detector.detect().faces, expected.faces)


def test_an_array_lives_as_long_as_its_object():
    detector = lodestone.Detector()
    detector.add(np.array(cube().vertices), np.array(cube().faces))
    detector.add(sphere())
    gc.collect()
    junk = [np.full((8, 3), 1e9) for _ in range(100)]
    assert detector.detect().collides and junk


def test_set_vertices_that_fails_leaves_the_array():
    for mode in ("exact", "particles"):
        detector = lodestone.Detector(mode=mode)
        a = detector.add(cube(), name="box")
        detector.add(cube().moved(0.5))
        assert detector.detect().collides
        broken = cube().vertices.copy()
        broken[:] = np.nan
        if mode == "particles":  # reads positions at once
            with pytest.raises(lodestone.BadMesh, match="not finite"):
                detector.set_vertices(a, broken)
        else:
            detector.set_vertices(a, broken)
            with pytest.raises(lodestone.BadMesh, match="not finite"):
                detector.detect()
            detector.set_vertices(a, cube().vertices)
        assert detector.detect().collides


def test_set_vertices_takes_another_array():
    detector = lodestone.Detector()
    a = detector.add(cube(), name="box")
    detector.add(cube().moved(5))
    assert not detector.detect().collides
    detector.set_vertices(a, cube().moved(4.5).vertices.astype(np.float32))
    assert detector.detect().collides
    with pytest.raises(lodestone.BadMesh, match="there are 8 vertices, but got 3"):
        detector.set_vertices(a, np.zeros((3, 3)))
    for call in (lambda object: detector.set_vertices(object, np.zeros((8, 2))),
                 lambda object: detector.rebuild(object, np.zeros((8, 2)), cube().faces)):
        with pytest.raises(lodestone.BadMesh, match=r"^object 0 \(box\): vertices must have the shape \(V, 3\)"):
            call(a)
        with pytest.raises(lodestone.BadMesh, match="^object 1: vertices must have the shape"):
            call(1)
        with pytest.raises(lodestone.BadArgument, match="there is no object 7"):
            call(7)
    with pytest.raises(lodestone.BadMesh, match=r"^object 0 \(box\): face 0 refers to vertex -1"):
        detector.rebuild(a, cube().vertices, cube().faces - 1)
    for indices in ("changed", "file_vertex"):
        with pytest.raises(lodestone.BadArgument, match=rf"^object 0 \(box\): {indices}"):
            detector.rebuild(a, cube().vertices, cube().faces, **{indices: [0.5]})
    with pytest.raises(lodestone.BadArgument, match=r"object 0 \(box\): it has no animation"):
        detector.set_frame(a, 1)
    with pytest.raises(lodestone.BadArgument, match="object 1: it has no animation"):
        detector.set_frame(1, 1)
    assert detector.detect().collides
    assert detector.name(a) == "box"


def test_detectors_and_pages_say_what_they_hold():
    detector = lodestone.Detector(mode="certified")
    assert repr(detector) == "<lodestone.Detector mode='certified', 0 objects>"
    detector.add(cube()), detector.add(cube()), detector.add(cube().moved(9))
    detector.remove(1)
    assert repr(detector) == "<lodestone.Detector mode='certified', 2 objects>"
    page = lodestone.Page(detector, title="Tea")
    assert repr(page) == "<lodestone.Page Tea: 0 frames>"
    page.add(detector.detect())
    assert repr(page) == "<lodestone.Page Tea: 1 frames>"


def test_frames_outlast_the_next_frame_and_their_detector():
    detector = lodestone.Detector(contact_points=True, contact_normals=True)
    a, b = cube(), cube().moved(0.5, 0.25, 0.125)
    detector.add(a), detector.add(b)
    frame = detector.detect()
    faces, pair = np.array(frame.faces), frame.pairs[0]
    b.vertices += 10
    assert not detector.detect().collides
    del detector
    gc.collect()
    assert np.array_equal(frame.faces, faces) and frame.faces is frame.faces
    assert len(pair.points) == len(pair.normals) == len(pair.depths) == len(pair.segments) == len(faces)
    assert not frame.faces.flags.writeable
    assert frame.faces.dtype == np.int64 and frame.points.shape == (len(faces), 3)
    with pytest.raises(ValueError):
        frame.faces[0, 0] = 7


def test_frames_are_freed():
    detector = lodestone.Detector(contact_points=True)
    detector.add(cube()), detector.add(sphere())
    frame = detector.detect()
    pair = frame.pairs[0]
    assert len(pair.points) == len(frame.faces) and frame.statistics
    known = weakref.ref(frame), weakref.ref(detector)
    del frame, pair, detector
    gc.collect()
    assert [ref() for ref in known] == [None, None]


def test_what_was_not_asked_for_is_none():
    pair = lodestone.find_collisions(cube(), sphere())
    assert pair.points is None and pair.normals is None and pair.depths is None and pair.segments is None
    assert pair.parting is None and pair.patches == [] and pair.containment == "none"


@pytest.mark.parametrize("scale", [1, 2.0**-540, 2.0**520])
def test_segments_of_faces_in_a_plane_are_their_longest_at_any_size(scale):
    triangle = Mesh(np.array([[1, -3, 3], [1, -1, 3], [1, -2, -1]]) * scale, [[0, 1, 2]])
    pair = lodestone.find_collisions(triangle, (triangle.vertices.copy(), triangle.faces), contact_points=True)
    assert np.linalg.norm(pair.segments[0][1] / scale - pair.segments[0][0] / scale) == pytest.approx(17**0.5)


def test_points_and_normals_of_two_crossing_triangles():
    flat = Mesh([[0, 0, 0], [4, 0, 0], [0, 4, 0]], [[0, 1, 2]])
    upright = Mesh([[1, 1, -1], [1, 1, 1], [1, -3, 0]], [[0, 1, 2]])
    pair = lodestone.find_collisions(flat, upright, contact_points=True, contact_normals=True)
    assert pair.faces.tolist() == [[0, 0]]
    assert sorted(pair.segments[0].tolist()) == [[1, 0, 0], [1, 1, 0]]
    assert pair.points.tolist() == [[1, 0.5, 0]]
    assert np.allclose(np.linalg.norm(pair.normals, axis=1), 1) and pair.depths[0] > 0
    assert sorted(pair.frame.outline(0).tolist()) == [[1, 0, 0], [1, 1, 0]]
    with pytest.raises(IndexError):
        pair.frame.outline(1)


def test_an_object_that_is_left_out_of_collisions_with_itself_is_told():
    crossing = [[0, 0, 0], [2, 0, 0], [0, 2, 0], [0.5, 0.5, -1], [0.6, 0.5, 1], [0.5, 0.6, 1]], [[0, 1, 2], [3, 4, 5]]
    detector = lodestone.Detector()
    detector.add(sphere(3))
    by_groups = detector.add(*crossing, groups=2, meets=1)
    by_choice = detector.add(*crossing)
    detector.ignore(by_choice, by_choice)
    for left_out in (by_groups, by_choice):
        with pytest.raises(lodestone.BadArgument, match=f"object {left_out} is left out of collisions with itself"):
            detector.self_collisions(left_out)
    detector.ignore(by_choice, by_choice, ignored=False)
    found = detector.self_collisions(by_choice)
    assert (found.a, found.b, found.collides) == (by_choice, by_choice, True)


@pytest.mark.parametrize("mode", ["exact", "certified", "particles"])
def test_many_objects_groups_and_ignored_pairs(mode):
    detector = lodestone.Detector(mode=mode)
    for i in range(4):
        detector.add(sphere(10).moved(1.5 * i), name=f"ball {i}", groups=1 if i < 3 else 2, meets=1)
    assert set(pairs_of(detector.detect())) == {(0, 1), (1, 2)}
    detector.ignore(0, 1)
    assert set(pairs_of(detector.detect())) == {(1, 2)}
    detector.ignore(1, 0, ignored=False)
    detector.remove(2)
    assert set(pairs_of(detector.detect())) == {(0, 1)}
    assert len(detector) == 4 and 1 in detector and 2 not in detector and 9 not in detector
    with pytest.raises(lodestone.BadArgument, match="object 2 has been removed"):
        detector.set_vertices(2, sphere(10).vertices)


def test_queries_about_two_objects():
    detector = lodestone.Detector()
    outer, inner, far = detector.add(cube(4)), detector.add(cube().moved(1, 1, 1)), detector.add(cube().moved(7, 1, 1))
    assert detector.contains(outer, inner) and not detector.contains(inner, outer)
    assert detector.within(outer, far, 3.001) and not detector.within(outer, far, 3)
    closest = detector.closest(outer, far)
    assert closest["distance"] == 3 and closest["points"][0][0] == 4 and closest["points"][1][0] == 7
    assert closest["direction"].tolist() == [-1, 0, 0]
    assert detector.parting(outer, far) is None
    shift = detector.parting(outer, inner)
    moved = Mesh(cube(4).vertices + shift, cube().faces)
    assert not lodestone.find_collisions(moved, cube().moved(1, 1, 1)).collides
    assert not lodestone.contains(moved, cube().moved(1, 1, 1))
    assert detector.detect(outer, far).pairs[0].collides is False


def test_an_array_that_is_resized_in_place_is_noticed():
    for mode in ("exact", "certified", "particles"):
        vertices, faces = sphere(20).vertices.copy(), sphere(20).faces
        detector = lodestone.Detector(mode=mode)
        detector.add(vertices, faces, name="ball"), detector.add(sphere(20).moved(1.5))
        expected = detector.detect().faces.tolist()
        vertices.resize((10, 3), refcheck=False)
        with pytest.raises(lodestone.BadMesh, match=r"object 0 \(ball\): the array of its vertices has been resized"):
            detector.detect()
        with pytest.raises(lodestone.BadMesh, match=r"^object 0 \(ball\): "):
            detector.vertices(0)
        detector.set_vertices(0, sphere(20).vertices)
        assert detector.detect().faces.tolist() == expected


def test_first_impact_of_two_cubes_that_pass_through_each_other():
    detector = lodestone.Detector()
    left, right = cube(), cube().moved(4, 0.25, 0.125)
    a, b = detector.add(left), detector.add(right)
    to_the_right, to_the_left = left.vertices + [8, 0, 0], right.vertices - [4, 0, 0]
    impact = detector.first_impact(a, to_the_right, b, to_the_left)
    assert impact["time"] == 0.25 and impact["point"][0] == 3
    of_lists = detector.first_impact(a, to_the_right.tolist(), b, to_the_left.astype(np.float32))
    assert of_lists["time"] == 0.25 and of_lists["faces"] == impact["faces"]
    assert detector.first_impact(a, left.vertices, b, right.vertices) is None
    one_call = lodestone.first_impact(left, to_the_right, right, to_the_left)
    assert one_call["time"] == 0.25 and one_call["faces"] == impact["faces"]
    swapped = detector.first_impact(b, to_the_left, a, to_the_right)
    assert swapped["time"] == 0.25
    of_all = detector.first_impact_of_all([to_the_right, to_the_left])
    assert of_all["objects"] == (a, b) and of_all["time"] == 0.25 and of_all["faces"] == impact["faces"]
    assert detector.first_impact_of_all([to_the_right, None])["time"] == 0.375
    assert detector.first_impact_of_all([None, None]) is None
    assert detector.first_impact_of_all([[], np.zeros((0, 3))]) is None
    (of_pair,) = detector.first_impacts([to_the_right, to_the_left])
    assert of_pair["objects"] == (a, b) and of_pair["time"] == 0.25 and of_pair["faces"] == impact["faces"]
    assert detector.first_impacts([None, None]) == []
    through_itself = lodestone.Detector(self_collision=True)
    through_itself.add(left)
    (of_itself,) = through_itself.first_impacts([-left.vertices])
    earliest = through_itself.first_impact_of_all([-left.vertices])
    assert of_itself["objects"] == earliest["objects"] == (0, 0) and of_itself["time"] == earliest["time"] == 0.5
    with pytest.raises(lodestone.BadArgument, match="each of the 2 object ids, but got 1"):
        detector.first_impact_of_all([to_the_right])
    with pytest.raises(lodestone.BadMesh, match="8 vertices, but got 7"):
        detector.first_impact(a, to_the_right[:7], b, to_the_left)
    with pytest.raises(lodestone.BadArgument, match=r"end_b must have the shape \(n, 3\)"):
        detector.first_impact(a, to_the_right, b, [1, 2, 3])
    with pytest.raises(lodestone.BadMesh):
        detector.first_impact(a, to_the_right * np.nan, b, to_the_left)
    with pytest.raises(lodestone.BadArgument,
                       match="first_impact, unlike first_self_impact, needs two different objects, but both are object 0"):
        detector.first_impact(a, to_the_right, a, to_the_right)


def test_first_self_impact_of_a_cube_that_turns_inside_out():
    detector = lodestone.Detector()
    box = cube()
    detector.add(box)
    end = box.vertices * [-1, 1, 1]
    impact = detector.first_self_impact(0, end)
    assert impact["time"] == 0.5 and impact["faces"][0] < impact["faces"][1]
    one_call = lodestone.first_self_impact(box, end)
    assert one_call["time"] == 0.5 and one_call["faces"] == impact["faces"]
    assert detector.first_self_impact(0, box.vertices + [1, 2, 3]) is None
    # Two faces along an edge that is stored twice touch from the start, unless its vertices are one.
    seam = Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0], [1, 0, 0], [0, -1, 1]], [[0, 1, 2], [4, 3, 5]])
    assert lodestone.first_self_impact(seam, seam.vertices)["time"] == 0
    assert lodestone.first_self_impact(seam, seam.vertices, file_vertex=[0, 1, 2, 0, 1, 5]) is None
    with pytest.raises(lodestone.BadArgument, match="file_vertex"):
        lodestone.first_self_impact(seam, seam.vertices, file_vertex=[0])
    with pytest.raises(lodestone.BadMesh, match="8 vertices, but got 7"):
        detector.first_self_impact(0, end[:7])
    with pytest.raises(lodestone.BadArgument, match=r"end must have the shape \(n, 3\)"):
        lodestone.first_self_impact(box, [1, 2, 3])


def test_a_visitor_sees_contacts_and_may_stop():
    detector = lodestone.Detector()
    detector.add(cube()), detector.add(cube().moved(0.5, 0.25, 0.125))
    seen = []
    assert detector.visit(0, 1, lambda a, b: seen.append((a, b)))
    assert sorted(seen) == [tuple(faces) for faces in detector.detect().faces]
    assert not detector.visit(0, 1, lambda a, b: True)
    with pytest.raises(ZeroDivisionError):
        detector.visit(0, 1, lambda a, b: 1 / 0)
    for call in (lambda *_: detector.detect(), lambda *_: detector.set_vertices(0, cube().vertices)):
        with pytest.raises(lodestone.BadArgument, match="must not call it"):
            detector.visit(0, 1, call)
    assert detector.detect().collides


def test_an_object_is_there_or_not():
    detector = lodestone.Detector()
    detector.add(cube()), detector.add(sphere())
    detector.remove(0)
    assert 1 in detector and np.int64(1) in detector
    for key in (0, 2, -1, 2**40, 1.0, np.float32(1.5), Decimal(1), np.array([1.5]), "1", None):
        assert key not in detector


def test_faces_change():
    detector = lodestone.Detector()
    shape = detector.add(sphere(8))
    other = sphere(6).moved(0.5)
    detector.add(other)
    detector.detect()
    finer = sphere(12)
    detector.rebuild(shape, finer.vertices, finer.faces)
    assert np.array_equal(detector.detect().faces, lodestone.find_collisions(finer, other).faces)
    faces = finer.faces.copy()
    faces[5] = faces[6]
    detector.rebuild(shape, finer.vertices, faces, changed=[5])
    assert np.array_equal(detector.detect().faces, lodestone.find_collisions(Mesh(finer.vertices, faces), other).faces)
    faces[9] = faces[10]
    for incomplete in ([], [5], [8, 10]):
        with pytest.raises(lodestone.BadArgument, match="object 0: face 9 has other corners than before"):
            detector.rebuild(shape, finer.vertices, faces, changed=incomplete)
    faces[9] = np.roll(finer.faces[9], 1)
    with pytest.raises(lodestone.BadArgument, match="face 9 has other corners"):
        detector.rebuild(shape, finer.vertices, faces, changed=[])
    faces[9] = finer.faces[9]
    with pytest.raises(lodestone.BadArgument, match=f"there is no face {len(faces)}"):
        detector.rebuild(shape, finer.vertices, faces, changed=[len(faces)])
    fewer = np.vstack([faces[:-3], faces[[0]]])  # one moved from the end, as `collect_garbage` does
    with pytest.raises(lodestone.BadArgument, match=f"face {len(fewer) - 1} has other corners"):
        detector.rebuild(shape, finer.vertices, fewer, changed=[])
    detector.rebuild(shape, finer.vertices, fewer, changed=[len(fewer) - 1])
    detector.rebuild(shape, finer.vertices, faces, changed=[len(fewer) - 1])  # those at the end are new
    with pytest.raises(lodestone.BadMesh, match="face 0 refers to vertex 7 of 3"):
        detector.rebuild(shape, np.zeros((3, 3)), [[0, 1, 7]])
    with pytest.raises(lodestone.BadMesh):
        detector.rebuild(shape, np.zeros((3, 3)), np.zeros((0, 3), dtype=int))
    assert np.array_equal(detector.detect().faces, lodestone.find_collisions(Mesh(finer.vertices, faces), other).faces)


def test_what_was_built_can_be_saved():
    detector = lodestone.Detector()
    ball, other = sphere(), sphere().moved(1.5)
    detector.add(ball), detector.add(other)
    expected, saved = detector.detect().faces, detector.save(0)
    again = lodestone.Detector()
    again.add(ball), again.add(other)
    again.load(0, saved)
    frame = again.detect()
    assert np.array_equal(frame.faces, expected) and frame.statistics["builds"] == 1
    with pytest.raises(lodestone.BadSavedObject):
        again.load(0, saved[:-1])


def test_a_placed_object_is_where_its_matrix_says():
    detector = lodestone.Detector()
    detector.add(cube()), detector.add(cube())
    matrix = np.eye(4)
    matrix[:3, 3] = [5, 0, 0]
    detector.place(1, matrix)
    assert not detector.detect().collides and detector.closest(0, 1)["distance"] == 4
    assert np.array_equal(detector.vertices(1), cube().vertices + [5, 0, 0])
    with pytest.raises(lodestone.BadArgument):
        detector.place(1, 2 * matrix)
    assert np.array_equal(detector.vertices(1), cube().vertices + [5, 0, 0])
    detector.place(1, np.eye(4))
    assert np.array_equal(detector.vertices(1), cube().vertices)


def test_regions_and_particles():
    detector = lodestone.Detector(mode="particles", particles=12, list_candidates=True)
    detector.add(sphere()), detector.add(sphere().moved(1.5))
    for call, what in ((detector.regions, "regions"), (detector.particles, "particles")):
        with pytest.raises(lodestone.BadArgument, match=f"object 0 has no {what} before the first query"):
            call(0)
    frame = detector.detect()
    assert frame.collides
    regions, particles = detector.regions(0), detector.particles(0)
    assert set(regions) == set(range(12)) and len(particles) == 12
    assert regions[particles[3]] == 3 and frame.candidates


@pytest.mark.parametrize("objects", [0, [0], None])
def test_rays_are_refused_by_the_name_of_their_function(objects):
    detector = lodestone.Detector(mode="particles")
    detector.add(sphere())
    with pytest.raises(lodestone.BadArgument, match="^first_hit needs the mode exact or certified$"):
        detector.first_hit(objects, (0, 0, 0), (1, 0, 0))
    with pytest.raises(lodestone.BadArgument, match="^first_hits needs the mode exact or certified$"):
        detector.first_hits(objects, [(0, 0, 0)], (1, 0, 0))


@pytest.mark.parametrize("mode", ["exact", "certified"])
def test_particles_are_refused_where_there_are_none(mode):
    detector = lodestone.Detector(mode=mode, particles=12)
    detector.add(sphere())
    detector.detect()
    with pytest.raises(lodestone.BadArgument, match="^particles needs the mode particles or senin; "):
        detector.particles(0)


@pytest.mark.parametrize("mode", ["exact", "certified", "particles"])
def test_regions_of_a_skin_are_those_of_the_same_mesh(mode):
    ball = sphere(8)
    joints = np.zeros((len(ball.vertices), 1), dtype=int)
    detector = lodestone.Detector(mode=mode, particles=4)
    detector.add(lodestone.Skin(ball.vertices, joints, np.ones_like(joints, dtype=float)), ball.faces)
    detector.add(ball)
    with pytest.raises(lodestone.BadArgument, match="object 0 has no regions before the first query"):
        detector.regions(0)
    detector.detect()
    assert set(detector.regions(0)) == {0, 1, 2, 3}
    assert np.array_equal(detector.regions(0), detector.regions(1))


def test_a_visitor_is_a_function():
    detector = lodestone.Detector()
    detector.add(cube()), detector.add(cube().moved(0.5))
    with pytest.raises(TypeError):
        detector.visit(0, 1, None)


def test_a_ray_that_begins_on_a_face_hits_it_at_zero():
    detector = lodestone.Detector()
    detector.add(cube())
    t = detector.first_hit(0, [0.25, 0.5, 1], [0, 0, -1])["t"]
    assert t == 0 and not np.signbit(t)


def test_positions_are_read_once_where_they_are_held():
    box = cube(1)
    vertices = np.array(box.vertices, dtype=float)[:, ::-1]  # not in memory as it is needed: copied by each query
    detector = lodestone.Detector()
    still, moved = detector.add(cube(1)), detector.add(vertices, np.array(box.faces)[:, ::-1])
    assert detector.detect().collides
    with detector.hold_positions():
        assert detector.detect().collides
        vertices += 5
        assert detector.detect().collides  # as promised: nothing was looked at
        detector.update(moved)
        assert not detector.detect().collides
        detector.set_vertices(moved, vertices - 5)
        assert detector.detect().collides
        detector.set_vertices(moved, vertices)
    assert detector.closest(still, moved)["distance"] > 1
    vertices -= 5
    assert detector.detect().collides
    with detector.hold_positions(), detector.hold_positions():
        assert detector.detect().collides
    with pytest.raises(lodestone.BadArgument):
        with lodestone.Detector(mode="particles").hold_positions():
            pass


def test_the_end_of_held_positions_is_noticed_wherever_it_comes():
    box = cube(1)
    vertices = np.array(box.vertices, dtype=np.float32)  # copied by each query
    detector = lodestone.Detector()
    still, moved = detector.add(cube(1)), detector.add(vertices, box.faces)
    with pytest.raises(lodestone.BadArgument):
        detector.hold_positions().__exit__(None, None, None)
    held = detector.hold_positions()
    held.__enter__()

    def end(face_a, face_b):
        if face_a == face_b == 0:
            held.__exit__(None, None, None)

    detector.visit(still, moved, end)
    vertices += 5
    assert not detector.detect().collides
    with pytest.raises(lodestone.BadArgument):
        held.__exit__(None, None, None)
    with pytest.raises(ZeroDivisionError):
        with detector.hold_positions():
            assert not detector.detect().collides
            raise ZeroDivisionError
    vertices -= 5
    assert detector.detect().collides
