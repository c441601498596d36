// The worker that draws: it checks its bits first, then draws until it is enough, telling how far it is.
"use strict";

let kernels = null;
let running = 0;

function check() {
  const wrong = kernels.stored.checks.filter((one) => !kernels.agrees(one));
  postMessage({ told: "checked", many: kernels.stored.checks.length, wrong: wrong.length });
}

function probabilities(problem, given) {
  if (problem === "bkw") return null;
  if (problem === "perfect") return [0, ...sphereProbabilities(given.n_particles, EDGES), 0];
  const below = kacCumulative(EDGES, given.time, kernels.stored.rate, (x) => kernels.cumulative(x));
  return [below[0], ...below.slice(1).map((p, k) => p - below[k]), 1 - below[BINS]];
}

// How many draws a call makes: few where each takes long, so that an answer comes soon.
function callSize(problem, given) {
  if (problem !== "kac") return 64;
  const ancestors = Math.min(given.n_particles, Math.exp(kernels.stored.rate * given.time));
  return Math.max(16, Math.min(MOST, 2 ** Math.floor(Math.log2(4e5 / ancestors))));
}

function start(order) {
  const law = probabilities(order.problem, order.given);
  kernels.start(order.problem, order.given, BigInt(order.seed));
  const sums = { n: 0, seconds: 0, mean: 0, square: 0, steps: 0 };
  const state = { order, law, sums, counts: new Array(BINS + 2).fill(0), size: callSize(order.problem, order.given) };
  state.goal = order.draws;
  state.first = null;
  return state;
}

let state = null;

function add(drawn) {
  const { sums, counts, order } = state;
  const power = order.problem === "bkw" ? 1 : 4;
  for (const v of drawn.values) {
    const x = power === 1 ? v : v * v * v * v;
    sums.mean += x;
    sums.square += x * x;
    if (power === 4) counts[Math.max(0, Math.min(BINS + 1, Math.floor((v + HALF_WIDTH) / BIN) + 1))] += 1;
  }
  for (const count of drawn.counts) sums.steps += Number(count);
  sums.n += drawn.values.length;
  state.first ??= Array.from(drawn.values.slice(0, 4));
}

function turn(mine) {
  if (mine !== running) return;
  const begun = performance.now();
  try {
    while (state.sums.n < state.goal && performance.now() - begun < 60) {
      const call = Math.min(state.size, state.order.problem === "kac" ? state.size : state.goal - state.sums.n);
      const before = performance.now();
      add(kernels.draw(call));
      state.sums.seconds += (performance.now() - before) / 1000;
      if (state.order.problem !== "kac" && performance.now() - before < 10) state.size = Math.min(MOST, 2 * state.size);
    }
  } catch (error) {
    postMessage({ told: "failed", why: String(error.message || error) });
    return;
  }
  const done = state.sums.n >= state.goal;
  const { sums, counts, law, first, size } = state;
  postMessage({ told: "drawn", sums: { ...sums }, counts: law && counts, law, first, size, done });
  if (!done) setTimeout(turn, 0, mine);
}

onmessage = ({ data }) => {
  try {
    if (data.kernels) {
      kernels = new Kernels(data.kernels, data.stored);
      check();
    } else if (data.order) {
      state = start(data.order);
      turn(++running);
    } else if (data.more) {
      state.goal = state.sums.n + data.more;
      turn(++running);
    } else {
      running++;
    }
  } catch (error) {
    postMessage({ told: "failed", why: String(error.message || error) });
  }
};
