"""CSV files of a result as NumPy structured arrays.

NumPy is imported where an array is made: a run that reads none does not wait for it.
"""

from __future__ import annotations

import csv
import pathlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy.typing as npt


def read_table(path: pathlib.Path) -> npt.NDArray[Any]:
    """A column is of whole numbers, else of floats (an empty cell is NaN), else of text."""
    import numpy as np

    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names, rows = rows[0], rows[1:]
    columns = [_column([row[c] for row in rows]) for c in range(len(names))]
    table = np.empty(len(rows), dtype=[(name, column.dtype) for name, column in zip(names, columns)])
    for name, column in zip(names, columns):
        table[name] = column
    return table


def _column(cells: list[str]) -> npt.NDArray[Any]:
    import numpy as np

    try:
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    except ValueError:
        pass
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)
