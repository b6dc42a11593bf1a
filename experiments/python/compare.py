# SPDX-License-Identifier: GPL-3.0-or-later
"""What the Python package costs beside C++: the same calls in one process, in turns. Prints a table.

    scripts/build release lodestone_python lodestone_baseline
    PYTHONPATH=build/release/python:build/release/experiments/python /usr/bin/python3 experiments/python/compare.py
"""

import argparse
import statistics
import time

import numpy as np

import lodestone
from lodestone_baseline import Baseline


def sphere(triangles):
    """A sphere of about so many triangles: vertices and faces."""
    rings = max(3, round(np.sqrt(triangles / 4)))
    sectors = 2 * rings
    polar = np.pi * np.arange(1, rings)[:, None] / rings
    azimuth = 2 * np.pi * np.arange(sectors)[None, :] / sectors
    around = np.stack([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth),
                       np.cos(polar) + 0 * azimuth], axis=-1).reshape(-1, 3)
    vertices = np.concatenate([[[0, 0, 1.0]], around, [[0, 0, -1.0]]])
    i, j = np.meshgrid(np.arange(rings - 2), np.arange(sectors), indexing="ij")
    next_j = (j + 1) % sectors
    a, b, c, d = (1 + r * sectors + s for r, s in ((i, j), (i + 1, j), (i + 1, next_j), (i, next_j)))
    middle = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    s = np.arange(sectors)
    last, below = len(vertices) - 1, 1 + (rings - 2) * sectors
    top = np.stack([0 * s, 1 + s, 1 + (s + 1) % sectors], -1)
    bottom = np.stack([below + s, 0 * s + last, below + (s + 1) % sectors], -1)
    return vertices, np.concatenate([top, middle, bottom])


def wobbling(vertices, frames):
    """Poses of a sphere that wobbles and comes nearer."""
    poses = []
    for frame in range(frames):
        phase = 2 * np.pi * frame / frames
        swell = 1 + 0.05 * np.sin(5 * vertices[:, :1] + phase) * np.cos(4 * vertices[:, 1:2])
        poses.append(np.ascontiguousarray(vertices * swell + [1.95 - 0.5 * frame / frames, 0.1, 0]))
    return poses


def measured(call):
    start = time.perf_counter()
    call()
    return time.perf_counter() - start


def compare_frames(vertices, faces, poses, contacts, rounds, dtype):
    """Median seconds per frame: C++, Python, and the median of the ratios of a frame."""
    baseline = Baseline(contacts == "yes_no")
    baseline.add(poses[0], faces)
    baseline.add(vertices, faces)
    baseline.build()
    moving, still = poses[0].astype(dtype), vertices.astype(dtype)
    detector = lodestone.Detector(contacts=contacts)
    detector.add(moving, faces)
    detector.add(still, faces)
    detector.detect()
    in_cpp, in_python = [], []
    for turn in range(rounds):
        for number, pose in enumerate(poses):
            given = pose.astype(dtype, copy=False)

            found = []

            def frame():
                np.copyto(moving, given)
                found.append(detector.detect().faces)

            calls = [lambda: in_cpp.append(baseline.frame(pose)), lambda: in_python.append(measured(frame))]
            for call in calls if (turn + number) % 2 else reversed(calls):
                call()
            if contacts == "all" and dtype == np.float64:
                assert len(found[0]) == baseline.contacts
    ratio = statistics.median(p / c for p, c in zip(in_python, in_cpp))
    return statistics.median(in_cpp), statistics.median(in_python), ratio


def compare_building(vertices, faces, poses, rounds):
    """The same for adding two meshes and the first answer. Times are of whole builds."""
    baseline = Baseline(True)
    baseline.add(poses[0], faces)
    baseline.add(vertices, faces)
    in_cpp, in_python = [], []

    def build():
        detector = lodestone.Detector(contacts="yes_no")
        detector.add(poses[0], faces)
        detector.add(vertices, faces)
        return detector.detect().collides

    for turn in range(rounds):
        calls = [lambda: in_cpp.append(baseline.build()), lambda: in_python.append(measured(build))]
        for call in calls if turn % 2 else reversed(calls):
            call()
    ratio = statistics.median(p / c for p, c in zip(in_python, in_cpp))
    return statistics.median(in_cpp), statistics.median(in_python), ratio


def main():
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--triangles", type=int, nargs="+", default=[5_000, 50_000, 500_000])
    arguments.add_argument("--frames", type=int, default=20)
    arguments.add_argument("--rounds", type=int, default=10)
    given = arguments.parse_args()
    print("| triangles each | what | C++ (ms) | Python (ms) | Python / C++ |")
    print("| ---: | --- | ---: | ---: | ---: |")
    for triangles in given.triangles:
        vertices, faces = sphere(triangles)
        poses = wobbling(vertices, given.frames)
        rows = [("update + yes/no", compare_frames(vertices, faces, poses, "yes_no", given.rounds, np.float64)),
                ("update + all pairs", compare_frames(vertices, faces, poses, "all", given.rounds, np.float64)),
                ("update + yes/no, float32", compare_frames(vertices, faces, poses, "yes_no", given.rounds, np.float32)),
                ("build + first yes/no", compare_building(vertices, faces, poses, given.rounds))]
        for what, (cpp, python, ratio) in rows:
            print(f"| {len(faces)} | {what} | {1e3 * cpp:.3g} | {1e3 * python:.3g} | {ratio:.2f} |", flush=True)


if __name__ == "__main__":
    main()
