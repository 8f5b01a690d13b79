"""Impacts of microspheres with adhesion: restitution, friction, spin and capture, on arrays of numpy.

Two models after R. M. Brach and P. F. Dunn (1995): `Scene` simulates the contact, `RigidBody` is algebra. Every number may be a
float or an array; arrays are broadcast as numpy does, and computed on all cores with the interpreter's lock released. All
numbers have SI units. The environment variable `RAYON_NUM_THREADS` sets the number of threads.
"""

from ._native import __version__
from .distributions import LogNormal, Normal, Samples
from .fitting import Candidate, Fit, Quantity, fit
from .impacts import CLASSES, Class, Impacts, Outcome, Status
from .laws import Dmt, Hertz, Jkr, Ring
from .methods import Adaptive, Collocation, FixedCost, RungeKuttaGill
from .population import Bounces, Estimate, Population, Sizes
from .rigid_body import RigidBody
from .scene import Scene
from .tables import BoundaryTable, RestitutionTable, TableOutcome
from .trajectory import Trajectory

__all__ = [
    "CLASSES",
    "Adaptive",
    "BoundaryTable",
    "Bounces",
    "Candidate",
    "Class",
    "Collocation",
    "Dmt",
    "Estimate",
    "Fit",
    "FixedCost",
    "Hertz",
    "Impacts",
    "Jkr",
    "LogNormal",
    "Normal",
    "Outcome",
    "Population",
    "Quantity",
    "RestitutionTable",
    "RigidBody",
    "Ring",
    "RungeKuttaGill",
    "Samples",
    "Scene",
    "Sizes",
    "Status",
    "TableOutcome",
    "Trajectory",
    "__version__",
    "fit",
]
