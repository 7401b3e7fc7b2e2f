"""The extension; use the package."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

__version__: str

class Error(ValueError):
    """The request cannot be carried out; the message says why, and what to write instead."""

class OutputError(OSError):
    """A result file cannot be read or written."""

class Frame:
    """One moment of a run; arrays are read-only views."""

    step: int
    """Number of the step that it was written after."""
    time: float
    """s"""
    present: list[int]
    outlines: list[npt.NDArray[np.float64]]
    outline_ranges: list[tuple[int, int]]
    position: npt.NDArray[np.float64]
    displacement: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    stress: npt.NDArray[np.float64]
    block_values: dict[str, npt.NDArray[np.float64]]
    contacts: npt.NDArray[Any]

block_fields: dict[str, str]
"""The unit of each of `Frame.block_values`."""

def check_text(text: str, name: str, settings: Sequence[str], directory: str) -> list[tuple[Any, ...]]: ...
def run_text(
    source: tuple[str, str, Sequence[str], str],
    results: str,
    threads: int,
    force: bool,
    on_step: Callable[[int, int, float], object] | None,
) -> tuple[bool, list[tuple[Any, ...]], list[str], list[str]]: ...
def frame_list(directory: str | os.PathLike[str]) -> list[tuple[int, float]]: ...
def read_frame(directory: str | os.PathLike[str], k: int) -> Frame: ...

Array = npt.NDArray[np.float64]

class polyfem:
    """The submodule that `polydda.polyfem` documents."""

    @staticmethod
    def wachspress(vertices: npt.ArrayLike, points: npt.ArrayLike) -> tuple[Array, Array]: ...
    @staticmethod
    def mean_value(vertices: npt.ArrayLike, points: npt.ArrayLike) -> tuple[Array, Array]: ...
    @staticmethod
    def stiffness(vertices: npt.ArrayLike, young: float, poisson: float, plane: str = "strain", tolerance: float = 1e-6) -> Array: ...
    @staticmethod
    def mass(vertices: npt.ArrayLike, density: float, tolerance: float = 1e-6) -> Array: ...
    @staticmethod
    def rule(vertices: npt.ArrayLike, degree: int) -> tuple[Array, Array]: ...
    @staticmethod
    def voronoi(boundary: npt.ArrayLike, cells: int, seed: int = 1) -> tuple[Array, list[list[int]]]: ...

    class Problem:
        def __init__(self, vertices: npt.ArrayLike, cells: Sequence[Sequence[int]], components: int = 2) -> None: ...
        def assemble(self, young: float, poisson: float, body_force: Sequence[float], plane: str, tolerance: float) -> None: ...
        def assemble_cells(self, cell_matrix: Callable[[int, Array], tuple[Any, Any]]) -> None: ...
        def hold(self, vertex: int, component: int, value: float = 0.0) -> None: ...
        def add_load(self, vertex: int, component: int, value: float) -> None: ...
        def solve(self) -> Array: ...
        def reactions(self) -> Array: ...
