"""`polydda.run`, `check` and `read`: physics against formulas, errors, interruption."""

import math
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import polydda
import pytest

G, ANGLE, FRICTION = 9.81, math.radians(45), math.radians(20)


def slide(friction=20.0, steps=20):
    """A block on a ramp of 45 degrees."""
    return {
        "format": 1,
        "analysis": {"steps": steps, "time_step": 0.01, "gravity": [0.0, -G]},
        "material": [{"name": "rock", "density": 2500.0, "young": "35 GPa", "poisson": 0.3}],
        "joint": [{"name": "interface", "friction_angle": friction}],
        "block": [
            {"name": "ramp", "vertices": [[0, 0], [12, 0], [0, 12]], "material": "rock", "fixed": True},
            {"name": "slider", "vertices": np.array([[1.0, 11], [3, 9], [4, 10], [2, 12]]), "material": "rock"},
        ],
        "monitor": [{"name": "slider", "block": "slider", "at": "centroid"}],
    }


def test_numpy_is_imported_with_the_first_array(tmp_path):
    scene = slide(steps=1)
    scene["block"][1]["vertices"] = scene["block"][1]["vertices"].tolist()
    program = f"""
import sys, polydda
result = polydda.run({scene!r}, {str(tmp_path / "out")!r})
assert result.summary["status"] == "completed" and "numpy" not in sys.modules
assert result.blocks["sxx_mean"].shape == (2,) and "numpy" in sys.modules
assert result.frame().contacts["normal_force"].sum() > 0
"""
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True)


def test_a_block_slides_with_the_acceleration_of_coulombs_law(tmp_path):
    result = polydda.run(slide(), tmp_path / "out")
    row = result.monitors[-1]
    acceleration = G * (math.sin(ANGLE) - math.tan(FRICTION) * math.cos(ANGLE))
    travelled = math.hypot(row["ux"], row["uy"])
    assert travelled == pytest.approx(acceleration * row["time"] ** 2 / 2, rel=2e-3)
    assert result.summary["status"] == "completed"
    assert polydda.read(tmp_path / "out").summary == result.summary


def test_stresses_in_five_lines():
    result = polydda.run(slide())
    frame = result.frame()
    assert frame.stress.shape == (2, 3) and np.isfinite(frame.stress).all()
    assert frame.displacement.base is not None and not frame.displacement.flags.writeable
    weight = 2500 * G * 4
    normal = frame.contacts["normal_force"].sum()
    assert normal == pytest.approx(weight * math.cos(ANGLE), rel=1e-3)
    assert set(result.blocks["block"]) == {"ramp", "slider"}


def test_a_view_outlives_its_frame():
    positions = polydda.run(slide()).frame(0).position
    assert positions[:3].tolist() == [[0, 0], [12, 0], [0, 12]]


def test_problems_have_place_and_cure():
    scene = slide()
    scene["joint"][0]["friction_angel"] = 10
    (problem,) = [p for p in polydda.check(scene) if p.severity == "error"]
    assert "friction_angle" in problem.text and problem.line > 1
    with pytest.raises(polydda.SceneError, match="friction_angel"):
        polydda.run(scene)
    assert polydda.check(slide()) == []


def test_on_step_sees_every_step_and_may_end_the_run(tmp_path):
    steps = []
    polydda.run(slide(), on_step=steps.append)
    assert [step.number for step in steps] == list(range(1, 21)) and steps[-1].of == 20
    assert steps[-1].time == pytest.approx(0.2)

    def give_up(step):
        if step.number == 5:
            raise KeyError("enough")

    with pytest.raises(KeyError, match="enough"):
        polydda.run(slide(), tmp_path / "out", on_step=give_up)
    result = polydda.read(tmp_path / "out")
    assert result.summary["status"] == "interrupted" and result.summary["steps_completed"] == 5


def test_other_threads_go_on_while_a_scene_runs():
    ticks, over = [], threading.Event()

    def tick():
        while not over.wait(0.001):
            ticks.append(time.monotonic())

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.monotonic()
    polydda.run(slide(steps=3000), settings=["output.every=0"])
    end = time.monotonic()
    over.set()
    thread.join()
    inside = sum(start < t < end for t in ticks)
    assert inside > 50 * (end - start)


def test_ctrl_c_ends_a_run(tmp_path):
    code = (
        "import polydda, sys; sys.path.insert(0, sys.argv[2]); from test_scenes import slide\n"
        "polydda.run(slide(steps=10**7), sys.argv[1], settings=['output.every=0'],"
        " on_step=lambda s: s.number == 10 and print('going', flush=True))"
    )
    process = subprocess.Popen(
        [sys.executable, "-c", code, tmp_path / "out", __file__.rsplit("/", 1)[0]],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    )
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in errors
    assert polydda.read(tmp_path / "out").summary["status"] == "interrupted"


def test_ctrl_c_ends_the_set_up_before_anything_is_written(tmp_path):
    wall = slide(steps=10**7)
    wall["block"][1]["vertices"] = wall["block"][1]["vertices"].tolist()
    wall["analysis"]["mode"] = "static"
    wall["block"].append(
        {"vertices": [[0, 100], [1, 100], [1, 100.5], [0, 100.5]], "material": "rock", "grid": {"count": [60, 40], "step": [1.0, 0.5]}}
    )
    code = "import polydda, sys; print('going', flush=True); polydda.run(eval(sys.argv[2]), sys.argv[1])"
    process = subprocess.Popen(
        [sys.executable, "-c", code, tmp_path / "out", repr(wall)], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )
    process.stdout.readline()
    time.sleep(0.1)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in errors
    assert not (tmp_path / "out").exists()


def test_threads_are_as_many_as_on_the_command_line():
    for threads in (0, 1025):
        with pytest.raises(ValueError, match="from 1 to 1024"):
            polydda.run(slide(), threads=threads)


def test_settings_are_a_list():
    with pytest.raises(TypeError, match="settings="):
        polydda.run(slide(), settings="output.every=0")


def test_a_text_a_path_and_a_dict_are_the_same_scene(tmp_path):
    from polydda.toml_text import to_toml

    text = to_toml(slide())
    path = tmp_path / "slide.toml"
    path.write_text(text)
    ends = [polydda.run(scene).monitors[-1]["ux"] for scene in (text, path, str(path), slide())]
    assert len(set(ends)) == 1


def test_plot_draws_the_blocks():
    import matplotlib

    matplotlib.use("Agg")
    result = polydda.run(slide())
    for field in ("s1", "displacement", "velocity", "rotation"):
        axes = result.plot(field)
        (blocks,) = axes.collections
        assert len(blocks.get_paths()) == 2
    with pytest.raises(ValueError, match="write one of"):
        result.plot("s3")
