"""Plots the shape functions of a pentagon and where they fail to be a partition of unity: nowhere.

    python3 shape_functions.py shape_functions.png
"""

import sys

import numpy as np
from matplotlib import pyplot
from matplotlib.path import Path
from polydda.polyfem import mean_value, wachspress

VERTICES = np.array([[0.0, 0.0], [2.0, -0.3], [2.6, 1.2], [1.1, 2.2], [-0.4, 1.3]])


def points_inside(vertices, n):
    """A grid of n x n points over the box of a polygon, and which of them lie in it."""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    x, y = np.meshgrid(*np.linspace(low, high, n).T)
    return x, y, Path(vertices).contains_points(np.c_[x.ravel(), y.ravel()], radius=-1e-9)


def main(picture):
    x, y, inside = points_inside(VERTICES, 121)
    points = np.c_[x.ravel(), y.ravel()][inside]
    figure, rows = pyplot.subplots(2, 3, figsize=(12, 7), subplot_kw={"aspect": "equal"})
    for functions, row in zip((wachspress, mean_value), rows):
        values, gradients = functions(VERTICES, points)
        errors = np.abs(values.sum(axis=1) - 1), np.abs(values @ VERTICES - points).max(axis=1)
        fields = {"N of vertex 1": values[:, 1], "sum of N, less 1": errors[0], "sum of N x, less x": errors[1]}
        for axes, (title, field) in zip(row, fields.items()):
            shown = np.full(x.size, np.nan)
            shown[inside] = field
            figure.colorbar(axes.contourf(x, y, shown.reshape(x.shape), 20), ax=axes)
            axes.plot(*np.vstack([VERTICES, VERTICES[:1]]).T, "k-")
            axes.set_title(f"{functions.__name__}: {title}")
        print(f"{functions.__name__}: partition of unity to {errors[0].max():.1e}, linear fields to {errors[1].max():.1e}, "
              f"gradients sum to {np.abs(gradients.sum(axis=1)).max():.1e}")
        if max(error.max() for error in errors) > 1e-13:
            raise SystemExit("the functions do not reproduce linear fields")
    figure.tight_layout()
    figure.savefig(picture, dpi=110)


if __name__ == "__main__":
    main(sys.argv[1])
