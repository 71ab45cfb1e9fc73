/* Numerical factorisation: assemble a front, take its pivots, hand the rest to the parent.

   The border's own square is not assembled front by front: every task adds up what its pivots
   leave there, some pivots at a time, and the border's front adds up the tasks. */

#define BATCH 32            /* pivots whose traces on the border are subtracted at once */
#define MANY_DELAYED 16     /* a front with more delayed unknowns takes pivots down to WEAK, */
#define WEAK 1e-11
#define MOST_DELAYED 200    /* ... with more than this ANY */
#define ANY 1e-30

typedef struct {
    Arena factors, handed; /* handed: what fronts give to their parents, last in first out */
    double *panel, *square; /* of the front at hand: fully summed columns, and the chain's */
    double *column, *columns;
    size_t panel_room, square_room, columns_room;
    double *border, *left, *right; /* border: (touched, touched); left, right: (BATCH, touched) */
    int batched;
    double *outside;       /* of a solve: sums for positions behind the tasks' */
    int *source;           /* (widest,) of the entries of the front at hand: places in the matrix's values */
    Counts counts;
    int failed;
} Work;

typedef struct {
    Tree tree;
    Part *part;  /* (fronts + 1,) the last is the border's */
    Mark *mark;  /* (fronts + 1,) of `handed`, before each front's */
    Work *work;  /* (tasks + 2,) tasks, top, border */
    double *x;   /* (n,) of a solve, by position; room for finding scales */
    int8_t *scale;            /* (n,) exponents of the rows' scales, in the matrix's order */
    int8_t *product;          /* (nz,) exponent of the product of every entry's two scales */
    int scaled;               /* whether there are scales of an earlier factorisation */
    const double *values;     /* the matrix at hand, until the first solve with its factors */
    double threshold;
    int rank, negative, threads;
    Counts counts;
} Factor;

static int make_room(double **at, size_t *room, size_t need) {
    if (need <= *room && *at) return 1;
    free(*at);
    *at = NULL;
    *room = need + need / 2 + LANES;
    return posix_memalign((void **)at, 64, *room * sizeof(double)) == 0;
}

static void add_vector(double *restrict x, const double *restrict y, int count) {
    for (int i = 0; i < count; i++) x[i] += y[i];
}

/* Add to the lower triangle of a front: `row` and `column` are places among fully summed, chain and border. */
typedef struct {
    double *panel, *square;
    int size, base, stride, square_stride;
} Target;

static inline double *place(const Target *t, int row, int column) {
    int low = row < column ? row : column, high = row < column ? column : row;
    if (low < t->size) return t->panel + (size_t)low * t->stride + (high < t->size ? high : t->base + high - t->size);
    return t->square + (size_t)(low - t->size) * t->square_stride + high - t->size;
}

/* Add what child `c` handed over; its delayed unknowns become fully summed places from `delayed` on. */
static void add_child(const Factor *s, const Target *t, int c, int own, int chain, int delayed) {
    const Tree *tree = &s->tree;
    const Front *v = &tree->front[c];
    const Part *p = &s->part[c];
    const TaskPlan *from = &tree->plan[v->task], *to = v->parent < 0 ? NULL : &tree->plan[tree->front[v->parent].task];
    int late = p->size - p->pivots, columns = late + v->chain, same = from == to;
    const int *map = tree->chain_map + v->chain_at;
    for (int j = 0; j < columns; j++) {
        const double *x = p->rest + (size_t)j * p->rest_stride;
        int column = j < late ? delayed + j : map[j - late] < own ? map[j - late] : map[j - late] - own + t->size;
        for (int i = j; i < columns; i++) {
            int row = i < late ? delayed + i : map[i - late] < own ? map[i - late] : map[i - late] - own + t->size;
            *place(t, row, column) += x[i];
        }
        x += columns;
        if (same) {
            add_vector(place(t, t->size + chain, column), x, from->border);
        } else if (to) { /* the top's front: its border is the whole one */
            for (int b = 0; b < from->border; b++) *place(t, t->size + chain + from->touched[b], column) += x[b];
        } else { /* the border's front: fully summed there */
            for (int b = 0; b < from->border; b++) *place(t, from->touched[b], column) += x[b];
        }
    }
}

static void subtract_batch(Work *w, int touched) {
    int stride = padded(touched);
    update(w->border, stride, touched, touched, w->left, stride, w->right, stride, w->batched);
    w->batched = 0;
}

static void leave_on_border(Work *w, const Part *p, int chain, int touched, int columns_stride) {
    int stride = padded(touched);
    for (int k = 0; k < p->pivots; k++) {
        if (w->batched == BATCH) subtract_batch(w, touched);
        size_t at = (size_t)w->batched++ * stride, bytes = sizeof(double) * touched;
        memcpy(w->left + at, p->panel + (size_t)k * p->stride + p->base + chain, bytes);
        memcpy(w->right + at, w->columns + (size_t)k * columns_stride + chain, bytes);
    }
}

/* Copy what a front could not eliminate to where its parent finds it. */
static int hand_over(Factor *s, Work *w, int f, int chain, int touched) {
    Part *p = &s->part[f];
    int late = p->size - p->pivots, outer = chain + touched, square_stride = padded(outer);
    p->rest_stride = padded(late + outer);
    s->mark[f] = mark(&w->handed);
    if (!(p->rest = take(&w->handed, (size_t)(late + chain) * p->rest_stride))) return 0;
    for (int j = 0; j < late; j++) {
        const double *x = p->panel + (size_t)(p->pivots + j) * p->stride;
        memcpy(p->rest + (size_t)j * p->rest_stride, x + p->pivots, sizeof(double) * late);
        memcpy(p->rest + (size_t)j * p->rest_stride + late, x + p->base, sizeof(double) * outer);
    }
    double *to = p->rest + (size_t)late * p->rest_stride + late;
    for (int j = 0; j < chain; j++, to += p->rest_stride)
        memcpy(to, w->square + (size_t)j * square_stride, sizeof(double) * outer);
    w->counts.delayed += late;
    return 1;
}

/* Room for a front with `size` fully summed and `outer` other rows, all zero. */
static int open_front(Work *w, Part *p, int size, int chain, int outer) {
    p->size = size, p->base = padded(size), p->stride = p->base + padded(outer);
    size_t head = padded((size + 1) / 2 + 2 * size), area = (size_t)p->stride * size;
    size_t square = (size_t)padded(outer) * chain;
    size_t columns = (size_t)padded(outer) * size + 2 * (size_t)p->stride + size;
    if (!make_room(&w->panel, &w->panel_room, head + area) || !make_room(&w->square, &w->square_room, square)
        || !make_room(&w->columns, &w->columns_room, columns)) return 0;
    p->rows = (int *)w->panel, p->inverse = w->panel + (size + 1) / 2, p->panel = w->panel + head;
    w->column = w->columns + (size_t)padded(outer) * size;
    p->initial = w->column + 2 * (size_t)p->stride;
    memset(p->panel, 0, sizeof(double) * area);
    memset(w->square, 0, sizeof(double) * square);
    return 1;
}

/* Numbers that a packed front takes. */
static size_t packed_size(int size, int pivots, int outer) {
    return (size_t)pivots * outer + (size_t)pivots * (2 * size - pivots - 1) / 2;
}

/* Keep of a front what solves need; its panel serves the next one. */
static int pack(Work *w, Part *p, int outer) {
    size_t below = packed_size(p->size, p->pivots, outer), inverse = 2 * (size_t)p->pivots;
    double *block = take(&w->factors, inverse + below + (p->size + 1) / 2), *to = block + inverse;
    if (!block) return 0;
    for (size_t i = 0; i < inverse + below; i += LANES) __builtin_prefetch(to + below + i, 1); /* the next front's */
    memcpy(block, p->inverse, sizeof(double) * inverse);
    p->packed = to;
    for (int k = 0; k < p->pivots; k++) {
        const double *x = p->panel + (size_t)k * p->stride;
        int left = p->size - 1 - k;
        memcpy(to, x + k + 1, sizeof(double) * left);
        memcpy(to + left, x + p->base, sizeof(double) * outer);
        to += left + outer;
    }
    memcpy(to, p->rows, sizeof(int) * p->size);
    p->inverse = block, p->rows = (int *)to, p->panel = NULL;
    return 1;
}

static void mirror(Part *p) {
    for (int j = 0; j < p->size; j++)
        for (int i = j + 1; i < p->size; i++) p->panel[(size_t)i * p->stride + j] = p->panel[(size_t)j * p->stride + i];
}

/* The scaled value of the front's entry number i. What the next front takes, most likely as far on, is fetched. */
static inline double scaled(const Factor *s, Work *w, int i, const Place *e) {
    int64_t k = w->source[i] += e->step;
    __builtin_prefetch(s->values + k + e->step), __builtin_prefetch(s->product + k + e->step);
    return s->values[k] * power_of_two(s->product[k]);
}

static int factorise_front(Factor *s, Work *w, int f) {
    const Tree *t = &s->tree;
    const Front *v = &t->front[f];
    Part *p = &s->part[f];
    int touched = t->plan[v->task].border, outer = v->chain + touched, size = v->own;
    for (int c = t->child[f]; c >= 0; c = t->sibling[c]) size += s->part[c].size - s->part[c].pivots;
    if (!open_front(w, p, size, v->chain, outer)) return 0;
    for (int i = 0; i < v->own; i++) p->rows[i] = v->first + i;
    const Place *e = t->place + v->place_at;
    for (int i = 0, count = (int)(v[1].entry_at - v->entry_at); i < count; i++, e++)
        p->panel[e->column * p->stride + (e->row < v->own ? e->row : e->row - v->own + p->base)] += scaled(s, w, i, e);
    Target target = {p->panel, w->square, size, p->base, p->stride, padded(outer)};
    int delayed = v->own, first = t->child[f];
    for (int c = first; c >= 0; c = t->sibling[c]) {
        const Part *q = &s->part[c];
        add_child(s, &target, c, v->own, v->chain, delayed);
        for (int i = q->pivots; i < q->size; i++) p->rows[delayed++] = q->rows[i];
    }
    if (first >= 0 && t->front[first].task == v->task && v->task < t->tasks) back_to(&w->handed, s->mark[first]);
    mirror(p);
    int late = delayed - v->own, stride = padded(outer);
    double threshold = late > MOST_DELAYED ? ANY : late > MANY_DELAYED ? WEAK : s->threshold;
    factorise_panel(p, threshold, w->column, w->columns, stride, &w->counts);
    update(w->square, stride, outer, v->chain, p->panel + p->base, p->stride, w->columns, stride, p->pivots);
    leave_on_border(w, p, v->chain, touched, stride);
    if (!hand_over(s, w, f, v->chain, touched)) return 0;
    w->counts.factor += (int64_t)p->pivots * p->stride;
    return pack(w, p, outer);
}

static void factorise_task(Factor *s, int a) {
    Work *w = &s->work[a];
    const TaskPlan *plan = &s->tree.plan[a];
    empty(&w->factors), empty(&w->handed);
    w->counts = (Counts){.smallest = INFINITY};
    w->batched = w->failed = 0;
    memset(w->border, 0, sizeof(double) * padded(plan->border) * (size_t)plan->border);
    memset(w->source, 0, sizeof(int) * s->tree.widest);
    for (int f = plan->first; f < plan->end && !w->failed; f++) w->failed = !factorise_front(s, w, f);
    subtract_batch(w, plan->border);
}

/* The last front: the border, and what nobody could eliminate. Every pivot is taken there. */
static int factorise_border(Factor *s) {
    const Tree *t = &s->tree;
    Work *w = &s->work[t->tasks + 1];
    Part *p = &s->part[t->fronts];
    int size = t->border;
    empty(&w->factors);
    w->counts = (Counts){.smallest = INFINITY};
    for (int c = t->child[t->fronts]; c >= 0; c = t->sibling[c]) size += s->part[c].size - s->part[c].pivots;
    if (!open_front(w, p, size, 0, 0)) return 0;
    Target target = {p->panel, NULL, size, p->base, p->stride, 0};
    for (int i = 0; i < t->border; i++) p->rows[i] = t->top + i;
    const Front *v = &t->front[t->fronts];
    const Place *e = t->place + v->place_at;
    memset(w->source, 0, sizeof(int) * t->widest);
    for (int i = 0, count = (int)(v[1].entry_at - v->entry_at); i < count; i++, e++)
        *place(&target, e->row, e->column) += scaled(s, w, i, e);
    for (int b = 0; b <= t->tasks; b++) {
        const TaskPlan *plan = &t->plan[b];
        for (int j = 0; j < plan->border; j++)
            for (int i = j; i < plan->border; i++) {
                double x = s->work[b].border[(size_t)j * padded(plan->border) + i];
                *place(&target, plan->touched[i], plan->touched[j]) += x;
            }
    }
    int delayed = t->border;
    for (int c = t->child[t->fronts]; c >= 0; c = t->sibling[c]) {
        const Part *q = &s->part[c];
        add_child(s, &target, c, 0, 0, delayed);
        for (int i = q->pivots; i < q->size; i++) p->rows[delayed++] = q->rows[i];
    }
    mirror(p);
    factorise_panel(p, 0, w->column, w->columns, 0, &w->counts);
    w->counts.null += p->size - p->pivots;
    w->counts.factor += (int64_t)p->pivots * p->stride;
    return pack(w, p, 0);
}
