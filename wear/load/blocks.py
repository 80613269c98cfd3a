"""Periodic loads one after the other."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wear.load.phase import FloatArray, inside

if TYPE_CHECKING:
    from wear.load import Load


class Block(NamedTuple):
    """A periodic load, run for a number of whole cycles."""

    load: Load
    cycles: int


@dataclass(frozen=True)
class Blocks:
    """Periodic loads one after the other, each from phase 0, and the list again `repeat` times.

    U_a may jump where one block gives way to the next; there the value is that of the new block.
    """

    blocks: tuple[Block, ...]
    repeat: int = 1

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
            raise ValueError(f"cycle {cycles!r} outside the load, which has {self.cycles!r}")
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
