/* The forward loop of kacsim.kac.bird in C, a peer of the benchmark: the same number of collisions
 * of uniform pairs, the same law. Once with variates from the C library's functions, and once with
 * the tables of kacsim.variate_tables and lanes of the generator side by side. */
#include <math.h>
#include <stdint.h>
#include <string.h>

#define LANES 8
#define BLOCK 256
#define PLACE (4 * LANES)
#define FIRST (PLACE + 1)
#define END (FIRST + BLOCK)
#define UNIT 0x1p-53

typedef struct {
    const double *edge, *least, *largest, *width;
    const int64_t *sure;
    const double *scale, *cos_sin;
    int64_t layers, points;
} tables;

/* One word of every lane. */
typedef uint64_t vector __attribute__((vector_size(8 * LANES)));

static inline vector rotated(vector word, int bits) { return word << bits | word >> (64 - bits); }

/* xoshiro256++ 1.0 of Blackman and Vigna, all lanes at a time. */
static __attribute__((noinline)) void refill(uint64_t *words) {
    vector s[4];
    memcpy(s, words, sizeof s);
    for (int start = FIRST; start < END; start += LANES) {
        vector word = rotated(s[0] + s[3], 23) + s[0], shifted = s[1] << 17;
        memcpy(words + start, &word, sizeof word);
        s[2] ^= s[0];
        s[3] ^= s[1];
        s[1] ^= s[2];
        s[0] ^= s[3];
        s[2] ^= shifted;
        s[3] = rotated(s[3], 45);
    }
    memcpy(words, s, sizeof s);
}

/* A stream whose place is in a register while a loop draws from it. */
typedef struct {
    uint64_t *words, place;
} stream_t;

static inline uint64_t next_bits(stream_t *stream) {
    if (stream->place == END) {
        refill(stream->words);
        stream->place = FIRST;
    }
    return stream->words[stream->place++];
}

static inline double uniform(stream_t *stream) { return (next_bits(stream) >> 11) * UNIT; }

static inline double random_sign(stream_t *stream) {
    return 1.0 - 2.0 * (int64_t)(next_bits(stream) >> 63);
}

static inline void pair_below(int64_t n, stream_t *stream, int64_t *i, int64_t *j) {
    unsigned __int128 product = (unsigned __int128)next_bits(stream) * (uint64_t)n;
    *i = product >> 64;
    *j = (unsigned __int128)(uint64_t)product * (uint64_t)(n - 1) >> 64;
    *j += *j >= *i;
}

static inline void rotate(double *v, int64_t i, int64_t j, double cos, double sin) {
    double vi = v[i], vj = v[j];
    v[i] = vi * cos + vj * sin;
    v[j] = vj * cos - vi * sin;
}

/* v**2 under f0 is an exponential variate and half the square of a normal one. */
static inline double energy_by_library(stream_t *stream) {
    double cosine = cos(2.0 * M_PI * uniform(stream));
    return -log1p(-uniform(stream)) - log1p(-uniform(stream)) * cosine * cosine;
}

void bird_by_library(double *velocities, int64_t draws, double *v, int64_t n, int64_t collisions,
                     uint64_t *words) {
    stream_t stream = {words, words[PLACE]};
    for (int64_t draw = 0; draw < draws; draw++) {
        for (int64_t k = 0; k < n; k++) v[k] = sqrt(energy_by_library(&stream)) * random_sign(&stream);
        for (int64_t k = 0; k < collisions; k++) {
            int64_t i, j;
            pair_below(n, &stream, &i, &j);
            double angle = 2.0 * M_PI * uniform(&stream);
            rotate(v, i, j, cos(angle), sin(angle));
        }
        velocities[draw] = v[0];
    }
    words[PLACE] = stream.place;
}

/* By strips of the density x**2 exp(1 - x**2); what a strip does not settle goes to the library. */
static inline double speed_beside(uint64_t strip, stream_t *stream, const tables *t) {
    for (;;) {
        if (strip == (uint64_t)t->layers - 1) {
            double tail = t->edge[strip];
            for (;;) {
                double y = -log1p(-uniform(stream)) / (tail * tail - 0.5);
                if (uniform(stream) < sqrt(1.0 + y) * exp(-0.5 * y)) return tail * sqrt(1.0 + y);
            }
        }
        double x = t->edge[strip] + uniform(stream) * t->width[strip];
        double gap = t->largest[strip] - t->least[strip];
        if (t->least[strip] + uniform(stream) * gap < x * x * exp(1.0 - x * x)) return x;
        uint64_t bits = next_bits(stream);
        int64_t height = bits >> 11;
        strip = bits & (uint64_t)(t->layers - 1);
        if (height < t->sure[strip]) return t->edge[strip] + height * t->scale[strip];
    }
}

static inline double maxwell_speed(stream_t *stream, const tables *t) {
    uint64_t bits = next_bits(stream), strip = bits & (uint64_t)(t->layers - 1);
    int64_t height = bits >> 11;
    if (height < t->sure[strip]) return t->edge[strip] + height * t->scale[strip];
    return speed_beside(strip, stream, t);
}

void bird_by_tables(double *velocities, int64_t draws, double *v, int64_t n, int64_t collisions,
                    uint64_t *words, const tables *given) {
    stream_t stream = {words, words[PLACE]};
    const tables t = *given;
    const double scale = 2.0 * M_PI / t.points * UNIT;
    for (int64_t draw = 0; draw < draws; draw++) {
        for (int64_t k = 0; k < n; k++) v[k] = maxwell_speed(&stream, &t) * random_sign(&stream);
        for (int64_t k = 0; k < collisions; k++) {
            int64_t i, j;
            pair_below(n, &stream, &i, &j);
            /* One of the fixed points on the circle, turned by at most half a step. */
            uint64_t bits = next_bits(&stream), place = 2 * (bits & (uint64_t)(t.points - 1));
            double turn = ((int64_t)bits >> 11) * scale;
            double square = turn * turn, x = t.cos_sin[place], y = t.cos_sin[place + 1];
            double cosine = 1.0 - square * (0.5 - square * (1.0 / 24.0));
            double sine = turn * (1.0 - square * (1.0 / 6.0));
            rotate(v, i, j, x * cosine - y * sine, y * cosine + x * sine);
        }
        velocities[draw] = v[0];
    }
    words[PLACE] = stream.place;
}
