/* The tree of fronts: who hands what to whom, which subtrees are a task of their own, and where
   every entry of the matrix goes. Made once for a pattern. */

#define TASKS 32 /* a subtree with less than this part of the work is no task of its own */

typedef struct {
    int own;           /* unknowns that this front is first to hold fully summed */
    int first;         /* position of the first of them; the others follow */
    int chain;         /* later unknowns outside the border that it touches */
    int place_at;      /* where the places of its entries begin */
    int64_t chain_at;  /* where their list begins */
    int parent;        /* -1: the border's front */
    int task;
    int64_t entry_at;
} Front;

typedef struct {
    unsigned short row, column; /* row: own, then chain, then border */
    int step; /* in the matrix's values, from what stood at this turn in the task's front before */
} Place;

typedef struct {
    int first, end;  /* fronts */
    int border;      /* border unknowns that its fronts touch */
    int *touched;    /* their numbers in the border */
} TaskPlan;

typedef struct {
    int n, fronts, tasks, border; /* the last of the tasks, number `tasks`, is the top of the tree */
    int inner, top;               /* positions: tasks' unknowns, the top's from `inner`, the border's from `top` */
    int *position;                /* (n,) */
    int *child, *sibling;         /* (fronts + 1,) first child, next sibling, -1; the border's front is last */
    Front *front;                 /* children before parents */
    int *chain, *chain_map;       /* positions, and places in the parent: own unknowns, then its chain */
    Place *place;                 /* of the fronts' entries in turn; fronts alike, as a chain's are, share theirs */
    int widest;                   /* most entries of a front */
    TaskPlan *plan;               /* (tasks + 1,) */
    double flops, factor;         /* multiplications and numbers of a factorisation without delays */
} Tree;

typedef struct {
    int count, *parent, *child, *sibling, *fresh; /* by turn; fresh: number in the tree */
    int64_t *own_at;
    int *own;          /* unknowns by turn */
    int64_t *chain_at; /* (count + 1,) */
    int *chain;
    int64_t room;
    double *work;      /* of the subtree */
} Draft;

static void free_draft(Draft *d) {
    free(d->parent), free(d->child), free(d->sibling), free(d->fresh), free(d->own_at), free(d->own);
    free(d->chain_at), free(d->chain), free(d->work);
}

static void sort_by_turn(Draft *d, const int *turn, int n) {
    for (int i = 0; i < n; i++)
        if (turn[i] >= 0) d->own_at[turn[i] + 1]++;
    for (int t = 0; t < d->count; t++) d->own_at[t + 1] += d->own_at[t];
    int64_t *at = malloc(sizeof(int64_t) * (d->count + 1));
    memcpy(at, d->own_at, sizeof(int64_t) * (d->count + 1));
    for (int i = 0; i < n; i++)
        if (turn[i] >= 0) d->own[at[turn[i]]++] = i;
    free(at);
}

static void add_chain(Draft *d, int64_t *count, int i) {
    if (*count == d->room) d->chain = realloc(d->chain, sizeof(int) * (size_t)(d->room = 2 * d->room + 1024));
    d->chain[(*count)++] = i;
}

/* Symbolic factorisation: what each turn's front touches, and who comes next. */
static void find_parents(Draft *d, const Graph *g, const int *turn, int border) {
    int *seen = malloc(sizeof(int) * (g->n + 1));
    int64_t count = 0;
    for (int i = 0; i < g->n; i++) seen[i] = -1;
    for (int t = 0; t < d->count; t++) {
        d->chain_at[t] = count;
        for (int64_t o = d->own_at[t]; o < d->own_at[t + 1]; o++)
            for (int64_t k = g->start[d->own[o]]; k < g->start[d->own[o] + 1]; k++) {
                int j = g->to[k];
                if (turn[j] > t && seen[j] != t) seen[j] = t, add_chain(d, &count, j);
            }
        double own = (double)(d->own_at[t + 1] - d->own_at[t]);
        for (int c = d->child[t]; c >= 0; c = d->sibling[c]) {
            d->work[t] += d->work[c];
            for (int64_t k = d->chain_at[c]; k < d->chain_at[c + 1]; k++) {
                int j = d->chain[k];
                if (turn[j] > t && seen[j] != t) seen[j] = t, add_chain(d, &count, j);
            }
        }
        int next = d->count;
        for (int64_t k = d->chain_at[t]; k < count; k++)
            if (turn[d->chain[k]] < next) next = turn[d->chain[k]];
        d->chain_at[t + 1] = count;
        d->parent[t] = next < d->count ? next : -1;
        if (next < d->count) d->sibling[t] = d->child[next], d->child[next] = t;
        double rest = (double)(count - d->chain_at[t]) + border;
        d->work[t] += own * (own * own / 3 + own * rest + rest * rest / 2);
    }
    free(seen);
}

static int make_draft(Draft *d, const Graph *g, const int *turn, int count, int border) {
    *d = (Draft){.count = count};
    size_t ints = sizeof(int) * (count + 1);
    d->parent = malloc(ints), d->child = malloc(ints), d->sibling = malloc(ints), d->fresh = malloc(ints);
    d->own_at = zeros(count + 2, sizeof(int64_t)), d->chain_at = zeros(count + 2, sizeof(int64_t));
    d->own = malloc(sizeof(int) * (g->n + 1)), d->work = zeros(count + 1, sizeof(double));
    for (int t = 0; t < count; t++) d->child[t] = d->sibling[t] = -1;
    sort_by_turn(d, turn, g->n);
    find_parents(d, g, turn, border);
    return 1;
}

/* Number the fronts so that every subtree is contiguous, tasks first and the top of the tree last. */
static void number_fronts(Draft *d, Tree *t, int *task_of) {
    double total = 0;
    int *size = malloc(sizeof(int) * (d->count + 1)), *end = malloc(sizeof(int) * (d->count + 1));
    char *top = zeros(d->count + 1, 1);
    for (int i = 0; i < d->count; i++)
        if (d->parent[i] < 0) total += d->work[i];
    for (int i = 0; i < d->count; i++) {
        int heavy = 0;
        size[i] = 1;
        for (int c = d->child[i]; c >= 0; c = d->sibling[c]) {
            size[i] += size[c], heavy += d->work[c] * TASKS >= total;
            top[i] |= top[c];
        }
        top[i] |= heavy > 1;
    }
    int next = 0, tasks = 0, open = -1;
    double filled = 0;
    for (int i = 0; i < d->count; i++) { /* whole subtrees outside the top, packed into tasks */
        if (top[i] || (d->parent[i] >= 0 && !top[d->parent[i]])) continue;
        if (open < 0 || filled + d->work[i] > total / TASKS) open = tasks++, filled = 0;
        filled += d->work[i], task_of[i] = open, next += size[i], end[i] = next;
    }
    for (int i = 0; i < d->count; i++)
        if (top[i]) d->fresh[i] = next++, task_of[i] = tasks;
    for (int i = d->count - 1; i >= 0; i--) {
        if (top[i]) continue;
        int at = end[i];
        d->fresh[i] = --at;
        for (int c = d->child[i]; c >= 0; c = d->sibling[c]) end[c] = at, at -= size[c], task_of[c] = task_of[i];
    }
    t->tasks = tasks;
    free(size), free(end), free(top);
}

static int ascending(const void *a, const void *b) { return *(const int *)a - *(const int *)b; }

static void fill_fronts(Draft *d, Tree *t, const int *turn, const int *task_of) {
    int *of = malloc(sizeof(int) * (d->count + 1)), at = 0;
    for (int i = 0; i < d->count; i++) of[d->fresh[i]] = i;
    for (int f = 0; f < d->count; f++) {
        int i = of[f];
        t->front[f] = (Front){.own = (int)(d->own_at[i + 1] - d->own_at[i]), .first = at,
                              .chain = (int)(d->chain_at[i + 1] - d->chain_at[i]), .chain_at = d->chain_at[i],
                              .parent = d->parent[i] < 0 ? -1 : d->fresh[d->parent[i]], .task = task_of[i]};
        if (task_of[i] < t->tasks) t->inner = at + t->front[f].own;
        TaskPlan *p = &t->plan[task_of[i]];
        if (p->end == 0) p->first = f;
        p->end = f + 1;
        for (int64_t k = d->own_at[i]; k < d->own_at[i + 1]; k++) t->position[d->own[k]] = at++;
    }
    for (int f = 0; f <= d->count; f++) t->child[f] = t->sibling[f] = -1;
    for (int f = d->count - 1; f >= 0; f--) {
        int *first = &t->child[t->front[f].parent < 0 ? d->count : t->front[f].parent];
        t->sibling[f] = *first, *first = f;
    }
    t->top = at;
    for (int i = 0; i < t->n; i++)
        if (turn[i] < 0) t->position[i] = at++;
    t->border = at - t->top;
    t->chain = d->chain, d->chain = NULL;
    for (int f = 0; f < d->count; f++) {
        int *c = t->chain + t->front[f].chain_at;
        for (int k = 0; k < t->front[f].chain; k++) c[k] = t->position[c[k]];
        qsort(c, t->front[f].chain, sizeof(int), ascending);
    }
    free(of);
}

/* Place of position `p` in a front: own, then chain; -1 where it is not there. */
static int place_in(const Tree *t, const Front *f, int p) {
    if (p < f->first + f->own) return p >= f->first ? p - f->first : -1;
    const int *c = t->chain + f->chain_at;
    int low = 0, high = f->chain;
    while (low < high) {
        int middle = (low + high) / 2;
        if (c[middle] < p) low = middle + 1;
        else high = middle;
    }
    return low < f->chain && c[low] == p ? f->own + low : -1;
}

static void map_to_parents(Tree *t) {
    int64_t total = t->fronts ? t->front[0].chain_at : 0;
    for (int f = 0; f < t->fronts; f++)
        if (t->front[f].chain_at + t->front[f].chain > total) total = t->front[f].chain_at + t->front[f].chain;
    t->chain_map = malloc(sizeof(int) * (size_t)(total + 1));
    for (int f = 0; f < t->fronts; f++) {
        const Front *v = &t->front[f];
        for (int k = 0; k < v->chain; k++)
            t->chain_map[v->chain_at + k] = place_in(t, &t->front[v->parent], t->chain[v->chain_at + k]);
    }
}
