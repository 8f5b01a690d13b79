"""Runs the case in LAMMPS on one and on two ranks, with the wall in Python and with that in C++, and checks what came out:

* the number of hits of each class is the same on one and on two ranks,
* every hit has the class and the motion that one call of the library gives for all of them,
* the capture efficiency of each range of diameters is that of the population within three binomial standard errors.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

import microimpact as mi
from case import ANGLE_DEG, DIAMETER, RECORD, SPEED, SPHERES, scene, spheres

HERE = Path(__file__).parent
RANKS = (1, 2)

ACCURACY = {"callback": 1e-7, "plugin": 1e-5}
"""Largest error of e^2, and of tangential velocities and spins times the radius over the speed. The tolerance of e^2 is 1e-9
in Python; the plugin computes in single precision, with 1e-6."""

NEAR = {"callback": 0.0, "plugin": 1e-4}
"""Distance of the margins from one within which single precision may find another class."""

LEAST = 25
"""Captures, and rebounds, of a range of diameters from which on their number is nearly normal."""


def run(wall, ranks, folder):
    """The hits of a run in the order of their tags, and their number by class, which the plugin sums over the ranks."""
    command = ["mpiexec", "-n", str(ranks), sys.executable, HERE / "case.py", wall, folder]
    printed = subprocess.run(command, check=True, timeout=300, stdout=subprocess.PIPE, text=True).stdout
    hits = np.concatenate([np.fromfile(file).reshape(-1, RECORD) for file in sorted(Path(folder).glob("hits.*"))])
    busy = sum(file.stat().st_size > 0 for file in Path(folder).glob("hits.*"))
    assert busy == ranks, f"{wall}: {busy} of {ranks} ranks have hits"
    hits = hits[np.argsort(hits[:, 0])]
    assert (hits[:, 0] == np.arange(1, SPHERES + 1)).all(), f"{wall}: {len(hits)} hits of {SPHERES} spheres"
    counts = np.bincount(hits[:, 8].astype(int), minlength=len(mi.CLASSES) + 1)
    if wall == "plugin":
        assert printed.split()[-len(counts) :] == [str(count) for count in counts], f"{wall}: the fix counts {printed}"
    return hits, counts


def over_critical():
    """Approach speed of each sphere over its critical speed."""
    radius, _, velocity = spheres()
    return -velocity[:, 2] / scene(radius).critical_speed()


def check_hits(wall, hits, margin):
    """Compares every hit with the library, as the planar motion that it is: the spheres do not spin before."""
    radius, velocity, found = hits[:, 1], hits[:, 2:5], hits[:, 8].astype(int)
    assert (hits[:, 5:8] == 0).all()
    tangential = np.hypot(velocity[:, 0], velocity[:, 1])
    expected = scene(radius).simulate(-velocity[:, 2], tangential)
    near = (np.abs(margin - 1) <= NEAR[wall]) | (np.abs(expected.friction_over_limit - 1) <= NEAR[wall])
    wrong = (found != expected.impact_class) & ~near
    assert not wrong.any(), f"{wall}: {wrong.sum()} hits have another class"
    course = velocity[:, :2] / tangential[:, None]
    along = course * expected.speed_tangential_out[:, None]
    spin = np.column_stack([-course[:, 1], course[:, 0]]) * expected.spin_out[:, None]
    speed = np.linalg.norm(velocity, axis=1)
    # Near the critical speed e is a root of a small difference, of which e^2 is the accurate number.
    errors = np.max(
        [
            np.abs((hits[:, 11] / velocity[:, 2]) ** 2 - expected.overall_restitution**2),
            np.abs(hits[:, 9:11] - along).max(axis=1) / speed,
            np.abs(hits[:, 12:14] - spin).max(axis=1) * radius / speed,
        ],
        axis=0,
    )
    compared = found == expected.impact_class
    largest = errors[compared].max()
    assert largest < ACCURACY[wall], f"{wall}: the motions after the impact differ by {largest:.1e}"
    print(
        f"{wall}: {compared.sum()} hits agree with the library to {largest:.0e}; of {near.sum()} near a boundary,",
        f"{(found != expected.impact_class).sum()} have the class beyond it",
    )


def check_captures(wall, hits):
    """Compares the capture efficiency by size with that of the population."""
    sizes = scene(None).population(diameter=DIAMETER, speed=SPEED, angle_deg=ANGLE_DEG).sizes
    diameter, captured = 2 * hits[:, 1], np.isin(hits[:, 8], [2, 3, 4])
    for bin, (low, high) in enumerate(zip(sizes.diameter_from, sizes.diameter_to)):
        inside = (diameter > low) & (diameter <= high)
        expected, count = sizes.capture[bin], inside.sum()
        if min(expected, 1 - expected) * count < LEAST:
            continue
        error = np.sqrt(expected * (1 - expected) / count)
        off = (captured[inside].mean() - expected) / error
        print(
            f"{wall}: {1e6 * low:5.2f} to {1e6 * high:5.2f} µm: {captured[inside].mean():.4f} captured of {count},",
            f"population {expected:.4f}, {off:+.1f} standard errors",
        )
        assert abs(off) < 3, f"{wall}: the capture efficiency is {off:.1f} standard errors off"


def main():
    margin = over_critical()
    for wall in ("callback", "plugin"):
        counts = {}
        for ranks in RANKS:
            with tempfile.TemporaryDirectory() as folder:
                hits, counts[ranks] = run(wall, ranks, folder)
            check_hits(wall, hits, margin)
        assert (counts[1] == counts[2]).all(), f"{wall}: {counts[1]} on one rank, {counts[2]} on two"
        check_captures(wall, hits)
        named = zip([*mi.CLASSES, "no result"], counts[1])
        print(f"{wall}: on one and on two ranks", ", ".join(f"{count} {name}" for name, count in named if count))


if __name__ == "__main__":
    main()
