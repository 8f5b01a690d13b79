"""Reference data of the repository: solutions to 20 digits."""

import csv
from pathlib import Path

import numpy as np
import pytest

DATA = Path(__file__).parents[3] / "host-tests" / "data"


class Table:
    """Columns of numbers and of words."""

    def __init__(self, rows):
        self.rows = rows

    def __getitem__(self, column):
        return np.array([float(row[column] or "nan") for row in self.rows])

    def words(self, column):
        return np.array([row[column] for row in self.rows])

    def where(self, keep):
        return Table([row for row in self.rows if keep(row)])


@pytest.fixture
def table():
    """Reads a table by its name."""

    def read(name):
        with open(DATA / name, newline="") as file:
            return Table(list(csv.DictReader(file)))

    return read
