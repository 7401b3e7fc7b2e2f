"""Scenes: checking and running them."""

import logging
import os
import pathlib
import tempfile
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

from . import _core
from .result import Result
from .toml_text import to_toml

_log = logging.getLogger("polydda")

Scene = str | os.PathLike[str] | Mapping[str, Any]
"""The path of a file, a TOML text (a string of more than one line), or a dict of the same tables."""


class Problem(NamedTuple):
    """One thing that is wrong with a scene."""

    severity: str
    """"error" or "warning"."""
    file: str
    line: int
    column: int
    what: str
    cure: str
    """What to write instead; may be empty."""
    text: str
    """All of it, as `dda check` prints it."""

    def __str__(self) -> str:
        return self.text


class SceneError(ValueError):
    """A scene is wrong; `problems` lists all that is."""

    def __init__(self, problems: list[Problem]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = problems


class AnalysisStopped(RuntimeError):
    """A step could not be solved; `result` holds what was computed before."""

    def __init__(self, result: Result) -> None:
        super().__init__(f"stopped at time {result.summary['time']:.6g} s: {result.summary['reason']}")
        self.result = result


class RunWarning(UserWarning):
    """What `dda run` prints as a warning; its notes go to the logger "polydda"."""


class Step(NamedTuple):
    """Where a run stands, for `on_step`."""

    number: int
    """Steps made."""
    of: int
    """Steps of the whole scene; a stage with `until` may need fewer."""
    time: float
    """s"""


def check(scene: Scene, settings: Sequence[str] = ()) -> list[Problem]:
    """Every problem of a scene, warnings too; an empty list when there is none. Computes nothing."""
    return [Problem(*problem) for problem in _core.check_text(*_text(scene, settings))]


def run(
    scene: Scene,
    out: str | os.PathLike[str] | None = None,
    on_step: Callable[[Step], object] | None = None,
    threads: int = 1,
    settings: Sequence[str] = (),
    force: bool = False,
) -> Result:
    """Runs a scene to its end.

    `out` is the result directory; left out, results are in a temporary one that lives as long as the Result.
    Older results in `out` are renamed `out`.1, .2, ..., with `force` overwritten.
    `on_step` is called after every step; an exception that it raises ends the run, as Ctrl-C does, with the
    results written so far in `out`. `settings` are "PATH=VALUE", as for `dda run --set`. Other Python threads
    go on meanwhile. BLAS is held to one thread, for NumPy too where it shares OpenBLAS.

    Raises SceneError when the scene is wrong, AnalysisStopped when a step cannot be solved, OutputError when
    a file cannot be written.
    """
    keep = None
    if out is None:
        keep = tempfile.TemporaryDirectory(prefix="polydda-")
        out = keep.name
    if not 1 <= threads <= 1024:
        raise ValueError(f"threads is {threads}: from 1 to 1024")
    call = None if on_step is None else lambda *step: on_step(Step(*step))
    is_scene, problems, notes, found_warnings = _core.run_text(_text(scene, settings), os.fspath(out), threads, force, call)
    found = [Problem(*problem) for problem in problems]
    if not is_scene:
        raise SceneError(found)
    for text in notes:
        _log.info(text)
    for text in [problem.text for problem in found] + found_warnings:
        warnings.warn(text, RunWarning, stacklevel=2)
    result = Result(out, keep)
    if result.summary["status"] == "stopped":
        raise AnalysisStopped(result)
    return result


def _text(scene: Scene, settings: Sequence[str]) -> tuple[str, str, list[str], str]:
    """The text, its name in messages, the settings and the directory of the files that it names."""
    if isinstance(settings, str):
        raise TypeError(f"settings is a list of \"PATH=VALUE\": write settings=[{settings!r}]")
    if isinstance(scene, Mapping):
        return to_toml(scene), "dict", list(settings), ""
    if isinstance(scene, str) and "\n" in scene:
        return scene, "text", list(settings), ""
    path = pathlib.Path(scene)
    return path.read_text(encoding="utf-8"), str(scene), list(settings), str(path.parent)
