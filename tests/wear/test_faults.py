"""The messages that a user reads when something is wrong."""

from wear.faults import MOST_FAULTS_SHOWN, AccuracyError, Fault, SceneError


def test_fault_without_line_or_table() -> None:
    fault = Fault("scene.toml", None, "", "load", "missing", "add a table [load]")
    assert str(fault) == "scene.toml: load: missing; add a table [load]"


def test_fault_of_a_whole_file() -> None:
    fault = Fault("scene.toml", None, "", "", "is empty", "start from a built-in scene")
    assert str(fault) == "scene.toml: is empty; start from a built-in scene"


def test_scene_error_tells_all_faults() -> None:
    faults = [Fault("a.toml", n, "bearing", f"key{n}", "unknown key", "drop it") for n in (1, 2)]
    assert str(SceneError(faults)).splitlines() == [str(fault) for fault in faults]
    assert SceneError(faults).faults == tuple(faults)


def test_scene_error_does_not_flood_the_terminal() -> None:
    faults = [Fault("a.toml", n, "", "x", "unknown key", "drop it") for n in range(200)]
    lines = str(SceneError(faults)).splitlines()
    assert len(lines) == MOST_FAULTS_SHOWN + 1
    assert lines[-1] == f"... and {200 - MOST_FAULTS_SHOWN} more faults"
    assert len(SceneError(faults).faults) == 200


def test_accuracy_error_keeps_the_best_result() -> None:
    assert AccuracyError("reached 1e-9 only").best is None
