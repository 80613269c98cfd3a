"""Periodic loads one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import Annotated, NamedTuple, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, PlainValidator, ValidationError, ValidationInfo, model_validator
from pydantic_core import InitErrorDetails

from wear.checked import MOST_CYCLES, Count, SceneTable, all_wrong, below, table, wrong
from wear.faults import UsageError
from wear.load.phase import FloatArray, inside
from wear.load.protocols import Load
from wear.load.tables import PERIODIC, load_from

MOST_BLOCKS = 1000


class Block(NamedTuple):
    """A periodic load, run for a number of whole cycles."""

    load: Load
    cycles: int


@table("")
class BlockCycles(SceneTable):
    """What a block has beside its load."""

    cycles: Count = Field(description="number of cycles of this block")


def _blocks(raw: object, info: ValidationInfo) -> tuple[Block, ...]:
    """Return blocks from tables of a load's entries and `cycles`, or from `Block`s."""
    if not isinstance(raw, list | tuple) or not all(isinstance(b, Mapping | Block) for b in raw):
        raise wrong("is not a list of tables", "write [[load.blocks]] for each")
    if not 1 <= len(raw) <= MOST_BLOCKS:
        raise wrong(f"has {len(raw)} blocks", f"give from 1 to {MOST_BLOCKS}; see repeat")
    made: list[Block] = []
    faults: list[InitErrorDetails] = []
    for place, block in enumerate(raw):
        rest = block._asdict() if isinstance(block, Block) else dict(block)
        cycles = {key: rest.pop(key) for key in ("cycles",) if key in rest}
        try:
            checked = BlockCycles.__pydantic_validator__.validate_python(cycles)  # type: ignore[attr-defined]
        except ValidationError as error:
            faults += below(place, error)
        try:
            load = load_from(rest.get("load", rest), info, PERIODIC)
        except ValidationError as error:
            faults += below(place, error)
        if not faults:
            made.append(Block(load, checked.cycles))
    if faults:
        raise ValidationError.from_exception_data("blocks", faults)
    return tuple(made)


@table("load", kind="blocks")
class Blocks(SceneTable):
    """Periodic loads one after the other, each from phase 0, and the list again `repeat` times.

    U_a may jump where one block gives way to the next; there the value is that of the new block.
    """

    blocks: Annotated[tuple[Block, ...], PlainValidator(_blocks)] = Field(
        description="[[load.blocks]] tables: a periodic load each, and its cycles"
    )
    repeat: Count = Field(default=1, description="how often the list is run")

    @model_validator(mode="after")
    def _countable(self) -> Self:
        if self.cycles > MOST_CYCLES:
            problem = f"makes {self.cycles:.3g} cycles in all"
            raise all_wrong(("repeat", problem, f"stay below {MOST_CYCLES:.0e}"))
        return self

    def stretches(self) -> Iterator[Block]:
        """Every block in the order in which it runs, repeats included."""
        for _ in range(self.repeat):
            yield from self.blocks

    @cached_property
    def _starts(self) -> FloatArray:
        """Time in s at which each block starts in one round, and the end of the round."""
        lengths = [block.cycles * block.load.period for block in self.blocks]
        return np.asarray([math.fsum(lengths[:n]) for n in range(len(lengths) + 1)])

    @property
    def duration(self) -> float:
        return self.repeat * float(self._starts[-1])

    @property
    def cycles(self) -> float:
        return float(self.repeat * self._cycles_of_round)

    @property
    def _cycles_of_round(self) -> int:
        return sum(block.cycles for block in self.blocks)

    def time_at(self, cycles: float) -> float:
        if not 0.0 <= cycles <= self.cycles:
            raise UsageError(f"cycle {cycles!r} outside the load, which has {self.cycles!r}")
        rounds, rest = divmod(cycles, self._cycles_of_round)
        time = rounds * float(self._starts[-1])
        for block, start in zip(self.blocks, self._starts.tolist(), strict=False):
            if rest <= block.cycles:
                return float(time + start + rest * block.load.period)
            rest -= block.cycles
        raise AssertionError("a remainder is less than the cycles of a round")

    def value(self, time: FloatArray | float) -> FloatArray:
        given, block_of, phase = self._locate(time)
        result = np.empty_like(given)
        for place, block in enumerate(self.blocks):
            here = block_of == place
            result[here] = block.load(phase[here])
        return result

    def slope(self, time: FloatArray | float) -> FloatArray:
        given, block_of, phase = self._locate(time)
        result = np.empty_like(given)
        for place, block in enumerate(self.blocks):
            here = block_of == place
            result[here] = block.load.slope(phase[here]) / block.load.period
        return result

    def _locate(self, time: FloatArray | float) -> tuple[FloatArray, NDArray[np.intp], FloatArray]:
        """The times, the block of each, and the phase in the block's load."""
        given = inside(time, self.duration)
        rounds = np.minimum(np.floor(given / self._starts[-1]), self.repeat - 1)
        rest = np.clip(given - rounds * self._starts[-1], 0.0, self._starts[-1])
        block_of = np.clip(
            np.searchsorted(self._starts, rest, side="right") - 1, 0, len(self.blocks) - 1
        )
        periods = np.asarray([block.load.period for block in self.blocks])
        return given, block_of, (rest - self._starts[block_of]) / periods[block_of]

    def breakpoints(self, start: float, end: float) -> FloatArray:
        round_length = float(self._starts[-1])
        first = max(0, math.floor(start / round_length) - 1)
        last = min(self.repeat, math.ceil(end / round_length) + 1)
        found = [
            self._breaks_of_block(place, number * round_length, start, end)
            for number in range(first, last)
            for place in range(len(self.blocks))
        ]
        times = np.unique(np.concatenate([*found, [self.duration]]))
        return times[(times > start) & (times < end)]

    def _breaks_of_block(self, place: int, origin: float, start: float, end: float) -> FloatArray:
        """Start of a block, and the kinks of its load in every cycle that meets (start, end)."""
        load, cycles = self.blocks[place]
        begin = origin + float(self._starts[place])
        first = max(0, math.floor((start - begin) / load.period) - 1)
        last = min(cycles, math.ceil((end - begin) / load.period) + 1)
        if not load.kinks or last <= first:
            return np.asarray([begin])
        kinks = np.add.outer(np.arange(first, last), np.asarray(load.kinks)).ravel()
        return np.append(begin, begin + kinks * load.period)

    @property
    def minimum(self) -> float:
        return min(block.load.minimum for block in self.blocks)

    @property
    def maximum(self) -> float:
        return max(block.load.maximum for block in self.blocks)

    @property
    def mean(self) -> float:
        areas = (block.cycles * block.load.period * block.load.mean for block in self.blocks)
        return math.fsum(areas) / float(self._starts[-1])
