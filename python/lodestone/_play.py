# SPDX-License-Identifier: GPL-3.0-or-later
"""Plays scenes."""

import operator

from ._lodestone import BadArgument, Detector, Scene, read_scene


def play(
    scene,
    *,
    frames=None,
    components=False,
    parts=False,
    allow_outside=False,
    max_faces=50_000_000,
    max_bytes=1 << 34,
    max_frames=1_000_000,
    max_objects=10_000,
    max_scene_faces=500_000_000,
    **options,
):
    """Plays a scene: yields a Frame per frame of the scene.

    scene: a Scene, or a path or paths as of `read_scene`. frames: which of its frames, such as range(10, 20), where -1
    is the last; None: all.
    components, parts, allow_outside and the limits max_faces, max_bytes, max_frames, max_objects and max_scene_faces
    are those of `read_scene`, and of no meaning for a Scene. Other options are those of Detector; `particles` counts
    for every object, whatever the scene says of it.
    `frame.detector` is the detector; its objects are those of the scene, in order.
    """
    if isinstance(scene, Scene):
        if components or parts:
            raise BadArgument("components and parts are of no meaning for a Scene: give them to read_scene")
    else:
        scene = read_scene(
            scene,
            components=components,
            parts=parts,
            allow_outside=allow_outside,
            max_faces=max_faces,
            max_bytes=max_bytes,
            max_frames=max_frames,
            max_objects=max_objects,
            max_scene_faces=max_scene_faces,
        )
    try:
        detector = Detector(**options)
    except TypeError as error:
        own = "frames, components, parts, allow_outside, max_faces, max_bytes, max_frames, max_objects, max_scene_faces"
        raise TypeError(f"{error}; play has {own} too") from None
    for number, animation in enumerate(scene.objects):
        own = scene.options(number)
        if options.get("particles"):
            del own["particles"]
        detector.add(animation, **own)
    for a, b in scene.ignored:
        detector.ignore(a, b)
    for given in range(scene.frames) if frames is None else frames:
        number = operator.index(given)
        if not -scene.frames <= number < scene.frames:
            raise BadArgument(f"there is no frame {number}: there are {scene.frames}")
        for animation in range(len(scene.objects)):
            detector.set_frame(animation, number)
        yield detector.detect()
