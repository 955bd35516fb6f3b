# A hand of 0.2 kg and a damper is pressed on a sphere, and feels the force late: what a slow link to a robot does.
#
#   python3 delay.py [FIGURE.png]
import sys
from collections import deque
from typing import Any

import numpy as np
import pointhaptics as ph

directions = np.random.default_rng(1).normal(size=(60_000, 3))
points = 0.03 * directions / np.linalg.norm(directions, axis=1)[:, None]  # a sphere of 30 mm
scene = ph.Scene(points)
MASS, DAMPER, PUSH, DT = 0.2, 4.0, np.array([0.0, 0.0, -0.8]), 0.001  # kg, N s/m, N, s


def press(delay: int) -> Any:
    """Felt forces of a second in which each force arrives `delay` ticks late."""
    proxy = ph.Proxy(scene, stiffness=800.0)
    on_the_way = deque([np.zeros(3)] * delay)
    hand, speed, felt = np.array([0.0, 0.0, 0.032]), np.zeros(3), []
    for _ in range(1000):
        felt.append(proxy.step(hand, DT))
        on_the_way.append(np.array([felt[-1]["force_x"], felt[-1]["force_y"], felt[-1]["force_z"]]))
        speed += DT / MASS * (PUSH + on_the_way.popleft() - DAMPER * speed)
        hand += DT * speed
    return np.array(felt)


felt = {delay: press(delay) for delay in (0, 4, 12)}
for delay, rows in felt.items():
    print(f"{delay:2} ms late: {rows['force_z'][-300:].min():.2f} to {rows['force_z'][-300:].max():.2f} N in the end")
try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    sys.exit("no figure: matplotlib is not installed (package python3-matplotlib)" if len(sys.argv) > 1 else 0)
for delay, rows in felt.items():
    pyplot.plot(rows["t"], rows["force_z"], label=f"{delay} ms late")
pyplot.xlabel("time (s)")
pyplot.ylabel("force (N)")
pyplot.legend()
pyplot.savefig(sys.argv[1] if len(sys.argv) > 1 else "delay.png", dpi=120)
