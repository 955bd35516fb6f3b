"""Shared by the tests of the Python package."""

import os
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    print("skipped: no numpy (package python3-numpy)")
    sys.exit(0)

PROGRAM = os.environ["POINTHAPTICS_PROGRAM"]


def run_program(*arguments):
    """Runs the program; returns what it prints."""
    done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"pointhaptics {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout


def bits(array):
    """The bytes of an array as integers: equal only where every bit is."""
    array = np.ascontiguousarray(array)
    return array.view(np.uint8).reshape(len(array), -1)


class TestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def assert_same_bits(self, left, right):
        self.assertEqual((left.shape, left.dtype), (right.shape, right.dtype))
        np.testing.assert_array_equal(bits(left), bits(right))

    def assert_raises(self, kind, words, function, *arguments, **named):
        """The exception is of this kind and its message holds each of the words in one line."""
        with self.assertRaises(kind) as caught:
            function(*arguments, **named)
        message = str(caught.exception)
        self.assertNotIn("\n", message)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, message)


def sphere(count, seed=1, radius=0.04):
    """Points on a sphere, denser on one side."""
    random = np.random.default_rng(seed)
    directions = random.normal(size=(count, 3))
    directions[:, 0] = np.abs(directions[:, 0]) * np.sign(random.random(count) - 0.2)
    return radius * directions / np.linalg.norm(directions, axis=1)[:, None]
