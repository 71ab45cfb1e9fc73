/* Vectors as wide as this processor's registers: GCC keeps wider ones in memory, word by word. Sums go by LANES, so
   that every width gives the same bits. */

#ifndef WIDTH /* a test gives it */
#if defined(__AVX512F__)
#define WIDTH 8
#elif defined(__AVX__)
#define WIDTH 4
#else
#define WIDTH 2
#endif
#endif
#define WORDS (LANES / WIDTH)

typedef double Vector __attribute__((vector_size(8 * WIDTH), aligned(8), may_alias));
typedef int64_t Bits __attribute__((vector_size(8 * WIDTH), aligned(8), may_alias));

static inline Vector *at(double *x) { return (Vector *)x; }
static inline Vector load(const double *x) { return *(const Vector *)x; }

static const int64_t KEPT[3 * WIDTH] = {[WIDTH ... 2 * WIDTH - 1] = -1};

static inline int clipped(int i) { return i < 0 ? 0 : i < WIDTH ? i : WIDTH; }

/* The vector at x, zero but for its entries from `low` up to, without, `high`. */
static inline Vector masked(const double *x, int low, int high) {
    Bits above = *(const Bits *)(KEPT + WIDTH - clipped(low)), below = *(const Bits *)(KEPT + 2 * WIDTH - clipped(high));
    return (Vector)(*(const Bits *)x & above & below);
}

/* Of the entries by lane, in an order that no width changes. */
static inline double sum(const Vector *x) {
    double s[LANES];
    memcpy(s, x, sizeof s);
    for (int half = LANES / 2; half; half /= 2)
        for (int j = 0; j < half; j++) s[j] += s[j + half];
    return s[0];
}

/* The largest absolute value of x[from:to] but for those of places a and b; NaN where there is one. `from` and `to` are
   so many vectors apart. Absolute values order like their bits. */
static inline double largest_beside(const double *x, int a, int b, int from, int to) {
    static const int64_t first[8] = {0, 1, 2, 3, 4, 5, 6, 7};
    Bits high = {0}, place = *(const Bits *)first + from;
    for (int i = from; i < to; i += WIDTH, place += WIDTH) {
        Bits here = *(const Bits *)(x + i) & INT64_MAX & ~((place == a) | (place == b)), more = here > high;
        high = (here & more) | (high & ~more);
    }
    int64_t most = 0;
    for (int j = 0; j < WIDTH; j++) most = high[j] > most ? high[j] : most;
    double out;
    memcpy(&out, &most, 8);
    return out;
}

static inline double largest(const double *x, int from, int to) { return largest_beside(x, -1, -1, from, to); }
