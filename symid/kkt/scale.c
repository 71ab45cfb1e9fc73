/* Symmetric scaling: every row's largest entry comes near one (Ruiz 2001), by powers of two, which round nothing.

   Without it a parameter's unit decides on pivots, and so do Ipopt's regularisations, of which far
   from feasible points one is 1e10 and the other 1e-8. */

#define PASSES 12 /* one or two suffice where scales start from those of the last factorisation */
#define LIMIT 60  /* of a scale's exponent: that of a product fits into a byte */
#define NEAR 3    /* binary digits from one that are near enough */

static inline int binary_exponent(double x) {
    int64_t bits;
    memcpy(&bits, &x, 8);
    return (int)(bits >> 52 & 2047) - 1022;
}

static inline double power_of_two(int e) {
    int64_t bits = (int64_t)(e + 1023) << 52;
    double out;
    memcpy(&out, &bits, 8);
    return out;
}

/* The largest scaled entry; `product` (nz,) exponents of the product of an entry's two scales. */
static double largest_scaled(int64_t nz, const double *a, const int8_t *product) {
    int64_t most = 0;
    for (int64_t k = 0; k < nz; k++) {
        double x = a[k] * power_of_two(product[k]);
        int64_t bits;
        memcpy(&bits, &x, 8);
        bits &= INT64_MAX;
        most = bits > most ? bits : most;
    }
    double out;
    memcpy(&out, &most, 8);
    return out;
}

/* Improve the exponents scale (n,) for the entries a; `most` (n,) is room. */
static void equilibrate(int n, int64_t nz, const int *irn, const int *jcn, const double *a, int8_t *scale,
                        double *most) {
    for (int pass = 0, far = 1; far && pass < PASSES; pass++) {
        memset(most, 0, sizeof(double) * n);
        for (int64_t k = 0; k < nz; k++) {
            int i = irn[k] - 1, j = jcn[k] - 1;
            double x = fabs(a[k]) * power_of_two(scale[i]) * power_of_two(scale[j]);
            if (x > most[i]) most[i] = x;
            if (x > most[j]) most[j] = x;
        }
        far = 0;
        for (int i = 0; i < n; i++) {
            int e = most[i] > 0 ? binary_exponent(most[i]) : 0;
            if (e >= -NEAR && e <= NEAR) continue;
            far = 1;
            e = scale[i] - e / 2;
            scale[i] = (int8_t)(e < -LIMIT ? -LIMIT : e > LIMIT ? LIMIT : e);
        }
    }
}

/* Scales that serve: where `known`, the last ones as long as no entry has outgrown them. */
static void find_scales(int n, int64_t nz, const int *irn, const int *jcn, const double *a, int8_t *scale, double *most,
                        int8_t *product, int known) {
    double size = known ? largest_scaled(nz, a, product) : INFINITY;
    if (size <= power_of_two(NEAR) && size >= power_of_two(-NEAR)) return;
    equilibrate(n, nz, irn, jcn, a, scale, most);
    for (int64_t k = 0; k < nz; k++) product[k] = (int8_t)(scale[irn[k] - 1] + scale[jcn[k] - 1]);
}
