// Small pictures as SVG text: bars with a curve, and an estimate with its band as draws grow.
"use strict";

const CHART = { width: 460, height: 260, left: 52, right: 12, top: 12, bottom: 40 };

function scaled(low, high, from, to) {
  return (x) => from + ((x - low) / (high - low || 1)) * (to - from);
}

function niceTicks(low, high, count = 5) {
  const raw = (high - low) / count;
  const unit = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 5, 10].find((m) => m * unit >= raw) * unit;
  const ticks = [];
  for (let k = Math.ceil(low / step); k * step <= high + 1e-9 * step; k++) ticks.push(Number((k * step).toPrecision(8)));
  return ticks;
}

function path(points) {
  return points.map(([x, y], k) => `${k ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");
}

function frame(x, y, ticks, labels, name) {
  const { width, height, left, right, top, bottom } = CHART;
  const lines = [`<path class="axis" d="M${left} ${top}V${height - bottom}H${width - right}"/>`];
  for (const [at, text] of ticks.x) {
    lines.push(`<path class="axis" d="M${x(at).toFixed(1)} ${height - bottom}v4"/>`);
    lines.push(`<text x="${x(at).toFixed(1)}" y="${height - bottom + 16}" text-anchor="middle">${text}</text>`);
  }
  for (const at of ticks.y) {
    lines.push(`<path class="axis" d="M${left} ${y(at).toFixed(1)}h-4"/>`);
    lines.push(`<text x="${left - 7}" y="${(y(at) + 4).toFixed(1)}" text-anchor="end">${at}</text>`);
  }
  lines.push(`<text x="${(left + width - right) / 2}" y="${height - 6}" text-anchor="middle">${labels[0]}</text>`);
  lines.push(`<text transform="translate(12 ${(top + height - bottom) / 2}) rotate(-90)" text-anchor="middle">${labels[1]}</text>`);
  return (inside) =>
    `<svg viewBox="0 0 ${width} ${height}" role="img" aria-label="${name}">${inside}${lines.join("")}</svg>`;
}

// counts and law hold the two tails as first and last; curve is the exact density.
function histogramChart(counts, n, curve, name) {
  const { width, height, left, right, top, bottom } = CHART;
  const density = counts.slice(1, -1).map((count) => count / n / BIN);
  const points = EDGES.filter((v) => Math.abs(v) <= 5).flatMap((v) => [v, v + BIN / 2]);
  const heights = points.map((v) => [v, curve(v)]).filter(([, f]) => Number.isFinite(f));
  const most = 1.1 * Math.max(...heights.map(([, f]) => f), ...density);
  const x = scaled(-5, 5, left, width - right);
  const y = scaled(0, most, height - bottom, top);
  let bars = "";
  density.forEach((f, k) => {
    if (EDGES[k] >= -5 && EDGES[k + 1] <= 5.0001 && f > 0) {
      bars += `M${x(EDGES[k]).toFixed(1)} ${y(0).toFixed(1)}V${y(f).toFixed(1)}H${x(EDGES[k + 1]).toFixed(1)}V${y(0).toFixed(1)}`;
    }
  });
  const ticks = { x: [-4, -2, 0, 2, 4].map((v) => [v, v]), y: niceTicks(0, most, 4) };
  const line = path(heights.map(([v, f]) => [x(v), y(Math.min(f, most))]));
  return frame(x, y, ticks, ["velocity v₁", "density"], name)(
    `<path class="bars" d="${bars}"/><path class="exact" d="${line}"/>`
  );
}

// trace: list of {n, mean, error}; exact: a value or null; set: [low, high] or null.
function traceChart(trace, exact, set, quantity, name) {
  const { width, height, left, right, top, bottom } = CHART;
  const last = trace[trace.length - 1];
  const spread = 6 * last.error || 1e-12;
  const seen = [last.mean - spread, last.mean + spread];
  if (exact !== null) seen.push(exact - spread / 2, exact + spread / 2);
  if (set) seen.push(...set);
  const [low, high] = [Math.min(...seen), Math.max(...seen)];
  const pad = 0.05 * (high - low);
  const y = scaled(low - pad, high + pad, height - bottom, top);
  const logs = trace.map(({ n }) => Math.log10(n));
  const from = Math.min(logs[0], logs[logs.length - 1] - 1);
  const x = scaled(from, logs[logs.length - 1], left, width - right);
  const inside = (v) => Math.max(top, Math.min(height - bottom, y(v)));
  const upper = trace.map(({ mean, error }, k) => [x(logs[k]), inside(mean + error)]);
  const lower = trace.map(({ mean, error }, k) => [x(logs[k]), inside(mean - error)]).reverse();
  const marks = [];
  if (set) marks.push(`<rect class="set" x="${left}" width="${width - left - right}" y="${inside(set[1])}" height="${inside(set[0]) - inside(set[1])}"/>`);
  marks.push(`<path class="band" d="${path([...upper, ...lower])}Z"/>`);
  if (exact !== null) marks.push(`<path class="exact" d="M${left} ${y(exact).toFixed(1)}H${width - right}"/>`);
  marks.push(`<path class="mean" d="${path(trace.map(({ mean }, k) => [x(logs[k]), inside(mean)]))}"/>`);
  const end = x(logs[logs.length - 1]) - 1;
  marks.push(`<path class="bar" d="M${end} ${inside(last.mean - last.error)}V${inside(last.mean + last.error)}"/>`);
  const decades = [];
  for (let k = Math.ceil(from); k <= logs[logs.length - 1]; k++) decades.push([k, `10<tspan dy="-5" font-size="9">${k}</tspan>`]);
  const ticks = { x: decades, y: niceTicks(low - pad, high + pad, 4) };
  return frame(x, y, ticks, ["draws", quantity], name)(marks.join(""));
}
