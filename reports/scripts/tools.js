// Tools of a figure: a closer look, and its files from the page itself.
"use strict";

const STEP = 1.5;
const CLOSEST = 12;

class Tools {
  constructor(figure, table) {
    Object.assign(this, { figure, table });
    this.svg = figure.querySelector(".plate svg");
    this.plate = figure.querySelector(".plate");
    this.whole = this.svg.getAttribute("viewBox").split(" ").map(Number);
    this.box = [...this.whole];
    const actions = { in: () => this.zoom(STEP), out: () => this.zoom(1 / STEP), whole: () => this.show(this.whole), svg: () => this.saveSvg(), csv: () => this.saveCsv() };
    for (const button of figure.querySelectorAll("[data-tool]")) {
      button.addEventListener("click", actions[button.dataset.tool]);
    }
    this.plate.addEventListener("keydown", ({ key }) => {
      const wanted = { "+": "in", "-": "out", 0: "whole" }[key];
      if (wanted) actions[wanted]();
    });
    this.svg.addEventListener("dblclick", (event) => this.zoom(STEP, this.placeOf(event)));
    this.svg.addEventListener("pointerdown", (event) => this.grip(event));
  }

  placeOf(event) {
    return new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
  }

  // About a place, or about the middle.
  zoom(factor, place) {
    const [x, y, width, height] = this.box;
    const centre = place || { x: x + width / 2, y: y + height / 2 };
    const wide = Math.max(this.whole[2] / CLOSEST, Math.min(this.whole[2], width / factor));
    const high = (wide * this.whole[3]) / this.whole[2];
    this.show([centre.x - wide / 2, centre.y - high / 2, wide, high]);
  }

  show([x, y, width, height]) {
    const left = Math.max(this.whole[0], Math.min(this.whole[0] + this.whole[2] - width, x));
    const top = Math.max(this.whole[1], Math.min(this.whole[1] + this.whole[3] - height, y));
    this.box = [left, top, width, height];
    this.svg.setAttribute("viewBox", this.box.map((value) => Number(value.toFixed(3))).join(" "));
    this.svg.classList.toggle("near", width < this.whole[2]);
  }

  // Drag what is shown larger than it is.
  grip(event) {
    if (this.box[2] >= this.whole[2]) return;
    const from = this.placeOf(event);
    const move = (moved) => {
      const to = this.placeOf(moved);
      const [x, y, width, height] = this.box;
      this.show([x + from.x - to.x, y + from.y - to.y, width, height]);
    };
    const end = () => {
      removeEventListener("pointermove", move);
      removeEventListener("pointerup", end);
    };
    addEventListener("pointermove", move);
    addEventListener("pointerup", end);
    event.preventDefault();
  }

  // The figure alone, with the letters that it shares with others on the page.
  svgText() {
    const copy = this.svg.cloneNode(true);
    copy.setAttribute("viewBox", this.whole.join(" "));
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.removeAttribute("style");
    copy.querySelectorAll(".ring").forEach((ring) => ring.remove());
    const letters = document.createElementNS("http://www.w3.org/2000/svg", "defs");
    const wanted = new Set([...copy.querySelectorAll("use")].map((use) => use.getAttribute("href").slice(1)));
    for (const letter of document.querySelectorAll("#letters defs > *")) {
      if (wanted.has(letter.id)) letters.append(letter.cloneNode(true));
    }
    copy.prepend(letters);
    return new XMLSerializer().serializeToString(copy);
  }

  // One row a mark: the panel's names, the series, x (of a bar its ends), y, what bars there are, in
  // space z, and the draws where they are known.
  csvText() {
    const rows = [["panel", "series", "x_name", "y_name", "x", "x_end", "y", "error", "low", "high", "z", "draws"]];
    this.table.axes.forEach((axes, panel) => {
      for (const series of axes.series) {
        const x = spread(series.x);
        series.y.forEach((y, k) => {
          const end = series.kind === "bars" ? x[k + 1] : "";
          const bars = ["error", "low", "high", "z"].map((name) => (series[name] ? series[name][k] : ""));
          rows.push([panel + 1, series.label, ...axes.labels.slice(0, 2), x[k], end, y, ...bars, drawsOf(this.table, series, k)]);
        });
      }
    });
    return rows.map((row) => row.map(quoted).join(",")).join("\r\n") + "\r\n";
  }

  saveSvg() {
    save(`${this.figure.dataset.item}.svg`, this.svgText(), "image/svg+xml");
  }

  saveCsv() {
    save(`${this.figure.dataset.item}.csv`, this.csvText(), "text/csv");
  }
}

function quoted(value) {
  const text = String(value ?? "");
  return /[",\n]/.test(text) ? `"${text.replace(/"/g, '""')}"` : text;
}

function save(name, text, type) {
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(new Blob([text], { type }));
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
