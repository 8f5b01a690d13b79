"""The same impacts in processes of MPI, each of which takes a part of the radii: mpiexec -n 2 python mpi_sweep.py"""

import numpy as np
from mpi4py import MPI

import microimpact as mi

ranks = MPI.COMM_WORLD
contact = mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
radius, speed = np.geomspace(1e-6, 2e-5, 200)[:, None], np.geomspace(0.5, 50, 500)
scene = mi.Scene(radius=radius[ranks.rank :: ranks.size], density=2600, contact=contact)
captured = ranks.allreduce(int((scene.simulate(speed).overall_restitution == 0).sum()))
if ranks.rank == 0:
    print(captured, "of", radius.size * speed.size, "impacts end in capture, on", ranks.size, "ranks")
