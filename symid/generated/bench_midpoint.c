// c7499b5398d0f8476ea9ce7b6c505a90
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 0, "n_data": 2, "n_constants": 18, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 0], [4, 1], [4, 2], [4, 3], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 2], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 3], [7, 4], [7, 5], [7, 7]]}
// local[0]: link1_angle#0
// local[1]: link2_angle#0
// local[2]: link1_velocity#0
// local[3]: link2_velocity#0
// local[4]: link1_angle#1
// local[5]: link2_angle#1
// local[6]: link1_velocity#1
// local[7]: link2_velocity#1
// data[0]: joint1_torque_noise
// data[1]: joint2_torque_noise
// constants[0]: m1
// constants[1]: a1
// constants[2]: I1
// constants[3]: L1
// constants[4]: m2
// constants[5]: a2
// constants[6]: I2
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: step h
// constants[10]: scale link1_angle
// constants[11]: scale link2_angle
// constants[12]: scale link1_velocity
// constants[13]: scale link2_velocity
// constants[14]: scale link1_kinematics
// constants[15]: scale link2_kinematics
// constants[16]: scale link1_balance
// constants[17]: scale link2_balance
#include <math.h>
#include <stddef.h>
#if defined(SYMID_LIBMVEC)
#define SYMID_VECTOR __attribute__((simd("notinbranch"), const, nothrow))
SYMID_VECTOR extern double sin(double);
SYMID_VECTOR extern double cos(double);
SYMID_VECTOR extern double exp(double);
SYMID_VECTOR extern double log(double);
SYMID_VECTOR extern double pow(double, double);
#if __GLIBC_PREREQ(2, 35)
SYMID_VECTOR extern double tan(double);
SYMID_VECTOR extern double asin(double);
SYMID_VECTOR extern double acos(double);
SYMID_VECTOR extern double atan(double);
SYMID_VECTOR extern double atan2(double, double);
SYMID_VECTOR extern double sinh(double);
SYMID_VECTOR extern double cosh(double);
SYMID_VECTOR extern double tanh(double);
#endif
#endif
#define BLOCK 8

void residual(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[14]);
    const double v2 = (0.5 * constants[12]);
    const double v3 = (1.0 / constants[9]);
    const double v4 = (constants[10] * v3);
    const double v5 = (1.0 / constants[15]);
    const double v7 = (0.5 * constants[13]);
    const double v8 = (constants[11] * v3);
    const double v9 = (1.0 / constants[16]);
    const double v10 = (0.5 * constants[10]);
    const double v13 = (constants[4] * (constants[3] * constants[7]));
    const double v14 = (constants[0] * (constants[1] * constants[7]));
    const double v16 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v3));
    const double v17 = (0.5 * constants[11]);
    const double v21 = (constants[4] * (constants[3] * constants[5]));
    const double v22 = (0.25 * ((constants[13] * constants[13]) * v21));
    const double v25 = (v3 * (constants[13] * v21));
    const double v26 = (1.0 / constants[17]);
    const double v27 = (constants[4] * (constants[5] * constants[7]));
    const double v28 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v3));
    const double v29 = (0.25 * (v21 * (constants[12] * constants[12])));
    const double v30 = (v3 * (constants[12] * v21));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (local_column[2][i] + local_column[6][i]);
            const double v6 = (local_column[3][i] + local_column[7][i]);
            const double v11 = (v10 * (local_column[0][i] + local_column[4][i]));
            const double v12 = sin(v11);
            const double v15 = (local_column[6][i] - local_column[2][i]);
            const double v18 = (v17 * (local_column[1][i] + local_column[5][i]));
            const double v19 = (v11 - v18);
            const double v20 = sin(v19);
            const double v23 = (local_column[7][i] - local_column[3][i]);
            const double v24 = cos(v19);
            value[0][i] = (v0 * ((v2 * v1) - (v4 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v5 * ((v7 * v6) - (v8 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v9 * ((((((data_column[1][i] - data_column[0][i]) - (v13 * v12)) - (v14 * v12)) - (v16 * v15)) - (v22 * ((v6 * v6) * v20))) - (v25 * (v23 * v24))));
            value[3][i] = (v26 * (((v29 * (v20 * (v1 * v1))) - ((v28 * v23) + (data_column[1][i] + (v27 * sin(v18))))) - (v30 * (v15 * v24))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 4; j++) out[k * 4 + j] = value[j][i];
        }
    }
}


void jacobian(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[14]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (1.0 / constants[15]);
    const double v5 = (1.0 / constants[16]);
    const double v6 = (0.5 * constants[10]);
    const double v8 = (0.5 * constants[11]);
    const double v12 = (constants[4] * (constants[3] * constants[5]));
    const double v14 = (1.0 / constants[17]);
    const double v15 = (v5 * (v2 * (constants[13] * v12)));
    const double v17 = ((-0.25) * (v5 * ((constants[13] * constants[13]) * v12)));
    const double v19 = (v17 + v17);
    const double v21 = ((v5 * (constants[0] * (constants[1] * constants[7]))) + (v5 * (constants[4] * (constants[3] * constants[7]))));
    const double v22 = (v14 * (v2 * (constants[12] * v12)));
    const double v24 = (0.25 * (v14 * (v12 * (constants[12] * constants[12]))));
    const double v25 = (v24 + v24);
    const double v27 = (v14 * (constants[4] * (constants[5] * constants[7])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[24][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (local_column[2][i] + local_column[6][i]);
            const double v4 = (local_column[3][i] + local_column[7][i]);
            const double v7 = (v6 * (local_column[0][i] + local_column[4][i]));
            const double v9 = (v8 * (local_column[1][i] + local_column[5][i]));
            const double v10 = (v7 - v9);
            const double v11 = sin(v10);
            const double v13 = cos(v10);
            const double v16 = (v15 * v13);
            const double v18 = ((v15 * (v11 * (local_column[7][i] - local_column[3][i]))) + (v17 * ((v4 * v4) * v13)));
            const double v20 = (v19 * (v4 * v11));
            const double v23 = (v22 * v13);
            const double v26 = (v25 * (v1 * v11));
            const double v28 = ((v22 * ((local_column[6][i] - local_column[2][i]) * v11)) + (v24 * (v13 * (v1 * v1))));
            value[0][i] = (v0 * (constants[10] * v2));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v2)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v3 * (constants[11] * v2));
            value[5][i] = (0.5 * (constants[13] * v3));
            value[6][i] = (-(v3 * (constants[11] * v2)));
            value[7][i] = (0.5 * (constants[13] * v3));
            value[8][i] = (v6 * (v18 - (v21 * cos(v7))));
            value[9][i] = (-(v8 * v18));
            value[10][i] = (v5 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2)));
            value[11][i] = (v16 + v20);
            value[12][i] = (v6 * (v18 - (v21 * cos(v7))));
            value[13][i] = (-(v8 * v18));
            value[14][i] = (-(v5 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2))));
            value[15][i] = (v20 - v16);
            value[16][i] = (v6 * v28);
            value[17][i] = (-(v8 * ((v27 * cos(v9)) + v28)));
            value[18][i] = (v23 + v26);
            value[19][i] = (v14 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2)));
            value[20][i] = (v6 * v28);
            value[21][i] = (-(v8 * ((v27 * cos(v9)) + v28)));
            value[22][i] = (v26 - v23);
            value[23][i] = (-(v14 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 24; j++) out[k * 24 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v1 = (1.0 / constants[9]);
    const double v3 = (1.0 / constants[16]);
    const double v4 = (0.5 * constants[10]);
    const double v6 = (0.5 * constants[11]);
    const double v10 = (constants[4] * (constants[3] * constants[5]));
    const double v12 = (1.0 / constants[17]);
    const double v13 = (v3 * (v1 * (constants[13] * v10)));
    const double v14 = (v3 * ((constants[13] * constants[13]) * v10));
    const double v15 = (0.25 * v14);
    const double v16 = (v12 * (v1 * (constants[12] * v10)));
    const double v17 = (v12 * (v10 * (constants[12] * constants[12])));
    const double v18 = (0.25 * v17);
    const double v19 = (v18 + v18);
    const double v22 = (v15 + v15);
    const double v23 = (0.5 * (constants[10] * v16));
    const double v26 = (0.5 * (constants[10] * v19));
    const double v28 = (0.5 * (constants[10] * v13));
    const double v31 = (constants[10] * constants[11]);
    const double v32 = (0.25 * v31);
    const double v34 = (0.5 * (constants[10] * v22));
    const double v36 = (0.5 * (constants[10] * ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))))));
    const double v37 = ((-0.5) * constants[11]);
    const double v38 = ((-0.5) * (constants[11] * v16));
    const double v40 = ((-0.5) * (constants[11] * v19));
    const double v42 = (0.5 * (constants[11] * (v12 * (constants[4] * (constants[5] * constants[7])))));
    const double v43 = ((-0.5) * (constants[11] * v13));
    const double v45 = ((-0.5) * (constants[11] * v22));
    const double v47 = ((-0.25) * v31);
    const double v48 = (0.5 * v17);
    const double v50 = (0.5 * v14);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[32][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v0 = (local_column[2][i] + local_column[6][i]);
            const double v2 = (local_column[3][i] + local_column[7][i]);
            const double v5 = (v4 * (local_column[0][i] + local_column[4][i]));
            const double v7 = (v6 * (local_column[1][i] + local_column[5][i]));
            const double v8 = (v5 - v7);
            const double v9 = sin(v8);
            const double v11 = cos(v8);
            const double v20 = (v9 * multipliers_column[3][i]);
            const double v21 = (v9 * multipliers_column[2][i]);
            const double v24 = (v23 * v20);
            const double v25 = (v0 * (v11 * multipliers_column[3][i]));
            const double v27 = (v26 * v25);
            const double v29 = (v28 * v21);
            const double v30 = ((v11 * ((v16 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v13 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) - (v9 * ((v18 * ((v0 * v0) * multipliers_column[3][i])) - (v15 * ((v2 * v2) * multipliers_column[2][i])))));
            const double v33 = (v2 * (v11 * multipliers_column[2][i]));
            const double v35 = (v34 * v33);
            const double v39 = (v38 * v20);
            const double v41 = (v40 * v25);
            const double v44 = (v43 * v21);
            const double v46 = (v45 * v33);
            const double v49 = ((v48 * (v11 * (v0 * multipliers_column[3][i]))) - (v16 * v20));
            const double v51 = ((v13 * v21) + (v50 * (v11 * (v2 * multipliers_column[2][i]))));
            value[0][i] = (v4 * ((v4 * v30) + (v36 * (sin(v5) * multipliers_column[2][i]))));
            value[1][i] = (-(v32 * v30));
            value[2][i] = (-(v6 * ((v37 * v30) - (v42 * (sin(v7) * multipliers_column[3][i])))));
            value[3][i] = (v27 - v24);
            value[4][i] = (v41 - v39);
            value[5][i] = (v19 * v20);
            value[6][i] = (-(v29 + v35));
            value[7][i] = (-(v44 + v46));
            value[8][i] = (-(v22 * v21));
            value[9][i] = (v4 * ((v4 * v30) + (v36 * (sin(v5) * multipliers_column[2][i]))));
            value[10][i] = (v47 * v30);
            value[11][i] = (v4 * v49);
            value[12][i] = (-(v4 * v51));
            value[13][i] = (v4 * ((v4 * v30) + (v36 * (sin(v5) * multipliers_column[2][i]))));
            value[14][i] = (-(v32 * v30));
            value[15][i] = (-(v6 * ((v37 * v30) - (v42 * (sin(v7) * multipliers_column[3][i])))));
            value[16][i] = (-(v6 * v49));
            value[17][i] = (v6 * v51);
            value[18][i] = (-(v32 * v30));
            value[19][i] = (-(v6 * ((v37 * v30) - (v42 * (sin(v7) * multipliers_column[3][i])))));
            value[20][i] = (v24 + v27);
            value[21][i] = (v39 + v41);
            value[22][i] = (v19 * v20);
            value[23][i] = (v24 + v27);
            value[24][i] = (v39 + v41);
            value[25][i] = (v19 * v20);
            value[26][i] = (v29 - v35);
            value[27][i] = (v44 - v46);
            value[28][i] = (-(v22 * v21));
            value[29][i] = (v29 - v35);
            value[30][i] = (v44 - v46);
            value[31][i] = (-(v22 * v21));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 32; j++) out[index[k * 32 + j]] += value[j][i];
        }
    }
}
