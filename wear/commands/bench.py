"""`wear bench`: speed against true error, and the hard cases.

examples:
  wear bench                         own methods and SciPy's, about a minute
  wear bench --peers -o speed        with heyoka, diffrax, ... as installed; files into speed/
  wear bench --quick --json          one scene, ten seconds
  wear bench --hard                  the hard cases: how each method fails
"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear.commands import arguments
from wear.faults import UsageError

if TYPE_CHECKING:
    from wear.benchmark import Measurement
    from wear.benchmark.results import Result, TextTable

PEERS = Path(__file__).parents[2] / "docs" / "bench"
HARD_SECONDS, HARD_SECONDS_QUICK = 2.0, 0.3


def add_arguments(parser: Parser) -> None:
    """Declare the methods, the effort and the output folder."""
    about = (
        "also cycle jumps and averaging, and those installed of heyoka, diffrax, JiTCODE, "
        "SUNDIALS, numba (pip install 'derive-wear[peers]'); in a checkout of the source"
    )
    declare(parser, "--peers", about)
    effort = parser.add_mutually_exclusive_group()
    declare(effort, "--quick", "one scene, short runs")
    declare(effort, "--full", "more scenes, long runs")
    declare(parser, "--hard", "the hard cases instead of speed")
    arguments.add_folder(parser, "write tables, raw CSV, JSON and the figure there")


def execute(options: Options) -> Answer:
    """Measure speed or hard cases, and report."""
    faults = arguments.read(options)
    if options.hard and options.peers:
        faults.append("--peers: the hard cases are for the package's own methods and SciPy's")
    faults.stop_if_any()
    return _hard(options) if options.hard else _speed(options)


def _speed(options: Options) -> Answer:
    from wear.benchmark import results
    from wear.benchmark.machine import footer

    result = _measure(options)
    document = results.document(result)
    if options.output is not None:
        contents: dict[str, str | bytes] = {
            "speed.csv": results.csv_text(result.measurements),
            "speed-start.csv": results.csv_text(result.start_up),
            "speed.md": results.markdown(result),
            "speed.json": terminal.json_text(document),
        }
        files.write_all(options.output, contents | _figures(result.shown))
    lines = [*map(_text, results.tables(result)), *document["sentences"], "", *result.absences]
    return Answer(document, lambda: "\n".join([*lines, footer(result.machine)]))


def _measure(options: Options) -> Result:
    from wear import benchmark
    from wear.benchmark.machine import import_seconds, machine, missing
    from wear.benchmark.methods import CYCLES, FEW, ONE, OWN, cases
    from wear.benchmark.results import Result

    methods = OWN
    if options.peers:
        methods += (*load_peers("jumps").JUMPS, *load_peers("peers").PEERS)
    absent = {method.name: lack for method in methods if (lack := missing(method))}
    methods = tuple(method for method in methods if method.name not in absent)
    facts = machine(options.peers)
    terminal.progress("imports")
    timed = () if options.quick else methods
    imports = {method.name: import_seconds(method.imports) for method in timed}
    if options.quick:
        chosen, effort = cases("speed", ONE, CYCLES), benchmark.QUICK
    elif options.full:
        chosen, effort = cases("speed", cycles=CYCLES), benchmark.FULL
    else:
        chosen, effort = cases("speed", FEW, CYCLES), benchmark.DEFAULT
    runs, starts = benchmark.benchmark(methods, chosen, effort, terminal.progress)
    terminal.progress("")
    return Result(facts, runs, starts, imports, absent)


def load_peers(name: str) -> ModuleType:
    """Return a module of other methods, "jumps" or "peers", from the folder `docs/bench`.

    Raises
    ------
    UsageError
        if this is no checkout of the source.
    """
    if not PEERS.is_dir():
        raise UsageError(
            "--peers: the other methods are set up in docs/bench of the source, "
            "which is not installed; run `wear bench --peers` in a checkout of the repository"
        )
    specification = spec_from_file_location(name, PEERS / f"{name}.py")
    assert specification is not None
    assert specification.loader is not None
    module = module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def _figures(runs: Sequence[Measurement]) -> dict[str, bytes]:
    """Return the figures by file name: time against the number of cycles, and against true error
    for numbers of cycles at which methods can be compared."""
    from wear.benchmark.results import DIGITS, comparable, curves, curves_by_cycles
    from wear.figure_style import encoded
    from wear.figures import speed_against_cycles, speed_against_error

    drawn = {
        f"speed-{cycles}.svg": speed_against_error(curves(of_cycles))
        for cycles, of_cycles in comparable(runs).items()
    }
    if by_cycles := curves_by_cycles(runs, DIGITS[0]):
        drawn["speed-cycles.svg"] = speed_against_cycles(by_cycles)
    return {name: encoded(figure, ".svg") for name, figure in drawn.items()}


def _hard(options: Options) -> Answer:
    from wear.benchmark import hard
    from wear.benchmark.machine import footer, machine
    from wear.benchmark.methods import cases
    from wear.benchmark.results import csv_text

    chosen = [case for case in cases("hard") if not options.quick or case.cycles <= 10]
    limit = HARD_SECONDS_QUICK if options.quick else HARD_SECONDS
    facts = machine()
    runs = hard.hard_cases(chosen, limit, terminal.progress)
    terminal.progress("")
    if options.output is not None:
        page = hard.markdown(runs, footer(facts))
        contents = {"hard-cases.csv": csv_text(runs), "hard-cases.md": page}
        files.write_all(options.output, contents)
    lines = [*map(_text, (hard.overview(runs), hard.failures(runs))), hard.LEGEND, footer(facts)]
    document = {"machine": facts, "cases": [entry._asdict() for entry in runs]}
    return Answer(document, lambda: "\n".join(lines))


def _text(table: TextTable) -> str:
    """Return a table for the terminal, its first column left-aligned."""
    width = max((len(row[0]) for row in table.rows), default=0)
    rows = [(row[0].ljust(width), *row[1:]) for row in table.rows]
    return f"{table.caption}\n\n{terminal.table(table.header, rows)}\n"
