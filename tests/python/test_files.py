# SPDX-License-Identifier: GPL-3.0-or-later
"""Files: meshes, animations, scenes, pages. Scenes give what the program gives."""

import base64
import json
import os
import re
import struct
import subprocess

import numpy as np
import pytest

import lodestone
from conftest import cube, root, sphere


@pytest.mark.parametrize("extension", ["obj", "off", "ply", "stl", "gltf", "glb"])
def test_a_written_mesh_is_read_again(tmp_path, extension):
    ball = sphere(8)
    path = tmp_path / f"ball.{extension}"
    lodestone.write_mesh(path, ball)
    read = lodestone.read_mesh(path)
    assert read.frames == 1 and len(read.faces) == len(ball.faces)
    corners = lambda mesh: np.sort(mesh.vertices[np.asarray(mesh.faces)].reshape(len(mesh.faces), 9), axis=1)
    assert np.allclose(corners(read), corners(ball), atol=1e-6)
    assert lodestone.find_collisions(read, cube()).collides


def test_positions_of_a_file_cannot_be_written_by_mistake(tmp_path):
    path = tmp_path / "ball.obj"
    lodestone.write_mesh(path, sphere(4))
    ball = lodestone.read_mesh(path)
    with pytest.raises(ValueError, match="read-only"):
        ball.vertices[:] += 1
    detector = lodestone.Detector()
    detector.add(ball)
    with pytest.raises(lodestone.BadArgument, match="add a copy of its vertices"):
        detector.set_vertices(0, ball.vertices + 1)
    assert ball.ignored_extensions == []
    for name in ["shape:teapot", "scene.json#teapot", "SCENE.JSON"]:
        with pytest.raises(lodestone.BadArgument, match="read by read_scene"):
            lodestone.read_mesh(name)


def test_extensions_that_place_surfaces_are_told(tmp_path):
    path = tmp_path / "copies.gltf"
    lodestone.write_mesh(path, sphere(2))
    document = json.loads(path.read_text())
    document["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {}}}
    path.write_text(json.dumps(document))
    assert lodestone.read_mesh(path).ignored_extensions == ["EXT_mesh_gpu_instancing"]


def test_a_polygon_is_cut_and_told(tmp_path):
    path = tmp_path / "quad.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nf 1 2 3 4\n")
    read = lodestone.read_mesh(path)
    assert len(read.vertices) == 5 and len(read.faces) == 2 and read.file_faces.tolist() == [0, 0]
    assert read.files == [str(path)] and read.kind == "mesh"


def test_errors_name_file_place_and_cause(tmp_path):
    path = tmp_path / "broken.obj"
    path.write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(lodestone.BadMesh, match=re.escape(str(path)) + ":2: "):
        lodestone.read_mesh(path)
    with pytest.raises(lodestone.BadMesh, match="there is no such file"):
        lodestone.read_mesh("nowhere.ply")
    with pytest.raises(lodestone.BadOutput):
        lodestone.write_mesh("/proc/nowhere/ball.ply", cube())
    with pytest.raises(lodestone.BadArgument):
        lodestone.write_mesh(tmp_path / "ball.txt", cube())
    scene = tmp_path / "scene.json"
    scene.write_text('{"objects": 3}')
    with pytest.raises(lodestone.BadScene, match="/objects"):
        lodestone.read_scene(scene)


def test_files_with_more_faces_than_allowed_are_refused(tmp_path, scenes):
    path = tmp_path / "box.obj"
    lodestone.write_mesh(path, cube())
    assert len(lodestone.read_mesh(path, max_faces=12).faces) == 12
    with pytest.raises(lodestone.BadMesh, match="box.obj.*11"):
        lodestone.read_mesh(path, max_faces=11)
    with pytest.raises(lodestone.BadMesh, match="11"):
        lodestone.read_animation(path, max_faces=11)
    scene = tmp_path / "scene.json"
    scene.write_text('{"frames": 2, "objects": [{"name": "box", "mesh": "box.obj"}]}')
    assert sum(1 for _ in lodestone.play(scene, max_faces=12)) == 2
    with pytest.raises(lodestone.BadMesh, match="11"):
        next(lodestone.play(scene, max_faces=11))


def test_limits_of_bytes_frames_and_objects_are_options(tmp_path):
    path = tmp_path / "box.obj"
    lodestone.write_mesh(path, cube())
    size = path.stat().st_size
    assert len(lodestone.read_mesh(path, max_bytes=size).faces) == 12
    for read in (lodestone.read_mesh, lodestone.read_animation):
        with pytest.raises(lodestone.BadMesh, match=f"at most {size - 1} are allowed"):
            read(path, max_bytes=size - 1)
    for number in (1, 2):
        lodestone.write_mesh(tmp_path / f"step_{number}.obj", cube())
    with pytest.raises(lodestone.BadMotion, match="2 frames, where at most 1 are allowed"):
        lodestone.read_animation(tmp_path / "step_#.obj", max_frames=1)
    scene = tmp_path / "scene.json"
    scene.write_text('{"frames": 2, "objects": [{"name": "a", "mesh": "box.obj"}, {"name": "b", "mesh": "box.obj"}]}')
    fitting = {"max_bytes": size, "max_frames": 2, "max_objects": 2, "max_scene_faces": 24}
    assert len(lodestone.read_scene(scene, **fitting).objects) == 2
    assert sum(1 for _ in lodestone.play(scene, **fitting)) == 2
    for name, most in fitting.items():
        for read in (lodestone.read_scene, lambda *given, **options: next(lodestone.play(*given, **options))):
            with pytest.raises((lodestone.BadScene, lodestone.BadMesh)):
                read(scene, **{**fitting, name: most - 1})


@pytest.mark.parametrize("extension", ["pc2", "mdd", "glb"])
def test_an_animation_goes_to_a_file_and_back(tmp_path, extension):
    box = cube()
    frames = [box.vertices + [t, 0, 0] for t in range(5)]
    path = tmp_path / f"box.{extension}"
    lodestone.write_animation(path, frames, box.faces if extension == "glb" else None, frames_per_second=10)
    lodestone.write_mesh(tmp_path / "box.obj", box)
    mesh = {} if extension == "glb" else {"mesh": tmp_path / "box.obj"}
    read = lodestone.read_animation(path, **mesh)
    assert len(read) == read.frames == 5 and len(read.faces) == 12
    for t, frame in enumerate(read):
        assert np.allclose(frame, frames[t])
    assert np.array_equal(read[-1], read.pose(4))
    with pytest.raises(IndexError):
        read[5]
    lodestone.write_animation(tmp_path / "again.glb", read)
    assert np.array_equal(lodestone.read_animation(tmp_path / "again.glb").faces, read.faces)
    detector = lodestone.Detector()
    moving = detector.add(read)
    detector.add(cube().moved(3.5))
    assert not detector.detect().collides
    detector.set_frame(moving, 3)
    assert detector.detect().collides and np.array_equal(detector.vertices(moving), read[3])
    with pytest.raises(lodestone.BadArgument, match="there is no frame 5"):
        detector.set_frame(moving, 5)
    with pytest.raises(IndexError, match="there is no frame -100: there are 5"):
        read[-100]
    detector.set_frame(moving, -1)
    assert np.array_equal(detector.vertices(moving), read[4])
    with pytest.raises(lodestone.BadArgument, match=r"object 0 \(box.*\): there is no frame -6: there are 5"):
        detector.set_frame(moving, -6)
    assert np.array_equal(detector.vertices(moving), read[4])
    for frames in (slice(0, 3), slice(None, None, -2), slice(7, 9)):
        assert [vertices[0, 0] for vertices in read[frames]] == [0, 1, 2, 3, 4][frames]


def test_frames_of_other_lengths_are_refused(tmp_path):
    with pytest.raises(lodestone.BadArgument, match="frame 1 has another number of vertices"):
        lodestone.write_animation(tmp_path / "a.pc2", [np.zeros((3, 3)), np.zeros((4, 3))])
    with pytest.raises(lodestone.BadArgument, match="no frames"):
        lodestone.write_animation(tmp_path / "a.pc2", [])


@pytest.mark.parametrize("mode", ["exact", "certified", "particles"])
@pytest.mark.parametrize("scene", ["teapot_sphere_2", "bodies_20"])
def test_a_scene_plays_as_in_the_program(scenes, program, tmp_path, scene, mode):
    options = {"particles": 32} if mode == "particles" else {}
    command = [program, "detect", str(scenes / f"{scene}.json"), "--mode", mode, "--contacts", "all", "--out",
               str(tmp_path), "--quiet"]
    subprocess.run(command + (["--particles", "32"] if options else []), check=True, capture_output=True)
    lines = [json.loads(line) for line in (tmp_path / "frames.jsonl").read_text().splitlines()]
    names = [animation.name for animation in lodestone.read_scene(scenes / f"{scene}.json").objects]
    assert len(lines) > 50
    for line, frame in zip(lines, lodestone.play(scenes / f"{scene}.json", mode=mode, **options), strict=True):
        told = {(p["a"], p["b"]): [tuple(f) for f in p["faces"]] for p in line["pairs"]}
        found = {(names[p.a], names[p.b]): [tuple(f) for f in p.faces] for p in frame.pairs}
        assert told == found


def test_a_scene_has_objects_that_are_animations(scenes):
    scene = lodestone.read_scene(scenes / "teapot_sphere_1.json")
    assert scene.frames == 300 and len(scene.objects) == 2 and scene.ignored == []
    assert scene.objects[0].vertices.shape[1] == 3 and scene.objects[0].frames == 300
    frames = list(lodestone.play(scene, frames=range(100, 103)))
    assert len(frames) == 3 and frames[0].detector is frames[2].detector


def test_a_scene_says_how_many_particles_its_objects_have_and_where_they_start(tmp_path, program):
    path = tmp_path / "scene.json"
    ball = {"shape": {"icosphere": {"frequency": 8}}}
    far = {"way_points": [{"frame": frame, "at": [40 + frame, 0, 0]} for frame in (0, 1)], "path": "linear"}
    path.write_text(json.dumps({"frames": 2, "objects": [
        {"name": "many", "particles": 40, "scattered_side": [1, 0, 0], **ball},
        {"name": "few", "motion": {"deform": [{"travel": far}]}, **ball}]}))
    scene = lodestone.read_scene(path)
    assert scene.options(0)["particles"] == 40 and scene.options(0)["scattered_side"].tolist() == [1, 0, 0]
    assert scene.options(1) == {"groups": 1, "meets": 2**32 - 1, "particles": 0, "scattered_side": None}
    with pytest.raises(IndexError):
        scene.options(2)
    subprocess.run([program, "detect", str(path), "--mode", "particles", "--out", str(tmp_path), "--quiet"], check=True,
                   capture_output=True)
    told = [o["particles"] for o in json.loads((tmp_path / "summary.json").read_text())["objects"]]
    for options, expected in [({}, told), ({"particles": 20}, [20, 20])]:
        frame = next(lodestone.play(path, mode="particles", **options))
        assert [len(frame.detector.particles(i)) for i in (0, 1)] == expected
    frame = next(lodestone.play(path, mode="senin", seed=2))  # too far apart to move
    least = [frame.detector.vertices(i)[frame.detector.particles(i)][:, 0].min() for i in (0, 1)]
    assert least[0] > 0 and least[1] < 40
    with pytest.raises(lodestone.BadArgument, match="must be a finite direction"):
        lodestone.Detector(mode="senin").add(cube(), scattered_side=[0, 0, 0])


def test_components_of_one_mesh_are_objects_on_demand(tmp_path):
    box = cube()
    pattern = tmp_path / "break_##.obj"
    faces = np.vstack([box.faces, box.faces + 8])
    shifts = [3, 1.5, 0.5]
    lodestone.write_animation(pattern, [np.vstack([box.vertices, box.vertices + [x, 0, 0]]) for x in shifts], faces)
    assert [o.name for o in lodestone.read_scene(pattern).objects] == ["break"]
    scene = lodestone.read_scene(pattern, components=True)
    assert scene.frames == 3 and [o.name for o in scene.objects] == ["break_1", "break_2"]
    assert np.array_equal(scene.objects[1][2], box.vertices + [0.5, 0, 0])
    assert scene.objects[1].file_faces.tolist() == list(range(12, 24))
    for mode in ("exact", "certified", "particles"):
        assert [bool(f) for f in lodestone.play(pattern, components=True, mode=mode)] == [False, False, True]
    with pytest.raises(lodestone.BadArgument, match="give them to read_scene"):
        next(lodestone.play(scene, components=True))
    with pytest.raises(TypeError, match="no option componets.*components, parts"):
        next(lodestone.play(pattern, componets=True))


def test_parts_that_a_file_names_are_objects_on_demand(tmp_path):
    path = tmp_path / "parts.obj"
    path.write_text("v 0 0 0\nv 2 0 0\nv 0 2 0\nv 1 1 -1\nv 1 1 1\nv 0 1 1\no floor\nf 1 2 3\no wall\nf 4 5 6\n")
    scene = lodestone.read_scene(path, parts=True)
    assert [o.name for o in scene.objects] == ["floor", "wall"] and scene.objects[1].file_faces.tolist() == [1]
    assert [bool(f) for f in lodestone.play(path, parts=True)] == [True]


def test_a_scene_can_be_several_inputs(tmp_path, scenes):
    lodestone.write_mesh(tmp_path / "box.obj", cube())
    scene = lodestone.read_scene([tmp_path / "box.obj", "shape:teapot"])
    assert [o.name for o in scene.objects] == ["box", "teapot"] and scene.frames == 1
    assert [bool(frame) for frame in lodestone.play([str(tmp_path / "box.obj"), "shape:teapot"])] == [True]
    with pytest.raises(lodestone.BadArgument, match="a scene must be the only input"):
        lodestone.read_scene([tmp_path / "box.obj", scenes / "teapot_sphere_1.json"])
    with pytest.raises(lodestone.BadArgument, match="at least one path"):
        lodestone.read_scene([])


def test_frames_of_a_scene_are_counted_from_the_end_too(scenes):
    def faces_of(*frames):
        return [frame.faces.tolist() for frame in lodestone.play(scenes / "teapot_sphere_1.json", frames=frames)]

    assert faces_of(-190, -1) == faces_of(110, 299) and faces_of(110) != faces_of(299)
    for number in (300, -301):
        with pytest.raises(lodestone.BadArgument, match=f"there is no frame {number}: there are 300"):
            faces_of(number)
    with pytest.raises(TypeError):
        faces_of(1.5)


def test_an_animation_that_is_written_again_keeps_its_first_time(tmp_path):
    times, positions = [0.25, 0.5, 0.75], np.zeros((3, 4, 3))
    (tmp_path / "late.mdd").write_bytes(
        struct.pack(">ii", 3, 4) + np.asarray(times, ">f4").tobytes() + positions.astype(">f4").tobytes()
    )
    late = lodestone.read_animation(tmp_path / "late.mdd")
    for given, expected in (({}, times), ({"frames_per_second": 8}, [0.125, 0.25, 0.375])):
        lodestone.write_animation(tmp_path / "copy.mdd", late, **given)
        assert np.frombuffer((tmp_path / "copy.mdd").read_bytes()[8:20], ">f4") == pytest.approx(expected)
    lodestone.write_animation(tmp_path / "some.mdd", late[1:3])
    assert np.frombuffer((tmp_path / "some.mdd").read_bytes()[8:16], ">f4") == pytest.approx([0, 1 / 30])


def test_an_animation_that_is_written_again_keeps_its_frame_rate(tmp_path):
    box = cube()
    lodestone.write_animation(tmp_path / "a.glb", [box.vertices, box.vertices + 1], box.faces, frames_per_second=12)
    read = lodestone.read_animation(tmp_path / "a.glb")
    for given, expected in (({}, 12), ({"frames_per_second": 25}, 25)):
        lodestone.write_animation(tmp_path / "b.glb", read, **given)
        assert lodestone.read_animation(tmp_path / "b.glb").frames_per_second == pytest.approx(expected)
    lodestone.write_animation(tmp_path / "c.glb", [box.vertices, box.vertices + 1], box.faces)
    assert lodestone.read_animation(tmp_path / "c.glb").frames_per_second == pytest.approx(30)


@pytest.mark.parametrize("extension", ["pc2", "mdd", "PC2"])
def test_a_mesh_is_not_written_as_a_point_cache_which_has_no_faces(tmp_path, extension):
    with pytest.raises(lodestone.BadArgument, match="a point cache has no faces"):
        lodestone.write_mesh(tmp_path / f"m.{extension}", cube())
    assert not list(tmp_path.iterdir())


def test_options_of_gltf_animations_are_refused_elsewhere(tmp_path):
    box = cube()
    for name in ("m.obj", "still.glb"):
        lodestone.write_mesh(tmp_path / name, box)
    lodestone.write_animation(tmp_path / "c.pc2", [box.vertices])
    for name in ("m.obj", "c.pc2"):
        for options in ({"animation": "walk"}, {"animation": 1}, {"frames_per_second": 24}):
            with pytest.raises(lodestone.BadArgument, match="for glTF files"):
                lodestone.read_animation(tmp_path / name, **options)
    with pytest.raises(lodestone.BadArgument, match="the file has no animations"):
        lodestone.read_animation(tmp_path / "still.glb", animation="walk")
    for rate in (-5, 0, float("nan"), float("inf")):
        with pytest.raises(lodestone.BadArgument, match="frames_per_second must be finite and > 0"):
            lodestone.read_animation(tmp_path / "still.glb", frames_per_second=rate)
    assert len(lodestone.read_animation(tmp_path / "still.glb", frames_per_second=24).faces) == 12


def test_faces_beside_an_animation_are_refused_with_the_way_out(tmp_path):
    lodestone.write_animation(tmp_path / "c.pc2", [cube().vertices] * 2)
    cache = lodestone.read_animation(tmp_path / "c.pc2")
    with pytest.raises(lodestone.BadArgument, match="give `mesh` to read_animation"):
        lodestone.Detector().add(cache, cube().faces)


def test_the_path_of_a_page_is_checked_before_frames_are_played(tmp_path):
    def frames():
        raise AssertionError("a frame was asked for")
        yield

    with pytest.raises(lodestone.BadArgument, match="written as .html"):
        lodestone.page(frames(), tmp_path / "page.htm")


def test_a_page_of_particles_says_that_collisions_may_be_missed(tmp_path):
    measured, unmeasured = "of the colliding frames", "has not measured how many"
    for options, own_particles, says in (
        ({"mode": "exact"}, 0, None),
        ({"mode": "particles"}, 0, measured),
        ({"mode": "particles"}, 12, measured),
        ({"mode": "particles"}, 4, unmeasured),
        ({"mode": "particles", "least_particles": 4}, 0, unmeasured),
        ({"mode": "particles", "strategy": "grid"}, 0, unmeasured),
        ({"mode": "particles", "normal_weight": 0.5}, 0, unmeasured),
        ({"mode": "particles", "strategy": lambda vertices, faces, count: np.arange(len(vertices)) % 2}, 0, unmeasured),
    ):
        detector = lodestone.Detector(**options)
        detector.add(cube(), particles=own_particles), detector.add(sphere(8))
        page = lodestone.Page(detector)
        page.add(detector.detect())
        page.save(tmp_path / "page.html")
        data = re.search(r'id="lodestone-data"[^>]*>([^<]*)<', (tmp_path / "page.html").read_text()).group(1)
        bytes_of_page = base64.b64decode(data)
        header = json.loads(bytes_of_page[16 : 16 + int.from_bytes(bytes_of_page[12:16], "little")])
        assert bool(header["note"]) == bool(says)
        assert not says or ("may miss collisions" in header["note"] and says in header["note"])


def test_a_page_shows_frames(scenes, tmp_path):
    path = tmp_path / "page.html"
    page = lodestone.page(lodestone.play(scenes / "teapot_sphere_1.json", frames=range(110, 114)), path, title="Tea <time>")
    text = path.read_text()
    assert len(page) == 4 and "Tea &lt;time&gt;" in text and "lodestone-data" in text
    shown = page._repr_html_()
    assert shown.startswith("<iframe srcdoc=") and len(shown) > len(text)
    with pytest.raises(lodestone.BadArgument, match="there are no frames"):
        lodestone.page([])
    with pytest.raises(lodestone.BadArgument, match="written as .html"):
        page.save(tmp_path / "page.txt")


def test_a_frame_shows_itself():
    detector = lodestone.Detector()
    detector.add(cube(), name="box"), detector.add(sphere())
    page = detector.detect().show()
    assert len(page) == 1 and "<iframe" in page._repr_html_()
    with pytest.raises(lodestone.BadArgument, match="only a frame of a Detector"):
        lodestone.find_collisions(cube(), sphere()).frame.show()
    with pytest.raises(TypeError, match="got Pair: its frame is pair.frame"):
        lodestone.page([detector.self_collisions(0)])


def test_the_name_of_a_mesh_file_is_taken_literally(tmp_path):
    for name in ("scan#1.obj", "what*.ply"):
        lodestone.write_mesh(tmp_path / name, cube())
        assert np.array_equal(lodestone.read_mesh(tmp_path / name).vertices, cube().vertices)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scan#1.obj", "what*.ply"]


@pytest.mark.parametrize("name", ["a.obj", "a.stl", "a.glb"])
def test_numbers_that_are_not_finite_are_not_written(tmp_path, name):
    mesh = cube()
    mesh.vertices[2, 1] = np.nan
    with pytest.raises(lodestone.BadMesh, match=f"{name}: vertex 2 has a coordinate that is not finite"):
        lodestone.write_mesh(tmp_path / name, mesh)
    with pytest.raises(lodestone.BadMesh, match=f"{name}: vertex 2 of frame 1"):
        lodestone.write_animation(tmp_path / name, [cube().vertices, mesh.vertices], cube().faces)
    with pytest.raises(lodestone.BadMesh, match=f"{name}: face 3 refers to vertex 8 of 8"):
        lodestone.write_mesh(tmp_path / name, cube().vertices, np.where(np.arange(12)[:, None] == 3, 8, cube().faces))
    with pytest.raises(lodestone.BadArgument, match=rf"{name}: frame 1 must have the shape \(n, 3\), but got \(8, 2\)"):
        lodestone.write_animation(tmp_path / name, [cube().vertices, np.zeros((8, 2))], cube().faces)
    with pytest.raises(lodestone.BadArgument, match=f"{name}: vertices must have the shape"):
        lodestone.write_mesh(tmp_path / name, np.zeros((8, 2)), cube().faces)
    assert not list(tmp_path.iterdir())


def test_a_page_refuses_other_faces_even_if_they_are_as_many():
    detector = lodestone.Detector()
    box = detector.add(cube())
    page = lodestone.Page(detector)
    page.add(detector.detect())
    detector.rebuild(box, cube().vertices, cube().faces[::-1])
    with pytest.raises(lodestone.BadArgument, match="begin another page"):
        page.add(detector.detect())
    assert len(page) == 1


def test_names_that_are_not_utf8_can_be_told(tmp_path):
    missing = os.fsencode(tmp_path) + b"/nope\xff.obj"
    with pytest.raises(lodestone.BadMesh, match="nope.*there is no such file"):
        lodestone.read_mesh(os.fsdecode(missing))
    path = os.fsencode(tmp_path) + b"/d\xff.obj"
    with open(path, "wb") as file:
        file.write(b"v 0 0 0\nv 1 0 0\nv 0 1 0\no caf\xe9\nf 1 2 3\no other\nf 2 1 3\n")
    mesh = lodestone.read_mesh(os.fsdecode(path))
    assert mesh.name == "d\ufffd.obj" and "d\ufffd.obj" in repr(mesh)
    assert [os.fsencode(file) for file in mesh.files] == [path]
    scene = lodestone.read_scene(os.fsdecode(path), parts=True)
    assert "caf\ufffd" in scene.objects[0].name and repr(scene)
    detector = lodestone.Detector()
    detector.add(scene.objects[0])
    assert "caf\ufffd" in detector.name(0)
    with pytest.raises(lodestone.BadArgument, match="caf.*there is no frame 99"):
        detector.set_frame(0, 99)


def test_a_page_needs_a_detector_and_a_speed():
    frame = lodestone.find_collisions(cube(), cube()).frame
    with pytest.raises(lodestone.BadArgument, match="only a frame of a Detector"):
        lodestone.page([frame])
    with pytest.raises(TypeError):
        lodestone.Page(None)
    for rate in (0, -1, float("nan"), float("inf")):
        with pytest.raises(lodestone.BadArgument, match="frames_per_second"):
            lodestone.Page(lodestone.Detector(), frames_per_second=rate)


def test_a_page_takes_only_frames_of_its_detector():
    detector, other = lodestone.Detector(), lodestone.Detector()
    for each, count in ((detector, 2), (other, 3)):
        for _ in range(count):
            each.add(cube())
    page = lodestone.Page(detector)
    with pytest.raises(lodestone.BadArgument, match="not one of the page's detector"):
        page.add(other.detect())
    with pytest.raises(lodestone.BadArgument, match="not one of the page's detector"):
        page.add(lodestone.find_collisions(cube(), cube()).frame)
    page.add(detector.detect())
    assert len(page) == 1


def test_a_page_refuses_a_frame_that_is_not_of_where_objects_are(scenes):
    kept = list(lodestone.play(scenes / "teapot_sphere_1.json", frames=range(108, 111)))
    with pytest.raises(lodestone.BadArgument, match="frame 1 was found before frame 3: add each frame before the next"):
        lodestone.page(kept)
    with pytest.raises(lodestone.BadArgument, match="frame 2 was found before frame 3"):
        kept[1].show()
    assert len(kept[2].show()) == 1
    detector = lodestone.Detector()
    ball = sphere(8)
    detector.add(cube()), detector.add(ball)
    moves = [
        lambda: detector.set_vertices(1, ball.vertices + 0.25),
        lambda: detector.place(0, np.eye(4)),
        lambda: detector.update(1),
        lambda: detector.rebuild(1, ball.vertices, ball.faces),
    ]
    for move in moves:
        frame = detector.detect()
        page = lodestone.Page(detector)
        page.add(frame)
        move()
        with pytest.raises(lodestone.BadArgument, match=f"frame {frame.number} was found before objects were moved"):
            page.add(frame)
        assert len(page) == 1
    kept[2].detector.set_frame(0, 7)
    with pytest.raises(lodestone.BadArgument, match="frame 3 was found before objects were moved"):
        kept[2].show()
    skin = lodestone.Skin(ball.vertices, np.zeros((len(ball.vertices), 1), int), np.ones((len(ball.vertices), 1)))
    moves = [
        lambda: detector.add(skin, ball.faces),
        lambda: skin.set_joints([np.eye(4)]),
    ]
    for move in moves:
        frame = detector.detect()
        move()
        with pytest.raises(lodestone.BadArgument, match="before objects were moved, added, removed or rebuilt"):
            frame.show()


def test_a_page_refuses_what_changed_after_the_frame():
    detector = lodestone.Detector()
    box, ball = cube(), sphere(8)
    detector.add(box), detector.add(ball)
    page, frame = lodestone.Page(detector), detector.detect()
    box.vertices[0, 0] = np.nan
    with pytest.raises(lodestone.BadMesh, match="finite"):
        frame.show()
    box.vertices[0, 0] = 0
    detector.rebuild(1, ball.vertices, ball.faces[:3])
    with pytest.raises(lodestone.BadArgument, match="removed or rebuilt"):
        frame.show()
    with pytest.raises(lodestone.BadArgument, match="begin another page"):
        page.add(detector.detect())
    frame = detector.detect()
    detector.remove(1)
    with pytest.raises(lodestone.BadArgument, match="removed or rebuilt"):
        frame.show()
    with pytest.raises(IndexError, match="there is no object 7"):
        lodestone.read_scene(root / "data" / "scenes" / "teapot_sphere_1.json").groups(7)


def write_moved_triangle(path, times, distances, names=("walk",)):
    """A triangle that each animation moves along x."""
    keys = np.array([[x, 0, 0] for x in distances], np.float32)
    blocks = [np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32), np.array(times, np.float32), keys]
    offsets = np.cumsum([0] + [block.nbytes for block in blocks])
    data = base64.b64encode(b"".join(block.tobytes() for block in blocks)).decode()
    path.write_text(json.dumps({
        "asset": {"version": "2.0"},
        "buffers": [{"uri": "data:application/octet-stream;base64," + data, "byteLength": int(offsets[-1])}],
        "bufferViews": [{"buffer": 0, "byteOffset": int(offset), "byteLength": block.nbytes}
                        for offset, block in zip(offsets, blocks)],
        "accessors": [{"bufferView": view, "componentType": 5126, "count": len(block), "type": kind,
                       "min": block.min(axis=0).reshape(-1).tolist(), "max": block.max(axis=0).reshape(-1).tolist()}
                      for view, (block, kind) in enumerate(zip(blocks, ("VEC3", "SCALAR", "VEC3")))],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}], "scene": 0,
        "animations": [{"name": name, "samplers": [{"input": 1, "output": 2}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}
                       for name in names]}))
    return path


def test_an_animation_of_one_key_is_chosen_at_any_rate(tmp_path):
    path = write_moved_triangle(tmp_path / "stands.gltf", [0], [2], ("first", "second"))
    for rate in (None, 30):
        assert lodestone.read_animation(path, animation="second", frames_per_second=rate).frames == 1
    lodestone.write_mesh(tmp_path / "still.glb", sphere(2))
    with pytest.raises(lodestone.BadArgument, match="the file has no animations"):
        lodestone.read_animation(tmp_path / "still.glb", animation=1)


def test_what_stands_still_does_not_change_the_rate_of_others(tmp_path):
    walk = write_moved_triangle(tmp_path / "walk.gltf", np.arange(25) / 24, np.arange(25))
    stand = write_moved_triangle(tmp_path / "stand.gltf", [0], [50])
    assert lodestone.read_scene([walk]).frames == 25
    assert lodestone.read_scene([walk, stand]).frames == 25
