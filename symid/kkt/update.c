/* Rank-k updates of the columns that a front hands on: x -= l m', eight rows by four columns at a time. */

#define TILE 4

/* x (8 rows, `wide` <= 4 columns) -= l[:8, k] m[:wide, k] for all k. */
static inline __attribute__((always_inline)) void
tile(double *x, int xs, const double *l, int ls, const double *m, int ms, int k, int wide) {
    Vector s[TILE][WORDS];
    for (int j = 0; j < wide; j++)
        for (int h = 0; h < WORDS; h++) s[j][h] = load(x + (size_t)j * xs + h * WIDTH);
    for (int i = 0; i < k; i++) {
        const double *v = l + (size_t)i * ls, *c = m + (size_t)i * ms;
        for (int j = 0; j < wide; j++)
            for (int h = 0; h < WORDS; h++) s[j][h] -= load(v + h * WIDTH) * c[j];
    }
    for (int j = 0; j < wide; j++)
        for (int h = 0; h < WORDS; h++) *at(x + (size_t)j * xs + h * WIDTH) = s[j][h];
}

/* The lower part of x (rows, columns) -= l m': columns of x `xs` apart, of l `ls`, of m `ms`; l is readable
   up to a full vector of rows, x writable. */
static void update(double *x, int xs, int rows, int columns, const double *l, int ls, const double *m, int ms, int k) {
    for (int j = 0; j < columns; j += TILE) {
        int wide = columns - j < TILE ? columns - j : TILE;
        for (int i = j & ~(LANES - 1); i < rows; i += LANES) {
            double *to = x + (size_t)j * xs + i;
            if (wide == 4) tile(to, xs, l + i, ls, m + j, ms, k, 4);
            else if (wide == 3) tile(to, xs, l + i, ls, m + j, ms, k, 3);
            else if (wide == 2) tile(to, xs, l + i, ls, m + j, ms, k, 2);
            else tile(to, xs, l + i, ls, m + j, ms, k, 1);
        }
    }
}
