// The page draws: a form, a worker made from the page itself, and what it finds as it finds it.
"use strict";

const MILLION = 1e6;

class Lab {
  constructor(root, stored, claims) {
    Object.assign(this, { root, stored, claims, trace: [], worker: null });
    this.form = root.querySelector("form");
    this.status = root.querySelector("[data-status]");
    this.answer = root.querySelector("[data-answer]");
    this.pictures = root.querySelector("[data-pictures]");
    this.form.addEventListener("submit", (event) => {
      event.preventDefault();
      this.draw();
    });
    this.form.addEventListener("input", () => this.adapt());
    root.querySelector("[data-more]").addEventListener("click", () => this.more());
    root.querySelector("[data-stop]").addEventListener("click", () => this.stop());
    this.adapt();
    this.hire();
  }

  // A new worker; it checks its bits before anything else.
  hire() {
    this.worker?.terminate();
    try {
      const code = document.getElementById("worker-code").textContent;
      const address = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
      this.worker = new Worker(address);
      URL.revokeObjectURL(address);
      this.worker.onmessage = ({ data }) => this.told(data);
      this.worker.onerror = (event) => this.fail(event.message || "the worker cannot be started");
      const kernels = bytesOf(document.getElementById("kernels").textContent.trim());
      this.worker.postMessage({ kernels, stored: this.stored });
    } catch (error) {
      this.fail(error.message);
    }
  }

  fail(why) {
    this.status.textContent = `✗ This browser cannot draw: ${why}.`;
    this.busy(false);
  }

  field(name) {
    return this.form.elements.namedItem(name);
  }

  // Show the fields that the problem has.
  adapt() {
    const problem = this.field("problem").value;
    const stepped = this.stored.stepped.includes(this.field("algorithm").value);
    for (const label of this.form.querySelectorAll("[data-for]")) {
      const wanted = label.dataset.for.split(" ").includes(problem);
      label.hidden = !wanted || (label.dataset.stepped === "" && !stepped);
    }
    const { problems } = this.given();
    this.tell(problems);
    return problems;
  }

  // What is asked for, and what is wrong with it, field by field.
  given() {
    const problem = this.field("problem").value;
    const given = problem === "kac" ? { algorithm: this.field("algorithm").value } : {};
    const problems = [];
    let seed = "0";
    for (const [name, rule] of Object.entries(this.stored.sentences[problem])) {
      if (this.field(name).closest("label").hidden) continue;
      const text = this.field(name).value.trim();
      const sentence = refused(text, rule);
      if (sentence) problems.push([name, `${name} = ${text || "''"}: ${sentence}`]);
      else if (name === "seed") seed = BigInt(text).toString();
      else given[name] = Number(text);
    }
    if (!problems.length) problems.push(...together(problem, given, this.stored));
    return { problem, given, seed, problems };
  }

  tell(problems) {
    for (const input of this.form.querySelectorAll("input")) {
      const mine = problems.find(([name]) => name === input.name);
      const note = document.getElementById(`lab-${input.name}-note`);
      note.textContent = mine ? mine[1] : "";
      input.setAttribute("aria-invalid", mine ? "true" : "false");
    }
  }

  draw() {
    const { problem, given, seed, problems } = this.given();
    this.tell(problems);
    if (problems.length) {
      this.field(problems[0][0]).focus();
      return;
    }
    this.order = { problem, given, seed, draws: MILLION };
    this.trace = [];
    this.busy(true);
    this.worker.postMessage({ order: this.order });
  }

  more() {
    if (!this.order) return this.draw();
    this.busy(true);
    this.worker.postMessage({ more: MILLION });
  }

  // At once, whatever the worker is at; what was drawn stays to be seen.
  stop() {
    this.hire();
    this.order = null;
    this.busy(false);
  }

  busy(is) {
    this.root.querySelector("[data-stop]").disabled = !is;
    this.root.querySelector("[data-draw]").disabled = is;
    this.root.querySelector("[data-more]").disabled = is || !this.order;
    this.root.classList.toggle("busy", is);
  }

  told(data) {
    if (data.told === "checked") {
      const good = data.wrong === 0;
      this.status.dataset.good = good;
      this.status.textContent = good
        ? `✓ Checked here: ${data.many} sets of draws by every kernel have the bits that the run stored.`
        : `✗ ${data.wrong} of ${data.many} sets of draws differ from those that the run stored: do not trust this browser.`;
    } else if (data.told === "failed") {
      this.answer.textContent = `The draws could not be made: ${data.why}. Ask for fewer particles or an earlier time.`;
      this.stop();
    } else {
      this.show(data);
    }
  }

  show({ sums, counts, law, first, size, done }) {
    const { problem, given } = this.order;
    const mean = sums.mean / sums.n;
    const spread = Math.sqrt(Math.max(0, sums.square / sums.n - mean * mean) / sums.n);
    const claim = this.claims.find((one) => one.problem === problem && sameValues(one.given, given));
    const wide = claim ? claim.deviations * spread : spread;
    this.trace.push({ n: sums.n, mean, error: wide });
    const { rate } = this.stored;
    const exact = problem === "bkw" ? bkwDensity(given.speed, given.time) : fourthMoment(problem, given, rate);
    const quantity = problem === "bkw" ? "f(c; t) / M(c)" : "E v₁⁴";
    const words = [`${sums.n.toLocaleString("en")} draws, ${rateOf(sums)}`];
    words.push(`${quantity} = ${rounded(mean, spread)}${exact === null ? "" : `, exact ${shown(exact)}`}`);
    const pictures = [];
    if (counts) {
      const curve = problem === "perfect" ? sphereDensity(given.n_particles) : (v) => kacDensity(v, given.time, rate);
      const tvn = totalVariation(counts, law, sums.n);
      words.push(`TVN = ${shown(tvn, 3)}, of exact draws ${shown(noiseFloor(law, sums.n), 3)}`);
      pictures.push(histogramChart(counts, sums.n, curve, `Histogram of ${sums.n} draws with the exact curve`));
      if (problem === "perfect") words.push(`mean coupling time ${shown(sums.steps / sums.n)} steps`);
    } else {
      words.push(`${shown(sums.steps / sums.n)} leaves a tree`);
    }
    if (claim) words.push(judged(claim, mean, wide));
    words.push(`first: ${first.map((v) => shown(v, 6)).join(", ")}`);
    pictures.push(traceChart(this.trace, exact, claim ? [claim.low, claim.high] : null, quantity, `${quantity} with its bar as draws grow`));
    this.pictures.innerHTML = pictures.join("");
    this.answer.textContent = `${words.join("; ")}.`;
    this.root.querySelector("[data-python]").textContent = python(problem, given, this.order.seed, size);
    if (done) this.busy(false);
  }
}

function sameValues(one, other) {
  return Object.keys(one).every((key) => one[key] === other[key]);
}

function judged(claim, mean, wide) {
  const inside = mean - wide >= claim.low && mean + wide <= claim.high;
  const apart = mean - wide > claim.high || mean + wide < claim.low;
  const word = inside ? "reproduced" : apart ? "contradicted" : "undecided";
  return `interval of row ${claim.claim} [${shown(mean - wide, 5)}, ${shown(mean + wide, 5)}] against [${shown(claim.low, 5)}, ${shown(claim.high, 5)}]: ${word}`;
}

function rateOf({ n, seconds }) {
  return `${shown(n / seconds / MILLION, 2)} million a second`;
}

function shown(value, digits = 5) {
  return String(Number(value.toPrecision(digits)));
}

function rounded(mean, error) {
  const places = Math.max(0, Math.min(12, 1 - Math.floor(Math.log10(error || 1e-12))));
  return `${mean.toFixed(places)} ± ${error.toFixed(places)}`;
}

// What gives the same first draws in Python, with the same bits.
function python(problem, given, seed, size) {
  const words = Object.entries(given).map(([key, value]) => (key === "algorithm" ? `"${value}"` : `${key}=${value}`));
  if (problem === "kac") return `kac.draw(${words.join(", ")}, n_draws=${size}, seed=${seed})`;
  if (problem === "perfect") return `kac.draw_equilibrium(${words.join(", ")}, n_draws=${size}, seed=${seed})`;
  return `boltzmann.estimate_bkw(${given.speed}, ${given.time}, method="free_leaf", n_realizations=${MILLION}, seed=${seed})`;
}
