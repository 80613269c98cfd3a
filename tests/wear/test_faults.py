"""The messages that a user reads when something is wrong."""

from wear.faults import MOST_FAULTS_SHOWN, Fault, SceneError


def test_a_fault_names_what_it_has() -> None:
    whole = Fault("scene.toml", None, "", "", "is empty", "start from a built-in scene")
    assert str(whole) == "scene.toml: is empty; start from a built-in scene"
    lacking = Fault("scene.toml", None, "", "load", "missing", "add a table [load]")
    assert str(lacking) == "scene.toml: load: missing; add a table [load]"


def test_scene_error_does_not_flood_the_terminal() -> None:
    faults = [Fault("a.toml", n, "", "x", "unknown key", "drop it") for n in range(200)]
    lines = str(SceneError(faults)).splitlines()
    assert lines[:-1] == [str(fault) for fault in faults[:MOST_FAULTS_SHOWN]]
    assert lines[-1] == f"... and {200 - MOST_FAULTS_SHOWN} more faults"
    assert SceneError(faults).faults == tuple(faults)
