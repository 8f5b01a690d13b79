"""What makes it a package: version, types, documentation, pictures."""

import ast
import inspect
import os
import re
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import numpy as np

import microimpact as mi
import microimpact.plot
from microimpact import _native

PACKAGE = Path(mi.__file__).parent
SOURCE = Path(__file__).parents[1]


def test_version():
    assert f'version = "{mi.__version__}"' in (SOURCE / "Cargo.toml").read_text()


def test_stubs_describe_what_is_there():
    stub = ast.parse((PACKAGE / "_native.pyi").read_text())
    declared = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef | ast.ClassDef)}
    present = {name for name in dir(_native) if callable(getattr(_native, name))}
    assert set(declared) == present
    for name, node in declared.items():
        if isinstance(node, ast.FunctionDef):
            signature = inspect.signature(getattr(_native, name))
            assert list(signature.parameters) == [argument.arg for argument in node.args.args], name


def test_types():
    command = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", os.devnull, "--package", "microimpact"]
    checked = subprocess.run(command, capture_output=True, text=True)
    assert checked.returncode == 0, checked.stdout


def test_every_public_name_is_documented():
    for name in mi.__all__:
        thing = getattr(mi, name)
        if inspect.isclass(thing) or inspect.isfunction(thing):
            assert inspect.getdoc(thing), name
            members = inspect.getmembers(thing, inspect.isfunction) if inspect.isclass(thing) else []
            for member, function in members:
                if not member.startswith("_") and function.__module__.startswith("microimpact"):
                    assert inspect.getdoc(function), f"{name}.{member}"


def test_examples_of_the_readme_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"```python\n(.*?)```", (SOURCE / "README.md").read_text(), re.DOTALL)
    assert len(blocks) >= 3
    names = {}
    for block in blocks:
        exec(block, names)
    assert (tmp_path / "fit.svg").stat().st_size > 0


def test_pictures():
    scene = mi.Scene(
        radius=5.06e-6, density=2600, contact=mi.Ring(stiffness=7.5e10, adhesion=250, zeta_a=6.25, zeta_h=10.5)
    )
    speeds = np.geomspace(0.5, 50, 30)
    line = microimpact.plot.restitution(scene, speeds).lines[0]
    assert (line.get_ydata() == scene.simulate(speeds).overall_restitution).all()
    course = scene.trajectory(2.8)
    time, force = course.plot().lines[0].get_data()
    assert np.isin(1e6 * course.force, force).all() and (np.diff(time) > 0).all()
    assert len(force) > 5 * len(course.force)
    # Between the nodes, the curve is near that of other nodes.
    finer = mi.Scene(radius=scene.radius, density=2600, contact=scene.contact, tolerance=1e-13).trajectory(2.8)
    assert np.abs(np.interp(1e9 * finer.time, time, force) / 1e6 - finer.force).max() < 0.02 * finer.force.max()
    population = scene.population(diameter=mi.LogNormal(8.6e-6, 1.2), speed=1.9)
    assert (population.plot().patches[0].get_data().values == population.sizes.capture).all()
    found = mi.fit(speeds[12:], overall_restitution=100 / (100 + speeds[12:]))
    assert (found.plot().lines[0].get_xdata() == speeds[12:]).all()


def test_results_say_what_they_are_in_a_line():
    scene = mi.Scene(radius=5.06e-6, density=2600, contact=mi.Dmt(stiffness=7.5e10, work_of_adhesion=0.1, zeta_h=5))
    course, table = scene.trajectory(2.8), scene.boundary_table(1e-6)
    assert repr(course) == f"<Trajectory: {len(course.time)} moments in {course.time[-1]:.3e} s>"
    readings = scene.restitution_table(table.smallest_radius)
    start = f"from {table.smallest_radius:.3e} m"
    for line, bound, expected in [
        (repr(table), table.margin, f"<BoundaryTable: 24 cells {start}, margin"),
        (repr(readings), readings.error, f"<RestitutionTable: {start}, error"),
    ]:
        words, _, shown = line.removesuffix(">").rpartition(" ")
        assert words == expected and bound <= float(shown) < 1.1 * bound
