// Numerics of the explorer: wear over any number of cycles from few of them.
//
// A cycle is integrated by Dormand and Prince's pair of order 5(4). Over many cycles the wear is
// an envelope v(n) with v(n + 1) - v(n) = D(v), D being the wear of one cycle; it solves
// v' = g(v), g = D - D D'/2 + D D'^2/3 + D^2 D''/12 - ..., a series in the small number D'. The
// first cycles are taken one by one until D' is small; then n(v) = integral of 1/g, panel by
// panel of Chebyshev points. The model itself (rates, pressures, fields) is generated.
"use strict";

const WEAR_TOLERANCE = 1e-9;
const MOST_EVALUATIONS = 1.5e6; // of a load with up to a hundred corners, else in proportion
const MOST_PANELS = 400;
const PANEL_TOLERANCE = 1e-8;
const LOOSE_TOLERANCE = 1e-5; // where the rate has corners and halving a panel helps little
const SMALL_SLOPE = 4e-3; // of D: beyond, cycles are taken one by one
const BEND_WIDTH = 1e-8; // phase to which a bend of the rate is located
const JUMP_WIDTH = 1e-14; // and a jump
const GRID = 128; // phases of a cycle at which contact is looked for

// The load: displacement of the pin in mm against phase, in cycles.

function makeLoad(data, size) {
  const turn = 2 * Math.PI;
  if (data.kind === "sine") {
    return finished(data, (x) => size * Math.sin(turn * x), (x) => size * turn * Math.cos(turn * x));
  }
  if (data.kind === "constant") return finished(data, () => size * data.value_mm, () => 0);
  if (data.kind === "harmonics") {
    const terms = [...data.cosine_mm.keys(), ...data.sine_mm.keys()];
    const orders = [...new Set(terms)].map((index) => index + 1);
    const part = (x, slope) => orders.reduce((sum, order) => {
      const a = data.cosine_mm[order - 1] ?? 0;
      const b = data.sine_mm[order - 1] ?? 0;
      const w = turn * order;
      return sum + (slope ? w * (b * Math.cos(w * x) - a * Math.sin(w * x))
        : a * Math.cos(w * x) + b * Math.sin(w * x));
    }, slope ? 0 : data.mean_mm);
    return finished(data, (x) => size * part(x, false), (x) => size * part(x, true));
  }
  const { phase, value } = data; // a table, from phase 0 to phase 1
  const at = (x) => {
    const inside = x - Math.floor(x);
    let k = 1; // of the first row after it
    let high = phase.length - 1;
    while (k < high) {
      const middle = (k + high) >> 1;
      if (phase[middle] <= inside) k = middle + 1;
      else high = middle;
    }
    return [k, inside];
  };
  const slope = (k) => (value[k] - value[k - 1]) / (phase[k] - phase[k - 1]);
  return finished(data, (x) => {
    const [k, inside] = at(x);
    return size * (value[k - 1] + slope(k) * (inside - phase[k - 1]));
  }, (x) => size * slope(at(x)[0]));
}

function finished(data, value, slope) {
  const grid = Array.from({ length: GRID + 1 }, (_, i) => i / GRID);
  const stops = [...new Set([...grid, ...(data.stops ?? [])])].sort((a, b) => a - b);
  const values = stops.map(value);
  const least = (pick) => stops[values.indexOf(pick(...values))];
  return {
    value, slope, stops,
    corners: [...new Set([0, ...(data.stops ?? []), 1])].sort((a, b) => a - b),
    peak: least(Math.max), trough: least(Math.min),
    maximum: Math.max(...values), minimum: Math.min(...values), mean: mean(stops, values),
  };
}

function mean(x, y) {
  let sum = 0;
  for (let i = 1; i < x.length; i += 1) sum += (x[i] - x[i - 1]) * (y[i] + y[i - 1]) / 2;
  return sum;
}

// One step of Dormand and Prince's pair.

function step(f, x, y, h) {
  const k1 = f(x, y);
  const k2 = f(x + h / 5, y + h * k1 / 5);
  const k3 = f(x + 3 * h / 10, y + h * (3 * k1 / 40 + 9 * k2 / 40));
  const k4 = f(x + 4 * h / 5, y + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9));
  const k5 = f(x + 8 * h / 9, y + h * (19372 * k1 / 6561 - 25360 * k2 / 2187
    + 64448 * k3 / 6561 - 212 * k4 / 729));
  const k6 = f(x + h, y + h * (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247
    + 49 * k4 / 176 - 5103 * k5 / 18656));
  const end = y + h * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192
    - 2187 * k5 / 6784 + 11 * k6 / 84);
  const k7 = f(x + h, end);
  const error = h * (71 * k1 / 57600 - 71 * k3 / 16695 + 71 * k4 / 1920
    - 17253 * k5 / 339200 + 22 * k6 / 525 - k7 / 40);
  return [end, Math.abs(error)];
}

// A solver for one model: `functions` generated, `c` their bound constants, `period` in s.

function makeSolver(functions, c, load, period) {
  let evaluations = 0;
  const budget = MOST_EVALUATIONS * Math.max(1, load.corners.length / 100);
  let most = budget;
  const ends = functions.margin !== undefined;
  const jumps = ends && functions.residual === undefined; // a support makes the jump a bend
  const rate = jumps ? functions.rate : functions.right_hand_side;
  const speed = (phase, u) => {
    evaluations += 1;
    return period * rate(u, load.value(phase), c);
  };
  const margin = (phase, u) => functions.margin(u, load.value(phase), c);

  // Wear gained from `from` to `to` in smooth contact; `until` may end it where it turns negative.
  function advance(from, to, u, scale, until) {
    let x = from;
    let gained = 0;
    let h = Math.min(to - from, 1 / 48);
    const f = (phase, y) => speed(phase, u + y);
    while (x < to) {
      h = Math.min(h, to - x);
      if (evaluations > most) return { gained: NaN, x: to };
      const [next, error] = step(f, x, gained, h);
      const size = WEAR_TOLERANCE * Math.max(scale, Math.abs(next));
      if (error > size && h > 1e-12) {
        h *= Math.max(0.2, 0.9 * (size / error) ** 0.2);
        continue;
      }
      if (until && until(x + h, u + next) < 0) {
        return ended(f, x, gained, h, u, until);
      }
      x = x + h >= to ? to : x + h;
      gained = next;
      h = Math.min(h * (error > 0 ? Math.min(4, 0.9 * (size / error) ** 0.2) : 4), 1 / 12);
    }
    return { gained, x: to };
  }

  function ended(f, x, gained, h, u, until) {
    let low = 0;
    let high = h;
    while (high - low > (jumps ? JUMP_WIDTH : BEND_WIDTH)) {
      const middle = (low + high) / 2;
      if (until(x + middle, u + step(f, x, gained, middle)[0]) < 0) high = middle;
      else low = middle;
    }
    return { gained: step(f, x, gained, high)[0], x: x + high, left: true };
  }

  // Wear of a span of phases; contact may come and go, in Filippov's sense where it jumps.
  function span(from, to, u, scale) {
    if (!jumps) {
      const corners = load.corners.map((corner) => Math.floor(from) + corner);
      let gained = 0;
      let x = from;
      for (const end of [...corners.filter((corner) => corner > from && corner < to), to]) {
        while (x < end) {
          const until = ends ? unbent(x, u + gained) : undefined;
          const done = advance(x, end, u + gained, Math.max(scale, gained), until);
          gained += done.gained;
          x = done.x;
        }
      }
      return gained;
    }
    return interrupted(from, to, u, scale);
  }

  // On a support the rate bends where contact ends and where the support lets go no further:
  // positive as long as none of both is passed.
  function unbent(x, u) {
    const branch = (phase, depth) => {
      const left = margin(phase, depth);
      if (left <= 0) return 0;
      const most = functions.limited_pressure(Infinity, left, c.compliance, c);
      return functions.pressure(depth, load.value(phase), c) < most ? 2 : 1;
    };
    const now = branch(x, u);
    return (phase, depth) => (branch(phase, depth) === now ? 1 : -1);
  }

  function interrupted(from, to, start, scale) {
    const stops = load.stops.map((stop) => Math.floor(from) + stop);
    const ends = [...stops.filter((stop) => stop > from && stop < to), to];
    let u = start;
    let x = from;
    for (const end of ends) {
      let turns = 0;
      while (x < end && turns < 8) {
        turns += 1;
        const gap = margin(x, u);
        const edge = Math.abs(gap) <= 1e-13 * Math.abs(load.maximum - load.minimum || 1);
        const rising = load.slope(x + 1e-9) > 0;
        if (!edge && gap < 0 || edge && !rising) {
          x = touching(x, end, u);
        } else if (edge && slides(x, u)) {
          [x, u] = slide(x, end, u);
        } else {
          const done = advance(x, end, u, scale, margin);
          u += done.gained;
          x = done.x;
        }
      }
      x = end;
    }
    return u - start;
  }

  // Out of contact: the phase at which it begins, or the end.
  function touching(x, end, u) {
    if (margin(end, u) <= 0) return end;
    let low = x;
    let high = end;
    for (let i = 0; i < 60; i += 1) {
      const middle = (low + high) / 2;
      if (margin(middle, u) < 0) low = middle;
      else high = middle;
    }
    return high;
  }

  const following = (x, u) => -load.slope(x) / functions.margin_slope(u, c);
  const slides = (x, u) => functions.margin_slope(u, c) < 0 && following(x, u) < speed(x, u);

  // On the edge of contact wear keeps up with the load: margin(u, U_a) = 0.
  function slide(x, end, u) {
    const pieces = 4;
    let at = x;
    let worn = u;
    for (let i = 1; i <= pieces; i += 1) {
      const next = x + (end - x) * i / pieces;
      let candidate = worn;
      for (let k = 0; k < 30; k += 1) {
        candidate -= margin(next, candidate) / functions.margin_slope(candidate, c);
      }
      if (load.slope(next) <= 0 || !slides(next, candidate)) return [next, Math.max(candidate, worn)];
      at = next;
      worn = candidate;
    }
    return [at, worn];
  }

  // Wear of one whole cycle.
  function cycle(u, scale) {
    return span(0, 1, u, scale);
  }

  // A further budget: what is shown of single cycles does not fail where the count has spent its own.
  const renew = () => {
    most = evaluations + budget;
  };
  return { cycle, span, renew, cost: () => evaluations };
}

// Chebyshev points of a panel, and the matrices that differentiate and integrate through them.

const ORDER = 8;
const NODES = Array.from({ length: ORDER + 1 }, (_, i) => -Math.cos(Math.PI * i / ORDER));
const WEIGHTS = NODES.map((_, i) => (i % 2 ? -1 : 1) * (i === 0 || i === ORDER ? 0.5 : 1));

function interpolate(values, x) {
  let top = 0;
  let bottom = 0;
  for (let i = 0; i <= ORDER; i += 1) {
    const distance = x - NODES[i];
    if (distance === 0) return values[i];
    top += WEIGHTS[i] / distance * values[i];
    bottom += WEIGHTS[i] / distance;
  }
  return top / bottom;
}

function differentiated(values) {
  return NODES.map((x, i) => NODES.reduce((sum, y, j) => (i === j ? sum
    : sum + WEIGHTS[j] / WEIGHTS[i] * (values[j] - values[i]) / (x - y)), 0));
}

function coefficients(values) {
  return NODES.map((_, k) => {
    let sum = 0;
    for (let i = 0; i <= ORDER; i += 1) {
      const half = i === 0 || i === ORDER ? 0.5 : 1;
      sum += half * values[i] * Math.cos(Math.PI * k * (1 - i / ORDER));
    }
    return sum * 2 / ORDER * (k === 0 || k === ORDER ? 0.5 : 1);
  });
}

function integrated(values) { // from the first node to each
  const a = coefficients(values);
  const b = a.map((_, k) => (k === 0 ? 0
    : ((k === 1 ? 2 : 1) * a[k - 1] - (a[k + 1] ?? 0)) / (2 * k)));
  b.push(a[ORDER] / (2 * (ORDER + 1)));
  const sum = (x) => b.reduce((total, value, k) => total + value * Math.cos(k * Math.acos(x)), 0);
  const start = sum(-1);
  return NODES.map((x) => sum(Math.max(-1, Math.min(1, x))) - start);
}

// Wear against cycles, up to `wanted`: points, a function for any number of cycles, notices.
// `smooth(u)`: from this wear on, the wear of a cycle changes smoothly with wear. `rough(u)`: there
// is roughness left, without which the model has no meaning.
// Cycles are taken one by one where they differ much, by panels elsewhere.

function wearOverCycles(solver, wanted, smooth, rough) {
  const points = [{ n: 0, u: 0 }];
  const panels = [];
  let n = 0;
  let u = 0;
  let gained = 0; // by the last cycle; errors are measured by it
  let before = NaN;
  let width = 0; // of the next panel; none: cycles one by one
  let halvings = 0;
  let coarsest = 0;
  let ending = "";
  while (n < wanted && !ending) {
    if (width === 0) {
      gained = solver.cycle(u, Math.abs(gained));
      const slope = (gained - before) / before; // D' = dD/du over the last cycle
      before = gained;
      // where contact ends for good, roundoff may leave a touch at the peak of the load
      const stopped = smooth(u) ? gained === 0 : gained <= 1e-14 * u;
      if (!Number.isFinite(gained)) ending = "limit";
      else if (!rough(u + gained)) ending = "vanished";
      else if (stopped) ending = "arrest";
      else if (n > 8 && Math.abs(slope) < SMALL_SLOPE && smooth(u)) {
        width = gained * Math.max(8, 0.2 * n);
      } else {
        u += gained;
        n += 1;
        points.push({ n, u });
      }
      continue;
    }
    const panel = panels.length < MOST_PANELS ? makePanel(solver, u, width, n, gained) : {};
    const meant = panel.n !== undefined && rough(panel.u[ORDER]) && panel.slope < 2 * SMALL_SLOPE;
    const narrow = width <= gained;
    const allowed = halvings < 4 && !narrow ? PANEL_TOLERANCE : LOOSE_TOLERANCE;
    if (!(meant && panel.error <= allowed)) {
      width = narrow ? 0 : width / 2;
      before = NaN;
      if (meant) halvings += 1;
      continue;
    }
    halvings = 0;
    coarsest = Math.max(coarsest, panel.error);
    panels.push(panel);
    for (let i = 1; i <= ORDER; i += 1) points.push({ n: panel.n[i], u: panel.u[i] });
    n = panel.n[ORDER];
    u = panel.u[ORDER];
    gained = panel.least;
    width *= panel.error < 1e-11 ? 2 : 1.5;
  }
  const notices = noticesOf(ending, n, u, coarsest);
  if (ending === "arrest") {
    points.push({ n: wanted, u });
    n = wanted;
  }
  const reached = Math.min(Math.floor(n), wanted);
  return { points, reached, notices, at: (count) => wearAt(points, panels, count) };
}

function noticesOf(ending, n, u, coarsest) {
  const notices = [];
  if (ending === "arrest") {
    notices.push({ kind: "arrest", text: u > 0 ? `Wear stops in cycle ${Math.round(n)}.` : "Nothing wears." });
  }
  if (coarsest > PANEL_TOLERANCE) {
    const digits = Math.floor(-Math.log10(coarsest));
    notices.push({ kind: "accuracy", text: `Only accurate to about ${digits} digits.` });
  }
  const reasons = {
    vanished: "There the roughness vanishes, and with it the model.",
    limit: "Beyond, this page would be slow or inaccurate.",
  };
  if (reasons[ending]) {
    notices.push({ kind: "limit", text: `Carried to ${shown(Math.floor(n))} cycles only. ${reasons[ending]}` });
  }
  return notices;
}

function makePanel(solver, start, width, from, scale) {
  const u = NODES.map((x) => start + width * (x + 1) / 2);
  let least = scale;
  const gains = u.map((depth) => {
    const gain = solver.cycle(depth, least);
    if (gain > 0) least = Math.min(least, gain);
    return gain;
  });
  if (!gains.every((gain) => Number.isFinite(gain) && gain > 0)) return {};
  const d1 = differentiated(gains).map((value) => value * 2 / width);
  const d2 = differentiated(d1).map((value) => value * 2 / width);
  const inverse = gains.map((d, i) => 1
    / (d * (1 - d1[i] / 2 + d1[i] * d1[i] / 3 + d * d2[i] / 12)));
  const a = coefficients(inverse);
  const tail = Math.max(Math.abs(a[ORDER]), Math.abs(a[ORDER - 1])) / Math.abs(a[0]);
  const n = integrated(inverse).map((value) => from + value * width / 2);
  const slope = Math.max(...d1.map(Math.abs));
  return { u, n, error: tail, slope, start, width, least };
}

function wearAt(points, panels, count) {
  const panel = panels.find((one) => one.n[0] <= count && count <= one.n[ORDER]);
  if (points.length === 1) return points[0].u;
  if (!panel) {
    let k = 1;
    while (k < points.length - 1 && points[k].n < count) k += 1;
    const [a, b] = [points[k - 1], points[k]];
    return a.u + (b.u - a.u) * Math.min(1, (count - a.n) / (b.n - a.n));
  }
  let low = -1;
  let high = 1;
  for (let i = 0; i < 60; i += 1) {
    const middle = (low + high) / 2;
    if (interpolate(panel.n, middle) < count) low = middle;
    else high = middle;
  }
  return panel.start + panel.width * ((low + high) / 2 + 1) / 2;
}

function shown(number) {
  if (number === 0) return "0";
  const size = Math.abs(number);
  if (size >= 1e-3 && size < 1e6) return Number(number.toPrecision(5)).toString().replace("-", "\u2212");
  const [digits, power] = number.toExponential(4).split("e");
  const raised = String(Number(power)).replace("-", "\u207b").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d]);
  return `${Number(digits)} × 10${raised}`.replace("-", "\u2212");
}
