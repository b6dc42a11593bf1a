# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames, pairs and partitions that are pickled, copied or sent from another process."""

import copy
import multiprocessing
import pickle

import numpy as np
import pytest

import lodestone
from conftest import cube, sphere

ARRAYS = ["faces", "intersects", "points", "segments", "normals", "depths"]


def detectors():
    """Detectors with different options, and the same three objects."""
    for options in [{}, {"mode": "particles", "list_candidates": True}, {"contacts": "yes_no"},
                    {"contact_points": True, "tolerance": 0.05}, {"contact_normals": True, "most_contacts": 3},
                    {"contact_points": True, "contact_normals": True, "patches": True, "parting": True,
                     "self_collision": True}]:
        detector = lodestone.Detector(**options)
        for mesh in (sphere(8), sphere(6, 0.5).moved(1), cube().moved(5)):
            detector.add(mesh)
        yield detector


def assert_same(one, other, names):
    for name in names:
        assert np.array_equal(getattr(one, name), getattr(other, name)), name


def assert_same_patches(one, other):
    assert len(one) == len(other)
    for mine, yours in zip(one, other):
        assert mine.keys() == yours.keys()
        assert all(np.array_equal(mine[key], yours[key]) for key in mine)


def assert_same_pairs(one, other):
    assert_same(one, other, ARRAYS + ["a", "b", "collides", "near", "capped", "unfinished", "containment", "parting"])
    assert_same_patches(one.patches, other.patches)


def assert_same_frames(one, other):
    assert_same(one, other, ARRAYS + ["number", "collides", "near", "capped", "unfinished", "candidates", "statistics"])
    if one.points is not None:
        for contact in range(len(one.faces)):
            assert np.array_equal(one.outline(contact), other.outline(contact))
    assert len(one.pairs) == len(other.pairs)
    for mine, yours in zip(one.pairs, other.pairs):
        assert_same_pairs(mine, yours)


PROTOCOLS = range(pickle.HIGHEST_PROTOCOL + 1)
AGAIN = [lambda x, p=p: pickle.loads(pickle.dumps(x, protocol=p)) for p in PROTOCOLS] + [copy.copy, copy.deepcopy]


@pytest.mark.parametrize("again", AGAIN)
def test_frames_keep_everything_but_their_detector(again):
    contacts = patches = candidates = 0
    for detector in detectors():
        frame = detector.detect()
        made = again(frame)
        assert_same_frames(frame, made)
        assert frame.detector is detector and made.detector is None
        contacts += len(frame.faces)
        patches += sum(len(pair.patches) for pair in frame.pairs)
        candidates += len(frame.candidates)
    assert contacts > 100 and patches > 0 and candidates > 0


@pytest.mark.parametrize("again", AGAIN)
def test_pairs_bring_their_frame(again):
    for detector in detectors():
        for pair in detector.detect().pairs:
            made = again(pair)
            assert_same_pairs(made, pair)
            assert_same_frames(made.frame, pair.frame)
    far = lodestone.find_collisions(cube(), cube().moved(9))
    assert not pickle.loads(pickle.dumps(far)) and len(pickle.loads(pickle.dumps(far)).faces) == 0


def test_partitions_are_the_same():
    partition = lodestone.partition(sphere(8), regions=5)
    made = pickle.loads(pickle.dumps(partition))
    assert_same(partition, made, ["labels", "regions", "particles", "strategy", "measures"])
    assert repr(partition) == repr(made)


@pytest.mark.parametrize("protocol", PROTOCOLS)
def test_what_cannot_be_pickled_says_so(protocol):
    for made in (lodestone.Detector(), lodestone.DisplacementPromise(), lodestone.StretchPromise(2)):
        with pytest.raises(TypeError, match="cannot pickle|not picklable"):
            pickle.dumps(made, protocol=protocol)
        with pytest.raises(TypeError, match="cannot pickle|not picklable"):
            made.__reduce__()


def find(shift):
    return lodestone.find_collisions(cube(), cube().moved(*shift), contact_points=True)


def test_other_processes_send_pairs_back():
    shifts = [(0.5, 0.25, 0.125), (3.0, 0.0, 0.0), (0.1, 0.2, 0.3)]
    with multiprocessing.get_context("spawn").Pool(2) as pool:
        for pair, shift in zip(pool.map(find, shifts), shifts):
            assert_same(pair, find(shift), ARRAYS + ["collides"])


def test_bytes_of_something_else_are_refused():
    *_, detector = detectors()
    frame, partition = detector.detect(), lodestone.partition(cube(), regions=2)
    for whole, other, name in [(frame, partition, "frame"), (partition, frame, "partition")]:
        for state in (b"", b"pickled", whole.__getstate__()[:-1], whole.__getstate__() + b"x", other.__getstate__()):
            made = type(whole).__new__(type(whole))
            with pytest.raises(lodestone.BadSavedObject, match=f"no pickled {name}, or of another format"):
                made.__setstate__(state)
    for state in ((), (frame, 0), (1, 0, 1), (frame, "a", 1)):
        made = lodestone.Pair.__new__(lodestone.Pair)
        with pytest.raises(lodestone.BadSavedObject, match="no pickled pair"):
            made.__setstate__(state)


def test_broken_bytes_are_refused_or_are_a_frame():
    """Whatever stands in one byte, nothing is read beyond the lists."""
    detector = lodestone.Detector(contact_points=True, contact_normals=True, patches=True)
    detector.add(cube())
    detector.add(cube().moved(0.5, 0.25, 0.125))
    state = detector.detect().__getstate__()
    refused = 0
    for place in range(len(state)):
        for byte in (0x00, 0x7f, 0xff):
            made = lodestone.Frame.__new__(lodestone.Frame)
            try:
                made.__setstate__(state[:place] + bytes([byte]) + state[place + 1:])
            except lodestone.BadSavedObject:
                refused += 1
                continue
            for name in ARRAYS + ["candidates", "statistics"]:
                getattr(made, name)
            for pair in made.pairs:
                _ = pair.faces, pair.points, pair.patches, pair.parting
    assert refused > 50
