// The table to question: search, filters, order, rows that unfold, and an address that keeps them.
"use strict";

const NAMES = ["q", "verdict", "kind", "text", "sort"];

class Table {
  constructor(form, table) {
    Object.assign(this, { form, table });
    this.rows = [...table.querySelectorAll("tr[data-claim]")];
    this.first = this.rows.map((row) => row.parentNode);
    this.words = new Map(this.rows.map((row) => [row, folded(this.textOf(row))]));
    this.sort = "";
    form.addEventListener("input", () => this.apply(true));
    form.addEventListener("reset", () => {
      this.sort = "";
      setTimeout(() => this.apply(true));
    });
    form.addEventListener("submit", (event) => event.preventDefault());
    table.querySelectorAll("thead th").forEach((head, k) => this.addOrder(head, k));
    for (const button of table.querySelectorAll("button.unfold")) {
      button.addEventListener("click", () => unfold(button));
    }
    addEventListener("hashchange", () => this.read());
    this.read();
  }

  // What is searched: the row itself and its evidence below the figure.
  textOf(row) {
    const evidence = document.getElementById(`claim-${row.dataset.claim}`);
    return `${row.textContent} ${row.dataset.claim} ${evidence ? evidence.textContent : ""}`;
  }

  addOrder(head, k) {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "order";
    button.textContent = "↕";
    button.setAttribute("aria-label", `Sort by ${head.textContent.trim()}`);
    head.append(" ", button);
    button.addEventListener("click", () => {
      this.sort = this.sort === `${k}` ? `-${k}` : this.sort === `-${k}` ? "" : `${k}`;
      this.apply(true);
    });
  }

  // Take the filters from the address, such as #claims?verdict=contradicted&q=tail.
  read() {
    const [place, query] = location.hash.slice(1).split("?");
    if (place !== "claims" || query === undefined) return;
    const wanted = new URLSearchParams(query);
    for (const name of ["q", "verdict", "kind", "text"]) {
      this.form.elements.namedItem(name).value = wanted.get(name) || "";
    }
    this.sort = /^-?\d$/.test(wanted.get("sort") || "") ? wanted.get("sort") : "";
    this.apply(false);
    document.getElementById("claims").scrollIntoView();
  }

  state() {
    const found = Object.fromEntries(new FormData(this.form));
    return { ...found, sort: this.sort };
  }

  apply(keep) {
    const wanted = this.state();
    const words = folded(wanted.q).split(/\s+/).filter(Boolean);
    let many = 0;
    for (const row of this.rows) {
      const fits = ["verdict", "kind", "text"].every((key) => !wanted[key] || row.dataset[key] === wanted[key]);
      const has = words.every((word) => this.words.get(row).includes(word));
      row.hidden = !(fits && has);
      many += !row.hidden;
      const detail = row.nextElementSibling;
      if (detail && detail.classList.contains("detail")) detail.hidden = row.hidden || detail.dataset.shut === "1";
    }
    this.order();
    for (const head of this.table.querySelectorAll("tr.kind")) {
      const own = this.rows.some((row) => row.parentNode === head.parentNode && !row.hidden);
      head.hidden = !own || this.sort !== "";
    }
    this.form.querySelector("output").textContent = `${many} of ${this.rows.length} rows`;
    if (keep) history.replaceState(null, "", this.address(wanted));
  }

  address(wanted) {
    const query = new URLSearchParams();
    for (const name of NAMES) if (wanted[name]) query.set(name, wanted[name]);
    return `#claims${[...query].length ? `?${query}` : ""}`;
  }

  order() {
    const column = Math.abs(Number(this.sort));
    const sign = this.sort.startsWith("-") ? -1 : 1;
    const bodies = [...this.table.tBodies];
    const sorted = this.sort === "" ? this.rows : [...this.rows].sort((a, b) => sign * compared(keyOf(a, column), keyOf(b, column)));
    sorted.forEach((row) => {
      const home = this.sort === "" ? this.first[this.rows.indexOf(row)] : bodies[0];
      const detail = row.nextElementSibling;
      home.append(row);
      if (detail && detail.classList.contains("detail")) row.after(detail);
    });
    this.table.querySelectorAll("thead th").forEach((head, k) => {
      if (this.sort !== "" && k === column) head.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
      else head.removeAttribute("aria-sort");
    });
  }
}

function folded(text) {
  return text.toLowerCase().replace(/\s+/g, " ").replace(/−/g, "-");
}

// A cell's key: its first number where it begins with one, else its words.
function keyOf(row, column) {
  let place = 0;
  for (const cell of row.cells) {
    if (place + cell.colSpan > column) return cell.textContent.trim();
    place += cell.colSpan;
  }
  return "";
}

function compared(a, b) {
  const [x, y] = [numberIn(a), numberIn(b)];
  if (x !== null && y !== null) return x - y;
  if (x !== null || y !== null) return x === null ? 1 : -1;
  return a.localeCompare(b, "en");
}

function numberIn(text) {
  const found = text.replace(/−/g, "-").match(/^[^\d-]{0,3}(-?\d+(?:\.\d+)?)/);
  return found ? Number(found[1]) : null;
}

// Show below a row what stands with its figure: reason, evidence, and the command that makes it again.
function unfold(button) {
  const row = button.closest("tr");
  let detail = row.nextElementSibling;
  if (!detail || !detail.classList.contains("detail")) {
    detail = document.createElement("tr");
    detail.className = "detail";
    const cell = detail.insertCell();
    cell.colSpan = 7;
    const evidence = document.getElementById(`claim-${row.dataset.claim}`);
    for (const small of evidence.querySelectorAll("th small")) {
      const text = document.createElement("p");
      text.innerHTML = small.innerHTML;
      cell.append(text);
    }
    for (let part = evidence.nextElementSibling; part?.className === "component"; part = part.nextElementSibling) {
      const text = document.createElement("p");
      text.textContent = [...part.cells].map((one) => one.textContent.trim().replace(/\s+/g, " ")).join("; ");
      cell.append(text);
    }
    const command = evidence.closest("article").querySelector(".facts div:last-child code");
    const again = document.createElement("p");
    again.append("Made again by ", command.cloneNode(true));
    cell.append(again);
    row.after(detail);
    detail.dataset.shut = "1";
  }
  const open = detail.dataset.shut === "1";
  detail.dataset.shut = open ? "0" : "1";
  detail.hidden = !open;
  button.setAttribute("aria-expanded", String(open));
}
