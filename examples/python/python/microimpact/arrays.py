"""Broadcasting of arguments to rows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Float = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Rows:
    """Numbers by the name of their argument: a float, or a contiguous array with one number for each row."""

    numbers: dict[str, float | Float]
    shape: tuple[int, ...]

    @property
    def count(self) -> int:
        """Number of rows."""
        return int(np.prod(self.shape, dtype=np.int64))


def number_array(name: str, value: npt.ArrayLike) -> Float:
    """An argument as an array; the error names the argument."""
    try:
        return np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise TypeError(f"{name}: {value!r} is refused: give a number or an array of numbers") from error


def rows(arguments: Mapping[str, npt.ArrayLike | None]) -> Rows:
    """Broadcasts arguments against each other; those that are None are left out."""
    arrays = {name: number_array(name, value) for name, value in arguments.items() if value is not None}
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError as error:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items() if array.ndim)
        raise ValueError(f"shapes that cannot be broadcast together: {shapes}") from error

    def flat(array: Float) -> float | Float:
        if array.ndim == 0:
            return float(array)
        return np.ascontiguousarray(np.broadcast_to(array, shape)).reshape(-1)

    return Rows({name: flat(array) for name, array in arrays.items()}, shape)


def components(name: str, value: npt.ArrayLike) -> dict[str, npt.ArrayLike]:
    """The components of vectors, whose last axis has the length three."""
    vectors = number_array(name, value)
    if vectors.ndim == 0 or vectors.shape[-1] != 3:
        raise ValueError(f"{name}: the shape {vectors.shape} is refused: the last axis must have three components")
    return {f"{name}_{axis}": vectors[..., index] for index, axis in enumerate("xyz")}


def one_number(name: str, value: npt.ArrayLike) -> float:
    """An argument that must be one number."""
    array = number_array(name, value)
    if array.ndim:
        raise ValueError(f"{name}: an array is refused: give one number")
    return float(array)
