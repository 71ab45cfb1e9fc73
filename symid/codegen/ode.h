/* What a generated model exports to symid/simulation/loop.c. Argument order of every function:
 * rates x', states x, late signals l, inputs u, noises w, parameters p, constants c, time t. */
typedef struct { int count; const int *row, *col; } Entries;

#define ODE_ARGUMENTS const double *, const double *, const double *, const double *, const double *, \
                      const double *, const double *, double

typedef struct {
    int nx, nl, nu, nw, np, nc, ny, outputs_need_rates;
    int ncoupled, nshared;
    const int *coupled;                     /* states whose rates are solved for together: M is 1 elsewhere */
    const int *late_kind, *late_index;      /* 0: of a state, 1: of an input */
    const int *input_between;               /* samples: 0: linear, 1: constant, 2: cubic, 3: quintic */
    /* `shared`: values of functions such as the sine that mass hands to slopes. */
    void (*mass)(ODE_ARGUMENTS, double *M, double *force, double *shared);
    void (*observe)(ODE_ARGUMENTS, double *y);
    void (*lags)(ODE_ARGUMENTS, double *lag);
    void (*slopes)(ODE_ARGUMENTS, double *dx, double *dl, double *dp, double *dw, const double *shared);
    void (*observe_slopes)(ODE_ARGUMENTS, double *dx, double *dl, double *dp, double *dxd);
    void (*lag_slopes)(ODE_ARGUMENTS, double *dp);
    Entries rx, rl, rp, rw, hx, hl, hp, hxd, lp;
} Ode;
