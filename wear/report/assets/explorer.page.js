// The page of the explorer: controls, what they change, and the check against Python.
"use strict";

const DATA = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const MICROMETRES = 1000; // in a millimetre; the model counts in mm
const loaded = {}; // generated functions by variant
let chosen; // the scene, whose numbers the controls change
const parameters = {}; // the numbers that hold; a field may show one that was refused

function functionsOf(variant) {
  loaded[variant] ??= MODELS[variant]();
  return loaded[variant];
}

// Controls and state.

function readState() {
  return {
    parameters: { ...parameters },
    law: $("law").value,
    pin: $("pin").value,
    compliant: $("compliant").checked,
    opening: $("opening").checked,
    cutoff: $("cutoff").checked,
    cycles: 10 ** Number($("cycles").value),
    logarithmic: $("logarithmic").checked,
  };
}

function variantOf(state) {
  if (chosen.load.area) return `${state.law}/given_load_${state.pin}`;
  return `${state.law}/${state.compliant ? "compliant" : "rigid"}_${state.pin}`
    + (state.cutoff ? "_ends_at_3_sigma" : "");
}

// A load that is no sine is multiplied by the number on the slider of the amplitude.
function rowOf(row) {
  if (row.name !== "U" || chosen.load.kind === "sine") return row;
  return { ...row, meaning: "the load is multiplied by", unit: "", scale: 1, low: 0.1, high: 10 };
}

function position(row, value) {
  return row.logarithmic ? Math.log10(Math.max(value, row.low * 1e-3)) : value;
}

function setNumber(row, value) {
  const slider = $(`slider-${row.name}`);
  const number = $(`number-${row.name}`);
  parameters[row.name] = value;
  const short = Number((value * row.scale).toPrecision(12));
  number.value = short !== 0 && Math.abs(short) < 1e-3 ? short.toExponential() : short;
  number.setCustomValidity("");
  const at = position(row, value);
  slider.min = Math.min(position(row, row.low), at);
  slider.max = Math.max(position(row, row.high), at);
  slider.value = at;
  slider.setAttribute("aria-valuetext", `${shown(value * row.scale)} ${row.unit}`);
}

function useScene(name) {
  chosen = DATA.scenes.find((scene) => scene.name === name);
  for (const row of DATA.parameters.map(rowOf)) {
    setNumber(row, chosen.parameters[row.name]);
    $(`meaning-${row.name}`).textContent = row.meaning;
    $(`unit-${row.name}`).textContent = row.unit;
  }
  for (const key of ["law", "pin"]) $(key).value = chosen[key];
  for (const key of ["compliant", "opening", "cutoff"]) $(key).checked = chosen[key];
  $("description").replaceChildren(symbols(chosen.description));
}

function enableWhatActs(state) {
  const wears = state.pin.startsWith("worn");
  $("opening").disabled = !wears;
  $("cutoff").disabled = Boolean(chosen.load.area);
  const acts = {
    K_a: wears, H_a: wears,
    sigma_a0: state.pin.endsWith("rough"), f_a: state.pin === "worn_rough",
    k: state.compliant,
  };
  for (const [name, active] of Object.entries(acts)) {
    $(`slider-${name}`).disabled = !active;
    $(`number-${name}`).disabled = !active;
  }
}

// What the controls say, solved.

function solveState(state) {
  const { area } = chosen.load;
  const functions = area ? underForce(functionsOf(`${state.law}/compliant_${state.pin}`), area)
    : functionsOf(variantOf(state));
  const k = area && !state.compliant ? Infinity : state.parameters.k;
  const c = functions.bind({ ...state.parameters, k }, state.opening ? 1 : -1);
  const load = makeLoad(chosen.load, state.parameters.U);
  const solver = makeSolver(functions, c, load, state.parameters.T);
  const jumps = functions.margin !== undefined && functions.residual === undefined;
  const settled = (u) => !jumps || functions.margin(u, load.minimum, c) >= 0
    || functions.margin_slope(u, c) > -1e-9;
  const fields = (u, U_a) => {
    const p = functions.pressure ? functions.pressure(u, U_a, c) : undefined;
    const found = functions.pressure ? functions.fields(p, u, U_a, c) : functions.fields(u, U_a, c);
    return jumps && functions.margin(u, U_a, c) < 0 ? { ...found, p: 0 } : found;
  };
  const rough = (u) => fields(u, load.minimum).sigma > 0;
  const history = wearOverCycles(solver, Math.round(state.cycles), settled, rough);
  solver.renew();
  return { functions, c, load, solver, fields, history };
}

// Where the load is a force it gives the pressure, and the displacement, which the page does not
// show, follows.
function underForce(functions, area) {
  const pressure = (R_a) => REACTION.pressure(R_a, area);
  return {
    bind: functions.bind,
    right_hand_side: (u, R_a, c) => functions.rate(pressure(R_a), c),
    fields: (u, R_a, c) => functions.fields(pressure(R_a), u, 0, c),
  };
}

// Pressure at phases of the cycle that starts with wear u, the peak of the load among them.
function insideCycle({ solver, load, fields }, u) {
  const pieces = Array.from({ length: 200 }, (_, i) => (i + 1) / 200);
  const phases = [...new Set([...pieces, load.peak])].filter((phase) => phase > 0).sort((a, b) => a - b);
  const scale = solver.cycle(u, 0);
  const points = [[0, fields(u, load.value(0)).p]];
  let worn = u;
  for (const phase of phases) {
    worn += solver.span(points.at(-1)[0], phase, worn, scale);
    points.push([phase, fields(worn, load.value(phase)).p]);
  }
  return points;
}

function draw(state, solved, inTheEnd) {
  const { history, load, fields } = solved;
  const points = history.points.filter((point) => point.n <= history.reached);
  const end = { n: history.reached, u: history.at(history.reached) };
  if (points.at(-1).n < end.n) points.push(end);
  const start = (u) => fields(u, load.value(0));
  const has = Object.keys(start(0));
  const over = (value) => points.map(({ n, u }) => [n, value(u)]);
  const micrometres = (value) => over((u) => MICROMETRES * value(u));
  const axis = { x: "number of cycles", logarithmic: state.logarithmic };
  const wear = [{ name: "bearing, u_c", points: micrometres((u) => u) }];
  if (has.includes("u_a")) wear.push({ name: "pin, u_a", points: micrometres((u) => start(u).u_a) });
  const { perCycle } = inTheEnd;
  if (perCycle) wear.push({ name: "as if steady from the start", points: points.map(({ n }) => [n, MICROMETRES * n * perCycle]) });
  const measured = (chosen.readings ?? []).filter(([n]) => n <= end.n);
  if (measured.length) wear.push({ name: "measured", points: measured, dots: true });
  show("wear", wear, { ...axis, y: "wear in µm", zero: true });
  const rough = [{ name: "bearing, σ_c", points: micrometres((u) => start(u).sigma_c) }];
  if (has.includes("sigma_a")) {
    rough.push({ name: "pin, σ_a", points: micrometres((u) => start(u).sigma_a) });
    rough.push({ name: "both, σ", points: micrometres((u) => start(u).sigma) });
  }
  show("roughness", rough, { ...axis, y: "roughness in µm", zero: true });
  show("pressure", [
    { name: "at the peak of the load, as worn after the cycle", points: over((u) => fields(u, load.value(load.peak)).p) },
    { name: "mean of a cycle", points: means(points, wearOfUnit(state)) },
    { name: "at the end of a cycle", points: over((u) => start(u).p) },
  ], { ...axis, y: "pressure in MPa", zero: true });
  const last = Math.max(0, end.n - 1);
  const inside = insideCycle(solved, history.at(last));
  show("inside", [
    { name: "first cycle", points: insideCycle(solved, 0) },
    { name: `cycle ${shown(Math.max(1, end.n))}`, points: inside },
  ], { x: "phase in the cycle, t/T", y: "pressure in MPa", zero: true, logarithmic: false });
  const pressures = inside.map((point) => point[1]);
  return {
    ...end,
    peak: Math.max(...pressures),
    mean: (end.u - history.at(last)) / wearOfUnit(state),
    fraction: pressures.filter((p) => p > 0).length / pressures.length,
  };
}

// Wear of a cycle under a mean pressure of 1 MPa, mm: Archard's law.
const wearOfUnit = (state) => FORMULAS.wear_per_cycle({ ...state.parameters, p_inf: 1 });

// Mean pressure over the cycles between each point and the next.
function means(points, unit) {
  return points.slice(1).map(({ n, u }, i) => {
    const cycles = n - points[i].n;
    return [cycles > 1 ? n - cycles / 2 : n, (u - points[i].u) / (cycles * unit)];
  });
}

function show(name, curves, options) {
  const names = plot($(`plot-${name}`), curves, options);
  $(`legend-${name}`).replaceChildren(...names.map((text, index) => {
    const item = document.createElement("span");
    const key = element("svg", { viewBox: "0 0 26 8", class: "key", "aria-hidden": "true" },
      curves[index].dots
        ? element("circle", { class: "dot", cx: 13, cy: 4, r: 3 })
        : element("path", { class: `curve curve-${index}`, d: "M1 4H25" }));
    item.append(key, symbols(text));
    return item;
  }));
}

// "u_c" in words becomes u with a lowered c.
function symbols(text) {
  const made = document.createElement("span");
  for (const [index, part] of text.split(/((?<!\w)\p{L}_\w(?!\w)|σ$)/u).entries()) {
    if (index % 2 === 0) made.append(part);
    else {
      const letter = document.createElement("i");
      const low = document.createElement("sub");
      letter.textContent = part[0];
      low.textContent = part.slice(2);
      made.append(letter, low);
    }
  }
  return made;
}

// Long-time behaviour, from generated formulas: the regime and what is known of it.

const REGIMES = {
  steady: "steady: in the long run every cycle wears off the same amount",
  partial: "steady, with contact in the same part of every cycle",
  closing: "steady: wear of the pin closes the gap without end",
  alike: "steady: every cycle is like the first",
  logarithmic: "logarithmic: wear goes on ever more slowly",
  saturating: "saturating: wear ends where the roughness would vanish",
  "finite-time": "finite-time: the roughness vanishes, and the model ends there",
  arrest: "arrest: the gap outgrows the roughness, and contact ends",
};

function longRun(state, { functions, c, load }) {
  const wears = state.pin.startsWith("worn");
  const own = state.parameters;
  if (chosen.load.area) {
    const pressure = REACTION.pressure(load.mean, chosen.load.area);
    return { kind: "steady", pressure, perCycle: FORMULAS.wear_per_cycle({ ...own, p_inf: pressure }), drift: 0 };
  }
  const rough = state.pin.endsWith("rough")
    ? { sigma_a0: own.sigma_a0, f_a: wears ? own.f_a : 0 } : { sigma_a0: 0, f_a: 0 };
  const data = {
    ...own, ...rough, kappa: wears ? FORMULAS.pin_wear(own) : 0,
    U_mean: load.mean, U_max: load.maximum, U_min: load.minimum,
  };
  data.q = FORMULAS.roughness_growth(data);
  data.g = (state.opening && wears ? FORMULAS.closure_growth_opening : FORMULAS.closure_growth)(data);
  data.p_1 = FORMULAS.cross_roughness(data);
  const vanishing = data.q !== 0 && FORMULAS.apart(data) === 0 ? FORMULAS.vanishing_wear(data) : -1;
  const oneSolid = data.kappa === 0 && data.sigma_a0 === 0;
  if (state.cutoff) {
    const depth = arrestDepth(functions.margin(0, load.maximum, c), oneSolid, data);
    if (depth !== undefined && !(vanishing > 0 && depth >= vanishing)) return { kind: "arrest", arrest: depth };
    if (depth === undefined && vanishing <= 0 && oneSolid && FORMULAS.gap_and_cutoff_grow_alike(data)) {
      return partial(state, data, load, (U_a) => functions.margin(0, U_a, c) >= 0);
    }
  }
  if (data.q === 0) return constantRoughness(data);
  if (vanishing > 0) {
    return { kind: FORMULAS.gap_at_peak(vanishing, data) > 0 ? "saturating" : "finite-time" };
  }
  const limit = FORMULAS.closure_ratio(data);
  data.p_inf = FORMULAS.pressure(FORMULAS[`share_${state.law}`](limit), data);
  return {
    kind: "steady",
    limit,
    pressure: data.p_inf,
    perCycle: FORMULAS.wear_per_cycle(data),
    drift: (state.compliant ? FORMULAS.log_coefficient_compliant : FORMULAS.log_coefficient)(
      FORMULAS[`steepness_${state.law}`](limit), data),
  };
}

// The wear at which the peak of the load no longer makes contact, if there is one.
function arrestDepth(marginAtPeak, oneSolid, data) {
  if (marginAtPeak <= 0) return 0;
  if (oneSolid) return FORMULAS.gap_outgrows_roughness(data) ? FORMULAS.arrest_depth(data) : undefined;
  let begin = 0;
  if (FORMULAS.gap_at_peak(begin, data) < 0) {
    if (data.g <= 0) return undefined;
    begin = FORMULAS.gap_opens(data);
  }
  if (!FORMULAS.margin_is_lost(begin, data)) return undefined;
  const depth = FORMULAS.arrest_depth_two_solids(begin, data);
  // A gap that closes has a second root, where it is less than -3 sigma.
  return FORMULAS.gap_at_peak(depth, data) > 0 ? depth : undefined;
}

function partial(state, data, load, touches) {
  const limit = FORMULAS.closure_ratio(data);
  const pressure = FORMULAS.pressure(FORMULAS[`share_${state.law}`](limit), data);
  const phases = Array.from({ length: 4096 }, (_, i) => (i + 0.5) / 4096);
  const part = phases.filter((phase) => touches(load.value(phase))).length / phases.length;
  return { kind: "partial", limit, pressure, perCycle: part * FORMULAS.wear_per_cycle({ ...data, p_inf: pressure }) };
}

function constantRoughness(data) {
  if (data.g > 0) return { kind: "logarithmic" };
  if (data.g === 0) return { kind: "alike" };
  const perCycle = FORMULAS.wear_per_cycle({ ...data, p_inf: data.p_max });
  return { kind: "closing", pressure: data.p_max, perCycle };
}

function tell(state, solved, end, found) {
  const number = (value, unit) => (value === undefined ? "does not apply" : `${shown(value)} ${unit}`.trim());
  const length = (value) => number(value && MICROMETRES * value, "µm");
  const rate = solved.solver.cycle(end.u, 0);
  const values = {
    regime: REGIMES[found.kind],
    "wear-now": length(end.u),
    "cycle-now": Number.isFinite(rate) ? length(rate) : "not found",
    "peak-now": number(end.peak, "MPa"),
    "mean-now": number(end.mean, "MPa"),
    "contact-now": number(end.fraction, ""),
    "limit-ratio": number(found.limit, ""),
    "limit-pressure": number(found.pressure, "MPa"),
    "limit-cycle": length(found.perCycle),
    "limit-drift": length(found.drift),
    "arrest-wear": length(found.arrest),
    variant: variantOf(state),
  };
  for (const [id, text] of Object.entries(values)) $(`value-${id}`).textContent = text;
  for (const node of document.querySelectorAll("[data-cycles]")) node.textContent = shown(end.n);
  const [regime] = REGIMES[found.kind].split(/[:,]/);
  const last = { perCycle: `${values["limit-cycle"]} a cycle in the end`, arrest: `ends at ${values["arrest-wear"]}` };
  const known = Object.keys(last).find((name) => found[name] !== undefined);
  $("summary").textContent = [
    `${values["wear-now"]} after ${shown(end.n)} cycles`, regime, ...(known ? [last[known]] : []),
  ].join(" \u00b7 ");
  showEquations(state, found.kind);
  const notices = solved.history.notices.map((notice) => notice.text);
  const fields = solved.fields(end.u, solved.load.value(0));
  if (Object.values(fields).some((value) => !(Math.abs(value) < 1e300))) {
    notices.push("These numbers are outside the range in which the model has a value.");
  }
  if (end.peak > state.parameters.p_max) notices.push("The contact does not carry this force: its pressure exceeds p_max.");
  if (fields.sigma_c < 0) notices.push("The roughness of the bearing is negative: beyond what the model means.");
  notify(notices);
}

function showEquations(state, regime) {
  const facts = { ...state, opening: state.opening && state.pin.startsWith("worn"), regime, load: chosen.load.kind };
  for (const row of document.querySelectorAll("[data-holds]")) {
    const holds = Object.entries(JSON.parse(row.dataset.holds));
    row.hidden = !holds.every(([choice, values]) => values.includes(facts[choice]));
  }
}

function notify(notices) {
  $("notices").replaceChildren(...notices.map((text) => {
    const item = document.createElement("li");
    item.textContent = text;
    return item;
  }));
}

function update() {
  const state = readState();
  enableWhatActs(state);
  const cycles = shown(Math.round(state.cycles));
  $("cycles-shown").textContent = cycles;
  $("cycles").setAttribute("aria-valuetext", cycles);
  showSceneFile(state);
  const started = performance.now();
  try {
    const solved = solveState(state);
    const inTheEnd = longRun(state, solved);
    tell(state, solved, draw(state, solved, inTheEnd), inTheEnd);
    $("value-time").textContent = `${Math.round(performance.now() - started)} ms, `
      + `${shown(solved.solver.cost())} right-hand sides`;
  } catch (fault) {
    notify(["This page cannot compute that. What it shows is the setting before."]);
    console.error(fault);
  }
  document.documentElement.dataset.ready = String(Number(document.documentElement.dataset.ready ?? 0) + 1);
}

// At most one update is under way; the last change counts.
let waiting = false;
function changed() {
  if (waiting) return;
  waiting = true;
  setTimeout(() => {
    waiting = false;
    update();
  }, 15);
}

// On loading: the same numbers as Python?

function checkAgainstPython() {
  let wear = 0;
  let rate = 0;
  let last = 0;
  for (const check of DATA.checks) {
    const scene = DATA.scenes.find((one) => one.name === check.scene);
    chosen = scene;
    const most = Math.max(...check.cycles);
    const state = { ...scene, cycles: most };
    const solved = solveState(state);
    for (const [index, n] of check.cycles.entries()) {
      if (n > solved.history.reached) continue; // the scene says how far it was carried
      const value = check.wear_mm[index];
      const own = solved.history.at(n);
      const error = value === 0 ? Math.abs(own) : Math.abs(own / value - 1);
      wear = Math.max(wear, Number.isNaN(error) ? Infinity : error);
      last = Math.max(last, n);
    }
    for (const [u, U_a, value] of check.rates) {
      const own = solved.functions.right_hand_side(u, U_a, solved.c);
      rate = Math.max(rate, value === 0 ? Math.abs(own) : Math.abs(own / value - 1));
    }
  }
  const good = wear <= DATA.agreement.wear && rate <= DATA.agreement.rate;
  const box = $("check");
  box.classList.add(good ? "good" : "bad");
  box.dataset.wear = wear;
  box.dataset.rate = rate;
  box.textContent = `${good ? "Checked" : "Does not agree with Python"}: wear rates within `
    + `${rate.toExponential(0)}, wear after up to ${shown(last)} cycles `
    + `within ${wear.toExponential(0)} of the values computed in Python (relative).`;
}

function faultOf(row, value) {
  if (!Number.isFinite(value)) return "Give a number.";
  if (row.positive && value <= 0) return "Give a number above zero.";
  return !row.negative && value < 0 ? "Give zero or a number above it." : "";
}

function begin() {
  const select = $("scene");
  for (const scene of DATA.scenes) select.add(new Option(scene.title, scene.name));
  checkAgainstPython();
  useScene(DATA.first);
  select.value = DATA.first;
  select.addEventListener("input", () => { useScene(select.value); update(); });
  $("reset").addEventListener("click", () => { useScene(select.value); update(); });
  for (const row of DATA.parameters) {
    $(`slider-${row.name}`).addEventListener("input", (event) => {
      const at = Number(event.target.value);
      setNumber(rowOf(row), Number((row.logarithmic ? 10 ** at : at).toPrecision(6)));
      changed();
    });
    $(`number-${row.name}`).addEventListener("change", (event) => {
      const { scale } = rowOf(row);
      const typed = event.target.valueAsNumber;
      const value = scale === 1 ? typed : Number((typed / scale).toPrecision(15));
      const fault = faultOf(row, value);
      event.target.setCustomValidity(fault);
      event.target.reportValidity();
      if (!fault) {
        setNumber(rowOf(row), value);
        changed();
      }
    });
  }
  for (const id of ["law", "pin", "compliant", "opening", "cutoff", "cycles", "logarithmic", "linear"]) {
    $(id).addEventListener("input", changed);
  }
  addEventListener("resize", changed);
  update();
}

begin();
