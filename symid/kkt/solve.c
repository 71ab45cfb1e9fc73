/* Substitution with the factors; tasks side by side, always summed in the same order. */

/* Value of a position, where positions behind the tasks' may have another home. */
static inline double *home(double *x, double *outside, int inner, int p) {
    return p < inner ? x + p : outside + p - inner;
}

static inline int position_of(int row) { return row < 0 ? ~row : row; }

/* Column k of a front as its panel held it, in `column` (stride), which is zero elsewhere; returns the next packed one.
   Columns are unpacked in turn, up or down. */
static inline const double *unpack(const Part *p, int k, int outer, const double *packed, double *column) {
    int left = p->size - 1 - k;
    column[k] = 0;
    memcpy(column + k + 1, packed, sizeof(double) * left);
    memcpy(column + p->base, packed + left, sizeof(double) * outer);
    return packed + left + outer;
}

static void forward_front(const Factor *s, int f, double *x, double *outside, double *y) {
    const Tree *t = &s->tree;
    const Part *p = &s->part[f];
    const Front *v = &t->front[f];
    int chain = f < t->fronts ? v->chain : 0, border = f < t->fronts ? t->plan[v->task].border : 0;
    const double *packed = p->packed;
    double *column = y + p->stride;
    memset(y, 0, sizeof(double) * 2 * p->stride);
    for (int k = 0; k < p->pivots; k++) y[k] = *home(x, outside, t->inner, position_of(p->rows[k]));
    for (int k = 0; k < p->pivots; k++) {
        packed = unpack(p, k, chain + border, packed, column);
        subtract(y, column, y[k], k & ~(LANES - 1), p->stride);
    }
    for (int k = 0; k < p->pivots; k++) *home(x, outside, t->inner, position_of(p->rows[k])) = y[k];
    for (int k = p->pivots; k < p->size; k++) *home(x, outside, t->inner, position_of(p->rows[k])) += y[k];
    const int *c = t->chain + v->chain_at;
    for (int k = 0; k < chain; k++) *home(x, outside, t->inner, c[k]) += y[p->base + k];
    if (!border) return;
    const TaskPlan *plan = &t->plan[v->task];
    double *to = outside + t->top - t->inner;
    for (int b = 0; b < border; b++) to[plan->touched[b]] += y[p->base + chain + b];
}

static inline double product(const double *restrict x, const double *restrict y, int from, int to) {
    Vector sum = {0};
    for (int i = from; i < to; i += LANES) sum += *(const Vector *)(x + i) * *(const Vector *)(y + i);
    return ((sum[0] + sum[4]) + (sum[2] + sum[6])) + ((sum[1] + sum[5]) + (sum[3] + sum[7]));
}

static void backward_front(const Factor *s, int f, double *x, double *y) {
    const Tree *t = &s->tree;
    const Part *p = &s->part[f];
    const Front *v = &t->front[f];
    int chain = f < t->fronts ? v->chain : 0, border = f < t->fronts ? t->plan[v->task].border : 0;
    const int *c = t->chain + v->chain_at;
    const double *packed = p->packed + packed_size(p->size, p->pivots, chain + border);
    double *column = y + p->stride;
    memset(y, 0, sizeof(double) * 2 * p->stride);
    for (int k = 0; k < p->size; k++) y[k] = x[position_of(p->rows[k])];
    for (int k = 0; k < chain; k++) y[p->base + k] = x[c[k]];
    for (int b = 0; b < border; b++) y[p->base + chain + b] = x[t->top + t->plan[v->task].touched[b]];
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
        packed -= p->size - 1 - k + chain + border;
        unpack(p, k, chain + border, packed, column);
        y[k] -= product(column, y, k & ~(LANES - 1), p->stride);
    }
    for (int k = 0; k < p->pivots; k++) x[position_of(p->rows[k])] = y[k];
}

static double *vector_of(Work *w, const Part *p) {
    return make_room(&w->columns, &w->columns_room, 2 * (size_t)p->stride) ? w->columns : NULL;
}

static int forward_task(Factor *s, int a, double *outside) {
    for (int f = s->tree.plan[a].first; f < s->tree.plan[a].end; f++) {
        double *y = vector_of(&s->work[a], &s->part[f]);
        if (!y) return 0;
        forward_front(s, f, s->x, outside, y);
    }
    return 1;
}

static int backward_task(Factor *s, int a) {
    for (int f = s->tree.plan[a].end - 1; f >= s->tree.plan[a].first; f--) {
        double *y = vector_of(&s->work[a], &s->part[f]);
        if (!y) return 0;
        backward_front(s, f, s->x, y);
    }
    return 1;
}
