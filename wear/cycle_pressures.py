"""Pressures over a whole cycle: the peak, the mean that Archard integrates, the share in contact.

Overview
    A cycle is cut at the kinks and turning points of its load and sampled at the nodes of a Gauss
    rule, with the wear at each node. The mean follows from the wear of the cycle by Archard's law,
    Eq. (5), or from the rule where rounding errors dominate that; the peak is the largest value of
    the interpolant; contact begins and ends at roots of the margin.
Key results
    cycle_pressures    all three for many cycles of a scene
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

from wear.binding import bind
from wear.inside import Chunk, fields_of_stage, stages_with
from wear.load import Load
from wear.model import Model
from wear.numerics.floating_point import ROUNDOFF
from wear.numerics.gauss import FloatArray, Mesh, mesh
from wear.scene import Scene
from wear.scene.notices import CONTACT_REACH

NODES = 12  # on each interval
INTERVALS = 32  # of a cycle, at least: pulses of a hundredth of the period are resolved
FEW_NODES = 3  # on each interval of a load of many rows
MOST_KINKS = 200  # with all nodes
SAME = 1e-12  # of a cycle: the distance between phases that are one
RESOLVED = 1e-6  # of the peak: a larger tail of the interpolant rings
FINE = 4 * NODES  # points of an interval at which its interpolant is searched for the peak


class CyclePressures(NamedTuple):
    """Peak and mean pressure (n,) in MPa over n cycles, and the share (n,) of the period with
    p > 0; NaN where there is no such cycle."""

    peak: FloatArray
    mean: FloatArray
    contact_fraction: FloatArray


def cycle_pressures(scene: Scene, cycles: FloatArray, rtol: float) -> CyclePressures:
    """Return the pressures over the cycles that end after each of these numbers of cycles (n,).

    They are NaN before the first cycle.
    """
    pressures = np.full((3, len(cycles)), np.nan)
    starts = np.unique(cycles[cycles > 0]) - 1.0
    if not len(starts):
        return CyclePressures(*pressures)
    model = bind(scene)
    per_cycle = np.full((3, len(starts)), np.nan)
    rate = _wear_rate_per_pressure(model, scene)
    for stage in stages_with(model, scene.load, starts, rtol):
        on = _mesh(stage.load)
        phases = np.concatenate([on.edges, on.phases.ravel()])
        for part in fields_of_stage(model, stage, starts, phases, rtol):
            rows, per_pressure = np.searchsorted(starts, part.cycles), rate * stage.load.period
            per_cycle[:, rows] = _pressures(part, on, per_pressure, scene)
    pressures[:, cycles > 0] = per_cycle[:, np.searchsorted(starts, cycles[cycles > 0] - 1.0)]
    return CyclePressures(*pressures)


def _mesh(load: Load) -> Mesh:
    """Return the intervals of a cycle, on which the load is smooth."""
    marks = {0.0, 1.0, *load.kinks, *load.peaks}
    edges = np.unique(np.concatenate([sorted(marks), np.arange(INTERVALS) / INTERVALS]))
    keep = np.append(np.diff(edges) > SAME, True)
    return mesh(edges[keep], NODES if len(marks) <= MOST_KINKS else FEW_NODES)


def _wear_rate_per_pressure(model: Model, scene: Scene) -> float:
    """Return the wear rate per pressure, Eq. (5), in mm/s per MPa, from those at zero closure, or
    under a force of 1 N."""
    load = np.array(1.0 if scene.given_load else scene.closure)
    return float(model.rate(np.array(0.0), load)) / float(model.fields(np.array(0.0), load).p)


class _OnMesh(NamedTuple):
    """A quantity of n cycles at the edges (n, q + 1) and nodes (n, q, m) of a mesh."""

    edges: FloatArray
    nodes: FloatArray

    def fine(self, over: Mesh, points: int = FINE) -> FloatArray:
        """Return the interpolant of each interval at `points` + 1 points, its ends among them."""
        m = self.nodes.shape[-1]
        basis = legvander(2.0 * np.linspace(0.0, 1.0, points + 1)[1:-1] - 1.0, m - 1)
        inner = self.nodes @ over.rule.coefficients.T @ basis.T
        return np.concatenate([self.edges[:, :-1, None], inner, self.edges[:, 1:, None]], axis=-1)


def _sampled(values: FloatArray, over: Mesh) -> _OnMesh:
    edges = len(over.edges)
    return _OnMesh(values[:, :edges], values[:, edges:].reshape(len(values), *over.phases.shape))


def _pressures(part: Chunk, over: Mesh, wear_per_pressure: float, scene: Scene) -> CyclePressures:
    """Return peak, mean and contact fraction of cycles sampled at the edges and nodes;
    `wear_per_pressure` is the wear of a cycle over its mean pressure, mm/MPa. A given pressure is
    smooth between the edges even where it vanishes; without loss of contact pressure is never zero,
    even where it is too small for a number."""
    given_load, fields = scene.given_load, part.fields
    p = _sampled(fields.p, over)
    touching = _sampled(np.where(part.fields.p > 0.0, 1.0, -1.0), over)
    whole = np.min(touching.nodes, axis=-1) > 0.0
    whole &= (touching.edges[:, :-1] > 0.0) & (touching.edges[:, 1:] > 0.0)
    whole |= not (given_load or scene.contact.ends_at_3_sigma)
    fraction = np.ones(len(part.cycles))
    if not whole.all():
        margin = fields.p
        if not given_load:
            margin = CONTACT_REACH * fields.sigma - (fields.h - getattr(fields, "U_c", 0.0))
        fraction = _share_above_zero(_sampled(margin, over), touching, over, whole)
    whole |= given_load
    tail = np.max(np.abs(p.nodes @ over.rule.coefficients.T)[..., -2:], axis=-1)
    largest = np.maximum(np.max(p.edges, axis=1), np.max(p.nodes, axis=(1, 2)))
    smooth = whole & (tail <= RESOLVED * largest[:, None])
    inside = np.max(np.where(smooth, _largest(p.fine(over)), 0.0), axis=1)
    peak = np.where(fraction > 0.0, np.maximum(largest, inside), 0.0)
    rule_error = np.where(whole, tail, np.max(p.nodes, axis=-1)) @ over.lengths
    return CyclePressures(peak, _mean(part, p, over, rule_error, wear_per_pressure), fraction)


def _largest(values: FloatArray) -> FloatArray:
    """Return the largest value (n, q) of values (n, q, points), from the parabola through three."""
    at = np.clip(np.argmax(values, axis=-1), 1, values.shape[-1] - 2)[..., None]
    before, middle, after = (
        np.take_along_axis(values, at + step, axis=-1)[..., 0] for step in (-1, 0, 1)
    )
    curvature = before - 2.0 * middle + after
    rise, concave = np.zeros_like(curvature), curvature < 0.0
    np.divide((after - before) ** 2, -8.0 * curvature, out=rise, where=concave)
    between = np.abs(after - before) <= -2.0 * curvature  # the vertex
    return np.where(between, middle + rise, np.maximum(middle, np.maximum(before, after)))


def _mean(
    part: Chunk, p: _OnMesh, over: Mesh, rule_error: FloatArray, wear_per_pressure: float
) -> FloatArray:
    """Return the mean pressure (n,) in MPa from the wear of the cycle, or by the rule where its
    `rule_error` (n,) is smaller."""
    last = len(over.edges) - 1
    increment = part.u[:, last] - part.u[:, 0]
    by_wear, by_rule = increment / wear_per_pressure, p.nodes @ over.rule.weights @ over.lengths
    with np.errstate(invalid="ignore", over="ignore"):  # an unknown error, of no wear perhaps
        wear_error = (part.error + ROUNDOFF) * part.u[:, last] / wear_per_pressure
    return np.where(wear_error < rule_error, by_wear, by_rule)


def _share_above_zero(
    margin: _OnMesh, touching: _OnMesh, over: Mesh, whole: NDArray[np.bool_]
) -> FloatArray:
    """Return the share (n,) of the cycle in which the margin is positive, or contact is held at
    zero."""
    fine = margin.fine(over, 4 * FINE)
    held = np.max(touching.nodes, axis=-1, keepdims=True) > 0.0
    left, right = fine[..., :-1], fine[..., 1:]
    above = np.maximum(left, right), np.minimum(left, right)
    span = np.where(above[0] > above[1], above[0] - above[1], 1.0)
    share = np.where(above[1] >= 0.0, 1.0, np.clip(above[0], 0.0, None) / span)
    shares = np.where(whole, 1.0, np.mean(np.where(held, share, 0.0), axis=-1))
    return shares @ over.lengths
