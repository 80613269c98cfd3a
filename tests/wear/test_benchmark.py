"""The benchmark: statuses, order of runs, medians, what readers learn, peers, the command."""

import csv
import io
import json
import math
from functools import partial
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from tests.programs import python
from tests.wear.reference_scenes import REFERENCE
from wear import benchmark
from wear.benchmark import Effort, Status, judge, results
from wear.benchmark.machine import footer, machine, missing
from wear.benchmark.methods import (
    CYCLES,
    OWN,
    Answer,
    Case,
    Method,
    UnsuitableError,
    cases,
)
from wear.binding import bind
from wear.commands import bench
from wear.direct.problem import scaled_ode
from wear.scene import load_scene

peers, jumps = bench.load_peers("peers"), bench.load_peers("jumps")
EFFORT = Effort(cap=10.0, repeated=5.0, rounds=3, rest=1e9)


class Clock:
    """Time that passes only while a method runs."""

    def __init__(self) -> None:
        self.now = 0.0

    def process_time(self) -> float:
        return self.now


@pytest.fixture
def clock(monkeypatch):
    clock = Clock()
    monkeypatch.setattr(benchmark, "time", clock)
    return clock


def method(name, clock, calls, error=0.0, times=lambda *_: 1.0, **answer) -> Method:
    """A method whose error is known and whose runs take what `times` says."""
    options = {"tolerances": (1e-6,)} | {k: answer.pop(k) for k in ("steps",) if k in answer}
    count: dict[int, int] = {}

    def run(cycles: int, _: float) -> Answer:
        count[cycles] = count.get(cycles, -1) + 1
        clock.now += times(cycles, count[cycles])
        calls.append((name, cycles))
        return Answer(2.0 * (1.0 + error), **answer)

    return Method(name, ("json",), lambda _: run, **options)


def made_cases(*cycles: int) -> tuple[Case, ...]:
    scene = load_scene("section4")
    return tuple(Case("section4", scene, number, 2.0) for number in cycles)


def test_statuses():
    assert judge(1e-7, 1e-6)[0] is Status.MET
    assert judge(-2e-6, 1e-6)[0] is Status.MISSED
    assert judge(0.02, 1e-6)[0] is Status.WRONG
    assert judge(1e-15, 1e-16)[0] is Status.MET  # nothing is better than roundoff
    assert judge(1e-9, 1e-6, Answer(1.0, complaint="gave up")) == (Status.REPORTED, "gave up")
    assert judge(1e-9, 1e-6, Answer(1.0, complaint="late", stopped=True))[0] is Status.STOPPED
    assert judge(math.nan, 1e-6)[0] is Status.REPORTED


def test_rounds_go_through_all_methods(clock):
    calls: list[tuple[str, int]] = []
    a, b = method("a", clock, calls), method("b", clock, calls)
    benchmark.benchmark([a, b], made_cases(1), EFFORT)
    first = [("a", 1), ("a", 1), ("b", 1), ("b", 1)]  # ready, then the first run
    assert calls == first + [("a", 1), ("b", 1)] * 3


def test_the_median_leaves_the_first_run_out(clock):
    took = {0: 7.0, 1: 4.0, 2: 1.0, 3: 3.0, 4: 2.0}  # the run that gets ready comes first
    runs, starts = benchmark.benchmark(
        [method("a", clock, [], times=lambda _, run: took[run])], made_cases(1), EFFORT
    )
    assert (runs[0].seconds, runs[0].repeats) == (2.0, 3)
    assert starts[0].seconds == 7.0


def test_a_run_that_would_be_too_long_is_predicted(clock):
    calls: list[tuple[str, int]] = []
    slow = method("a", clock, calls, times=lambda cycles, _: 0.01 * cycles)
    runs, _ = benchmark.benchmark([slow], made_cases(1, 100, 9000), EFFORT)
    by_cycles = {run.cycles: run for run in runs}
    assert by_cycles[100].repeats > 0
    assert by_cycles[9000].status is Status.SKIPPED
    assert by_cycles[9000].seconds == pytest.approx(90.0)
    assert ("a", 9000) not in calls


def test_a_method_that_counts_cycles_is_never_predicted(clock):
    flat = method("a", clock, [], times=lambda *_: 9.0, steps=False)
    runs, _ = benchmark.benchmark([flat], made_cases(1, 10**8), EFFORT)
    assert all(run.repeats == 1 for run in runs)


def test_an_unsuitable_scene_is_told_for_each_case():
    def prepare(_):
        raise UnsuitableError("no")

    picky = Method("a", ("json",), prepare, (1e-6,))
    runs, starts = benchmark.benchmark([picky], made_cases(1, 10), EFFORT)
    assert [(run.status, run.remark) for run in runs] == [(Status.UNSUITABLE, "no")] * 2
    assert starts == ()


@pytest.fixture
def result(clock):
    """Four methods: right and quick, right and slow, off, and silently wrong."""
    makers = [
        method("quick", clock, [], 1e-12, lambda *_: 0.002, estimate=1e-11, evaluations=7),
        method("slow", clock, [], 1e-12, lambda cycles, _: 0.02 * cycles),
        method("off", clock, [], 1e-4, lambda *_: 0.001),
        method("wrong", clock, [], -0.4, lambda *_: 0.001),
    ]
    runs, starts = benchmark.benchmark(makers, made_cases(1, 100, 9000), EFFORT)
    return results.Result(machine(), runs, starts, {"quick": 0.1}, {"absent": ("nothing",)})


def test_times_are_compared_at_equal_true_error(result):
    here = benchmark.grouped(result.measurements, "cycles")[100]
    assert [entry.method for entry in results.best(here, 6)] == ["quick", "slow"]
    assert [entry.method for entry in results.best(here, 3)] == ["off", "quick", "slow"]
    cells = [results.cell(here, name, 6) for name in ("quick", "slow", "off", "wrong")]
    assert cells == ["2 ms", "2 s (1000x)", "off by 1e-4", "off by 40 %"]
    assert (
        results.cell(benchmark.grouped(result.measurements, "cycles")[9000], "slow", 6) == "~ 3 min"
    )


def test_the_sentence_names_the_fastest_and_the_ratio(result):
    one, hundred, many = results.sentences(result.shown)
    assert "use quick: it takes 2 ms; slow takes 10 times as long" in one
    assert "100 cycles" in hundred
    assert "1000 times" in hundred
    assert "no other method reached them" in many
    assert "no method tried reaches them" in results.sentences(result.shown, 14)[0]


def test_silent_failures_are_listed(result):
    assert [row[0] for row in results.failure_table(result.measurements).rows] == ["wrong"]


def test_the_raw_csv_reads_back(result):
    rows = list(csv.DictReader(io.StringIO(results.csv_text(result.measurements))))
    assert len(rows) == len(result.measurements)
    for row, run in zip(rows, result.measurements, strict=True):
        assert row["method"] == run.method
        assert float(row["seconds"]) == run.seconds
        assert row["estimate"] == ("" if run.estimate is None else repr(run.estimate))


def test_report_and_documentation_have_the_same_figures():
    written = (bench.PEERS / "speed.md").read_text(encoding="utf-8")
    assert results.markdown(results.committed()) == written


def test_markdown_tables_have_no_loose_ends(result):
    text = results.markdown(result)
    widths = {line.count("|") for line in results.markdown_table(results.tables(result)[0]).split()}
    assert "quick" in text
    assert "absent: not measured, nothing not installed" in text
    assert footer(dict(result.machine)) in text
    for block in text.split("\n\n"):
        if block.startswith("|"):
            assert len({line.count("|") for line in block.splitlines()}) == 1
    assert widths


def test_references_are_those_of_the_tests():
    labels = {"section3": "S1", "section4": "S2", "fast-wear": "S4", "f-one-eighth": "S5"}
    labels |= {"f-negative": "S6", "section3-support": "S8_1", "section4-support": "S8_2"}
    assert {case.name for case in cases("speed")} == set(labels)
    for case in cases("speed"):
        assert case.wear == REFERENCE[labels[case.name]][case.cycles]


@pytest.mark.parametrize("name", ["section4", "fast-wear"])
def test_own_methods_reach_what_they_promise(name):
    for made in OWN:
        run = made.prepare(load_scene(name))
        for case in cases("speed", [name], CYCLES):
            if case.cycles == 1 or not made.steps:
                answer = run(case.cycles, 1e-6)
                error = abs(answer.wear / case.wear - 1.0)
                if answer.estimate is not None:
                    assert error <= answer.estimate <= 1e-6
                else:
                    assert error < 0.3  # solve_ivp as it comes


@pytest.mark.parametrize("name", ["section3", "section4", "fast-wear", "f-zero"])
def test_a_traced_right_hand_side_is_the_generated_one(name):
    """With Python's own numbers as the peer's expressions."""
    scene = load_scene(name)
    given, model = peers.equation(scene), bind(scene)
    unit = scaled_ode(model, scene.periodic_load).unit
    for phase in (0.0, 0.2, 0.6):
        for y in (0.0, 3.0):
            load = scene.periodic_load(phase)
            rate = float(model.rate(y * unit, load)) * scene.periodic_load.period / unit
            assert given.traced(y, phase, math) == pytest.approx(rate, rel=1e-13)


def test_peers_refuse_what_they_are_not_set_up_for():
    for overrides in (["contact.ends_at_3_sigma=true"], ["support.stiffness_MPa_per_mm=1e5"]):
        with pytest.raises(UnsuitableError, match="not set up"):
            peers.equation(load_scene("section4", overrides))
    known = peers.functions(math)
    with pytest.raises(UnsuitableError, match="tanh"):
        np.tanh(peers.Traced(1.0, known))


def test_installed_peers_agree():
    """The extra `peers` is optional: those that are there are tried, in a process of their own, in
    which they leave their threads and folders."""
    code = """
from tests.wear.reference_scenes import REFERENCE
from wear.benchmark.machine import missing
from wear.commands.bench import load_peers
from wear.scene import load_scene
for peer in load_peers("peers").PEERS:
    if not missing(peer):
        wear = peer.prepare(load_scene("section4"))(10, 1e-9).wear
        assert abs(wear / REFERENCE["S2"][10] - 1) < 1e-5, peer.name
"""
    if not all(map(missing, peers.PEERS)):
        python(code, cwd=Path(__file__).parents[2])


@pytest.fixture(scope="module")
def cycles():
    """The cycles of the fastest wear of the comparison."""
    return jumps.cycles_of(load_scene("fast-wear"))


@pytest.mark.parametrize(
    ("method", "coarse", "fine", "order"),
    [
        (jumps.fixed_jumps, 1 / 90, 1 / 900, 1),
        (jumps.adaptive_jumps, 0.2, 0.02, 1),
        (jumps.envelope, 1e-2, 1e-4, 2),  # the estimate is one of first order
    ],
)
def test_jumps_are_of_the_order_that_they_claim(cycles, method, coarse, fine, order):
    """A tenth of the length, or of the root of the tolerance: 10^order times as exact."""
    errors = [abs(method(cycles, 9000, far) / REFERENCE["S4"][9000] - 1) for far in (coarse, fine)]
    assert np.log10(errors[0] / errors[1]) == pytest.approx(order, abs=0.5)


@pytest.mark.parametrize("tolerance", [1e-6, 1e-9])
def test_stroboscopic_averaging_keeps_its_tolerance(cycles, tolerance):
    for number in (100, 10**6):
        error = jumps.stroboscopic(cycles, number, tolerance) / REFERENCE["S4"][number] - 1
        assert abs(error) < tolerance


def test_the_page_on_jumps_has_what_is_measured(monkeypatch):
    monkeypatch.syspath_prepend(bench.PEERS)
    how_far = bench.load_peers("how_far")
    (case,) = cases("speed", ["section4"], [9000])
    one = jumps.cycles_of(case.scene)
    rows = [how_far.fixed(one, case, 10), how_far.adaptive(one, case, 0.1)]
    written = (bench.PEERS / "how-far.md").read_text()
    for line in results.markdown_table(how_far.table(rows)).splitlines():
        assert line in written
    assert all(0.9 < row.predicted / row.error < 1.1 for row in rows)


def test_the_end_of_contact_is_not_jumped_over():
    with pytest.raises(UnsuitableError, match="loss of contact"):
        jumps.cycles_of(load_scene("section4", ["contact.ends_at_3_sigma=true"]))


def test_the_figure_over_cycles_shows_what_was_expected(result):
    slow = results.curves_by_cycles(result.shown, 6)[1]
    assert (slow.name, slow.x.tolist()) == ("slow", [1, 100, 9000])
    assert slow.failed.tolist() == [False, False, True]
    assert slow.seconds[2] == pytest.approx(180.0)


@pytest.fixture
def wear(call, monkeypatch):
    """Run `wear bench` with the least effort; give status and results."""
    monkeypatch.setattr("wear.benchmark.methods.CYCLES", (1, 9000))
    monkeypatch.setattr(benchmark, "QUICK", Effort(cap=0.0, repeated=1.0, rounds=1, rest=0.5))

    return partial(call, "bench")


def test_the_command_prints_its_results_and_writes_its_files(wear, monkeypatch, tmp_path):
    """With one of the methods that `--peers` adds, all of which are tried above."""
    one = jumps.JUMPS[:1]
    added = {"jumps": SimpleNamespace(JUMPS=one), "peers": SimpleNamespace(PEERS=())}
    monkeypatch.setattr(bench, "load_peers", added.get)
    folder = tmp_path / "new"
    status, shown, _ = wear("--quick", "--peers", "-o", str(folder))
    assert status == 0
    assert "use abel" in shown
    expected = {"speed.csv", "speed-start.csv", "speed.md", "speed.json"}
    assert expected <= {file.name for file in folder.iterdir()}
    told = json.loads((folder / "speed.json").read_text())
    assert {run["method"] for run in told["measurements"]} == {m.name for m in (*OWN, *one)}
    assert len(told["sentences"]) == 2
    assert told["machine"]["cores"] >= 1
    counted = [run for run in told["measurements"] if run["method"] == "abel"]
    assert all(abs(run["error"]) <= run["tolerance"] for run in counted)


def test_a_place_that_cannot_be_written_is_told_before_the_work(wear, tmp_path):
    place = tmp_path / "file"
    place.write_text("mine")
    status, _, message = wear("--quick", "-o", str(place))
    assert status == 2
    assert "file" in message
    assert place.read_text() == "mine"


def test_an_installation_says_where_the_peers_are(wear, monkeypatch, tmp_path):
    monkeypatch.setattr(bench, "PEERS", tmp_path / "none")
    status, _, message = wear("--quick", "--peers")
    assert (status, "docs/bench" in message) == (2, True)


def test_the_hard_cases_have_no_peers(wear):
    status, _, message = wear("--hard", "--peers")
    assert (status, "--peers" in message) == (2, True)
