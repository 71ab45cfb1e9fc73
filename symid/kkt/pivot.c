/* Dense fronts: pivots of one or two columns, and the columns that they leave behind.

   A panel holds the fully summed columns of a front, each over all rows of the front, by column;
   both triangles of its square part are kept, so that every column is contiguous. Its rows are
   the fully summed ones, from `base` on the chain's and the border's, each part filled up with
   zeros to full vectors.

   What a solve needs of a panel is kept packed, once its pivots are taken: of every pivot's column
   the fully summed rows below it, then the chain's and the border's, without the zeros. */

#define GOOD 1e-3        /* a pivot whose multipliers are below the inverse of this is taken at once */
#define NOTHING 2e-15     /* a column brought down to this part of itself is rounding: zero */

typedef struct {
    double *panel;           /* of the front at hand only */
    double *packed;          /* its pivots' columns, for solves */
    double *inverse;         /* of the pivots, (pivots, 2): diagonal, and beside it for a pair's first */
    int *rows;               /* positions of the fully summed, pivots first; the first of a pair as ~position */
    double *initial;         /* largest entry of each fully summed column before elimination */
    int size, base, pivots, stride;
    double *rest;            /* what the parent gets: delayed and chain columns over delayed, chain, border */
    int rest_stride;
} Part;

typedef struct {
    int kind; /* columns: 1, 2, or 0 where there is none */
    int null; /* a column of zeros */
    int a, b; /* b of a pair only */
    double quality;
} Pivot;

static Pivot better(Pivot x, Pivot y) { return y.quality > x.quality ? y : x; }

/* The best pivot that begins with column j: it alone, its largest partner alone, or both. */
static Pivot pivot_at(const Part *p, int k, int j) {
    int stride = p->stride, from = k & ~(LANES - 1), r = -1;
    double *x = p->panel + (size_t)j * stride, d = x[j];
    double g = largest_beside(x, j, j, from, stride), partner = 0;
    if (fmax(g, fabs(d)) <= NOTHING * p->initial[j]) return (Pivot){1, 1, j, -1, INFINITY};
    Pivot best = {1, 0, j, -1, g > 0 ? fabs(d) / g : INFINITY};
    if (best.quality >= GOOD) return best;
    for (int i = k; i < p->size; i++)
        if (i != j && fabs(x[i]) > partner) partner = fabs(x[i]), r = i;
    if (r < 0) return best;
    double *y = p->panel + (size_t)r * stride, e = y[r];
    if (e != 0) best = better(best, (Pivot){1, 0, r, -1, fabs(e) / largest_beside(y, r, r, from, stride)});
    if (best.quality >= GOOD) return best;
    double gj = g > partner ? g : largest_beside(x, j, r, from, stride), gr = largest_beside(y, j, r, from, stride);
    double det = fabs(d * e - partner * partner);
    double growth = fmax(fabs(e) * gj + partner * gr, partner * gj + fabs(d) * gr);
    return better(best, (Pivot){2, 0, j, r, growth > 0 ? det / growth : INFINITY});
}

static Pivot choose(const Part *p, int k, double threshold) {
    Pivot best = {0, 0, -1, -1, 0};
    for (int j = k; j < p->size; j++) {
        Pivot here = pivot_at(p, k, j);
        if (here.quality >= GOOD) return here;
        best = better(best, here);
    }
    return best.quality >= threshold ? best : (Pivot){0, 0, -1, -1, 0};
}

static void exchange(Part *p, int a, int b) {
    if (a == b) return;
    double *x = p->panel + (size_t)a * p->stride, *y = p->panel + (size_t)b * p->stride;
    for (int i = 0; i < p->stride; i += WIDTH) {
        Vector t = load(x + i);
        *at(x + i) = load(y + i), *at(y + i) = t;
    }
    for (int j = 0; j < p->size; j++) {
        double *c = p->panel + (size_t)j * p->stride, t = c[a];
        c[a] = c[b], c[b] = t;
    }
    int row = p->rows[a];
    double initial = p->initial[a];
    p->rows[a] = p->rows[b], p->rows[b] = row;
    p->initial[a] = p->initial[b], p->initial[b] = initial;
}

static inline void subtract(double *restrict x, const double *restrict l, double c, int from, int to) {
    for (int i = from; i < to; i += WIDTH) *at(x + i) -= load(l + i) * c;
}

static inline void subtract_pair(double *restrict x, const double *restrict l, const double *restrict m, double c,
                                 double d, int from, int to) {
    for (int i = from; i < to; i += WIDTH) *at(x + i) -= load(l + i) * c + load(m + i) * d;
}

/* What a pivot leaves behind: `columns`, its columns before division, keep the rows from `base` on. */
static void eliminate_single(Part *p, int k, double *column, double *columns, int columns_stride) {
    double *x = p->panel + (size_t)k * p->stride, d = x[k], inverse = d != 0 ? 1 / d : 0;
    int from = k & ~(LANES - 1);
    memcpy(column + from, x + from, sizeof(double) * (p->stride - from));
    memcpy(columns + (size_t)k * columns_stride, x + p->base, sizeof(double) * (p->stride - p->base));
    for (int i = from; i < p->stride; i += WIDTH) *at(x + i) *= inverse;
    for (int i = 0; i <= k; i++) x[i] = 0;
    for (int j = k + 1; j < p->size; j++) {
        double *y = p->panel + (size_t)j * p->stride;
        if (column[j] != 0) subtract(y, x, column[j], from, p->stride);
        y[k] = 0;
    }
    p->inverse[2 * k] = inverse, p->inverse[2 * k + 1] = 0;
}

static void eliminate_pair(Part *p, int k, double *column, double *columns, int columns_stride) {
    int s = p->stride, from = k & ~(LANES - 1);
    double *x = p->panel + (size_t)k * s, *y = x + s, *other = column + s;
    double a = x[k], b = x[k + 1], c = y[k + 1], det = a * c - b * b;
    double ia = c / det, ib = -b / det, ic = a / det;
    memcpy(column + from, x + from, sizeof(double) * (s - from));
    memcpy(other + from, y + from, sizeof(double) * (s - from));
    memcpy(columns + (size_t)k * columns_stride, x + p->base, sizeof(double) * (s - p->base));
    memcpy(columns + (size_t)(k + 1) * columns_stride, y + p->base, sizeof(double) * (s - p->base));
    for (int i = from; i < s; i += WIDTH) {
        Vector v = load(x + i), w = load(y + i);
        *at(x + i) = v * ia + w * ib, *at(y + i) = v * ib + w * ic;
    }
    for (int i = 0; i <= k + 1; i++) x[i] = y[i] = 0;
    for (int j = k + 2; j < p->size; j++) {
        double *z = p->panel + (size_t)j * s;
        if (column[j] != 0 || other[j] != 0) subtract_pair(z, x, y, column[j], other[j], from, s);
        z[k] = z[k + 1] = 0;
    }
    p->inverse[2 * k] = ia, p->inverse[2 * k + 1] = ib, p->inverse[2 * k + 2] = ic, p->inverse[2 * k + 3] = 0;
    p->rows[k] = ~p->rows[k];
}

typedef struct {
    int64_t negative, null, delayed, factor;
    double smallest; /* quality of a pivot */
} Counts;

static void count_single(Counts *n, double d) {
    n->negative += d < 0;
    n->null += d == 0;
}

static void count_pair(Counts *n, double a, double b, double c) {
    n->negative += a * c - b * b < 0 ? 1 : a < 0 ? 2 : 0;
}

/* Factorise the panel as far as pivots are good enough; p->pivots of them are in front afterwards. */
static void factorise_panel(Part *p, double threshold, double *column, double *columns, int columns_stride, Counts *n) {
    int k = 0;
    for (int j = 0; j < p->size; j++) p->initial[j] = largest(p->panel + (size_t)j * p->stride, 0, p->stride);
    while (k < p->size) {
        Pivot v = choose(p, k, threshold);
        if (v.kind == 0) break;
        if (v.quality < n->smallest) n->smallest = v.quality;
        exchange(p, k, v.a);
        double *x = p->panel + (size_t)k * p->stride;
        if (v.kind == 1) {
            if (v.null) x[k] = 0;
            count_single(n, x[k]);
            eliminate_single(p, k, column, columns, columns_stride);
        } else {
            exchange(p, k + 1, v.b == k ? v.a : v.b);
            count_pair(n, x[k], x[k + 1], x[p->stride + k + 1]);
            eliminate_pair(p, k, column, columns, columns_stride);
        }
        k += v.kind;
    }
    p->pivots = k;
}
