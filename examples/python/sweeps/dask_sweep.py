"""Impacts over many radii and speeds in two processes: dask gives each of them blocks of the arrays."""

import dask
import dask.array as da
import numpy as np

import microimpact as mi

CONTACT = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)


def restitution(radius, speed):
    return mi.Scene(radius=radius, density=2600, contact=CONTACT).simulate(speed).overall_restitution


if __name__ == "__main__":
    radius = da.from_array(np.geomspace(1e-6, 2e-5, 200)[:, None], chunks=(50, 1))
    speed = da.from_array(np.geomspace(0.5, 50, 500)[None, :], chunks=(1, 500))
    captured = da.map_blocks(restitution, radius, speed, dtype=float) == 0
    with dask.config.set(scheduler="processes", num_workers=2):
        print(int(captured.sum().compute()), "of", radius.size * speed.size, "impacts end in capture")
