/* Which group is eliminated when, and with which rows.

   Least degree first, and of equals the one that waits longest: the ends of a chain burn towards
   its middle (towards the links between episodes where there are any), so that a front never
   holds more than one frontier, and each end is a path of its own for a thread. */

#define WORK_LIMIT 4000 /* neighbours looked at, per group; a problem that needs more is no chain */

typedef struct {
    uint64_t key; /* degree, then time of arrival */
    int group;
} Waiting;

typedef struct {
    Waiting *at;
    int64_t count, room;
} Heap;

static void push(Heap *h, uint64_t key, int group) {
    if (h->count == h->room) h->at = realloc(h->at, sizeof(Waiting) * (size_t)(h->room = 2 * h->room + 64));
    int64_t i = h->count++;
    for (; i > 0 && h->at[(i - 1) / 2].key > key; i = (i - 1) / 2) h->at[i] = h->at[(i - 1) / 2];
    h->at[i] = (Waiting){key, group};
}

static Waiting pop(Heap *h) {
    Waiting top = h->at[0], last = h->at[--h->count];
    int64_t i = 0;
    for (int64_t child; (child = 2 * i + 1) < h->count; i = child) {
        if (child + 1 < h->count && h->at[child + 1].key < h->at[child].key) child++;
        if (h->at[child].key >= last.key) break;
        h->at[i] = h->at[child];
    }
    h->at[i] = last;
    return top;
}

/* Lists of integers, one after the other. */
typedef struct {
    int64_t *start;
    int *to;
} Lists;

static void free_lists(Lists *l) { free(l->start), free(l->to); }

static int touches(const Graph *g, const Groups *s, int row, int *seen, int stamp, int *out) {
    int count = 0;
    for (int64_t k = g->start[row]; k < g->start[row + 1]; k++) {
        int a = s->group[g->to[k]];
        if (a >= 0 && seen[a] != stamp) seen[a] = stamp, out[count++] = a;
    }
    return count;
}

/* The groups that each row touches; a row that touches too many moves to the border. */
static Lists groups_of_rows(const Graph *g, Groups *s, int *seen) {
    Lists l = {zeros(g->n + 2, sizeof(int64_t)), NULL};
    int *out = malloc(sizeof(int) * (s->count + 1)), *to = malloc(sizeof(int) * (g->start[g->n] + 1));
    for (int i = 0; i < s->count; i++) seen[i] = -1;
    for (int i = 0; i < g->n; i++) {
        int count = i < s->first_row || s->border[i] ? 0 : touches(g, s, i, seen, i, out);
        if (count > WIDEST_ROW) s->border[i] = 1, count = 0;
        memcpy(to + l.start[i], out, sizeof(int) * count);
        l.start[i + 1] = l.start[i] + count;
    }
    l.to = to;
    free(out);
    return l;
}

static Lists transposed(const Lists *l, int rows, int columns) {
    Lists t = {zeros(columns + 2, sizeof(int64_t)), malloc(sizeof(int) * (l->start[rows] + 1))};
    int64_t *at = malloc(sizeof(int64_t) * (columns + 1));
    for (int64_t k = 0; k < l->start[rows]; k++) t.start[l->to[k] + 1]++;
    for (int a = 0; a < columns; a++) t.start[a + 1] += t.start[a];
    memcpy(at, t.start, sizeof(int64_t) * columns);
    for (int i = 0; i < rows; i++)
        for (int64_t k = l->start[i]; k < l->start[i + 1]; k++) t.to[at[l->to[k]]++] = i;
    free(at);
    return t;
}

typedef struct {
    int *to, count, room;
    int weight; /* columns of the neighbours */
} Neighbours;

static void add_neighbour(Neighbours *v, int a, int size) {
    if (v->count == v->room) v->to = realloc(v->to, sizeof(int) * (v->room = 2 * v->room + 2));
    v->to[v->count++] = a;
    v->weight += size;
}

static Neighbours *neighbours_of_groups(const Graph *g, const Groups *s, const Lists *rows, const Lists *of,
                                        int *seen) {
    Neighbours *v = zeros(s->count, sizeof *v);
    int column = 0;
    for (int a = 0; a < s->count; a++) seen[a] = -1;
    for (int a = 0; a < s->count; a++) {
        seen[a] = a;
        for (int64_t k = of->start[a]; k < of->start[a + 1]; k++)
            for (int64_t l = rows->start[of->to[k]]; l < rows->start[of->to[k] + 1]; l++) {
                int b = rows->to[l];
                if (seen[b] != a) seen[b] = a, add_neighbour(&v[a], b, s->size[b]);
            }
        for (; column < s->first_row && s->group[column] <= a; column++)
            for (int64_t k = s->group[column] < 0 ? 0 : g->start[column];
                 s->group[column] >= 0 && k < g->start[column + 1]; k++) {
                int b = s->group[g->to[k]];
                if (b >= 0 && seen[b] != a) seen[b] = a, add_neighbour(&v[a], b, s->size[b]);
            }
    }
    return v;
}

/* Join `clique` into the neighbours of `u`, and drop `gone`. */
static int64_t absorb(Neighbours *v, int u, int gone, const Neighbours *clique, const int *size, int *seen, int stamp) {
    Neighbours *own = &v[u];
    int kept = 0;
    seen[u] = seen[gone] = stamp;
    own->weight = 0;
    for (int k = 0; k < own->count; k++) {
        int b = own->to[k];
        if (b == gone) continue;
        seen[b] = stamp, own->to[kept++] = b, own->weight += size[b];
    }
    own->count = kept;
    for (int k = 0; k < clique->count; k++) {
        int b = clique->to[k];
        if (seen[b] != stamp) seen[b] = stamp, add_neighbour(own, b, size[b]);
    }
    return kept + clique->count + 1;
}

/* Fills `turn` (groups,): when each group is eliminated. Returns 0 where the fill grows without bound. */
static int least_degree(const Groups *s, Neighbours *v, int *turn, int *seen) {
    Heap heap = {NULL, 0, 0};
    uint64_t arrival = 0;
    int64_t work = 0, limit = (int64_t)WORK_LIMIT * (s->count + 1000);
    int stamp = s->count, next = 0;
    for (int a = 0; a < s->count; a++) turn[a] = -1, push(&heap, ((uint64_t)v[a].weight << 32) | arrival++, a);
    while (next < s->count && work < limit) {
        Waiting w = pop(&heap);
        int a = w.group;
        if (turn[a] >= 0 || (uint64_t)v[a].weight != w.key >> 32) continue;
        turn[a] = next++;
        for (int k = 0; k < v[a].count; k++) {
            int u = v[a].to[k];
            work += absorb(v, u, a, &v[a], s->size, seen, stamp++);
            push(&heap, ((uint64_t)v[u].weight << 32) | arrival++, u);
        }
        free(v[a].to);
        v[a] = (Neighbours){NULL, 0, 0, 0};
    }
    free(heap.at);
    return next == s->count;
}

typedef struct {
    int row, deadline;
} Candidate;

static int by_deadline(const void *a, const void *b) {
    const Candidate *x = a, *y = b;
    return x->deadline != y->deadline ? (x->deadline > y->deadline) - (x->deadline < y->deadline) : x->row - y->row;
}

/* Give every row to the first group that has a column left for it (its pivot is a pair of a column
   and a row), those first whose groups end first; `turn_of` (n,) gets the turn of every unknown. */
static void place_rows(const Graph *g, const Groups *s, const Lists *rows, const Lists *of, const int *turn,
                       int *turn_of) {
    int *group_at = malloc(sizeof(int) * (s->count + 1)), *deadline = malloc(sizeof(int) * (g->n + 1));
    char *slack = zeros(g->n, 1);
    int64_t widest = 1;
    for (int a = 0; a < s->count; a++) {
        group_at[turn[a]] = a;
        if (of->start[a + 1] - of->start[a] > widest) widest = of->start[a + 1] - of->start[a];
    }
    Candidate *c = malloc(sizeof *c * widest);
    for (int i = 0; i < g->n; i++) {
        turn_of[i] = s->group[i] >= 0 && !s->border[i] ? turn[s->group[i]] : -1;
        if (s->host[i] >= 0) slack[s->host[i]] = 1;
        deadline[i] = -1;
        for (int64_t k = rows->start[i]; k < rows->start[i + 1]; k++)
            if (turn[rows->to[k]] > deadline[i]) deadline[i] = turn[rows->to[k]];
    }
    for (int t = 0; t < s->count; t++) {
        int a = group_at[t], count = 0, taken = 0;
        for (int64_t k = of->start[a]; k < of->start[a + 1]; k++)
            if (turn_of[of->to[k]] < 0) c[count++] = (Candidate){of->to[k], deadline[of->to[k]]};
        qsort(c, count, sizeof *c, by_deadline);
        for (int k = 0; k < count; k++) {
            int row = c[k].row;
            if (slack[row] || deadline[row] == t || taken < s->size[a]) turn_of[row] = t, taken += !slack[row];
        }
    }
    for (int i = 0; i < g->n; i++) { /* slacks go with their rows; rows without columns join the border */
        int home = s->host[i] >= 0 ? s->host[i] : i;
        if (s->border[i] || turn_of[i] >= 0) continue;
        turn_of[i] = turn_of[home] >= 0 || home == i ? turn_of[home] : s->count ? 0 : -1;
    }
    free(group_at), free(deadline), free(slack), free(c);
}

/* When each unknown is eliminated: its group's turn, or -1 for the border. Returns the number of turns, -1 where
   the pattern is no chain. */
static int find_turns(const Graph *g, int *turn_of) {
    Groups s;
    find_groups(g, &s);
    int *seen = malloc(sizeof(int) * (s.count + 1)), *turn = malloc(sizeof(int) * (s.count + 1));
    Lists rows = groups_of_rows(g, &s, seen), of = transposed(&rows, g->n, s.count);
    Neighbours *v = neighbours_of_groups(g, &s, &rows, &of, seen);
    int chain = least_degree(&s, v, turn, seen);
    if (chain) place_rows(g, &s, &rows, &of, turn, turn_of);
    for (int a = 0; a < s.count; a++) free(v[a].to);
    free(v), free(seen), free(turn), free_lists(&rows), free_lists(&of);
    int count = s.count;
    free_groups(&s);
    return chain ? count : -1;
}
