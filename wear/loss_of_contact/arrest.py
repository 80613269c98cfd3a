"""Iterates of the period map between two grazing wears or towards the limit wear; and where double
precision does not resolve the cycles, or wear has stopped."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wear.loss_of_contact.increments import TO_ROUNDOFF, Coordinate, IncrementSeries
from wear.numerics.floating_point import TINY
from wear.numerics.gauss import BoolArray, FloatArray, IntArray
from wear.orbit.abel import Density
from wear.orbit.iterates import CountTable, Iterates

NO_DIGIT = 0.1  # relative error
RESOLVABLE = 1e5  # times the uncertainty of the limit wear


class LimitWear(NamedTuple):
    """The limit `wear` (mm), at which the peak of the load just fails to make contact, with its
    `uncertainty` (mm) by rounding."""

    wear: float
    uncertainty: float

    @property
    def nearest(self) -> float:
        """Return the smallest distance (mm) from it at which cycles are integrated."""
        return RESOLVABLE * self.uncertainty


class TabulatedIterates(NamedTuple):
    """Iterates by a `table` of the number of cycles n as a function of z, the coordinate of the
    wear in the `series` of the increments; n is the integral of the density on `panels`. The
    estimated error of n, `count_error`, where each cell starts and where the last one ends; the
    `limit_wear` at the end of the table, if any; and the number of `whole` cycles in it, up to
    rounding of the limit wear."""

    series: IncrementSeries
    table: CountTable
    density: Density
    count_error: FloatArray
    limit_wear: LimitWear | None
    limit: FloatArray
    whole: float

    @property
    def coordinate(self) -> Coordinate:
        """Return the coordinate z of the wear."""
        return self.series.coordinate

    @property
    def in_z(self) -> Iterates:
        """Return the same iterates with z as the state."""
        begin, none, edges = self.table.u[:1][None], np.zeros((1, 1)), np.array([[0.0, 1.0]])
        limit = np.array([np.inf])
        return Iterates(begin, none, self.table, self.density, self.count_error[None], limit, edges)

    def take(self, rows: IntArray) -> TabulatedIterates:
        """Return these iterates, which are of one scene."""
        return self

    @property
    def first_increment(self) -> FloatArray:
        """Return the increment (mm) of the first cycle."""
        return self.coordinate.rate(self.table.u[:1], self.table.first_rate[:1])

    @property
    def last_state(self) -> FloatArray:
        """Return the wear (mm) after the last cycle."""
        if self.limit_wear:
            return np.array([self.limit_wear.wear])
        return self.coordinate.wear(self.table.ends[-1:])

    @property
    def reach(self) -> float:
        """Return the number of cycles in the table, no less than the whole ones."""
        last = self.table.last_cycles
        return last if self.limit_wear else max(last, self.whole)

    @property
    def at_rest(self) -> BoolArray:
        """Return whether the increment of the last cycle is below rounding."""
        return np.array([self.limit_wear is not None])

    @property
    def whole_cycles(self) -> FloatArray:
        """Return the number of whole cycles."""
        return np.array([self.whole])

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (1, c), and its estimated relative error."""
        (z, rate), shape = self.table.state_after(cycles.ravel()), cycles.shape
        z, error_of_z = z.reshape(shape), rate.reshape(shape) * self._error_at(cycles)
        if self.limit_wear:
            distance = np.where(cycles < self.reach, 1.0 / z, 0.0)
            wear = self.limit_wear.wear - distance
            error = self.limit_wear.uncertainty + np.minimum(error_of_z * distance, 1.0) / z
            return wear, error / wear
        wear = self.coordinate.wear(z)
        error = self.coordinate.rate(z, error_of_z) / np.where(wear > 0.0, wear, 1.0)
        return wear, np.where((error < NO_DIGIT) & (cycles <= self.reach), error, np.inf)

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each wear (mm, (1, c)) is reached, infinite beyond
        the end, and the error of the count in cycles."""
        if self.limit_wear:
            within = self.limit_wear.wear - wear > TO_ROUNDOFF * self.limit_wear.wear
        else:
            within = wear <= self.last_state
        count, error = np.full(wear.shape, np.inf), np.zeros(wear.shape)
        z = np.clip(self.coordinate.at(wear[within]), self.table.u[0], self.table.ends[-1])
        found = self.table.cycles_at(z)
        uncertain = self._error_at(found)
        if self.limit_wear:
            uncertain += self.limit_wear.uncertainty * z**2 / self.table.state_after(found)[1]
        # A wear that is reached at the very end of a cycle takes no other one.
        count[within] = np.maximum(np.ceil(found - uncertain), 0.0)
        error[within] = 2 * uncertain
        return count, error

    def _error_at(self, cycles: FloatArray) -> FloatArray:
        ends = np.append(self.table.cycles, self.table.last_cycles)
        return np.interp(cycles, ends, self.count_error)


class UnresolvedIterates(NamedTuple):
    """Iterates between the wears `start` and `last_state` (1,), mm, so near to each other that
    double precision does not resolve the `reach` cycles (1,) between them; the wear is known up to
    `uncertainty` (1,), mm. At rest there are none."""

    start: FloatArray
    last_state: FloatArray
    reach: FloatArray
    uncertainty: FloatArray

    def take(self, rows: IntArray) -> UnresolvedIterates:
        """Return these iterates, which are of one scene."""
        return self

    @property
    def ends(self) -> FloatArray:
        """Return the wear (mm) at both ends."""
        return np.concatenate([self.start, self.last_state])

    @property
    def limit(self) -> FloatArray:
        """Return infinity: the model has no limit here."""
        return np.full(1, np.inf)

    @property
    def at_rest(self) -> BoolArray:
        """Return whether wear has stopped."""
        return np.asarray(self.reach == 0.0)

    @property
    def whole_cycles(self) -> FloatArray:
        """Return the number of whole cycles."""
        return np.ceil(self.reach)

    @property
    def first_increment(self) -> FloatArray:
        """Return the mean increment (mm) of a cycle."""
        return (self.last_state - self.start) / np.maximum(self.reach, 1.0)

    def after(self, cycles: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the wear (mm) after `cycles` (1, c), and its relative error."""
        wear = np.minimum(self.start + cycles * self.first_increment, self.last_state)
        return wear, self.uncertainty / wear

    def until(self, wear: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the whole cycles after which each wear (mm, (1, c)) is reached, infinite beyond,
        and the error in cycles; at rest none is reached any more."""
        reached = (wear <= self.last_state) & ~self.at_rest
        taken = np.maximum(wear - self.start, 0.0) / (self.first_increment + TINY)
        return np.where(reached, np.ceil(taken), np.inf), self.reach + np.zeros(wear.shape)
