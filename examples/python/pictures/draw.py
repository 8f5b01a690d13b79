"""Draws the pictures of README beside this file."""

from pathlib import Path

import matplotlib
import matplotlib.pyplot as pyplot
import numpy as np

import microimpact as mi
from microimpact import plot

matplotlib.use("svg")
# The same file from the same numbers.
matplotlib.rcParams.update({"svg.hashsalt": "microimpact", "svg.fonttype": "none", "figure.figsize": (4.8, 3.2)})

GLASS_ON_STEEL = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_h=10.5, zeta_a=6.25)


def save(axes, name):
    axes.figure.tight_layout()
    axes.figure.savefig(Path(__file__).parent / f"{name}.svg", metadata={"Date": None})


axes = pyplot.subplots()[1]
for diameter in (5, 8.6, 13, 50):
    scene = mi.Scene(radius=0.5e-6 * diameter, density=2600, contact=GLASS_ON_STEEL)
    plot.restitution(scene, np.geomspace(0.1, 50, 400), axes).lines[-1].set_label(f"{diameter} µm")
axes.legend(title="diameter")
save(axes, "restitution")

scene = mi.Scene(radius=4.3e-6, density=2600, contact=GLASS_ON_STEEL, friction=0.1)
save(scene.trajectory(2.8).plot(), "force")

population = scene.population(diameter=mi.LogNormal(8.6e-6, 1.3), speed=mi.LogNormal(1.9, 1.3), bins=16)
save(population.plot(), "capture")
