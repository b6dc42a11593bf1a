# SPDX-License-Identifier: GPL-3.0-or-later
"""What the class Detector refuses: bad meshes, numbers and options, and that the message says what is wrong."""

import decimal

import numpy as np
import pytest

import lodestone
from conftest import cube, sphere


class Stubborn:
    faces = cube().faces

    @property
    def vertices(self):
        raise KeyboardInterrupt


class Unreadable:
    def __array__(self, *_):
        raise MemoryError


def test_what_a_property_raises_passes_through():
    with pytest.raises(KeyboardInterrupt):
        lodestone.Detector().add(Stubborn())
    with pytest.raises(MemoryError):
        lodestone.Detector().add(Unreadable(), cube().faces)
    with pytest.raises(lodestone.BadArgument, match="vertices and faces"):
        lodestone.Detector().add(object())


@pytest.mark.parametrize("mode", ["exact", "certified", "particles", "senin"])
def test_a_vertex_that_is_no_number_is_an_error(mode):
    detector = lodestone.Detector(mode=mode)
    bad = cube()
    bad.vertices[3, 1] = np.nan
    detector.add(bad, name="broken box"), detector.add(sphere())
    with pytest.raises(lodestone.BadMesh, match="finite"):
        detector.detect()
    bad.vertices[3, 1] = 1
    detector.detect()


@pytest.mark.parametrize("arguments, error, text", [
    (dict(mode="fast"), lodestone.BadArgument, "mode must be one of exact, certified, particles, senin, but is 'fast'"),
    (dict(tolerence=1), TypeError, "there is no option tolerence"),
    (dict(threads=-1), TypeError, "threads must be an integer >= 0, but is -1"),
    (dict(threads=1.5), TypeError, "threads must be"),
    (dict(threads=True), TypeError, "threads must be"),
    (dict(most_contacts=np.float32(2.5)), TypeError, "most_contacts must be an integer >= 0, but is 2.5"),
    (dict(tolerance="1"), TypeError, "tolerance must be a number"),
    (dict(tolerance=-1), lodestone.BadArgument, "tolerance"),
    (dict(self_collision=2), TypeError, "self_collision must be True or False"),
    (dict(strategy="voronoy"), lodestone.BadArgument, "voronoy"),
    (dict(self_tolerance=0.1), lodestone.BadArgument, "self_tolerance needs self_collision=True"),
    (dict(mode="particles", tolerance=1.0), lodestone.BadArgument, "exact"),
    (dict(contacts="first", most_contacts=5), lodestone.BadArgument, "most_contacts needs contacts='all'"),
    (dict(mode="particles", meetings=0, opening_budget=5), lodestone.BadArgument, "opening_budget has no effect"),
    (dict(mode="particles", meetings=0, opening_reach=0.5), lodestone.BadArgument, "opening_reach has no effect"),
])
def test_options_are_checked(arguments, error, text):
    with pytest.raises(error, match=text):
        lodestone.Detector(**arguments)


def test_a_distance_within_one_object_needs_a_detector_that_knows_it_at_rest():
    with pytest.raises(lodestone.BadArgument, match="use a Detector"):
        lodestone.self_collisions(sphere(), self_tolerance=0.1, self_collision=True)
    with pytest.raises(lodestone.BadArgument, match="self_tolerance"):
        lodestone.self_collisions(sphere(), self_tolerance=0.1)


def test_numbers_of_objects_and_frames_are_integers(tmp_path):
    detector = lodestone.Detector()
    ball = detector.add(sphere())
    with pytest.raises(TypeError):
        detector.vertices(np.float32(0.9))
    with pytest.raises(TypeError):
        detector.add(sphere(), particles=np.float32(2.5))
    with pytest.raises(TypeError):
        lodestone.partition(sphere(), regions=decimal.Decimal("2.5"))
    lodestone.write_animation(tmp_path / "still.pc2", [sphere().vertices] * 2)
    animation = lodestone.read_animation(tmp_path / "still.pc2")
    with pytest.raises(TypeError):
        animation.pose(np.float32(0.9))
    assert len(detector.vertices(np.uint8(ball))) == len(sphere().vertices)
    assert lodestone.partition(sphere(), regions=np.int64(3)).labels.max() == 2


@pytest.mark.parametrize("vertices, faces, text", [
    (cube().vertices[:, :2], cube().faces, r"vertices must have the shape \(V, 3\), but have \(8, 2\)"),
    (cube().vertices, cube().faces.ravel(), r"faces must have the shape \(F, 3\), but have \(36,\)"),
    (cube().vertices, cube().faces + 0.5, "faces must be an array of integers"),
    (cube().vertices, cube().faces - 1, "face 0 refers to vertex -1"),
    (cube().vertices, cube().faces + 1, "face [0-9]+ refers to vertex 8 of 8"),
    (cube().vertices, [[0, 1, 2**32]], "face 0 refers to vertex 4294967296"),
    (cube().vertices, np.zeros((0, 3), int), "no face"),
    (cube().vertices, [], "no face"),
    (np.zeros((0, 3)), [[0, 1, 2]], "face 0 refers to vertex 2 of 0"),
    (cube().vertices + 1j, cube().faces, "vertices must be an array of numbers"),
    ("vertices", "faces", "must be an array"),
    ([[1, 2, 3], [4, 5]], cube().faces, "vertices must be"),
    (None, cube().faces, "vertices must be"),
])
@pytest.mark.filterwarnings("ignore::numpy.VisibleDeprecationWarning")
def test_bad_meshes_are_refused(vertices, faces, text):
    detector = lodestone.Detector()
    with pytest.raises(lodestone.BadMesh, match=text):
        detector.add(vertices, faces)
    assert len(detector) == 0


def test_something_without_faces_is_refused():
    with pytest.raises(lodestone.BadArgument, match="vertices and faces"):
        lodestone.Detector().add(cube().vertices)


def test_errors_are_python_errors_too():
    assert issubclass(lodestone.BadMesh, lodestone.Error) and issubclass(lodestone.BadMesh, ValueError)
    assert lodestone.BadMesh.__module__ == "lodestone" and lodestone.Detector.__module__ == "lodestone"


CLASSES = [type_ for type_ in vars(lodestone).values() if isinstance(type_, type) and not issubclass(type_, Exception)]


@pytest.mark.parametrize("type_", CLASSES, ids=lambda type_: type_.__name__)
def test_objects_without_init_are_refused(type_):
    bare = type_.__new__(type_)
    detector = lodestone.Detector(mode="certified")
    detector.add(cube())
    for name in [name for name, value in vars(type_).items() if isinstance(value, property)]:
        with pytest.raises((TypeError, RuntimeError), match="initialised|non-held"):
            getattr(bare, name)
    calls = [repr, len, bool, lambda made: detector.promise(0, made)]
    calls += [lambda made, name=name: getattr(made, name)() for name in vars(type_) if not name.startswith("__")]
    refused = 0
    for call in calls:
        try:
            call(bare)
        except (TypeError, RuntimeError) as error:
            refused += "initialised" in str(error) or "non-held" in str(error)
    assert refused > 0


def test_a_class_below_detector_calls_its_init_first():
    class Mine(lodestone.Detector):
        def __init__(self):
            self.floor = self.add(cube())
            super().__init__()

    with pytest.raises(TypeError, match="__init__"):
        Mine()
