"""Periodic loads one after the other."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cached_property, partial
from typing import Annotated, Self

import numpy as np
from pydantic import Field, PlainValidator, ValidationError, ValidationInfo, model_validator

from wear.load.conversion import PERIODIC, load_from_table
from wear.load.periodic import Load
from wear.numerics.gauss import FloatArray
from wear.quantities import MOST_CYCLES
from wear.validation import Count, EntryError, Finding, SceneTable, problems, table, wrong

MOST_BLOCKS = 1000
Periodic = Annotated[Load, PlainValidator(partial(load_from_table, kinds=PERIODIC))]


@table("")
class Block(SceneTable):
    """A periodic load, run for a number of whole cycles."""

    load: Periodic
    cycles: Count = Field(description="number of cycles of this block")


def _blocks(raw: object, info: ValidationInfo) -> tuple[Block, ...]:
    """Return blocks from tables of a load's entries and `cycles`, or from `Block`s."""
    if not isinstance(raw, list | tuple) or not all(isinstance(b, Mapping | Block) for b in raw):
        raise wrong("is not a list of tables", "write [[load.blocks]] for each")
    if not 1 <= len(raw) <= MOST_BLOCKS:
        raise wrong(f"has {len(raw)} blocks", f"give from 1 to {MOST_BLOCKS}; see repeat")
    blocks, faults = list[Block](), list[Finding]()
    for place, block in enumerate(raw):
        if isinstance(block, Mapping) and "load" not in block:
            cycles = {key: block[key] for key in block if key == "cycles"}
            block = cycles | {"load": {key: block[key] for key in block if key != "cycles"}}
        try:
            validator = Block.__pydantic_validator__  # type: ignore[attr-defined]
            blocks.append(validator.validate_python(block, context=info.context))
        except ValidationError as error:
            for path, problem, remedy in problems(error):
                within = path[1:] if path[:1] == ("load",) else path
                faults.append(((place, *within), problem, remedy))
    if faults:
        raise EntryError(*faults)
    return tuple(blocks)


@table("load", kind="blocks")
class Blocks(SceneTable):
    """Periodic loads one after the other, each from phase 0; the whole list runs `repeat` times.

    U_a may jump between blocks; there the value is that of the new block.
    """

    blocks: Annotated[tuple[Block, ...], PlainValidator(_blocks)] = Field(
        description="[[load.blocks]] tables: a periodic load each, and its cycles"
    )
    repeat: Count = Field(default=1, description="how many times the whole list runs")

    @model_validator(mode="after")
    def _check_count(self) -> Self:
        if self.cycles > MOST_CYCLES:
            problem = f"makes {self.cycles:.3g} cycles in all"
            raise wrong(problem, f"stay below {MOST_CYCLES:.0e}", "repeat")
        return self

    @property
    def cycles(self) -> int:
        """Return the total number of cycles."""
        return self.repeat * self.cycles_of_round

    @cached_property
    def cycles_of_round(self) -> int:
        """Return the number of cycles of the list."""
        return sum(block.cycles for block in self.blocks)

    def time_at(self, cycles: FloatArray | float) -> FloatArray:
        """Return the time in s after numbers of cycles."""
        done = np.cumsum([0, *(block.cycles for block in self.blocks)])
        times = np.cumsum([0.0, *(block.cycles * block.load.period for block in self.blocks)])
        rounds, rest = np.divmod(cycles, done[-1])
        return np.asarray(rounds * times[-1] + np.interp(rest, done, times))

    @property
    def minimum(self) -> float:
        return min(block.load.minimum for block in self.blocks)

    @property
    def maximum(self) -> float:
        return max(block.load.maximum for block in self.blocks)

    @property
    def mean(self) -> float:
        lengths = [block.cycles * block.load.period for block in self.blocks]
        areas = (b.load.mean * length for b, length in zip(self.blocks, lengths, strict=True))
        return math.fsum(areas) / math.fsum(lengths)
