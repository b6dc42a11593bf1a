# SPDX-License-Identifier: GPL-3.0-or-later
"""Collision detection for triangle meshes that deform.

    import lodestone

    pair = lodestone.find_collisions((vertices_a, faces_a), mesh_b)   # misses nothing
    pair.collides, pair.faces

    detector = lodestone.Detector(contact_points=True)
    cloth = detector.add(vertices, faces, name="cloth")
    ball = detector.add(ball_mesh)                  # anything with .vertices and .faces
    for vertices in simulation:
        detector.set_vertices(cloth, vertices)
        frame = detector.detect()
        print(frame.collides, frame.faces)

Meshes are arrays: vertices (V, 3) of float64 or float32, faces (F, 3) of integers. Errors are subclasses of `Error`,
with the words of the library.
"""

from ._lodestone import (
    Animation,
    BadArgument,
    BadMesh,
    BadMotion,
    BadOutput,
    BadSavedObject,
    BadScene,
    BoxPromise,
    BrokenBound,
    Detector,
    DisplacementPromise,
    Error,
    Frame,
    LipschitzPromise,
    Pair,
    Partition,
    Scene,
    Skin,
    StretchPromise,
    __version__,
    closest,
    contains,
    find_collisions,
    first_impact,
    first_self_impact,
    partition,
    read_animation,
    read_mesh,
    read_scene,
    self_collisions,
    strategies,
    within,
    write_animation,
    write_mesh,
)
from ._page import Page, page
from ._play import play

__all__ = [
    "Animation", "BadArgument", "BadMesh", "BadMotion", "BadOutput", "BadSavedObject", "BadScene", "BoxPromise",
    "BrokenBound", "Detector", "DisplacementPromise", "Error", "Frame", "LipschitzPromise", "Page", "Pair", "Partition",
    "Scene", "Skin", "StretchPromise", "__version__", "closest", "contains", "find_collisions", "first_impact",
    "first_self_impact", "page", "partition", "play", "read_animation", "read_mesh", "read_scene", "self_collisions",
    "strategies", "within", "write_animation", "write_mesh",
]

# Messages and help name what users import, not where it is compiled.
for _name in __all__:
    if hasattr(globals()[_name], "__module__"):
        globals()[_name].__module__ = "lodestone"
del _name
