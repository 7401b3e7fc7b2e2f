"""Discontinuous deformation analysis of blocks in contact, and finite elements on polygons.

    import polydda
    result = polydda.run("rock.toml")
    print(result.blocks["sxx_mean"])

`run`, `check` and `read` are all there is for scenes; `polydda.polyfem` has the finite elements.
"""

from . import polyfem
from ._core import Error, OutputError, __version__
from .result import Result, read
from .running import AnalysisStopped, Problem, RunWarning, SceneError, Step, check, run

__all__ = [
    "AnalysisStopped",
    "Error",
    "OutputError",
    "Problem",
    "Result",
    "RunWarning",
    "SceneError",
    "Step",
    "__version__",
    "check",
    "polyfem",
    "read",
    "run",
]
