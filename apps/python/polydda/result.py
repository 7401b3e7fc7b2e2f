"""What a run left, read back."""

from __future__ import annotations

import functools
import json
import os
import pathlib
from typing import TYPE_CHECKING, Any

from . import _core
from .tables import read_table

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

STRESSES = ("s1", "s2", "sxx", "syy", "sxy")
UNITS = {**dict.fromkeys(STRESSES, "Pa"), "displacement": "m", "velocity": "m/s", **_core.block_fields}


class Result:
    """A result directory. Files are read when they are needed, and once."""

    def __init__(self, directory: str | os.PathLike[str], keep: object = None) -> None:
        """`keep` lives as long as the result: the temporary directory that holds it."""
        self.directory = pathlib.Path(directory)
        self._keep = keep
        if not (self.directory / "summary.json").is_file():
            raise FileNotFoundError(f"{self.directory} holds no summary.json: give the directory of a run")

    def __repr__(self) -> str:
        return f"<polydda.Result {self.directory}: {self.summary['status']}, {len(self.blocks)} blocks>"

    @functools.cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: status, counts, energies, unbalanced forces, warnings."""
        return json.loads((self.directory / "summary.json").read_text(encoding="utf-8"))

    @functools.cached_property
    def monitors(self) -> npt.NDArray[Any]:
        """monitors.csv: a row a monitor and step."""
        return read_table(self.directory / "monitors.csv")

    @functools.cached_property
    def energy(self) -> npt.NDArray[Any]:
        """energy.csv: a row a step, J per metre of thickness."""
        return read_table(self.directory / "energy.csv")

    @functools.cached_property
    def blocks(self) -> npt.NDArray[Any]:
        """blocks.csv: position, motion and mean stress of every block at the end."""
        return read_table(self.directory / "blocks.csv")

    @functools.cached_property
    def contacts(self) -> npt.NDArray[Any]:
        """contacts.csv: the closed contacts at the end, N per metre of thickness."""
        return read_table(self.directory / "contacts.csv")

    @functools.cached_property
    def bolts(self) -> npt.NDArray[Any]:
        """bolts.csv, of a scene with bolts: their segments at the end, N per metre of thickness."""
        return read_table(self.directory / "bolts.csv")

    @functools.cached_property
    def bolt_history(self) -> npt.NDArray[Any]:
        """bolt_history.csv, of a scene with bolts: a row a step and bolt, N per metre of thickness."""
        return read_table(self.directory / "bolt_history.csv")

    @functools.cached_property
    def support_history(self) -> npt.NDArray[Any]:
        """support_history.csv, of a scene with supports: a row a step and block, N per metre of thickness."""
        return read_table(self.directory / "support_history.csv")

    @functools.cached_property
    def frames(self) -> list[tuple[int, float]]:
        """Step and time, s, of each frame."""
        return _core.frame_list(self.directory)

    def frame(self, k: int = -1) -> _core.Frame:
        """Frame k of `frames`; negative indices count from the last. Its arrays are views, without copies."""
        n = len(self.frames)
        if not -n <= k < n:
            raise IndexError(f"frame {k}: the run has {n}, 0 to {n - 1}")
        return _core.read_frame(self.directory, k % n)

    def plot(self, field: str = "s1", frame: int = -1, axes: Any = None, **patches: Any) -> Any:
        """Draws blocks with Matplotlib, coloured by `field`, and returns the axes.

        A block has one colour: its mean stress (sxx, syy, sxy, s1, s2 in Pa, tension positive) or the mean
        magnitude of its vertices' displacement (m) or velocity (m/s). The numbers of `frame.block_values` are
        fields too. `dda plot` draws stress within blocks.
        Further arguments go to Matplotlib's PolyCollection.
        """
        from matplotlib import pyplot
        from matplotlib.collections import PolyCollection

        if field not in UNITS:
            raise ValueError(f"field is {field!r}: write one of {', '.join(UNITS)}")
        moment = self.frame(frame)
        if axes is None:
            axes = pyplot.figure().add_subplot()
        blocks = PolyCollection(moment.outlines, **{"edgecolors": "black", "linewidths": 0.5, **patches})
        blocks.set_array(block_values(moment, field))
        axes.add_collection(blocks)
        axes.autoscale_view()
        axes.set_aspect("equal")
        axes.set_xlabel("x, m")
        axes.set_ylabel("y, m")
        axes.set_title(f"t = {moment.time:.6g} s")
        axes.figure.colorbar(blocks, ax=axes, label=f"{field}, {UNITS[field]}")
        return axes


def block_values(frame: _core.Frame, field: str) -> npt.NDArray[np.float64]:
    """One value a block that is present: see `Result.plot`."""
    import numpy as np

    if field in _core.block_fields:
        if field not in frame.block_values:
            raise ValueError(f"the frames hold no {field}: they are of an older version")
        return frame.block_values[field][frame.present]
    columns = {"displacement": frame.displacement, "velocity": frame.velocity}.get(field, frame.stress)
    if len(columns) == 0:
        raise ValueError(f"the frames hold no {field}: add it to `fields` of [output] in the scene")
    if field in ("displacement", "velocity"):
        size = np.hypot(*columns.T)
        return np.array([size[first : first + count].mean() for first, count in frame.outline_ranges])
    sxx, syy, sxy = columns[frame.present].T
    mean, radius = (sxx + syy) / 2, np.hypot((sxx - syy) / 2, sxy)
    return {"sxx": sxx, "syy": syy, "sxy": sxy, "s1": mean + radius, "s2": mean - radius}[field]


def read(directory: str | os.PathLike[str]) -> Result:
    """The result of an earlier run, of this module or of `dda run`."""
    return Result(directory)
