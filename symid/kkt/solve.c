/* Substitution with the factors; tasks side by side, always summed in the same order. */

/* Value of a position, where positions behind the tasks' may have another home. */
static inline double *home(double *x, double *outside, int inner, int p) {
    return p < inner ? x + p : outside + p - inner;
}

static inline int position_of(int row) { return row < 0 ? ~row : row; }

/* A front's unknowns are y: the fully summed, the chain's, the border's. Column k of the factor is packed: its rows from
   k + 1 on. It is loaded where the vectors of y are, so that these are stored and loaded as the same ones. */

static void forward_front(const Factor *s, int f, double *x, double *outside, double *y) {
    const Tree *t = &s->tree;
    const Part *p = &s->part[f];
    const Front *v = &t->front[f];
    int chain = f < t->fronts ? v->chain : 0, border = f < t->fronts ? t->plan[v->task].border : 0;
    int all = p->size + chain + border;
    const double *packed = p->packed;
    memset(y, 0, sizeof(double) * padded(all));
    for (int k = 0; k < p->pivots; k++) y[k] = *home(x, outside, t->inner, position_of(p->rows[k]));
    for (int k = 0; k < p->pivots; k++) {
        double a = y[k];
        *home(x, outside, t->inner, position_of(p->rows[k])) = a;
        /* Vectors begin before row k + 1 and end behind the last row: nobody reads there any more. */
        for (int i = (k + 1) & ~(WIDTH - 1); i < all; i += WIDTH)
            *at(y + i) -= load(packed + i - k - 1) * a;
        packed += all - 1 - k;
    }
    for (int k = p->pivots; k < p->size; k++) *home(x, outside, t->inner, position_of(p->rows[k])) += y[k];
    const int *c = t->chain + v->chain_at;
    for (int k = 0; k < chain; k++) *home(x, outside, t->inner, c[k]) += y[p->size + k];
    if (!border) return;
    const TaskPlan *plan = &t->plan[v->task];
    double *to = outside + t->top - t->inner;
    for (int b = 0; b < border; b++) to[plan->touched[b]] += y[p->size + chain + b];
}

/* Of column k of the factor and y; only the first and the last lanes hold what does not belong to them. */
static inline double product_below(const double *packed, const double *y, int k, int all) {
    Vector product[WORDS] = {{0}};
    int i = (k + 1) & ~(LANES - 1);
    const double *x = packed - k - 1;
    for (int h = 0; i < all && h < WORDS; h++)
        product[h] += masked(x + i + h * WIDTH, k + 1 - i - h * WIDTH, all - i - h * WIDTH) * load(y + i + h * WIDTH);
    for (i += LANES; i + LANES <= all; i += LANES)
        for (int h = 0; h < WORDS; h++) product[h] += load(x + i + h * WIDTH) * load(y + i + h * WIDTH);
    for (int h = 0; i < all && h < WORDS; h++)
        product[h] += masked(x + i + h * WIDTH, 0, all - i - h * WIDTH) * load(y + i + h * WIDTH);
    return sum(product);
}

static void backward_front(const Factor *s, int f, double *x, double *y) {
    const Tree *t = &s->tree;
    const Part *p = &s->part[f];
    const Front *v = &t->front[f];
    int chain = f < t->fronts ? v->chain : 0, border = f < t->fronts ? t->plan[v->task].border : 0;
    int all = p->size + chain + border;
    const int *c = t->chain + v->chain_at;
    const double *packed = p->packed + packed_size(p->size, p->pivots, chain + border);
    memset(y, 0, sizeof(double) * padded(all));
    for (int k = 0; k < p->size; k++) y[k] = x[position_of(p->rows[k])];
    for (int k = 0; k < chain; k++) y[p->size + k] = x[c[k]];
    for (int b = 0; b < border; b++) y[p->size + chain + b] = x[t->top + t->plan[v->task].touched[b]];
    for (int k = 0; k < p->pivots; k++) {
        const double *d = p->inverse + 2 * k;
        double a = y[k];
        if (p->rows[k] >= 0) y[k] = d[0] * a;
        else {
            double b = y[k + 1];
            y[k] = d[0] * a + d[1] * b, y[k + 1] = d[1] * a + d[2] * b;
            k++;
        }
    }
    for (int k = p->pivots - 1; k >= 0; k--) {
        packed -= all - 1 - k;
        y[k] -= product_below(packed, y, k, all);
    }
    for (int k = 0; k < p->pivots; k++) x[position_of(p->rows[k])] = y[k];
}

static double *vector_of(Work *w, const Part *p) {
    return make_room(&w->columns, &w->columns_room, (size_t)p->stride + LANES) ? w->columns : NULL;
}

/* What is kept of a front, asked for while its neighbour is at work: factors do not fit into a processor's own memory. */
static void fetch_front(const Factor *s, int f) {
    const Part *p = &s->part[f];
    const Front *v = &s->tree.front[f];
    size_t kept = 2 * p->pivots + packed_size(p->size, p->pivots, v->chain + s->tree.plan[v->task].border) + p->size / 2;
    for (size_t i = 0; i < kept; i += LANES) __builtin_prefetch(p->inverse + i);
}

static int forward_task(Factor *s, int a, double *outside) {
    for (int f = s->tree.plan[a].first; f < s->tree.plan[a].end; f++) {
        double *y = vector_of(&s->work[a], &s->part[f]);
        if (!y) return 0;
        if (f + 1 < s->tree.plan[a].end) fetch_front(s, f + 1);
        forward_front(s, f, s->x, outside, y);
    }
    return 1;
}

static int backward_task(Factor *s, int a) {
    for (int f = s->tree.plan[a].end - 1; f >= s->tree.plan[a].first; f--) {
        double *y = vector_of(&s->work[a], &s->part[f]);
        if (!y) return 0;
        if (f > s->tree.plan[a].first) fetch_front(s, f - 1);
        backward_front(s, f, s->x, y);
    }
    return 1;
}
