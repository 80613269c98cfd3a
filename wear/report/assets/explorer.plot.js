// Plots of the explorer: curves in a frame, as SVG that follows the page's colours.
"use strict";

const ONE_AT_A_TIME = matchMedia("(max-width: 44rem)"); // as in explorer.css
const MARGIN = { left: 54, right: 14, top: 12, bottom: 44 };

// Ticks at round numbers: 1, 2 or 5 times a power of ten; on a logarithmic axis powers of ten.
function ticks(low, high, logarithmic) {
  if (logarithmic) {
    const first = Math.ceil(Math.log10(low) - 1e-9);
    const last = Math.floor(Math.log10(high) + 1e-9);
    const stride = Math.max(1, Math.ceil((last - first) / 6));
    const powers = [];
    for (let k = first; k <= last; k += stride) powers.push(10 ** k);
    return powers;
  }
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const unit = [1, 2, 5, 10].map((m) => m * power).find((size) => size >= rough * 0.999);
  const found = [];
  for (let k = Math.ceil(low / unit - 1e-9); k * unit <= high + 1e-9 * unit; k += 1) found.push(k * unit);
  return found;
}

function powerOfTen(k) {
  return `10${String(k).replace("-", "\u207b").replace(/\d/g, (d) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[d])}`;
}

function label(value, logarithmic, scale) {
  if (logarithmic) {
    const power = Math.round(Math.log10(value));
    return power >= 0 && power < 4 ? String(value) : powerOfTen(power);
  }
  return String(Number((value / 10 ** scale).toPrecision(6))).replace("-", "\u2212");
}

// The power of ten that is written once, beside the axis, in place of at every tick.
function scaleOf(largest) {
  const power = largest > 0 ? Math.floor(Math.log10(largest) + 1e-9) : 0;
  return power >= -1 && power < 5 ? 0 : power;
}

function element(name, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

// As wide as the page has room for, so that letters keep their size; one plot at a time is flat.
function sizeOf(svg) {
  const room = svg.clientWidth || document.getElementById("plots").clientWidth; // hidden: none
  if (ONE_AT_A_TIME.matches) return { width: Math.max(300, room), height: 225 };
  const width = Math.min(460, Math.max(300, room));
  return { width, height: Math.round(0.587 * width) };
}

// Draw `curves` ({ name, points: [x, y][] }) into `svg`; { x, y } name the axes.
function plot(svg, curves, { x, y, logarithmic, zero }) {
  const drawn = curves.map((curve) => ({
    ...curve,
    points: curve.points.filter(([a, b]) => Number.isFinite(b) && (!logarithmic || a > 0)),
  }));
  const all = drawn.flatMap((curve) => curve.points);
  const range = (values, fallback) => (values.length ? [Math.min(...values), Math.max(...values)] : fallback);
  let [left, right] = range(all.map((point) => point[0]), [0, 1]);
  let [low, high] = range(all.map((point) => point[1]), [0, 1]);
  if (right <= left) right = logarithmic ? left * 10 : left + 1;
  if (zero) [low, high] = [Math.min(0, low), Math.max(0, high)];
  if (high - low <= 1e-12 * Math.max(Math.abs(high), Math.abs(low))) {
    [low, high] = high === 0 ? [0, 1] : [Math.min(low * 0.9, low * 1.1), Math.max(high * 0.9, high * 1.1)];
  }
  high += 0.04 * (high - low);
  if (low !== 0) low -= 0.04 * (high - low);
  const { width, height } = sizeOf(svg);
  const across = width - MARGIN.left - MARGIN.right;
  const down = height - MARGIN.top - MARGIN.bottom;
  const position = logarithmic
    ? (value) => MARGIN.left + across * Math.log(value / left) / Math.log(right / left)
    : (value) => MARGIN.left + across * (value - left) / (right - left);
  const level = (value) => MARGIN.top + down * (1 - (value - low) / (high - low));
  const rightScale = logarithmic ? 0 : scaleOf(right);
  const highScale = scaleOf(Math.max(Math.abs(low), Math.abs(high)));
  const titled = (text, scale) => (scale === 0 ? text : text.includes(" in ")
    ? text.replace(" in ", ` in ${powerOfTen(scale)} `) : `${text}, in ${powerOfTen(scale)}`);
  const parts = [];
  for (const value of ticks(left, right, logarithmic)) {
    const at = position(value).toFixed(1);
    parts.push(element("line", { class: "grid", x1: at, x2: at, y1: MARGIN.top, y2: MARGIN.top + down }));
    parts.push(element("text", { x: at, y: height - MARGIN.bottom + 17, "text-anchor": "middle" },
      label(value, logarithmic, rightScale)));
  }
  for (const value of ticks(low, high, false)) {
    const at = level(value).toFixed(1);
    parts.push(element("line", { class: "grid", x1: MARGIN.left, x2: width - MARGIN.right, y1: at, y2: at }));
    parts.push(element("text", { x: MARGIN.left - 6, y: Number(at) + 4, "text-anchor": "end" },
      label(value, false, highScale)));
  }
  parts.push(element("rect", {
    class: "frame", x: MARGIN.left, y: MARGIN.top, width: across, height: down,
  }));
  for (const [a, b] of drawn.filter((curve) => curve.dots).flatMap((curve) => curve.points)) {
    parts.push(element("circle", { class: "dot", cx: position(a).toFixed(1), cy: level(b).toFixed(1), r: 3 }));
  }
  drawn.forEach((curve, index) => {
    if (curve.dots) return;
    const path = thinned(curve.points.map(([a, b]) => [position(a), level(b)]))
      .map(([a, b], i) => `${i ? "L" : "M"}${a.toFixed(1)} ${b.toFixed(1)}`).join("");
    if (path) parts.push(element("path", { class: `curve curve-${index}`, d: path }));
  });
  parts.push(element("text", {
    class: "axis", x: MARGIN.left + across / 2, y: height - 6, "text-anchor": "middle",
  }, titled(x, rightScale)));
  parts.push(element("text", {
    class: "axis", x: -MARGIN.top - down / 2, y: 13, transform: "rotate(-90)", "text-anchor": "middle",
  }, titled(y, highScale)));
  svg.setAttribute("viewBox", `0 0 ${width} ${height}`);
  svg.replaceChildren(...parts);
  svg.setAttribute("aria-label", described(drawn, x, y));
  return drawn.map((curve) => curve.name);
}

// Points nearer than a third of a pixel to the one before add nothing.
function thinned(points) {
  let last;
  return points.filter((point, i) => {
    const far = !last || i === points.length - 1
      || Math.abs(point[0] - last[0]) + Math.abs(point[1] - last[1]) > 0.34;
    if (far) last = point;
    return far;
  });
}

// For those who do not see the plot: where each curve starts and ends.
function described(curves, x, y) {
  const ends = curves.filter((curve) => curve.points.length).map((curve) => {
    const [first, last] = [curve.points[0], curve.points.at(-1)];
    return `${curve.name} goes from ${shown(first[1])} at ${shown(first[0])} to ${shown(last[1])} at ${shown(last[0])}`;
  });
  return `${y} against ${x}: ${ends.join("; ")}.`;
}
