# SPDX-License-Identifier: GPL-3.0-or-later
"""Threads: those of a call, and those of Python that use detectors at once."""

import subprocess
import sys
import threading

import numpy as np

import lodestone
from conftest import cube, sphere


def test_answers_do_not_depend_on_the_number_of_threads():
    found = []
    for threads in (1, 2, 5):
        detector = lodestone.Detector(threads=threads, contact_points=True, self_collision=True)
        for i in range(5):
            detector.add(sphere(24).moved(0.9 * i, 0.1 * i))
        frame = detector.detect()
        found.append((frame.faces.tobytes(), frame.points.tobytes()))
    assert found[0] == found[1] == found[2]


def test_python_threads_share_a_detector():
    detector = lodestone.Detector()
    ball = sphere(20)
    detector.add(ball), detector.add(sphere(20).moved(1.5))
    expected = detector.detect().faces
    problems = []

    def work():
        try:
            for i in range(50):
                if i % 5 == 0:
                    detector.set_vertices(0, ball.vertices.copy())
                if not np.array_equal(detector.detect().faces, expected):
                    problems.append("another answer")
                detector.visit(0, 1, lambda a, b: True)
        except Exception as error:  # pragma: no cover
            problems.append(error)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not problems


def test_the_global_lock_is_free_during_a_query():
    detector = lodestone.Detector(self_collision=True, contact_points=True)
    for i in range(6):
        detector.add(sphere(90).moved(0.3 * i))
    done = threading.Event()
    counted = []

    def count():
        n = 0
        while not done.is_set():
            n += 1
        counted.append(n)

    thread = threading.Thread(target=count)
    thread.start()
    before = detector.detect().number
    done.set()
    thread.join()
    assert before == 1 and counted[0] > 100


def test_a_page_can_be_saved_while_frames_are_added(tmp_path):
    detector = lodestone.Detector()
    detector.add(cube()), detector.add(cube().moved(0.5))
    page = lodestone.Page(detector)
    page.add(detector.detect())
    done = threading.Event()

    def save():
        while not done.is_set():
            page.save(tmp_path / "a.html")
            assert len(page) >= 1

    saver = threading.Thread(target=save)
    saver.start()
    for _ in range(300):
        page.add(detector.detect())
    done.set()
    saver.join()
    assert len(page) == 301


def test_a_deadlock_is_an_error():
    detectors = [lodestone.Detector(), lodestone.Detector()]
    for detector in detectors:
        detector.add(cube()), detector.add(cube().moved(0.5))
    both_inside = threading.Barrier(2)
    outcomes = []

    def ask(own, other):
        def visitor(*_):
            both_inside.wait(timeout=60)
            other.detect()
            return True

        try:
            own.visit(0, 1, visitor)
            outcomes.append("answered")
        except lodestone.BadArgument as error:
            assert "deadlock" in str(error)
            outcomes.append("refused")

    threads = [threading.Thread(target=ask, args=pair) for pair in (detectors, detectors[::-1])]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(timeout=60)
    assert sorted(outcomes) == ["answered", "refused"]
    assert all(detector.detect().collides for detector in detectors)


def test_python_ends_while_a_thread_asks():
    code = """
import threading, time, numpy, lodestone
vertices, faces = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), numpy.array([[0, 1, 2]])
def ask():
    while True:
        lodestone.find_collisions((vertices, faces), (vertices, faces))
threading.Thread(target=ask, daemon=True).start()
time.sleep(0.2)
"""
    for _ in range(3):
        subprocess.run([sys.executable, "-c", code], check=True, timeout=60)


def test_python_ends_while_a_thread_waits_for_another():
    code = """
import threading, time, numpy, lodestone
vertices, faces = numpy.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]]), numpy.array([[0, 1, 2]])
detector, inside = lodestone.Detector(), threading.Event()
detector.add(vertices, faces), detector.add(vertices.copy(), faces)
def visitor(*_):
    inside.set()
    time.sleep(1000)
def ask():
    inside.wait()
    detector.detect()
threading.Thread(target=detector.visit, args=(0, 1, visitor), daemon=True).start()
threading.Thread(target=ask, daemon=True).start()
inside.wait()
time.sleep(0.2)
"""
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
