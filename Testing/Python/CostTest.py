"""A call from Python costs little beside the filter alone, and that does not grow with the points."""

import time
import unittest

from support import TestCase, sphere

import numpy as np
import pointhaptics as ph

POINTS = 543652
#: Of the time of the filter alone at so many points.
MOST = 0.1
#: What runs beside the test slows the call more than the filter in some tries.
TRIES = 4


def least(work, rounds):
    """The shortest processor time of a call: other programs on the machine only add to it."""
    best = np.inf
    for _ in range(rounds):
        start = time.process_time()
        kept = work()
        best = min(best, time.process_time() - start)
        del kept
    return best


def filter_alone(cloud):
    """Runs the filter as a C++ program does; it ends before the clock stops, as in ph.resample()."""
    resampler = ph.vtkVoxelMeanResampler()
    resampler.SetInputData(cloud.data)
    resampler.Update()
    return resampler.GetOutput()


class Cost(TestCase):
    def test_of_a_call_of_many_points_is_that_of_the_filter(self):
        few, many = sphere(10), sphere(POINTS)
        for _ in range(TRIES):
            call = least(lambda: ph.resample(few), 500) - least(lambda: filter_alone(ph.arrays.Cloud(few)), 500)
            alone = least(lambda: filter_alone(ph.arrays.Cloud(many)), 20)
            if call / alone <= MOST:
                break
        print(f"{1e6 * call:.0f} us of Python beside {1e3 * alone:.2f} ms of the filter: {1 + call / alone:.3f} times as long")
        self.assertLessEqual(call / alone, MOST)

    def test_nothing_is_done_point_by_point_in_python(self):
        # A copy of the points, or a look at each of them, would grow with their number.
        few, many = sphere(10), sphere(POINTS)
        growth = least(lambda: ph.arrays.Cloud(many), 500) - least(lambda: ph.arrays.Cloud(few), 500)
        self.assertLess(growth, 1e-4)


if __name__ == "__main__":
    unittest.main()
