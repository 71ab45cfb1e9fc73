/* Where every entry of the matrix goes, and the tree as a whole. */

#define WIDEST_FRONT 60000 /* rows: places in a front are kept in 16 bits */

static int owner_of(const Tree *t, const int *front_at, int p) { return p >= t->top ? t->fronts : front_at[p]; }

/* The border unknowns that each task touches. */
static void find_touched(Tree *t, const int *front_at, int64_t nz, const int *irn, const int *jcn) {
    char *touched = zeros((size_t)(t->tasks + 1) * (t->border + 1), 1);
    for (int64_t k = 0; k < nz; k++) {
        int a = t->position[irn[k] - 1], b = t->position[jcn[k] - 1];
        int low = a < b ? a : b, high = a < b ? b : a;
        if (high >= t->top && low < t->top)
            touched[(size_t)t->front[front_at[low]].task * t->border + high - t->top] = 1;
    }
    for (int a = 0; a <= t->tasks; a++) {
        TaskPlan *p = &t->plan[a];
        p->touched = malloc(sizeof(int) * (t->border + 1));
        for (int b = 0; b < t->border; b++)
            if (a == t->tasks || touched[(size_t)a * t->border + b]) p->touched[p->border++] = b;
    }
    free(touched);
}

/* Turn places in the matrix's values, by front, into steps from front to front: those of a chain are all the same. */
static int find_steps(Tree *t, const int *source) {
    for (int f = 0; f <= t->fronts; f++) {
        int64_t count = t->front[f + 1].entry_at - t->front[f].entry_at;
        if (count > t->widest) t->widest = (int)count;
    }
    size_t bytes = sizeof(int) * (size_t)(t->widest + 1);
    int *last = malloc(bytes);
    for (int f = 0; f <= t->fronts && last; f++) {
        const Front *v = &t->front[f];
        if (f == t->fronts || f == t->plan[v->task].first) memset(last, 0, bytes);
        for (int64_t k = v->entry_at, i = 0; k < v[1].entry_at; k++, i++)
            t->place[k].step = source[k] - last[i], last[i] = source[k];
    }
    free(last);
    return last != NULL;
}

/* Keep every list of places once, in front of all; fronts find theirs by a table of those before them. */
static int share_places(Tree *t) {
    int64_t end = 0, room = 16;
    while (room < 2 * (int64_t)t->fronts) room *= 2;
    int *table = malloc(sizeof(int) * room);
    if (!table) return 0;
    for (int64_t i = 0; i < room; i++) table[i] = -1;
    for (int f = 0; f <= t->fronts; f++) {
        Front *v = &t->front[f];
        Place *own = t->place + v->entry_at;
        int64_t count = v[1].entry_at - v->entry_at, i = 0;
        uint64_t hash = 1469598103934665603u;
        for (int64_t k = 0; k < count; k++)
            hash = (hash ^ ((uint64_t)own[k].step << 32 | own[k].row << 16 | own[k].column)) * 1099511628211u;
        for (i = (int64_t)(hash >> 20) & (room - 1); table[i] >= 0; i = (i + 1) & (room - 1)) {
            const Front *w = &t->front[table[i]];
            if (w[1].entry_at - w->entry_at == count
                && !memcmp(t->place + w->place_at, own, sizeof(Place) * count)) break;
        }
        if (table[i] < 0) {
            table[i] = f, v->place_at = (int)end, end += count;
            memmove(t->place + v->place_at, own, sizeof(Place) * count);
        }
        v->place_at = t->front[table[i]].place_at;
    }
    free(table);
    Place *kept = realloc(t->place, sizeof(Place) * (size_t)(end + 1));
    if (kept) t->place = kept;
    return 1;
}

/* Fills `t->place`, by front; those of the border alone come last. */
static int place_entries(Tree *t, int64_t nz, const int *irn, const int *jcn) {
    int *front_at = malloc(sizeof(int) * (t->n + 1));
    int *border_place = malloc(sizeof(int) * ((size_t)(t->tasks + 1) * t->border + 1));
    int64_t *at = zeros(t->fronts + 2, sizeof(int64_t));
    for (int f = 0; f < t->fronts; f++)
        for (int k = 0; k < t->front[f].own; k++) front_at[t->front[f].first + k] = f;
    find_touched(t, front_at, nz, irn, jcn);
    for (int a = 0; a <= t->tasks; a++)
        for (int b = 0; b < t->plan[a].border; b++) border_place[(size_t)a * t->border + t->plan[a].touched[b]] = b;
    for (int64_t k = 0; k < nz; k++) {
        int a = t->position[irn[k] - 1], b = t->position[jcn[k] - 1];
        at[owner_of(t, front_at, a < b ? a : b) + 1]++;
    }
    for (int f = 0; f <= t->fronts; f++) at[f + 1] += at[f];
    for (int f = 0; f <= t->fronts; f++) t->front[f].entry_at = at[f];
    t->front[t->fronts + 1].entry_at = nz;
    int *source = malloc(sizeof(int) * (size_t)(nz + 1));
    t->place = malloc(sizeof(Place) * (size_t)(nz + 1));
    int complete = source && t->place;
    for (int64_t k = 0; k < nz && complete; k++) {
        int a = t->position[irn[k] - 1], b = t->position[jcn[k] - 1];
        int low = a < b ? a : b, high = a < b ? b : a, f = owner_of(t, front_at, low);
        const Front *v = &t->front[f];
        int row = high - t->top, column = low - (f < t->fronts ? v->first : t->top);
        if (f < t->fronts)
            row = high < t->top ? place_in(t, v, high)
                                : v->own + v->chain + border_place[(size_t)v->task * t->border + row];
        complete = row >= 0 && row < WIDEST_FRONT && column < WIDEST_FRONT;
        source[at[f]] = (int)k, t->place[at[f]++] = (Place){(unsigned short)row, (unsigned short)column, 0};
    }
    complete = complete && find_steps(t, source);
    free(front_at), free(border_place), free(at), free(source);
    return complete && share_places(t);
}

static void estimate(Tree *t) {
    double b = t->border;
    t->flops = b * b * b / 6, t->factor = b * b / 2;
    for (int f = 0; f < t->fronts; f++) {
        const Front *v = &t->front[f];
        double own = v->own, rest = v->chain + t->plan[v->task].border;
        t->flops += own * (own * own / 6 + own * rest / 2 + rest * rest / 2);
        t->factor += own * (own / 2 + rest);
    }
}

static void free_tree(Tree *t) {
    for (int a = 0; t->plan && a <= t->tasks; a++) free(t->plan[a].touched);
    free(t->child), free(t->sibling);
    free(t->position), free(t->front), free(t->chain), free(t->chain_map), free(t->place), free(t->plan);
    *t = (Tree){0};
}

/* The tree of a pattern (`irn`, `jcn` count from 1, any triangle, entries may repeat); 0 where it is no chain. */
static int make_tree(Tree *t, int n, int64_t nz, const int *irn, const int *jcn) {
    Graph g;
    Draft d;
    *t = (Tree){.n = n};
    if (!build_graph(&g, n, nz, irn, jcn)) return 0;
    int *turn = malloc(sizeof(int) * (n + 1)), count = find_turns(&g, turn);
    if (count < 0) {
        free(turn), free_graph(&g);
        return 0;
    }
    int border = 0;
    for (int i = 0; i < n; i++) border += turn[i] < 0;
    make_draft(&d, &g, turn, count, border);
    int *task_of = malloc(sizeof(int) * (count + 1));
    t->fronts = count;
    t->front = zeros(count + 2, sizeof(Front));
    t->position = malloc(sizeof(int) * (n + 1));
    t->child = malloc(sizeof(int) * (count + 1)), t->sibling = malloc(sizeof(int) * (count + 1));
    number_fronts(&d, t, task_of);
    t->plan = zeros(t->tasks + 1, sizeof(TaskPlan));
    fill_fronts(&d, t, turn, task_of);
    map_to_parents(t);
    free(turn), free(task_of), free_graph(&g), free_draft(&d);
    int complete = place_entries(t, nz, irn, jcn);
    estimate(t);
    if (!complete) free_tree(t);
    return complete;
}
