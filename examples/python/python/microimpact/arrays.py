"""Arguments as arrays, and their broadcasting to rows."""

from __future__ import annotations

import reprlib
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from numbers import Real
from operator import index

import numpy as np
import numpy.typing as npt

Float = npt.NDArray[np.float64]

AT_A_TIME = 32_768
"""Rows of a call of Rust: few enough that Ctrl-C is seen within a second, and enough for many cores."""


@dataclass(frozen=True)
class Rows:
    """Numbers by the name of their argument: a float, or a contiguous array with one number for each row."""

    numbers: dict[str, float | Float]
    shape: tuple[int, ...]

    @property
    def count(self) -> int:
        """Number of rows."""
        return int(np.prod(self.shape, dtype=np.int64))

    def parts(self) -> Iterator[tuple[dict[str, float | Float], int]]:
        """The numbers of some rows at a time, and how many rows. The interpreter sees Ctrl-C between them."""
        for start in range(0, max(self.count, 1), AT_A_TIME):
            end = min(start + AT_A_TIME, self.count)
            yield {n: v if isinstance(v, float) else v[start:end] for n, v in self.numbers.items()}, end - start


def number_array(name: str, value: npt.ArrayLike) -> Float:
    """An argument as an array, with NaN for what a mask hides; the error names the argument."""
    try:
        array = np.asanyarray(value)
        numbers = array.dtype.kind in "iuf" or (
            array.dtype.kind == "O" and all(isinstance(each, Real) for each in array.ravel())
        )
        if not numbers:
            raise TypeError(f"the type {array.dtype} has no real numbers")
        floats = array.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        raise TypeError(f"{name}: {reprlib.repr(value)} is refused: give a number or an array of numbers") from error
    return np.asarray(floats.filled(np.nan) if isinstance(floats, np.ma.MaskedArray) else floats)


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


def whole_number(name: str, value: object, low: int, high: int) -> int:
    """An argument that must be a whole number in a range."""
    try:
        number = index(value)  # type: ignore[arg-type]
    except TypeError as error:
        raise TypeError(f"{name}: {value!r} is refused: give a whole number, {low} to {high}") from error
    if not low <= number <= high:
        raise ValueError(f"{name}: {number} is refused: it must be {low} to {high}")
    return number


class ByValue:
    """Equality and hash by the values of the fields, which may be arrays: equal numbers in equal shapes. What holds an array or a
    list, whose numbers may change, has no hash."""

    def _values(self) -> tuple[object, ...]:
        return (type(self), *(_value(field) for field in vars(self).values()))

    def __eq__(self, other: object) -> bool:
        return self._values() == other._values() if isinstance(other, ByValue) else NotImplemented

    def __hash__(self) -> int:
        for name, field in vars(self).items():
            if isinstance(field, np.ndarray | list):
                raise TypeError(f"{name}: an array or a list has no hash, because its numbers may change; give a tuple")
        return hash(self._values())


def _value(field: object) -> object:
    if field is None or isinstance(field, str | ByValue):
        return field
    # Zeros of both signs are equal.
    array = number_array("field", field) + 0.0  # type: ignore[arg-type]
    return (array.shape, array.tobytes())
