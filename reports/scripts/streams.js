// The states of random streams: numpy's SeedSequence, as kacsim.streams.new_stream takes it.
"use strict";

const LANES = 8;
const STATE_WORDS = 4 * LANES;
const END_OF_BLOCK = STATE_WORDS + LANES + 256;
const MIXED = 4; // words of the pool

function mixer(constant, factor) {
  let hash = constant;
  return (value) => {
    value ^= hash;
    hash = Math.imul(hash, factor);
    value = Math.imul(value, hash);
    return (value ^ (value >>> 16)) >>> 0;
  };
}

function mixed(x, y) {
  const found = Math.imul(0xca01f9dd, x) - Math.imul(0x4973f715, y);
  return (found ^ (found >>> 16)) >>> 0;
}

function pool(entropy) {
  const hash = mixer(0x43b0d7e5, 0x931e8875);
  const words = [];
  for (let k = 0; k < MIXED; k++) words.push(hash(k < entropy.length ? entropy[k] : 0));
  for (let from = 0; from < MIXED; from++) {
    for (let to = 0; to < MIXED; to++) {
      if (from !== to) words[to] = mixed(words[to], hash(words[from]));
    }
  }
  for (let from = MIXED; from < entropy.length; from++) {
    for (let to = 0; to < MIXED; to++) words[to] = mixed(words[to], hash(entropy[from]));
  }
  return words;
}

// The 32-bit words of a whole number that is not negative, the lowest first, at least one.
function wordsOf(number) {
  const words = [Number(number & 0xffffffffn)];
  while ((number >>= 32n)) words.push(Number(number & 0xffffffffn));
  return words;
}

// A new stream: seed is a BigInt, name the words that stand for the stream's name.
function newStream(seed, name) {
  const own = wordsOf(seed);
  const words = pool([own.length, ...own, ...name, 0]);
  const hash = mixer(0x8b51f9dd, 0x58f38ded);
  const halves = [];
  for (let k = 0; k < 2 * STATE_WORDS; k++) halves.push(hash(words[k % MIXED]));
  const stream = new BigUint64Array(END_OF_BLOCK);
  for (let k = 0; k < STATE_WORDS; k++) {
    stream[k] = BigInt(halves[2 * k]) | (BigInt(halves[2 * k + 1]) << 32n);
  }
  stream[STATE_WORDS] = BigInt(END_OF_BLOCK);
  return stream;
}
