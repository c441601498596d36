// Exact laws that draws are compared with: eqs. (8) and (9), the sphere of N particles, the BKW mode.
"use strict";

const HALF_WIDTH = 8; // of the range of the bins
const BIN = 0.1;
const BINS = Math.round((2 * HALF_WIDTH) / BIN);
const EDGES = Array.from({ length: BINS + 1 }, (_, k) => -HALF_WIDTH + (k * 2 * HALF_WIDTH) / BINS);

function kacShape(time, rate) {
  return 1 / (3 - 2 * Math.exp((-rate * time) / 8));
}

function kacDensity(v, time, rate) {
  const c = kacShape(time, rate);
  const polynomial = 1.5 * (1 - c) * Math.sqrt(c) + (3 * c - 1) * c ** 1.5 * v * v;
  return (polynomial * Math.exp(-c * v * v)) / Math.sqrt(Math.PI);
}

// P(v_1 <= v) of eq. (8) at the edges; `normal` gives the standard normal cumulative of an array.
function kacCumulative(edges, time, rate, normal) {
  const c = kacShape(time, rate);
  const w = edges.map((v) => Math.sqrt(c) * v);
  const bell = normal(w.map((x) => Math.SQRT2 * x));
  return w.map((x, k) => bell[k] - ((3 * c - 1) / (2 * Math.sqrt(Math.PI))) * x * Math.exp(-x * x));
}

// The density of v_1 uniform on the sphere: v**2 / (3 N / 2) ~ Beta(1/2, (N - 1) / 2).
function sphereDensity(n) {
  const radius = Math.sqrt(1.5 * n);
  const power = (n - 3) / 2;
  const raw = (v) => (Math.abs(v) < radius ? (1 - (v / radius) ** 2) ** power : 0);
  let total = 0;
  const parts = 4000;
  for (let k = 0; k < parts; k++) {
    // By v = radius sin(a), so that the ends of two particles do no harm.
    const a = (Math.PI * (k + 0.5)) / parts - Math.PI / 2;
    total += ((Math.cos(a) ** (n - 2) * Math.PI) / parts) * radius;
  }
  return (v) => raw(v) / total;
}

function sphereProbabilities(n, edges) {
  const radius = Math.sqrt(1.5 * n);
  const angle = (v) => Math.asin(Math.max(-1, Math.min(1, v / radius)));
  const parts = 64;
  const masses = edges.slice(1).map((high, k) => {
    const [from, to] = [angle(edges[k]), angle(high)];
    let sum = 0;
    for (let j = 0; j < parts; j++) {
      sum += Math.cos(from + ((to - from) * (j + 0.5)) / parts) ** (n - 2);
    }
    return (sum * (to - from)) / parts;
  });
  let total = 0;
  for (let j = 0; j < 40000; j++) total += Math.cos(-Math.PI / 2 + (Math.PI * (j + 0.5)) / 40000) ** (n - 2);
  total *= Math.PI / 40000;
  return masses.map((mass) => mass / total);
}

// Collisions of n particles in a time, in the mean.
function meanCollisions(n, time, rate) {
  return (rate * n * time) / 2;
}

// E v_1**4 of the process itself, where it has a short form; null elsewhere.
function fourthMoment(problem, given, rate) {
  const n = given.n_particles;
  if (problem === "perfect") return (3 * (1.5 * n) ** 2) / (n * (n + 2));
  const gain = (3 * (n - 1)) / (n + 2);
  if (given.algorithm === "poisson") {
    return 3.75 + gain * -Math.expm1((-rate * given.time * (n + 2)) / (4 * (n - 1)));
  }
  if (given.algorithm !== "bird") return null;
  const lost = (n + 2) / (2 * n * (n - 1));
  const collisions = Math.ceil(meanCollisions(n, given.time, rate));
  return 3.75 - gain * (lost < 1 ? Math.expm1(collisions * Math.log1p(-lost)) : -1);
}

// f(c; t) / M(c) of the BKW mode, eq. (7) of the Boltzmann paper.
function bkwDensity(speed, time) {
  const k = 1 - 0.4 * Math.exp(-time / 6);
  const s = speed * speed;
  const polynomial = (5 * k - 3) / k + ((1 - k) / k ** 2) * s;
  return 0.5 * k ** -1.5 * polynomial * Math.exp(-0.5 * s * (1 / k - 1));
}

function totalVariation(counts, probabilities, n) {
  return 0.5 * counts.reduce((sum, count, k) => sum + Math.abs(count / n - probabilities[k]), 0);
}

// The mean TVN of n exact draws, nearly.
function noiseFloor(probabilities, n) {
  return 0.5 * probabilities.reduce((sum, p) => sum + Math.sqrt((2 * p * (1 - p)) / (Math.PI * n)), 0);
}
