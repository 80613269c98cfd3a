"""Whatever the bytes, the answer is a scene or a clean list of faults."""

import string
from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

from wear.faults import SceneError
from wear.scene import Scene, builtin_names, load_scene, parse_scene
from wear.validation import TABLES

NAMES = sorted(
    {"title", "description", "load", "kind", "cycles", "blocks"}
    | {name for table in TABLES for name in (table.place, table.kind, *table.entries) if name}
)
TEXTS = [load_scene(name).to_toml() for name in ("section3", "section4", "soft-support")]

words = st.sampled_from(NAMES) | st.text(string.ascii_letters + "_.-\"'[]=\x1b", max_size=12)
scalars = (
    st.none()
    | st.booleans()
    | st.integers()
    | st.integers(10**300, 10**320)
    | st.floats()
    | st.text(max_size=20)
    | words
)
values = st.recursive(
    scalars, lambda inner: st.lists(inner, max_size=4) | st.dictionaries(words, inner, max_size=4)
)


def check_answer(answer: Scene | SceneError) -> None:
    """A scene that can be written and read again, or faults that can be printed."""
    if isinstance(answer, Scene):
        assert parse_scene(answer.to_toml()) == answer
        assert all(isinstance(value, float) for value in answer.parameters().values())
        assert answer.closure >= 0.0 < answer.initial_roughness
        assert answer.variant.module
        assert all(answer.notices)
        return
    assert answer.faults
    for fault in answer.faults:
        assert fault.problem
        assert fault.remedy
    assert all(line.isprintable() for line in str(answer).split("\n"))


def read(data: bytes | str, *overrides: str) -> Scene | SceneError:
    try:
        return parse_scene(data, overrides=overrides)
    except SceneError as error:
        return error


@settings(max_examples=300)
@given(st.text(st.sampled_from("[]{}='\"#.,\n\\ ae_1-+"), max_size=80))
def test_texts_that_look_like_toml(text: str) -> None:
    check_answer(read(text))


@settings(max_examples=300)
@given(st.sampled_from(TEXTS), st.data())
def test_damaged_texts(text: str, data: st.DataObject) -> None:
    raw = bytearray(text.encode())
    for _ in range(data.draw(st.integers(1, 4))):
        start = data.draw(st.integers(0, len(raw)))
        end = start + data.draw(st.integers(0, 6))
        raw[start:end] = data.draw(st.binary(max_size=4) | st.sampled_from([b"e999", b"-", b"[["]))
    check_answer(read(bytes(raw)))


@settings(max_examples=120)
@given(st.sampled_from(builtin_names()), st.data())
def test_changed_tables(name: str, data: st.DataObject) -> None:
    tables: dict[str, Any] = load_scene(name).to_tables()
    for _ in range(data.draw(st.integers(1, 3))):
        table = data.draw(st.sampled_from(sorted(tables)) | words)
        if not isinstance(tables.get(table), dict) or data.draw(st.integers(0, 5)) == 0:
            tables[table] = data.draw(values)
            continue
        key = data.draw(st.sampled_from(sorted(tables[table]) or ["kind"]) | words)
        if data.draw(st.booleans()):
            tables[table].pop(key, None)
        else:
            tables[table][key] = data.draw(values)
        if not tables:
            break
    try:
        answer: Scene | SceneError = Scene.from_dict(tables)
    except SceneError as error:
        answer = error
    check_answer(answer)


@settings(max_examples=300)
@given(st.lists(st.builds("{}.{}={}".format, words, words, scalars) | st.text(), max_size=3))
def test_any_override(overrides: list[str]) -> None:
    check_answer(read(TEXTS[0], *overrides))
