"""Cuts a slope by a joint set, sweeps the friction angle, and plots how far the rock slides.

    python3 slope.py slope.png

Cells begin with `# %%`: Jupyter (by Jupytext), Spyder, PyCharm and VS Code run them one by one.
Joints dip out of the slope at 30 degrees, so that blocks slide when the friction angle is below that of the joints.
"""

# %% The slope, as a dictionary of the tables that a scene file has
import sys

import numpy as np
import polydda
from matplotlib import pyplot

DIP = 30.0


def slope(friction_angle):
    """Rock on joints of 30 degrees that settles with more friction and is released for a second; its base is fixed."""
    return {
        "format": 1,
        "analysis": {"time_step": 0.01, "gravity": [0.0, -9.81]},
        "output": {"every": 0},
        "material": [{"name": "rock", "density": 2600.0, "young": "20 GPa", "poisson": 0.25}],
        "joint": [{"name": "bedding", "friction_angle": friction_angle}],
        "block": [
            {
                "name": "base",
                "vertices": [[-8, -6], [20, -6], [20, 11.547], [-8, -4.6188]],
                "material": "rock",
                "fixed": True,
            }
        ],
        "domain": {
            "boundary": [[0, 0], [20, 11.547], [20, 15], [8, 15]],
            "material": "rock",
            "joint_set": [{"joint": "bedding", "angle": DIP, "spacing": 2.0, "origin": [0, 0]}],
        },
        "stage": [
            {"name": "settle", "mode": "static", "steps": 50, "joints": {"bedding": {"friction_angle": 60.0}},
             "reset_displacements": True},
            {"name": "release", "steps": 100},
        ],
    }


# %% Friction swept: one run an angle, 1 s of motion each
angles = np.array([10.0, 20.0, 25.0, 28.0, 32.0, 40.0])
results = [polydda.run(slope(angle)) for angle in angles]
moved = np.array([np.hypot(*result.frame().displacement.T).max() for result in results])

# %% By hand: a block on a plane slides by a t^2 / 2, a = g (sin 30 - tan(friction) cos 30), once friction is too low
dip, time = np.radians(DIP), 1.0
acceleration = 9.81 * (np.sin(dip) - np.tan(np.radians(angles)) * np.cos(dip))
exact = np.maximum(acceleration, 0) * time**2 / 2
for angle, distance, expected in zip(angles, moved, exact):
    print(f"friction {angle:4.1f} degrees: moved {distance:.4f} m, by Coulomb's law {expected:.4f} m")

# %% The slope at the least friction, and both results over the angle
figure, (left, right) = pyplot.subplots(1, 2, figsize=(11, 4))
results[0].plot("displacement", axes=left)
right.plot(angles, exact, "k-", label="Coulomb's law")
right.plot(angles, moved, "o", label="polydda")
right.set_xlabel("friction angle, degrees")
right.set_ylabel("displacement after 1 s, m")
right.legend()
figure.tight_layout()
if len(sys.argv) > 1 and sys.argv[1].endswith(".png"):
    figure.savefig(sys.argv[1], dpi=120)
else:
    pyplot.show()

# %% What a test asks
if np.abs(moved - exact).max() > 0.02 * exact.max():
    raise SystemExit("the rock does not move as it should")
