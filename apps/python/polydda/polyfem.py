"""Finite elements on polygons.

Vertices and points are arrays (n, 2), polygons counter-clockwise. The unknowns of an n-gon are
(u1, v1, ..., un, vn); everything is per metre of thickness.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

from ._core import polyfem as _polyfem

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    Array = npt.NDArray[np.float64]


def wachspress(vertices: npt.ArrayLike, points: npt.ArrayLike) -> tuple[Array, Array]:
    """Wachspress functions of a convex polygon, Eq. (6): values (q, n), gradients (q, n, 2)."""
    return _polyfem.wachspress(vertices, points)


def mean_value(vertices: npt.ArrayLike, points: npt.ArrayLike) -> tuple[Array, Array]:
    """Mean value functions of any simple polygon: values (q, n), gradients (q, n, 2)."""
    return _polyfem.mean_value(vertices, points)


def stiffness(
    vertices: npt.ArrayLike, young: float, poisson: float, plane: str = "strain", tolerance: float = 1e-6
) -> Array:
    """K (2n, 2n), Eq. (17), to a relative tolerance; `young` in Pa, plane "strain" or "stress"."""
    return _polyfem.stiffness(vertices, young, poisson, plane, tolerance)


def mass(vertices: npt.ArrayLike, density: float, tolerance: float = 1e-6) -> Array:
    """The consistent mass matrix (2n, 2n), kg per metre."""
    return _polyfem.mass(vertices, density, tolerance)


def rule(vertices: npt.ArrayLike, degree: int) -> tuple[Array, Array]:
    """Points (q, 2) and weights (q) of a rule that is exact for polynomials of that degree, 1 to 20."""
    return _polyfem.rule(vertices, degree)


def voronoi(boundary: npt.ArrayLike, cells: int, seed: int = 1) -> tuple[Array, list[list[int]]]:
    """Voronoi cells in a polygon: vertices (n, 2) and, for each cell, the indices of its own."""
    return _polyfem.voronoi(boundary, cells, seed)


class Problem:
    """One field on a mesh of polygons: prescribed values, loads, one sparse symmetric system."""

    def __init__(self, vertices: npt.ArrayLike, cells: Sequence[Sequence[int]], components: int = 2) -> None:
        self._problem = _polyfem.Problem(vertices, [list(cell) for cell in cells], components)

    def assemble(
        self,
        young: float,
        poisson: float,
        body_force: Sequence[float] = (0, 0),
        plane: str = "strain",
        tolerance: float = 1e-6,
    ) -> None:
        """Linear elasticity; `body_force` in N/m3."""
        self._problem.assemble(young, poisson, body_force, plane, tolerance)

    def assemble_cells(self, cell_matrix: Callable[[int, Array], tuple[Any, Any]]) -> None:
        """Any equation: `cell_matrix(cell, vertices)` returns the matrix and the load vector of a cell."""
        self._problem.assemble_cells(cell_matrix)

    def hold(self, vertex: int, component: int, value: float = 0.0) -> None:
        """Prescribes an unknown."""
        self._problem.hold(int(vertex), component, value)

    def add_load(self, vertex: int, component: int, value: float) -> None:
        """Adds a load to an unknown, N/m in elasticity."""
        self._problem.add_load(int(vertex), component, value)

    def solve(self) -> Array:
        """The field at the vertices (n, components)."""
        return self._problem.solve()

    def reactions(self) -> Array:
        """Forces that prescribed unknowns need (n, components); zero elsewhere."""
        return self._problem.reactions()
