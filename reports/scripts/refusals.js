// Why a value is refused, in the sentences of the project's own checks.
"use strict";

const REAL = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;

// The sentence on one field's text, "" if the value is right.
function refused(text, rule) {
  if (rule.kind === "whole") {
    if (!/^[+-]?\d{1,400}$/.test(text) || BigInt(text) < BigInt(rule.least)) return rule.allowed;
    return "most" in rule && BigInt(text) > BigInt(rule.most) ? rule.too_large : "";
  }
  const value = REAL.test(text) ? Number(text) : NaN;
  const low = "above" in rule ? value > rule.above : value >= rule.least;
  if (!low || !Number.isFinite(value) || Math.abs(value) >= 1e50) return rule.allowed;
  if ("above" in rule && rule.above === 0 && value < 1e-50) return rule.allowed;
  return "most" in rule && value > rule.most ? rule.too_large : "";
}

// [field, line] of values that are right alone but not together.
function together(problem, given, stored) {
  const sentences = stored.sentences.together;
  const found = [];
  const add = (name, sentence, words) => {
    const text = sentence.replace(/\{(\w+)\}/g, (_, word) => words[word]);
    found.push([name, `${name} = ${given[name]}: ${text}`]);
  };
  const n = given.n_particles;
  if (problem === "perfect") {
    const least = stored.least_tolerance * Math.sqrt(1.5 * n);
    if (given.tolerance < least) add("tolerance", sentences.tolerance, { least: exponential(least) });
  }
  if (problem !== "kac") return found;
  const ancestors = Math.min(n, Math.exp(Math.min(700, stored.rate * given.time)));
  if (ancestors > stored.most_ancestors) {
    add("time", sentences.late, { n: exponential(ancestors, 0), most: stored.most_ancestors });
  }
  if (!("time_step" in given)) return found;
  const steps = given.time / given.time_step;
  const share = stored.rate * given.time_step;
  if (Math.round(steps) < 1 || Math.abs(steps - Math.round(steps)) > 1e-9 * Math.max(steps, Math.round(steps))) {
    add("time_step", sentences.uneven, { time: given.time });
  } else if (share > 1) {
    add("time_step", `${sentences.fast} (${Number(stored.rate.toPrecision(4))} * ${given.time_step} = ${Number(share.toPrecision(4))})`, {});
  } else if (given.algorithm === "nanbu_babovsky") {
    const pairs = Math.ceil(meanCollisions(n, given.time_step, stored.rate));
    if (2 * pairs > n) add("time_step", sentences.pairs, { pairs, n });
  } else if (steps > 1e5) {
    add("time_step", `must be longer: ${Math.round(steps)} steps, more than 100000`, {});
  }
  return found;
}

// As Python's format with an exponent of two digits.
function exponential(value, places = 1) {
  return value.toExponential(places).replace(/e([+-])(\d)$/, "e$10$2");
}
