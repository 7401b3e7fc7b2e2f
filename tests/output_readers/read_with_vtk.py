"""Frames of a run are what VTK reads, and say what the run's tables say.

    read_with_vtk.py DDA SCENE.toml DIRECTORY REFINE
"""
import csv
import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree

try:
    import vtk
except ImportError:
    sys.exit("skipped: python3-vtk9 is not installed")

STATES = {"open": 0, "stick": 1, "slip": 2}


def read_grid(path):
    problems = []
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: problems.append(path))
    reader.AddObserver("WarningEvent", lambda *_: problems.append(path))
    reader.SetFileName(path)
    reader.Update()
    assert not problems, f"VTK has complaints about {path}"
    grid = reader.GetOutput()
    assert grid.GetNumberOfPoints() > 0, path
    return grid


def arrays(data):
    """Name -> list of tuples."""
    found = [data.GetArray(k) for k in range(data.GetNumberOfArrays())]
    return {a.GetName(): [a.GetTuple(k) for k in range(a.GetNumberOfTuples())] for a in found}


def table(directory, name):
    with open(os.path.join(directory, name), newline="") as file:
        return list(csv.DictReader(file))


def close(a, b, tolerance=0.0):
    a, b = float(a), float(b)
    assert abs(a - b) <= tolerance * max(abs(a), abs(b)), f"{a!r} is not {b!r}"


def area(grid, cell):
    points = grid.GetCell(cell).GetPoints()
    corners = [points.GetPoint(k) for k in range(points.GetNumberOfPoints())]
    following = corners[1:] + corners[:1]
    return sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(corners, following)) / 2


def check_vertices(directory, grid):
    """Positions, displacements and velocities at the outlines' vertices are those of vertices.csv."""
    field, point = arrays(grid.GetFieldData()), arrays(grid.GetPointData())
    rows = table(directory, "vertices.csv")
    assert len(rows) == sum(int(n) for (n,) in field["n_vertices"])
    names = list(dict.fromkeys(row["block"] for row in rows))
    for row in rows:
        block = names.index(row["block"])
        k = int(field["first_point"][block][0]) + int(row["vertex"])
        assert point["block_id"][k] == (block,)
        for value, name in zip(grid.GetPoint(k), ("x", "y")):
            close(value, row[name])
        for array, columns in (("displacement", ("ux", "uy")), ("velocity", ("vx", "vy"))):
            assert point[array][k][2] == 0
            for value, name in zip(point[array][k], columns):
                close(value, row[name])


def check_stress(directory, grid, refine):
    """Cells cover the blocks; their stresses are the blocks' means, or average to them; s1 and s2 belong to them."""
    field, cell = arrays(grid.GetFieldData()), arrays(grid.GetCellData())
    rows = table(directory, "blocks.csv")
    covered = [0.0] * len(rows)
    average = [[0.0] * 3 for _ in rows]
    for k in range(grid.GetNumberOfCells()):
        block = int(cell["block_id"][k][0])
        covered[block] += area(grid, k)
        stress = [cell[name][k][0] for name in ("sxx", "syy", "sxy")]
        for c in range(3):
            average[block][c] += area(grid, k) * stress[c]
        middle, radius = (stress[0] + stress[1]) / 2, math.hypot((stress[0] - stress[1]) / 2, stress[2])
        for name, principal in (("s1", middle + radius), ("s2", middle - radius)):
            assert abs(cell[name][k][0] - principal) <= 1e-12 * max(map(abs, stress))
        if refine == 0:
            for c, name in enumerate(("sxx_mean", "syy_mean", "sxy_mean")):
                close(stress[c], rows[block][name])
    for block, row in enumerate(rows):
        close(covered[block], row["area"], 1e-12)
        mean = [float(row[name]) for name in ("sxx_mean", "syy_mean", "sxy_mean")]
        for c in range(3):
            close(field["mean_stress"][block][c], mean[c])
            # Cells take stress at their middles: near the blocks' mean, not at it.
            assert abs(average[block][c] / covered[block] - mean[c]) <= 0.02 * max(map(abs, mean))


def check_contacts(directory, grid):
    point = arrays(grid.GetPointData())
    rows = table(directory, "contacts.csv")
    names = [row["block"] for row in table(directory, "blocks.csv")]
    assert len(rows) == grid.GetNumberOfPoints() == grid.GetNumberOfCells()
    for k, row in enumerate(rows):
        assert names[int(point["block_a"][k][0])] == row["block_a"]
        assert names[int(point["block_b"][k][0])] == row["block_b"]
        assert point["state"][k] == (STATES[row["state"]],)
        for name in ("gap", "normal_force", "shear_force"):
            close(point[name][k][0], row[name])
        force, normal = point["force"][k], point["normal"][k]
        close(sum(f * n for f, n in zip(force, normal)), row["normal_force"], 1e-9)
        close(math.hypot(*force), math.hypot(float(row["normal_force"]), float(row["shear_force"])), 1e-12)


def series(directory, name, times):
    """The files of a series, whose times are those of the run."""
    root = xml.etree.ElementTree.parse(os.path.join(directory, name)).getroot()
    entries = root.findall("./Collection/DataSet")
    assert [float(e.get("timestep")) for e in entries] == times, name
    files = [os.path.join(directory, e.get("file")) for e in entries]
    for file, time in zip(files, times):
        grid = read_grid(file) if time > 0 or name == "results.pvd" else None
        if grid:
            assert arrays(grid.GetFieldData())["TimeValue"] == [(time,)]
    return files


def main(program, scene, directory, refine):
    subprocess.run([program, "run", scene, "-o", directory, "--quiet", "--force", "--steps", "20", "--set", "output.every=5",
                    "--set", f"output.refine={refine}"], check=True)
    times = [0.0] + [float(row["time"]) for row in table(directory, "energy.csv") if int(row["step"]) in (5, 10, 15, 20)]
    blocks, contacts = series(directory, "results.pvd", times), series(directory, "contacts.pvd", times)
    grid = read_grid(blocks[-1])
    kind = vtk.VTK_POLYGON if refine == 0 else vtk.VTK_TRIANGLE
    assert {grid.GetCellType(k) for k in range(grid.GetNumberOfCells())} == {kind}
    check_vertices(directory, grid)
    check_stress(directory, grid, refine)
    check_contacts(directory, read_grid(contacts[-1]))
    with open(os.path.join(directory, "summary.json")) as file:
        assert json.load(file)["blocks"] == len(arrays(grid.GetFieldData())["n_vertices"])


main(sys.argv[1], sys.argv[2], sys.argv[3], int(sys.argv[4]))
