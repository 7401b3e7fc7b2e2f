"""`polydda.polyfem`: properties of shape functions, patch test, equilibrium."""

import numpy as np
import polydda
import pytest
from polydda import polyfem

PENTAGON = np.array([[0.0, 0], [2, 0], [3, 1.5], [1, 3], [-0.5, 1.2]])
INSIDE = np.array([[1.0, 1], [0.3, 0.9], [2.5, 1.4]])


@pytest.mark.parametrize("basis", [polyfem.wachspress, polyfem.mean_value])
def test_functions_sum_to_one_and_reproduce_linear_fields(basis):
    values, gradients = basis(PENTAGON, INSIDE)
    assert values.shape == (3, 5) and gradients.shape == (3, 5, 2)
    assert np.abs(values.sum(1) - 1).max() < 1e-14
    assert np.abs(values @ PENTAGON - INSIDE).max() < 1e-14
    assert np.abs(np.einsum("qid,ie->qde", gradients, PENTAGON) - np.eye(2)).max() < 1e-13


def test_stiffness_has_the_energy_of_a_uniform_strain_and_no_energy_of_rigid_motion():
    young, poisson = 1e9, 0.25
    K = polyfem.stiffness(PENTAGON, young, poisson)
    stretch = np.column_stack([PENTAGON[:, 0], 0 * PENTAGON[:, 0]]).ravel()
    area = polyfem.rule(PENTAGON, 1)[1].sum()
    D11 = young * (1 - poisson) / (1 + poisson) / (1 - 2 * poisson)
    assert stretch @ K @ stretch == pytest.approx(D11 * area, rel=1e-12)
    turn = np.column_stack([-PENTAGON[:, 1], PENTAGON[:, 0]]).ravel()
    assert np.abs(K @ turn).max() < 1e-12 * np.abs(K).max()
    M = polyfem.mass(PENTAGON, 2000)
    assert M.sum() == pytest.approx(2 * 2000 * area, rel=1e-6)


def test_rule_integrates_polynomials():
    points, weights = polyfem.rule([[0, 0], [2, 0], [2, 1], [0, 1]], 6)
    assert (weights * points[:, 0] ** 4 * points[:, 1] ** 2).sum() == pytest.approx(2**5 / 5 / 3, rel=1e-14)


def test_patch_test():
    vertices, cells = polyfem.voronoi([[0, 0], [4, 0], [4, 3], [0, 3]], cells=50)
    problem = polyfem.Problem(vertices, cells)
    problem.assemble(young=1e9, poisson=0.3)
    exact = 1e-3 * vertices @ [[1, 0.2], [-0.5, 2]]
    edge = (vertices[:, 0] % 4 == 0) | (vertices[:, 1] % 3 == 0)
    for v in np.flatnonzero(edge):
        for c in range(2):
            problem.hold(v, c, exact[v, c])
    assert np.abs(problem.solve() - exact).max() < 1e-14


def test_reactions_carry_the_weight():
    vertices, cells = polyfem.voronoi([[0, 0], [4, 0], [4, 3], [0, 3]], cells=30)
    problem = polyfem.Problem(vertices, cells)
    problem.assemble(young=1e9, poisson=0.3, body_force=(0, -24e3))
    for v in np.flatnonzero(vertices[:, 1] == 0):
        problem.hold(v, 0)
        problem.hold(v, 1)
    problem.solve()
    assert problem.reactions().sum(0) == pytest.approx([0, 12 * 24e3], abs=1e-4)


def test_a_cell_matrix_of_ones_own_is_assembled():
    """Poisson's equation with a linear solution, by Wachspress functions."""
    vertices, cells = polyfem.voronoi([[0, 0], [1, 0], [1, 1], [0, 1]], cells=20)

    def laplace(cell, polygon):
        points, weights = polyfem.rule(polygon, 4)
        _, gradients = polyfem.wachspress(polygon, points)
        return np.einsum("q,qid,qjd->ij", weights, gradients, gradients), np.zeros(len(polygon))

    problem = polyfem.Problem(vertices, cells, components=1)
    problem.assemble_cells(laplace)
    exact = vertices @ [[1.0], [2.0]]
    for v in np.flatnonzero((vertices % 1 == 0).any(1)):
        problem.hold(v, 0, exact[v, 0])
    assert np.abs(problem.solve() - exact).max() < 1e-2


def test_errors_are_exceptions_with_the_cure():
    with pytest.raises(polydda.Error, match="vertex 2"):
        polyfem.wachspress([[0, 0], [2, 0], [0.5, 0.5], [0, 2]], [[0.2, 0.2]])
    with pytest.raises(ValueError, match=r"shape \(n, 2\)"):
        polyfem.wachspress([0, 1, 2], [[0, 0]])
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    with pytest.raises(ValueError, match="components=2"):
        polyfem.Problem(square, [[0, 1, 2, 3]], components=1).assemble(young=1.0, poisson=0.3)
    with pytest.raises(ValueError, match="no vertices"):
        polyfem.Problem(np.zeros((0, 2)), [])
    for density in (-1.0, float("nan")):
        with pytest.raises(ValueError, match="density"):
            polyfem.mass(square, density)
    with pytest.raises(ValueError, match="strain"):
        polyfem.stiffness(PENTAGON, 1e9, 0.3, plane="strian")
