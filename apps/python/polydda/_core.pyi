"""The extension; use the package."""

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

__version__: str

class Error(ValueError): ...
class OutputError(OSError): ...

class Frame:
    """One moment of a run; arrays are read-only views."""

    step: int
    time: float
    present: list[int]
    outlines: list[npt.NDArray[np.float64]]
    outline_ranges: list[tuple[int, int]]
    position: npt.NDArray[np.float64]
    displacement: npt.NDArray[np.float64]
    velocity: npt.NDArray[np.float64]
    stress: npt.NDArray[np.float64]
    contacts: npt.NDArray[Any]

def check_text(text: str, name: str, settings: Sequence[str], directory: str) -> list[tuple[Any, ...]]: ...
def run_text(
    text: str,
    name: str,
    settings: Sequence[str],
    directory: str,
    results: str,
    threads: int,
    force: bool,
    on_step: Callable[[int, int, float], object] | None,
) -> tuple[bool, list[tuple[Any, ...]], list[str], list[str]]: ...
def frame_list(directory: str | os.PathLike[str]) -> list[tuple[int, float]]: ...
def read_frame(directory: str | os.PathLike[str], k: int) -> Frame: ...

class polyfem:
    Problem: Any
    wachspress: Any
    mean_value: Any
    stiffness: Any
    mass: Any
    rule: Any
    voronoi: Any
