/* A factorisation and a solve as a whole: tasks on threads, then the top of the tree and the border. */

typedef enum { FACTORISE, FORWARD, BACKWARD } Step;

typedef struct {
    Factor *s;
    Step step;
    int next;
} Job;

static void do_task(Factor *s, Step step, int a) {
    Work *w = &s->work[a];
    size_t outside = sizeof(double) * (size_t)(s->tree.n - s->tree.inner);
    if (step == FACTORISE) factorise_task(s, a);
    else if (step == FORWARD) memset(w->outside, 0, outside), w->failed = !forward_task(s, a, w->outside);
    else w->failed = !backward_task(s, a);
}

static void *work_through(void *argument) {
    Job *job = argument;
    for (int a; (a = __atomic_fetch_add(&job->next, 1, __ATOMIC_RELAXED)) < job->s->tree.tasks;)
        do_task(job->s, job->step, a);
    return NULL;
}

static int all_tasks(Factor *s, Step step) {
    Job job = {s, step, 0};
    pthread_t helper[64];
    int helpers = 0, wanted = s->threads < s->tree.tasks ? s->threads : s->tree.tasks, failed = 0;
    while (helpers + 1 < wanted && helpers < 64) {
        if (pthread_create(&helper[helpers], NULL, work_through, &job)) break;
        helpers++;
    }
    work_through(&job);
    for (int i = 0; i < helpers; i++) pthread_join(helper[i], NULL);
    for (int a = 0; a < s->tree.tasks; a++) failed |= s->work[a].failed;
    return !failed;
}

static void add_counts(Counts *to, const Counts *from) {
    to->negative += from->negative, to->null += from->null;
    to->delayed += from->delayed, to->factor += from->factor;
    if (from->smallest < to->smallest) to->smallest = from->smallest;
}

static int factorise(Factor *s, int64_t nz, const int *irn, const int *jcn, const double *values) {
    s->counts = (Counts){.smallest = INFINITY};
    s->values = values;
    find_scales(s->tree.n, nz, irn, jcn, values, s->scale, s->x, s->product, s->scaled);
    s->scaled = 1;
    if (!all_tasks(s, FACTORISE)) return 0;
    factorise_task(s, s->tree.tasks);
    if (s->work[s->tree.tasks].failed || !factorise_border(s)) return 0;
    for (int a = 0; a <= s->tree.tasks + 1; a++) add_counts(&s->counts, &s->work[a].counts);
    return 1;
}

/* Overwrite b, in the matrix's order, with the solution. */
static int solve(Factor *s, double *b) {
    const Tree *t = &s->tree;
    double *y = vector_of(&s->work[t->tasks + 1], &s->part[t->fronts]);
    if (!y) return 0;
    for (int i = 0; i < t->n; i++) s->x[t->position[i]] = b[i] * power_of_two(s->scale[i]);
    if (!all_tasks(s, FORWARD)) return 0;
    for (int a = 0; a < t->tasks; a++) add_vector(s->x + t->inner, s->work[a].outside, t->n - t->inner);
    if (!forward_task(s, t->tasks, s->x + t->inner)) return 0;
    forward_front(s, t->fronts, s->x, s->x + t->inner, y);
    backward_front(s, t->fronts, s->x, y);
    if (!backward_task(s, t->tasks) || !all_tasks(s, BACKWARD)) return 0;
    for (int i = 0; i < t->n; i++) b[i] = s->x[t->position[i]] * power_of_two(s->scale[i]);
    return 1;
}

static void free_factor(Factor *s) {
    for (int a = 0; s->work && a < s->tree.tasks + 2; a++) {
        Work *w = &s->work[a];
        free_arena(&w->factors), free_arena(&w->handed);
        free(w->panel), free(w->square), free(w->columns), free(w->border), free(w->left), free(w->right);
        free(w->outside), free(w->source);
    }
    free(s->part), free(s->mark), free(s->work), free(s->x), free(s->scale), free(s->product);
    free_tree(&s->tree);
    *s = (Factor){0};
}

/* Numbers that the factors of a task take where nothing is delayed. */
static size_t expected(const Tree *t, int a) {
    size_t total = 0;
    for (int f = t->plan[a].first; f < t->plan[a].end; f++) {
        const Front *v = &t->front[f];
        size_t head = 2 * v->own + (v->own + 1) / 2;
        total += padded(head + packed_size(v->own, v->own, v->chain + t->plan[a].border));
    }
    return total;
}

static int make_factor(Factor *s, int n, int64_t nz, const int *irn, const int *jcn) {
    *s = (Factor){.threads = 1};
    if (!make_tree(&s->tree, n, nz, irn, jcn)) return 0;
    const Tree *t = &s->tree;
    s->part = zeros(t->fronts + 1, sizeof(Part)), s->mark = zeros(t->fronts + 1, sizeof(Mark));
    s->work = zeros(t->tasks + 2, sizeof(Work)), s->x = zeros(n, sizeof(double));
    s->scale = zeros(n, sizeof *s->scale), s->product = zeros(nz, sizeof *s->product);
    for (int a = 0; a < t->tasks + 2; a++) {
        Work *w = &s->work[a];
        int border = a <= t->tasks ? t->plan[a].border : 0;
        w->factors.usual = a <= t->tasks ? expected(t, a) + 4096 : 4096;
        w->handed.usual = 4096;
        size_t square = (size_t)padded(border) * border + TILE * padded(border), batch = (size_t)BATCH * padded(border);
        w->border = zeros(square, sizeof(double));
        w->left = zeros(batch + LANES, sizeof(double)), w->right = zeros(batch + LANES, sizeof(double));
        w->outside = zeros(n - t->inner, sizeof(double));
        w->source = zeros(t->widest, sizeof(int));
    }
    return 1;
}
