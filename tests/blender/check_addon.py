# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of the add-on python/blender/lodestone_check.py, in scenes whose colliding frames and faces are known.

Runs inside Blender: scripts/integrations/blender. The last argument is a folder for what is exported.
"""

import math
import pathlib
import sys

import bpy

root = pathlib.Path(__file__).parents[2]
sys.path.insert(0, str(root / "python" / "blender"))

import lodestone_check  # noqa: E402

import lodestone  # noqa: E402


def empty_scene(last_frame):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, last_frame
    scene.frame_set(1)
    return scene


def add_cube(name, x, y=0.0, z=0.0):
    """A cube with edges of length 2 around a point."""
    bpy.ops.mesh.primitive_cube_add(location=(x, y, z))
    bpy.context.object.name = name
    return bpy.context.object


def move_linearly(data):
    for curve in data.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def push_by_shape_key(cube, x, last_frame):
    """Moves all vertices by x from frame 1 to the last, the same way in each frame."""
    cube.shape_key_add(name="Basis")
    key = cube.shape_key_add(name="push")
    for point in key.data:
        point.co.x += x
    for frame, value in ((1, 0.0), (last_frame, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    move_linearly(cube.data.shape_keys)


def select_only(*objects):
    bpy.ops.object.select_all(action="DESELECT")
    for each in objects:
        each.select_set(True)


def lines():
    return bpy.data.texts[lodestone_check.TEXT].as_string().splitlines()


def colliding_frames():
    return sorted({int(line.split()[1].rstrip(":")) for line in lines()[1:]})


def markers(scene):
    return sorted(m.frame for m in scene.timeline_markers if m.name == lodestone_check.MARKER)


def normals_of_selected(mesh_object):
    return sorted(tuple(round(c) for c in p.normal) for p in mesh_object.data.polygons if p.select)


def equal(found, expected):
    if found != expected:
        raise AssertionError(f"found {found}, expected {expected}")


def approaching_cubes():
    """The right cube spans [x - 1, x + 1], x = 10.5 in frame 1 and one less per frame. It meets [-1, 1] in frames 10, 11."""
    scene = empty_scene(11)
    left, right = add_cube("Left", 0), add_cube("Right", 10.5, 0.3, 0.3)
    push_by_shape_key(right, -10, 11)
    select_only(left, right)
    return scene, left, right


def test_two_cubes_collide_in_the_frames_where_they_meet():
    scene, left, right = approaching_cubes()
    scene.frame_set(10)
    equal(bpy.ops.lodestone.check(), {"FINISHED"})
    equal(colliding_frames(), [10, 11])
    equal(markers(scene), [10])
    equal(scene.lodestone.result, "Collisions in 2 of 11 frames: 10-11")
    equal(scene.frame_current, 10)
    # In frame 10 the corner (0.5, -0.7, -0.7) of the right cube is inside the left one.
    equal(normals_of_selected(left), [(0, 0, 1), (0, 1, 0), (1, 0, 0)])
    equal(normals_of_selected(right), [(-1, 0, 0), (0, -1, 0), (0, 0, -1)])
    equal([a.name for a in left.data.attributes if a.name == lodestone_check.FACE_ATTRIBUTE], [])


def test_the_current_frame_is_checked_alone():
    scene, left, right = approaching_cubes()
    scene.frame_set(11)
    equal(bpy.ops.lodestone.check_frame(), {"FINISHED"})
    equal(len(normals_of_selected(left)), 3)
    scene.frame_set(5)
    equal(bpy.ops.lodestone.check_frame(), {"FINISHED"})
    equal(normals_of_selected(left) + normals_of_selected(right), [])


def test_cubes_nearer_than_the_distance_are_found():
    scene, left, right = approaching_cubes()
    scene.lodestone.distance = 0.6  # in frame 9 they are 0.5 apart, in frame 8 1.5
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [9, 10, 11])


def test_only_selected_or_all_visible_meshes_are_checked():
    scene, left, right = approaching_cubes()
    select_only(left)
    bpy.ops.lodestone.check()
    equal(scene.lodestone.result, "No collision in 11 frames")
    scene.lodestone.objects = "VISIBLE"
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [10, 11])
    right.hide_set(True)
    bpy.ops.lodestone.check()
    equal((colliding_frames(), markers(scene)), ([], []))


def test_faces_below_a_subdivision_are_those_of_the_mesh_itself():
    scene, left, right = approaching_cubes()
    for each in (left, right):
        modifier = each.modifiers.new("Subdivision", "SUBSURF")
        modifier.subdivision_type, modifier.levels = "SIMPLE", 2
    scene.frame_set(10)
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [10, 11])
    equal(normals_of_selected(left), [(0, 0, 1), (0, 1, 0), (1, 0, 0)])
    equal(normals_of_selected(right), [(-1, 0, 0), (0, -1, 0), (0, 0, -1)])


def test_a_bending_strip_meets_itself_when_it_is_a_full_circle():
    """It is bent by 50 degrees more in each frame: 350 in frame 8, 400 in frame 9, 450 in frame 10."""
    scene = empty_scene(10)
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=2, size=2)
    strip = bpy.context.object
    for vertex in strip.data.vertices:
        vertex.co.x *= 10
    bend = strip.modifiers.new("Bend", "SIMPLE_DEFORM")
    bend.deform_method, bend.deform_axis = "BEND", "Z"
    for frame, degrees in ((1, 0), (10, 450)):
        bend.angle = math.radians(degrees)
        bend.keyframe_insert("angle", frame=frame)
    move_linearly(strip)
    select_only(strip)
    scene.frame_set(9)
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [9, 10])
    # In frame 9 the last 40 of 400 degrees lie on the first 40: a tenth of the strip at each end.
    chosen = sorted(p.center.x for p in strip.data.polygons if p.select)
    assert chosen and all(abs(x) > 7.5 for x in chosen) and chosen[0] < 0 < chosen[-1], chosen
    scene.lodestone.self_collisions = False
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [])


def test_faces_may_appear_and_vanish():
    """The left cube is built face by face: none in frame 1, one more per frame, all six in frame 7."""
    scene = empty_scene(8)
    left, right = add_cube("Left", 0), add_cube("Right", 0.5, 0.3, 0.3)
    build = left.modifiers.new("Build", "BUILD")
    build.frame_start, build.frame_duration = 1, 6
    select_only(left, right)
    counts = []
    for frame in range(1, 9):
        scene.frame_set(frame)
        counts.append(len(left.evaluated_get(bpy.context.evaluated_depsgraph_get()).data.polygons))
    equal((counts[0], counts[-1]), (0, 6))
    bpy.ops.lodestone.check()
    equal(max(colliding_frames()), 8)
    expected = []
    for frame in range(1, 9):
        scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        surfaces = [lodestone_check.surface_of(o, depsgraph)[:2] for o in (left, right)]
        if len(surfaces[0][1]) and lodestone.find_collisions(*surfaces).collides:
            expected.append(frame)
    equal(colliding_frames(), expected)


def test_faces_are_cut_anew_where_their_corners_move():
    """In frame 2 the second corner of a square is pushed inwards, beyond the place where the spike goes through."""
    scene = empty_scene(2)
    mesh = bpy.data.meshes.new("Square")
    mesh.from_pydata([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], [], [(0, 1, 2, 3)])
    square = bpy.data.objects.new("Square", mesh)
    scene.collection.objects.link(square)
    square.shape_key_add(name="Basis")
    key = square.shape_key_add(name="inwards")
    key.data[1].co = (0.5, 1.5, 0)
    for frame in (1, 2):
        key.value = frame - 1
        key.keyframe_insert("value", frame=frame)
    spike = add_cube("Spike", 0.8, 1.2)
    spike.scale = (0.05, 0.05, 1)
    select_only(square, spike)
    bpy.ops.lodestone.check()
    equal(colliding_frames(), [1])


def test_objects_are_where_rotation_and_scale_put_them():
    """A beam of half length 2, turned by 30 degrees, ends at (1.73, 1, 0)."""
    scene = empty_scene(1)
    beam, end, beside = add_cube("Beam", 0), add_cube("End", 1.7, 1), add_cube("Beside", 1.7, -1)
    beam.scale, beam.rotation_euler = (2, 0.1, 0.5), (0, 0, math.radians(30))
    end.scale = beside.scale = (0.2, 0.2, 0.2)
    select_only(beam, end, beside)
    bpy.ops.lodestone.check()
    equal([line.split(":")[1] for line in lines()[1:]], [" Beam with End"])


def test_faces_of_joined_geometry_are_not_taken_for_own_ones():
    """A Boolean joins a bar of the other checked object to the left cube; another joins one of an unchecked object."""
    scene, left, right = approaching_cubes()
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=12, y_subdivisions=12, size=1, location=(20, 0, 0))
    fine = bpy.context.object
    solid = fine.modifiers.new("Solid", "SOLIDIFY")
    solid.thickness = 1
    for operand in (fine, right):
        union = left.modifiers.new("Union", "BOOLEAN")
        union.operation, union.object = "UNION", operand
    for chosen in ((left, right), (left, right, fine)):
        select_only(*chosen)
        scene.frame_set(10)
        equal(bpy.ops.lodestone.check(), {"FINISHED"})
        assert 10 in colliding_frames(), lines()
        # What meets the right cube is that cube itself, joined: no face of the left cube's own far side.
        assert (-1, 0, 0) not in normals_of_selected(left), normals_of_selected(left)


def test_a_frame_with_broken_positions_keeps_what_was_found_before():
    scene, left, right = approaching_cubes()
    left.shape_key_add(name="Basis")
    key = left.shape_key_add(name="burst")
    for point in key.data:
        point.co.x = float("nan")
    for frame, value in ((10, 0.0), (11, 1.0)):
        key.value = value
        key.keyframe_insert("value", frame=frame)
    for curve in left.data.shape_keys.animation_data.action.fcurves:
        for point in curve.keyframe_points:
            point.interpolation = "CONSTANT"
    message = error_of(bpy.ops.lodestone.check)
    assert message.startswith("Frame 11: ") and "Collisions in 1 of 10 frames: 10" in message, message
    equal(colliding_frames(), [10])


def test_checking_the_current_frame_leaves_a_pose_without_keys():
    scene, left, right = approaching_cubes()
    scene.frame_set(5)
    right.data.shape_keys.key_blocks["push"].value = 1.0  # as in frame 11; not keyed
    bpy.ops.lodestone.check_frame()
    equal(len(normals_of_selected(left)), 3)
    equal(right.data.shape_keys.key_blocks["push"].value, 1.0)


def test_markers_of_an_earlier_check_go_with_the_option():
    scene, left, right = approaching_cubes()
    bpy.ops.lodestone.check()
    equal(markers(scene), [10])
    scene.lodestone.markers = False
    bpy.ops.lodestone.check()
    equal(markers(scene), [])


def test_messages_say_what_is_missing():
    scene, left, right = approaching_cubes()
    select_only()
    equal(error_of(bpy.ops.lodestone.check), "No mesh is selected")
    select_only(left)
    sys.modules["lodestone"] = None
    try:
        message = error_of(bpy.ops.lodestone.check)
    finally:
        sys.modules["lodestone"] = lodestone
    assert "The Python package lodestone cannot be imported" in message and "PYTHONPATH" in message, message


def error_of(operator):
    try:
        operator()
    except RuntimeError as error:
        return str(error).removeprefix("Error: ").strip()
    raise AssertionError("there was no error")


def bending_arm():
    """A tube around x from 0 to 8, of two bones that meet at 4. The second turns by 9 degrees per frame, up to 171 degrees
    in frame 20, and back."""
    scene = empty_scene(39)
    scene.render.fps = 30
    arm = bpy.data.objects.new("Arm", tube("Arm", length=8, radius=0.5, rings=49, sectors=24))
    scene.collection.objects.link(arm)
    bpy.ops.object.armature_add(location=(0, 0, 0))
    rig = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    upper = rig.data.edit_bones[0]
    upper.name, upper.head, upper.tail = "upper", (0, 0, 0), (4, 0, 0)
    fore = rig.data.edit_bones.new("fore")
    fore.head, fore.tail, fore.parent, fore.use_connect = (4, 0, 0), (8, 0, 0), upper, True
    bpy.ops.object.mode_set(mode="POSE")
    bone = rig.pose.bones["fore"]
    bone.rotation_mode = "XYZ"
    for frame, degrees in ((1, 0), (20, 171), (39, 0)):
        bone.rotation_euler = (math.radians(degrees), 0, 0)
        bone.keyframe_insert("rotation_euler", frame=frame)
    move_linearly(rig)
    bpy.ops.object.mode_set(mode="OBJECT")
    for name in ("upper", "fore"):
        group = arm.vertex_groups.new(name=name)
        for vertex in arm.data.vertices:
            share = min(max((vertex.co.x - 3.5) / 1.0, 0), 1)
            weight = share if name == "fore" else 1 - share
            if weight > 0:
                group.add([vertex.index], weight, "REPLACE")
    modifier = arm.modifiers.new("Armature", "ARMATURE")
    modifier.object = rig
    arm.parent = rig
    return scene, arm, rig


def tube(name, length, radius, rings, sectors):
    """A closed tube along x: quads, and a fan at each end."""
    points = [(length * i / (rings - 1), radius * math.cos(2 * math.pi * j / sectors),
               radius * math.sin(2 * math.pi * j / sectors)) for i in range(rings) for j in range(sectors)]
    at = lambda i, j: i * sectors + j % sectors
    faces = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for i in range(rings - 1) for j in range(sectors)]
    points += [(0, 0, 0), (length, 0, 0)]
    faces += [(len(points) - 2, at(0, j + 1), at(0, j)) for j in range(sectors)]
    faces += [(len(points) - 1, at(rings - 1, j), at(rings - 1, j + 1)) for j in range(sectors)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    return mesh


def test_an_exported_animation_gives_what_the_add_on_finds():
    scene, arm, rig = bending_arm()
    select_only(arm)
    bpy.ops.lodestone.check()
    folder = pathlib.Path(sys.argv[-1])
    path = folder / "arm.glb"
    select_only(arm, rig)
    bpy.ops.export_scene.gltf(filepath=str(path), use_selection=True, export_apply=False)
    animation = lodestone.read_animation(path)
    equal(animation.frames, 39)
    equal(colliding_frames_of(animation), colliding_frames())
    # Bent by less than a right angle it is free; bent by 171 degrees it is not; it moves back as it came.
    assert 20 in colliding_frames() and not set(colliding_frames()) & set(range(1, 10)), colliding_frames()
    equal(sorted(40 - frame for frame in colliding_frames()), colliding_frames())


def test_exported_point_caches_give_what_the_add_on_finds():
    scene, arm, rig = bending_arm()
    select_only(arm)
    bpy.context.view_layer.objects.active = arm
    bpy.ops.lodestone.check()
    expected = colliding_frames()
    folder = pathlib.Path(sys.argv[-1])
    scene.frame_set(1)
    bpy.ops.wm.obj_export(filepath=str(folder / "arm.obj"), export_selected_objects=True)
    for module in ("io_shape_mdd", "io_export_pc2"):
        bpy.ops.preferences.addon_enable(module=module)
    bpy.ops.export_shape.mdd(filepath=str(folder / "arm.mdd"), frame_start=1, frame_end=39, fps=30)
    bpy.ops.export_shape.pc2(filepath=str(folder / "arm.pc2"), range_start=1, range_end=39)
    for cache in ("arm.mdd", "arm.pc2"):
        animation = lodestone.read_animation(folder / cache, mesh=folder / "arm.obj")
        equal(colliding_frames_of(animation), expected)


def colliding_frames_of(animation):
    """Frames in which a file's only object intersects itself, counted from 1."""
    detector = lodestone.Detector(self_collision=True, contacts="yes_no")
    detector.add(animation)
    colliding = []
    for number in range(animation.frames):
        detector.set_frame(0, number)
        if detector.detect().collides:
            colliding.append(1 + number)
    return colliding


def main():
    tests = {name: value for name, value in globals().items() if name.startswith("test_")}
    for name, test in tests.items():
        lodestone_check.register()
        test()
        lodestone_check.unregister()
        print("passed:", name)
    print(f"{len(tests)} tests of the add-on passed")


main()
