# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender add-on: finds the frames of an animation in which meshes collide, and selects the faces that do.

It needs the Python package `lodestone` where Blender's Python finds it. Panel: 3D view, sidebar, tab Lodestone.
"""

import time

import bpy
import numpy as np

bl_info = {
    "name": "Lodestone: check for collisions",
    "description": "Finds the frames in which meshes intersect each other or themselves, and selects these faces",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View > Sidebar > Lodestone",
    "category": "Animation",
}

#: Face attribute that a check gives each mesh for its duration: a number for each of its own faces, which modifiers pass
#: on.
FACE_ATTRIBUTE = "lodestone_face"
#: Name of the text that lists what was found.
TEXT = "Lodestone"
#: Name of the timeline markers.
MARKER = "Lodestone: collision"
#: Seconds of work between two looks at the keyboard.
SLICE = 0.1


class Missing_package(Exception):
    """The package lodestone cannot be imported."""


def import_lodestone():
    try:
        import lodestone
    except ImportError as error:
        raise Missing_package(
            f"The Python package lodestone cannot be imported ({error}). Install it for Blender's Python, or start "
            "Blender with its folder in PYTHONPATH"
        ) from error
    return lodestone


def surface_of(mesh_object, depsgraph, first_label=None):
    """An object as modifiers, bones and shape keys leave it: world coordinates (V, 3), triangles (F, 3), and per
    triangle the face of the object's own mesh that it is of, -1 where that is unknown. first_label: as in own_faces."""
    evaluated = mesh_object.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        mesh.calc_loop_triangles()
        vertices = np.empty((len(mesh.vertices), 3), dtype=np.float32)
        triangles = np.empty((len(mesh.loop_triangles), 3), dtype=np.int32)
        polygon = np.empty(len(mesh.loop_triangles), dtype=np.int32)
        mesh.vertices.foreach_get("co", vertices.reshape(-1))
        mesh.loop_triangles.foreach_get("vertices", triangles.reshape(-1))
        mesh.loop_triangles.foreach_get("polygon_index", polygon)
        own_face = own_faces(mesh, len(mesh_object.data.polygons), first_label)[polygon]
    finally:
        evaluated.to_mesh_clear()
    world = np.array(evaluated.matrix_world)
    return vertices.astype(float) @ world[:3, :3].T + world[:3, 3], triangles, own_face


def own_faces(evaluated_mesh, own_count, first_label):
    """Per face of an evaluated mesh the face of the object's own mesh that it comes from, -1: unknown, or of another.

    first_label: the label of the first face of the object's own mesh; None: it has no labels. A modifier that joins
    other geometry brings in the labels of that, or 0.
    """
    count = len(evaluated_mesh.polygons)
    attribute = evaluated_mesh.attributes.get(FACE_ATTRIBUTE)
    labelled = attribute is not None and attribute.domain == "FACE" and len(attribute.data) == count
    if labelled and first_label is not None:
        faces = np.empty(count, dtype=np.int32)
        attribute.data.foreach_get("value", faces)
        faces -= first_label
        return np.where((faces >= 0) & (faces < own_count), faces, -1)
    return np.arange(count) if count == own_count else np.full(count, -1)


class Check:
    """Objects that are checked frame by frame."""

    def __init__(self, scene, mesh_objects, self_collisions, distance):
        self.scene = scene
        self.objects = list(mesh_objects)
        self.detector = import_lodestone().Detector(
            self_collision=self_collisions,
            tolerance=distance,
            self_tolerance=distance if self_collisions else 0,
        )
        self.ids = {}  # of the objects that have faces in the last frame
        self.vertex_count = {}
        self.triangles = {}
        self.own_face = {}
        self.hits = {}  # frame -> list of (object, object, number of face pairs)
        self.frame_before = scene.frame_current
        self.subframe_before = scene.frame_subframe
        self.first_label = {}  # per mesh
        self.label_faces()

    def label_faces(self):
        """Labels the faces of all meshes, each with a number of its own, from 1 on."""
        label = 1
        for mesh in {o.data for o in self.objects}:
            if not mesh.polygons:
                continue
            if FACE_ATTRIBUTE in mesh.attributes:  # left by a check that could not end
                mesh.attributes.remove(mesh.attributes[FACE_ATTRIBUTE])
            attribute = mesh.attributes.new(FACE_ATTRIBUTE, "INT", "FACE")
            attribute.data.foreach_set("value", np.arange(label, label + len(mesh.polygons), dtype=np.int32))
            self.first_label[mesh] = label
            label += len(mesh.polygons)

    def play(self, number):
        """Goes to a frame, and finds what collides there."""
        self.scene.frame_set(number)
        return self.look_at(number)

    def look_at(self, number):
        """Finds what collides in the frame that is shown: a list of (object, its faces, object, its faces)."""
        depsgraph = bpy.context.evaluated_depsgraph_get()
        for mesh_object in self.objects:
            self.move(mesh_object, *surface_of(mesh_object, depsgraph, self.first_label.get(mesh_object.data)))
        if not self.ids:
            return []
        objects = {i: mesh_object for mesh_object, i in self.ids.items()}
        found = []
        for pair in self.detector.detect().pairs:
            if len(pair.faces) > 0:
                a, b = objects[pair.a], objects[pair.b]
                found.append((a, self.own_face[a][pair.faces[:, 0]], b, self.own_face[b][pair.faces[:, 1]]))
        if found:
            self.hits[number] = [(a, b, len(faces)) for a, faces, b, _ in found]
        return found

    def move(self, mesh_object, vertices, triangles, own_face):
        """Gives the detector an object where it is now; modifiers may have changed its faces."""
        self.own_face[mesh_object] = own_face
        known = mesh_object in self.ids
        if len(triangles) == 0:
            if known:
                self.detector.remove(self.ids.pop(mesh_object))
            return
        if not known:
            self.ids[mesh_object] = self.detector.add(vertices, triangles, name=mesh_object.name)
        elif len(vertices) == self.vertex_count[mesh_object] and np.array_equal(triangles, self.triangles[mesh_object]):
            self.detector.set_vertices(self.ids[mesh_object], vertices)
        else:
            self.detector.rebuild(self.ids[mesh_object], vertices, triangles)
        self.vertex_count[mesh_object] = len(vertices)
        self.triangles[mesh_object] = triangles

    def select(self):
        """Goes back to the frame where the check began, and selects what collides there. If it is still there, poses
        that have no key stay as they are.
        """
        self.go_back()
        select_faces(self.objects, self.look_at(self.frame_before))

    def go_back(self):
        now = (self.scene.frame_current, self.scene.frame_subframe)
        if now != (self.frame_before, self.subframe_before):
            self.scene.frame_set(self.frame_before, subframe=self.subframe_before)

    def close(self):
        """Leaves scene and meshes as they were. May be called twice."""
        for mesh in self.first_label:
            mesh.attributes.remove(mesh.attributes[FACE_ATTRIBUTE])
        self.first_label = {}
        self.go_back()


def select_faces(objects, found):
    """Selects the faces that were found, and no others."""
    chosen = {o.data: np.zeros(len(o.data.polygons), dtype=bool) for o in objects}
    for a, faces_a, b, faces_b in found:
        chosen[a.data][faces_a[faces_a >= 0]] = True
        chosen[b.data][faces_b[faces_b >= 0]] = True
    for mesh, selected in chosen.items():
        mesh.vertices.foreach_set("select", np.zeros(len(mesh.vertices), dtype=bool))
        mesh.edges.foreach_set("select", np.zeros(len(mesh.edges), dtype=bool))
        mesh.polygons.foreach_set("select", selected)
        mesh.update()


def ranges_of(numbers):
    """As text: [3, 4, 5, 9] is '3-5, 9'."""
    runs = []
    for number in sorted(numbers):
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)


def write_text(hits, summary):
    text = bpy.data.texts.get(TEXT) or bpy.data.texts.new(TEXT)
    text.clear()
    lines = [summary]
    for number in sorted(hits):
        for a, b, count in hits[number]:
            other = "itself" if a == b else b.name
            lines.append(f"frame {number}: {a.name} with {other}: {count} pairs of triangles")
    text.write("\n".join(lines) + "\n")


def set_markers(scene, numbers):
    """One marker at the first frame of each run of colliding frames, in place of those of the last check."""
    for marker in [m for m in scene.timeline_markers if m.name == MARKER]:
        scene.timeline_markers.remove(marker)
    for number in sorted(numbers):
        if number - scene.frame_step not in numbers:
            scene.timeline_markers.new(MARKER, frame=number)


class Lodestone_settings(bpy.types.PropertyGroup):
    objects: bpy.props.EnumProperty(
        name="Objects",
        items=[("SELECTED", "Selected", "Selected meshes"), ("VISIBLE", "Visible", "All visible meshes")],
        default="SELECTED",
    )
    self_collisions: bpy.props.BoolProperty(
        name="Self-intersections", description="Also faces of one object that intersect", default=True
    )
    distance: bpy.props.FloatProperty(
        name="Distance",
        description="Also faces that are nearer to each other than this; of one object, only those that share no vertex "
        "and were at least twice this distance apart in the first frame that is checked",
        default=0,
        min=0,
        unit="LENGTH",
    )
    markers: bpy.props.BoolProperty(
        name="Markers", description="Mark where collisions begin in the timeline", default=True
    )
    result: bpy.props.StringProperty(name="Result")


def chosen_objects(context):
    objects = context.selected_objects if context.scene.lodestone.objects == "SELECTED" else context.visible_objects
    return [o for o in objects if o.type == "MESH"]


class Checking:
    """What both operators share."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.mode == "OBJECT"

    def begin(self, context):
        """Whether there is something to check, and something to check it with. If not, a message says why."""
        settings = context.scene.lodestone
        objects = chosen_objects(context)
        if not objects:
            self.report({"ERROR"}, f"No mesh is {settings.objects.lower()}")
            return False
        try:
            self.check = Check(context.scene, objects, settings.self_collisions, settings.distance)
        except Missing_package as error:
            self.report({"ERROR"}, str(error))
            return False
        return True

    def select(self, context):
        self.check.select()
        context.tool_settings.mesh_select_mode = (False, False, True)


class LODESTONE_OT_check_frame(Checking, bpy.types.Operator):
    """Selects the faces that collide in the current frame"""

    bl_idname = "lodestone.check_frame"
    bl_label = "Check This Frame"

    def execute(self, context):
        if not self.begin(context):
            return {"CANCELLED"}
        try:
            self.select(context)
        except import_lodestone().Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        finally:
            self.check.close()
        pairs = sum(count for _, _, count in self.check.hits.get(context.scene.frame_current, []))
        self.report({"INFO"}, f"{pairs} pairs of triangles collide" if pairs else "Nothing collides in this frame")
        return {"FINISHED"}


class LODESTONE_OT_check(Checking, bpy.types.Operator):
    """Checks all frames of the scene's range, then selects the faces that collide in the current frame"""

    bl_idname = "lodestone.check"
    bl_label = "Check Animation"

    def begin(self, context):
        if not super().begin(context):
            return False
        scene = context.scene
        self.frames = list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))
        self.done = 0
        self.failure = ""
        context.window_manager.progress_begin(0, len(self.frames))
        return True

    def step(self, context):
        """Checks the next frame.

        Returns whether others follow. A frame that cannot be checked, such as one with positions that are no numbers, ends
        the check, and what was found before is told.
        """
        if self.done == len(self.frames):
            return False
        number = self.frames[self.done]
        try:
            self.check.play(number)
        except import_lodestone().Error as error:
            self.failure = f"Frame {number}: {error}"
            return False
        self.done += 1
        context.window_manager.progress_update(self.done)
        return self.done < len(self.frames)

    def tell(self, context):
        """Selects faces, writes the text, sets the markers."""
        scene, hits = context.scene, dict(self.check.hits)
        try:
            self.select(context)
        except import_lodestone().Error as error:  # the frame that is selected may be the bad one
            self.failure = self.failure or f"Frame {self.check.frame_before}: {error}"
        part = "" if self.done == len(self.frames) else f"Stopped after {self.done} frames. "
        if self.failure:
            part = f"{self.failure}. {part}"
        if hits:
            summary = f"{part}Collisions in {len(hits)} of {self.done} frames: {ranges_of(hits)}"
        else:
            summary = f"{part}No collision in {self.done} frames"
        scene.lodestone.result = summary
        write_text(hits, summary)
        set_markers(scene, hits if scene.lodestone.markers else {})
        self.report({"ERROR" if self.failure else "INFO"}, summary)

    def close(self, context):
        context.window_manager.progress_end()
        self.check.close()

    def execute(self, context):
        if not self.begin(context):
            return {"CANCELLED"}
        try:
            while self.step(context):
                pass
            self.tell(context)
        finally:
            self.close(context)
        return {"FINISHED"}

    def invoke(self, context, event):
        if not self.begin(context):
            return {"CANCELLED"}
        self.timer = context.window_manager.event_timer_add(0.01, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        try:
            if event.type not in {"TIMER", "ESC"} or (event.type == "TIMER" and self.work(context)):
                return {"RUNNING_MODAL"}
            self.tell(context)
        except Exception:
            self.cancel(context)
            raise
        self.cancel(context)
        return {"FINISHED"}

    def work(self, context):
        """Checks frames for a moment. Returns whether others follow."""
        until = time.monotonic() + SLICE
        goes_on = self.step(context)
        while goes_on and time.monotonic() < until:
            goes_on = self.step(context)
        context.workspace.status_text_set(f"Checked {self.done} of {len(self.frames)} frames. Esc: stop")
        return goes_on

    def cancel(self, context):
        """Ends the modal run; Blender calls it too, when it quits."""
        context.window_manager.event_timer_remove(self.timer)
        context.workspace.status_text_set(None)
        self.close(context)


class LODESTONE_PT_panel(bpy.types.Panel):
    bl_label = "Lodestone"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Lodestone"

    def draw(self, context):
        settings = context.scene.lodestone
        column = self.layout.column()
        for name in ("objects", "distance", "self_collisions", "markers"):
            column.prop(settings, name)
        self.layout.operator("lodestone.check")
        self.layout.operator("lodestone.check_frame")
        if settings.result:
            column = self.layout.column(align=True)
            for line in settings.result.replace(". ", ".\n").replace(": ", ":\n").split("\n"):
                column.label(text=line)
            column.label(text=f"All pairs: text '{TEXT}'")


classes = (Lodestone_settings, LODESTONE_OT_check_frame, LODESTONE_OT_check, LODESTONE_PT_panel)


def register():
    for each in classes:
        bpy.utils.register_class(each)
    bpy.types.Scene.lodestone = bpy.props.PointerProperty(type=Lodestone_settings)


def unregister():
    del bpy.types.Scene.lodestone
    for each in reversed(classes):
        bpy.utils.unregister_class(each)


if __name__ == "__main__":
    register()
