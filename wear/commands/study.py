"""`wear study`: many scenes that differ in a few numbers.

examples:
  wear study section4 --vary bearing.roughness_growth=0.1:0.4:31 \\
      --vary bearing.wear_coefficient=1e-8:1e-5:31:log --cycles 1e6 -o map.zarr
  wear study section4 --vary "bearing.hardness_MPa=normal(200,15)" --design sobol \\
      --samples 4096 --seed 1 --cycles 9000,1e6 --until-wear 0.01 -o life.zarr
  wear study ... --dry-run              number of scenes, time and disk space alone
  wear study ... --workers 8            eight processes
  wear study ... --scheduler tcp://host:8786    the workers of a Dask cluster
  wear study ... --figure map.png       a picture of the results

The same command again resumes a study that was stopped.
"""

from __future__ import annotations

import logging
import re
import time
from argparse import ArgumentTypeError
from collections.abc import Iterator
from concurrent.futures import Executor
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from derive import files, terminal
from derive.command_line import Answer, Options, Parser, declare
from wear import processes
from wear.commands import arguments
from wear.words import shown

if TYPE_CHECKING:
    from wear.studies.rows import Study

LONGEST_WAIT = 10  # seconds for a scheduler to answer
FIRST_ROWS, LEAST_SECONDS = 64, 0.5  # of a dry run, which solves more rows until it took as long


def add_arguments(parser: Parser) -> None:
    """Declare the scene, the varied keys, the requested results, and the workers."""
    from wear.studies.design import DESIGNS

    arguments.add_scene(parser)
    about = (
        "a number of the scene that varies: KEY=low:high:count, KEY=low:high:count:log or "
        "KEY=a,b,c in a grid; KEY=uniform(a,b), loguniform(a,b), normal(mean,sd) or "
        "lognormal(median,factor) in samples; may be repeated"
    )
    declare(parser, "--vary KEY=VALUES", about, action="append", default=[])
    arguments.add_cycles(parser, "numbers of cycles", "9000")
    about = f"{', '.join(DESIGNS)} (default: %(default)s)"
    declare(parser, "--design DESIGN", about, lambda: DESIGNS, default="grid")
    samples, seeds = arguments.whole(0, 10**9), arguments.whole(0, 2**63)
    declare(parser, "--samples N", "number of samples", type=samples, default="0")
    about = "seed of the samples (default: %(default)s)"
    declare(parser, "--seed SEED", about, type=seeds, default="0")
    arguments.add_depth(parser, "also the number of cycles to this wear depth")
    arguments.add_rtol(parser, 1e-13, "1e-7", of="")
    declare(parser, "-o, --output OUT.zarr", "folder of the results", required=True)
    where = parser.add_mutually_exclusive_group()
    about = "processes on this machine (default: one for each core)"
    declare(where, "--workers N", about, type=arguments.whole(1, 1024))
    about = "use the workers of the Dask scheduler that runs there"
    declare(where, "--scheduler ADDRESS", about, type=_address)
    declare(parser, "--dry-run", "report the number of scenes, the time and the disk space")
    about = "also draw the results: .png, .svg, .pdf"
    declare(parser, "--figure FILE", about, type=arguments.file(*arguments.PICTURES))


def _address(text: str) -> str:
    """Return the address of a scheduler, with its port."""
    if not re.fullmatch(r"((tcp|tls|ucx|wss?)://)?(\[[\da-fA-F:]+\]|[^:/\s]+):\d+", text):
        raise ArgumentTypeError(f'"{shown(text)}" is not an address such as tcp://host:8786')
    return text


def execute(options: Options) -> Answer:
    """Run a study, or estimate its cost."""
    from wear.studies.run import prepare, run

    arguments.read(options).stop_if_any()
    workers = options.workers or processes.cores()
    request = prepare(
        options.scene, options.vary, options.cycles, options.design, options.samples,
        options.seed, options.until_wear, options.rtol,
    )  # fmt: skip
    if options.dry_run:
        return _dry_run(request, workers)
    with _executor(options.scheduler, workers) as executor, terminal.busy("solving") as tell:
        store = run(request, Path(options.output), executor, tell)
    results = store.dataset()
    notices = results.attrs["notices"]
    arguments.strict_faults(notices, options).stop_if_any()
    if options.figure is not None:
        from wear.figure_style import encoded
        from wear.studies.figures import picture

        drawn = encoded(picture(results), options.figure.suffix)
        files.write_atomically(options.figure, drawn)
    counts = store.counts()
    done = ", ".join(
        f"{number} {name.replace('_', ' ')}" for name, number in counts.items() if number
    )
    document = {"output": options.output, "rows": counts, "notices": notices}
    return Answer(document, lambda: f"{options.output}: {done}", notices)


def _dry_run(request: Study, workers: int) -> Answer:
    """Solve a few rows, and report the estimated cost of all."""
    from wear.benchmark.results import duration
    from wear.studies.design import ROWS
    from wear.studies.rows import solve_rows
    from wear.studies.store import disk_bytes

    rows, tried, spent = request.design.rows, FIRST_ROWS // 4, 0.0
    solve_rows(request, request.design.random_rows(2))  # imports
    while spent < LEAST_SECONDS and tried < ROWS:
        tried *= 4
        start = time.process_time()
        solve_rows(request, request.design.random_rows(tried))
        spent = time.process_time() - start
    seconds = spent / tried * rows
    size = disk_bytes(request)
    return Answer(
        {"scenes": rows, "core_seconds": seconds, "disk_bytes": size},
        lambda: (
            f"{rows} scenes, about {duration(seconds)} of one core "
            f"({duration(seconds / workers)} on {workers}), up to {size / 1e6:.3g} MB on disk"
        ),
    )


def _executor(scheduler: str | None, workers: int) -> AbstractContextManager[Executor | None]:
    """Return the workers: those of a Dask cluster, local processes, or none for one core."""
    if scheduler is not None:
        return _cluster(scheduler)
    return nullcontext() if workers == 1 else processes.workers(workers)


@contextmanager
def _cluster(address: str) -> Iterator[Executor]:
    """Provide the workers of a running Dask scheduler."""
    from wear.faults import UsageError

    try:
        from distributed import Client
    except ImportError as fault:
        raise UsageError("--scheduler needs Dask: pip install 'derive-wear[study]'") from fault
    logging.disable()  # faults of the cluster are reported once, by our message
    try:
        client = Client(address, timeout=LONGEST_WAIT, set_as_default=False)
    except (OSError, ValueError) as fault:
        raise UsageError(
            f"--scheduler: nothing answers at {address}: start one, or correct it"
        ) from fault
    try:
        yield client.get_executor()
    finally:
        with suppress(OSError, RuntimeError):  # the scheduler may be lost
            client.close(timeout=LONGEST_WAIT)
