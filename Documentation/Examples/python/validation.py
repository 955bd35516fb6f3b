# The paper's validation: a hand crosses a surface that is known, and the felt force stands beside the exact one.
#
#   python3 validation.py [FIGURE.png]
#
# Cell by cell in an editor or notebook that knows "# %%", or as a whole. Needs the package pointhaptics and NumPy; the
# figure needs matplotlib, and without it the same numbers are printed.

# %% A sphere of 30 mm, sixteen times as dense on its right half as on its left one
import sys

import numpy as np
import pointhaptics as ph

RADIUS = 0.03  # metres
STIFFNESS = 800.0  # N/m

random = np.random.default_rng(1)
directions = random.normal(size=(340_000, 3))
directions /= np.linalg.norm(directions, axis=1)[:, None]
points = RADIUS * directions[(directions[:, 0] > 0) | (random.random(len(directions)) < 1 / 16)]

# %% The hand glides over the top from the sparse side to the dense one, 2 mm deep in the middle
t = np.linspace(0.0, 2.0, 201)
angle = np.radians(np.linspace(-50.0, 50.0, len(t)))
distance = RADIUS + 0.002 - 0.004 * np.sin(np.pi * t / t[-1])
path = np.column_stack([t, distance * np.sin(angle), np.zeros_like(t), distance * np.cos(angle)])

# %% What it feels, and what it should feel
felt = ph.Scene(points).feel(path, stiffness=STIFFNESS)
force = np.sqrt(felt["force_x"] ** 2 + felt["force_y"] ** 2 + felt["force_z"] ** 2)
hip = np.sqrt(felt["hip_x"] ** 2 + felt["hip_y"] ** 2 + felt["hip_z"] ** 2)
exact = STIFFNESS * np.maximum(0.0, RADIUS - hip)
error = np.abs(force - exact)
print(f"{len(points)} points, {len(felt)} ticks, {int(felt['contact'].sum())} in contact")
print(f"largest force {force.max():.3f} N, exact {exact.max():.3f} N")
print(f"error: median {np.median(error):.4f} N, largest {error.max():.4f} N")
print(f"proxy radius: {1e3 * felt['radius'].min():.2f} to {1e3 * felt['radius'].max():.2f} mm")
if error.max() > 0.1:
    sys.exit("the felt force is off: error above 0.1 N")

# %% The figure
try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    print("no figure: matplotlib is not installed (package python3-matplotlib)")
    sys.exit()

figure, (upper, lower) = pyplot.subplots(2, 1, sharex=True, figsize=(7, 5), constrained_layout=True)
upper.plot(felt["t"], exact, color="0.6", linewidth=4, label="exact")
upper.plot(felt["t"], force, color="tab:blue", linewidth=1.5, label="felt")
upper.set_ylabel("force (N)")
upper.legend()
lower.plot(felt["t"], 1e3 * felt["radius"], color="tab:orange")
lower.set_ylabel("proxy radius (mm)")
lower.set_xlabel("time (s)")
name = sys.argv[1] if len(sys.argv) > 1 else "validation.png"
figure.savefig(name, dpi=120)
print(f"figure: {name}")
