// The kernels of the run, compiled to WebAssembly: where their arrays lie, and what they are called with.
"use strict";

const STACK = 1 << 21; // it grows down from here, towards the kernels' tables
const MOST = 8192; // draws of one call
const PAGES = 160;

class Kernels {
  constructor(bytes, stored) {
    this.stored = stored;
    this.memory = new WebAssembly.Memory({ initial: PAGES, maximum: 8192 });
    const pointer = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = { __linear_memory: this.memory, __stack_pointer: pointer };
    this.code = new WebAssembly.Instance(new WebAssembly.Module(bytes), { env }).exports;
    this.result = STACK;
    this.values = STACK + 1024;
    this.counts = this.values + 8 * MOST;
    this.stream = this.counts + 8 * MOST;
    this.heap = this.stream + 8 * 512;
  }

  // Make what is drawn next begin anew.
  start(problem, given, seed) {
    const name = { kac: `kac.draw ${given.algorithm} ancestral` }[problem] || this.names[problem];
    new BigUint64Array(this.memory.buffer, this.stream, END_OF_BLOCK).set(
      newStream(seed, this.stored.streams[name])
    );
    this.kernel = problem === "kac" ? `kac_${given.algorithm}` : problem;
    this.arguments = this.argumentsOf(problem, given);
  }

  get names() {
    return { perfect: "kac.draw_equilibrium", bkw: "boltzmann.estimate_bkw" };
  }

  // As the ``arguments`` of each algorithm's module.
  argumentsOf(problem, given) {
    const n = given.n_particles;
    if (problem === "bkw") return [given.speed, given.time];
    if (problem === "perfect") return [BigInt(n), 1.5 * n, given.tolerance];
    const rate = this.stored.rate;
    if (given.algorithm === "bird") {
      return [BigInt(n), BigInt(Math.ceil(meanCollisions(n, given.time, rate)))];
    }
    if (this.stored.stepped.includes(given.algorithm)) {
      const share = rate * given.time_step;
      const each = given.algorithm === "nanbu_babovsky" ? meanCollisions(n, given.time_step, rate) : share;
      return [BigInt(n), BigInt(Math.round(given.time / given.time_step)), each];
    }
    const others = given.algorithm === "poisson" ? n - 1 : n - 2;
    return [BigInt(n), rate * given.time, n === 2 ? 0 : 1 / others];
  }

  // Draw so many values; the arrays are overwritten by the next call.
  draw(n) {
    this.call(this.kernel, n, ...this.arguments);
    return {
      values: new Float64Array(this.memory.buffer, this.values, n),
      counts: new BigInt64Array(this.memory.buffer, this.counts, n),
    };
  }

  call(name, n, ...rest) {
    this.code.free_from(this.heap);
    const failed = this.code[name](
      this.result, this.result + 64, this.values, this.counts, BigInt(n), this.stream, ...rest
    );
    if (failed) throw new Error(`the kernel ${name} has failed`);
  }

  // The standard normal cumulative at some values.
  cumulative(x) {
    new Float64Array(this.memory.buffer, this.values, x.length).set(x);
    this.call("cumulative", x.length);
    return Array.from(new Float64Array(this.memory.buffer, this.values, x.length));
  }

  // Whether the stored draws of one check are drawn here with the same bits.
  agrees(check) {
    this.start(check.problem, check.given, BigInt(check.seed));
    const wanted = bytesOf(check.values);
    this.draw(wanted.length / 8);
    const found = new Uint8Array(this.memory.buffer, this.values, wanted.length);
    return found.every((byte, k) => byte === wanted[k]);
  }
}
