"""What is computed in Rust; the other modules of the package call it."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from . import methods

__version__: str
PARAMETERS: list[str]
LARGEST_DIAMETER: float
QUANTITIES: list[str]
COLLOCATION_NODES: tuple[int, int, int]
FIXED_COST_NODES: tuple[int, int, int]
ITERATIONS: tuple[int, int, int]
STEPS: tuple[int, int, int]
TOLERANCE: float

_Float = npt.NDArray[np.float64]
_Numbers = Mapping[str, float | _Float]
_Words = tuple[str, str, str]
_Failure = tuple[int, str] | None
_Statuses = tuple[npt.NDArray[np.int8], npt.NDArray[np.int16], _Failure]
_Results = tuple[_Statuses, npt.NDArray[np.int8], dict[str, _Float]]
_Shape = tuple[str, float, float] | _Float
_Shapes = tuple[_Shape, _Shape, _Shape, _Shape | None]
_Asked = tuple[int, Sequence[float], Sequence[float], int, float]

def simulate(
    words: _Words, numbers: _Numbers, count: int, method: methods.Method, outputs: Sequence[str]
) -> _Results: ...
def critical_speeds(words: _Words, numbers: _Numbers, count: int, tolerance: float) -> tuple[_Statuses, _Float]: ...
def classify(numbers: _Numbers, count: int, outputs: Sequence[str]) -> _Results: ...
def critical_speeds_of_bodies(numbers: _Numbers, count: int) -> tuple[_Statuses, _Float]: ...
def trajectory(words: _Words, numbers: _Numbers, tolerance: float) -> dict[str, _Float]: ...
def fit(
    numbers: Sequence[_Float],
    captured: npt.NDArray[np.bool_] | None,
    has_mass: bool,
    are_restitutions: bool,
    laws: Sequence[str],
    natural_scatter: bool,
) -> dict[str, Any]: ...
def population_of_contacts(
    words: _Words, numbers: _Numbers, shapes: _Shapes, asked: _Asked, tolerance: float
) -> dict[str, Any]: ...
def population_of_bodies(numbers: _Numbers, shapes: _Shapes, asked: _Asked) -> dict[str, Any]: ...

class BoundaryTable:
    def __new__(
        cls, words: _Words, numbers: _Numbers, smallest_radius: float, cells: int, tolerance: float
    ) -> BoundaryTable: ...
    @staticmethod
    def from_parts(smallest: float, units: int, cells: list[list[int]]) -> BoundaryTable: ...
    def classify(self, radius: _Float, speed: _Float) -> tuple[npt.NDArray[np.int8], _Failure]: ...
    @property
    def smallest_radius(self) -> float: ...
    @property
    def margin(self) -> float: ...
    @property
    def parts(self) -> tuple[float, int, list[list[int]]]: ...

class RestitutionTable:
    def __new__(
        cls, words: _Words, numbers: _Numbers, smallest_radius: float, speed_ratio: float, tolerance: float
    ) -> RestitutionTable: ...
    @staticmethod
    def from_parts(boundary: Any, scales: Any, nodes: Any) -> RestitutionTable: ...
    @property
    def parts(self) -> tuple[Any, Any, Any]: ...
    def read(self, radius: _Float, speed: _Float) -> tuple[npt.NDArray[np.int8], _Float, _Float, _Failure]: ...
    @property
    def error(self) -> float: ...
