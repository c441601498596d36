// Figures to read off: the mark under the pointer, or chosen by the arrow keys, tells its values.
"use strict";

const REACH = 14; // screen pixels from a mark

class Reading {
  constructor(figure, table, draws) {
    Object.assign(this, { figure, draws });
    this.svg = figure.querySelector(".plate svg");
    this.plate = figure.querySelector(".plate");
    this.output = figure.querySelector("output");
    this.marks = marksOf(table);
    this.series = [...new Set(this.marks.map((mark) => mark.series))];
    this.chosen = null;
    this.ring = document.createElementNS("http://www.w3.org/2000/svg", "circle");
    this.ring.setAttribute("class", "ring");
    this.ring.setAttribute("r", 5);
    this.svg.addEventListener("pointermove", (event) => this.point(event));
    this.svg.addEventListener("pointerleave", () => this.choose(null));
    this.plate.addEventListener("keydown", (event) => this.key(event));
    this.plate.addEventListener("blur", () => this.choose(null));
    for (const button of figure.querySelectorAll("[data-curve]")) {
      button.addEventListener("click", () => this.toggle(button));
    }
  }

  visible() {
    return this.marks.filter((mark) => !this.elements(mark.series.id)[0]?.classList.contains("off"));
  }

  // The parts of the figure that show a series.
  elements(id) {
    const own = `${this.figure.dataset.item}-${id}`;
    return [...this.svg.querySelectorAll(`[id="${own}"], [id^="${own}-"]`)];
  }

  point(event) {
    const matrix = this.svg.getScreenCTM();
    if (!matrix) return;
    const here = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    let [best, least] = [null, (REACH / matrix.a) ** 2];
    for (const mark of this.visible()) {
      const far = (mark.px - here.x) ** 2 + (mark.py - here.y) ** 2;
      if (far < least) [best, least] = [mark, far];
    }
    this.choose(best, event);
  }

  key(event) {
    if (!event.key.startsWith("Arrow")) {
      if (event.key === "Escape") this.choose(null);
      return;
    }
    const all = this.visible();
    if (!all.length) return;
    event.preventDefault();
    const place = all.indexOf(this.chosen);
    let next = place < 0 ? 0 : place;
    if (place >= 0 && event.key === "ArrowRight") next = Math.min(all.length - 1, place + 1);
    if (place >= 0 && event.key === "ArrowLeft") next = Math.max(0, place - 1);
    if (place >= 0 && (event.key === "ArrowDown" || event.key === "ArrowUp")) {
      const order = this.series.filter((one) => all.some((mark) => mark.series === one));
      const step = event.key === "ArrowDown" ? 1 : order.length - 1;
      const other = order[(order.indexOf(this.chosen.series) + step) % order.length];
      next = all.findIndex((mark) => mark.series === other);
    }
    this.choose(all[next]);
    this.output.textContent = this.told(all[next]);
  }

  told(mark) {
    const { axes, series, depth } = mark;
    const words = [series.label || axes.labels[1] || "value"];
    words.push(`${axes.labels[0] || "x"} = ${mark.at}`);
    words.push(`${axes.labels[1] || "y"} = ${mark.value}`);
    if (depth !== undefined) words.push(`${axes.labels[2]} = ${short(depth)}`);
    return `${words.join("; ")}. ${mark.draws ?? `Whole figure: ${this.draws}`}.`;
  }

  choose(mark) {
    this.chosen = mark;
    const tip = document.getElementById("tip");
    if (!mark) {
      this.ring.remove();
      tip.hidden = true;
      return;
    }
    this.ring.setAttribute("cx", mark.px);
    this.ring.setAttribute("cy", mark.py);
    this.svg.append(this.ring);
    tip.textContent = this.told(mark);
    tip.hidden = false;
    const matrix = this.svg.getScreenCTM();
    const place = new DOMPoint(mark.px, mark.py).matrixTransform(matrix);
    const [wide, high] = [tip.offsetWidth, tip.offsetHeight];
    tip.style.left = `${Math.max(8, Math.min(innerWidth - wide - 8, place.x + 14))}px`;
    tip.style.top = `${place.y - high - 14 > 0 ? place.y - high - 14 : place.y + 18}px`;
  }

  toggle(button) {
    const on = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", String(on));
    for (const one of this.series.filter((series) => series.label === button.dataset.curve)) {
      for (const element of this.elements(one.id)) element.classList.toggle("off", !on);
    }
  }
}

// All marks of a figure: their place in it, and their values as text.
function marksOf(table) {
  const found = [];
  for (const axes of table.axes) {
    const x = placing(axes.x, axes.box[0], axes.box[0] + axes.box[2]);
    const y = placing(axes.y, axes.box[1] + axes.box[3], axes.box[1]);
    if (!x || !y) continue;
    for (const series of axes.series) {
      const places = spread(series.x);
      series.y.forEach((value, k) => {
        const at = series.kind === "bars" ? (places[k] + places[k + 1]) / 2 : places[k];
        const [px, py] = series.left ? [series.left[k], series.top[k]] : [x(at), y(value)];
        const inside = px >= axes.box[0] - 2 && px <= axes.box[0] + axes.box[2] + 2 && py >= axes.box[1] - 2 && py <= axes.box[1] + axes.box[3] + 2;
        if (value === null || at === null || !inside) return;
        found.push({ axes, series, px, py, draws: drawsOf(table, series, k), at: atOf(series, places, k), value: valueOf(series, k), depth: series.z?.[k] });
      });
    }
  }
  return found;
}

// The draws behind a mark, where its case is known.
function drawsOf(table, series, k) {
  return table.cases[Array.isArray(series.case) ? series.case[k] : series.case];
}

function spread(x) {
  if (Array.isArray(x)) return x;
  return Array.from({ length: x.many }, (_, k) => x.from + (k * (x.to - x.from)) / (x.many - 1));
}

function atOf(series, places, k) {
  return series.kind === "bars" ? `${short(places[k])} to ${short(places[k + 1])}` : short(places[k]);
}

function valueOf(series, k) {
  const value = short(series.y[k]);
  if (series.error && series.error[k] !== null) return `${value} ± ${short(series.error[k], 2)}`;
  if (series.low) return `${value} (${short(series.low[k])} to ${short(series.high[k])})`;
  return value;
}

function short(value, digits = 6) {
  return value === null ? "none" : String(Number(value.toPrecision(digits))).replace("-", "−");
}

// Where a value lies between two ends of a panel; null for scales that are neither linear nor log.
function placing(scale, first, last) {
  const maps = { linear: (x) => x, log: (x) => (x > 0 ? Math.log(x) : NaN) };
  const map = maps[scale.scale];
  if (!map) return null;
  const [from, to] = [map(scale.from), map(scale.to)];
  return (x) => first + ((map(x) - from) / (to - from)) * (last - first);
}
