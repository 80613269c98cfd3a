// What the controls of the explorer say, as a scene file: everything that acts, and nothing else.
"use strict";

function sceneFile(state) {
  const { U, T } = state.parameters;
  const { kind, rows, period_s } = chosen.load;
  const what = kind === "force" ? "forces" : "displacements";
  const tables = Object.entries({ ...keysThatAct(state), load: loadEntries(state.parameters) });
  const parts = tables.map(([name, entries]) => [
    "", `[${name}]`, ...Object.entries(entries).map(([key, value]) => `${key} = ${toml(value)}`), "",
  ].join("\n"));
  const other = rows && (U !== 1 || T !== period_s);
  return [
    `title = ${toml(chosen.title)}\n`, ...parts,
    ...(other ? [`# to be multiplied in that file: its ${what} by ${U}, its times by ${T / period_s}\n`] : []),
  ];
}

function toml(value) {
  if (Array.isArray(value)) return `[${value.map(toml).join(", ")}]`;
  return Math.abs(value) > 0 && Math.abs(value) < 1e-2 ? value.toExponential() : JSON.stringify(value);
}

function keysThatAct(state) {
  const tables = { bearing: {}, pin: {}, contact: { law: state.law, ends_at_3_sigma: state.cutoff }, support: {}, motion: {} };
  for (const [symbol, [table, key]] of Object.entries(DATA.keys)) tables[table][key] = state.parameters[symbol];
  const wears = state.pin.startsWith("worn");
  const rough = state.pin.endsWith("rough");
  if (!wears) tables.pin.wear_coefficient = 0;
  if (!rough) tables.pin.roughness_mm = 0;
  if (!wears || !rough) tables.pin.roughness_growth = 0;
  if (wears) tables.contact.pin_wear_opens_gap = state.opening;
  const { area } = chosen.load;
  if (area) Object.assign(tables.contact, { width_mm: area.b, length_mm: area.L });
  if (state.pin === "bearing") delete tables.pin;
  if (!state.compliant) delete tables.support;
  return tables;
}

function loadEntries({ U, T }) {
  const { kind, value_mm, mean_mm, cosine_mm, sine_mm, rows, phase, value } = chosen.load;
  const times = (list) => list.map((value) => U * value);
  return {
    sine: () => ({ kind, amplitude_mm: U, period_s: T }),
    constant: () => ({ kind, value_mm: U * value_mm, period_s: T }),
    harmonics: () => ({
      kind, mean_mm: U * mean_mm, cosine_mm: times(cosine_mm), sine_mm: times(sine_mm), period_s: T,
    }),
    table: () => (rows ?? { kind, times_s: phase.map((x) => T * x), values_mm: times(value) }),
    force: () => (rows ?? { kind, times_s: phase.map((x) => T * x), forces_N: times(value) }),
  }[kind]();
}

function showSceneFile(state) {
  const parts = sceneFile(state);
  $("scene-file").replaceChildren(...parts.map((part) => {
    const block = document.createElement("span");
    block.textContent = part;
    return block;
  }));
  $("save").href = `data:application/toml;charset=utf-8,${encodeURIComponent(parts.join(""))}`;
}
