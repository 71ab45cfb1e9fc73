/* The pattern of the matrix as a graph, and the groups of unknowns that are eliminated together.

   Ipopt's order of unknowns: variables x, slacks s, multipliers of equations, of inequalities.
   Multipliers have no entries among themselves, so the longest tail without inner entries holds
   them: "rows" here; what stands before are "columns". Columns stand in the order of time. */

#define DENSE_FACTOR 10 /* an unknown with so many times the median's neighbours belongs to the border */
#define DENSE_LEAST 64
#define WIDEST_ROW 256 /* groups that a row may touch; more, and it belongs to the border */
#define SMALLEST_GROUP 4
#define LARGEST_GROUP 64 /* columns */

typedef struct {
    int n;
    int64_t *start; /* (n + 1,) */
    int *to;
} Graph;

typedef struct {
    int count;       /* of groups */
    int first_row;   /* unknowns from here on are multipliers */
    char *border;    /* (n,) 1 where an unknown belongs to the border */
    int *group;      /* (n,) of a column; -1 in the border and for pendants */
    int *size;       /* (count,) columns */
    int *host;       /* (n,) the one neighbour of a pendant column (a slack), else -1 */
} Groups;

/* Neighbours of every unknown, each once, without the diagonal. */
static int build_graph(Graph *g, int n, int64_t nz, const int *irn, const int *jcn) {
    int64_t *at = zeros(n + 1, sizeof *at), kept = 0;
    int *seen = malloc(sizeof(int) * (n ? n : 1));
    *g = (Graph){n, zeros(n + 2, sizeof *at), NULL};
    if (!at || !seen || !g->start) goto failed;
    for (int64_t k = 0; k < nz; k++)
        if (irn[k] != jcn[k]) g->start[irn[k]]++, g->start[jcn[k]]++;
    for (int i = 0; i < n; i++) g->start[i + 1] += g->start[i];
    if (!(g->to = malloc(sizeof(int) * (size_t)(g->start[n] + 1)))) goto failed;
    memcpy(at, g->start, sizeof *at * n);
    for (int64_t k = 0; k < nz; k++)
        if (irn[k] != jcn[k]) {
            g->to[at[irn[k] - 1]++] = jcn[k] - 1;
            g->to[at[jcn[k] - 1]++] = irn[k] - 1;
        }
    for (int i = 0; i < n; i++) seen[i] = -1;
    for (int i = 0; i < n; i++) {
        int64_t from = g->start[i], end = g->start[i + 1];
        g->start[i] = kept;
        for (int64_t k = from; k < end; k++)
            if (seen[g->to[k]] != i) seen[g->to[k]] = i, g->to[kept++] = g->to[k];
    }
    g->start[n] = kept;
    free(at), free(seen);
    return 1;
failed:
    free(at), free(seen), free(g->start), free(g->to);
    g->start = NULL, g->to = NULL;
    return 0;
}

static int degree(const Graph *g, int i) { return (int)(g->start[i + 1] - g->start[i]); }

static void mark_border(const Graph *g, char *border) {
    int *count = zeros(g->n + 1, sizeof *count), median = 0;
    for (int i = 0; i < g->n; i++) count[degree(g, i)]++;
    for (int64_t below = 0; median < g->n && (below += count[median]) * 2 < g->n;) median++;
    int limit = DENSE_FACTOR * median > DENSE_LEAST ? DENSE_FACTOR * median : DENSE_LEAST;
    for (int i = 0; i < g->n; i++) border[i] = degree(g, i) > limit;
    free(count);
}

static int find_first_row(const Graph *g) {
    int first = g->n;
    while (first > 0) {
        int i = first - 1;
        for (int64_t k = g->start[i]; k < g->start[i + 1]; k++)
            if (g->to[k] > i) return first;
        first = i;
    }
    return first;
}

/* How many rows and second derivatives reach across the place behind each column. */
static int64_t *crossings(const Graph *g, const Groups *s, const int *place, int columns) {
    int64_t *across = zeros(columns + 2, sizeof *across);
    for (int i = 0; i < g->n; i++) {
        if (s->border[i] || s->host[i] >= 0) continue;
        int low = columns, high = -1;
        for (int64_t k = g->start[i]; k < g->start[i + 1]; k++) {
            int p = place[g->to[k]];
            if (p < 0) continue;
            if (i >= s->first_row) {
                if (p < low) low = p;
                if (p > high) high = p;
            } else if (p > place[i]) across[place[i]]++, across[p]--;
        }
        if (low < high) across[low]++, across[high]--;
    }
    for (int t = 1; t < columns; t++) across[t] += across[t - 1];
    return across;
}

/* Cut the columns where least reaches across: between the nodes of a chain. */
static void cut_into_groups(const Graph *g, Groups *s) {
    int *place = malloc(sizeof(int) * (g->n + 1)), columns = 0;
    for (int i = 0; i < g->n; i++) {
        int inside = i < s->first_row && !s->border[i] && s->host[i] < 0;
        place[i] = inside ? columns++ : -1;
    }
    int64_t *across = crossings(g, s, place, columns);
    s->size = zeros(columns + 1, sizeof *s->size);
    for (int i = 0, size = 0; i < g->n; i++) {
        int t = place[i];
        s->group[i] = -1;
        if (t < 0) continue;
        s->group[i] = s->count;
        s->size[s->count] = ++size;
        int lowest = (t == 0 || across[t] <= across[t - 1]) && (t + 1 >= columns || across[t] <= across[t + 1]);
        if ((lowest && (size >= SMALLEST_GROUP || across[t] == 0)) || size == LARGEST_GROUP) s->count++, size = 0;
        else if (t == columns - 1) s->count++;
    }
    free(place), free(across);
}

static void find_groups(const Graph *g, Groups *s) {
    *s = (Groups){0, find_first_row(g), zeros(g->n, 1), malloc(sizeof(int) * (g->n + 1)), NULL, NULL};
    s->host = malloc(sizeof(int) * (g->n + 1));
    mark_border(g, s->border);
    for (int i = 0; i < g->n; i++) {
        int pendant = i < s->first_row && degree(g, i) == 1 && g->to[g->start[i]] >= s->first_row && !s->border[i];
        s->host[i] = pendant ? g->to[g->start[i]] : -1;
    }
    cut_into_groups(g, s);
}

static void free_groups(Groups *s) { free(s->border), free(s->group), free(s->size), free(s->host); }
static void free_graph(Graph *g) { free(g->start), free(g->to); }
