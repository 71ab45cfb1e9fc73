// 4cc9392c6a3647e13122e6aea5c6c146
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 2, "n_data": 2, "n_constants": 20, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 9]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 0], [4, 1], [4, 2], [4, 3], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 2], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 3], [7, 4], [7, 5], [7, 7], [8, 2], [8, 6], [9, 2], [9, 3], [9, 6], [9, 7]]}
// local[0]: link1_angle#0
// local[1]: link2_angle#0
// local[2]: link1_velocity#0
// local[3]: link2_velocity#0
// local[4]: link1_angle#1
// local[5]: link2_angle#1
// local[6]: link1_velocity#1
// local[7]: link2_velocity#1
// shared[0]: viscous_friction_joint1_coefficient_Nms_rad
// shared[1]: viscous_friction_joint2_coefficient_Nms_rad
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
// constants[14]: scale viscous_friction_joint1_coefficient_Nms_rad
// constants[15]: scale viscous_friction_joint2_coefficient_Nms_rad
// constants[16]: scale link1_kinematics
// constants[17]: scale link2_kinematics
// constants[18]: scale link1_balance
// constants[19]: scale link2_balance
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
    const double v0 = (1.0 / constants[16]);
    const double v2 = (0.5 * constants[12]);
    const double v4 = (1.0 / constants[9]);
    const double v5 = (constants[10] * v4);
    const double v6 = (1.0 / constants[17]);
    const double v8 = (0.5 * constants[13]);
    const double v10 = (constants[11] * v4);
    const double v11 = (1.0 / constants[18]);
    const double v12 = (shared[1] * constants[15]);
    const double v14 = (0.5 * constants[10]);
    const double v17 = (constants[4] * (constants[3] * constants[7]));
    const double v18 = (constants[0] * (constants[1] * constants[7]));
    const double v19 = (0.5 * (shared[0] * (constants[12] * constants[14])));
    const double v21 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v4));
    const double v22 = (0.5 * constants[11]);
    const double v26 = (constants[4] * (constants[3] * constants[5]));
    const double v27 = (0.25 * ((constants[13] * constants[13]) * v26));
    const double v30 = (v4 * (constants[13] * v26));
    const double v31 = (1.0 / constants[19]);
    const double v32 = (constants[4] * (constants[5] * constants[7]));
    const double v33 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v4));
    const double v34 = (0.25 * (v26 * (constants[12] * constants[12])));
    const double v35 = (v4 * (constants[12] * v26));
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
            const double v3 = (v2 * v1);
            const double v7 = (local_column[3][i] + local_column[7][i]);
            const double v9 = (v8 * v7);
            const double v13 = (v12 * (v9 - v3));
            const double v15 = (v14 * (local_column[0][i] + local_column[4][i]));
            const double v16 = sin(v15);
            const double v20 = (local_column[6][i] - local_column[2][i]);
            const double v23 = (v22 * (local_column[1][i] + local_column[5][i]));
            const double v24 = (v15 - v23);
            const double v25 = sin(v24);
            const double v28 = (local_column[7][i] - local_column[3][i]);
            const double v29 = cos(v24);
            value[0][i] = (v0 * (v3 - (v5 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v6 * (v9 - (v10 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v11 * (((((((v13 + (data_column[1][i] - data_column[0][i])) - (v17 * v16)) - (v18 * v16)) - (v19 * v1)) - (v21 * v20)) - (v27 * ((v7 * v7) * v25))) - (v30 * (v28 * v29))));
            value[3][i] = (v31 * (((v34 * (v25 * (v1 * v1))) - ((v33 * v28) + ((v32 * sin(v23)) + (data_column[1][i] + v13)))) - (v35 * (v20 * v29))));
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
    const double v0 = (1.0 / constants[16]);
    const double v2 = (0.5 * constants[12]);
    const double v3 = (1.0 / constants[9]);
    const double v4 = (1.0 / constants[17]);
    const double v6 = (0.5 * constants[13]);
    const double v7 = (1.0 / constants[18]);
    const double v9 = (shared[1] * constants[15]);
    const double v10 = (0.5 * constants[10]);
    const double v12 = (constants[12] * constants[14]);
    const double v13 = (0.5 * constants[11]);
    const double v17 = (constants[4] * (constants[3] * constants[5]));
    const double v19 = (1.0 / constants[19]);
    const double v20 = (v7 * (v3 * (constants[13] * v17)));
    const double v22 = ((-0.25) * (v7 * ((constants[13] * constants[13]) * v17)));
    const double v24 = (v22 + v22);
    const double v25 = (v7 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v3)));
    const double v26 = (0.5 * (v7 * v12));
    const double v27 = ((v7 * (constants[0] * (constants[1] * constants[7]))) + (v7 * (constants[4] * (constants[3] * constants[7]))));
    const double v28 = (v7 * v9);
    const double v29 = (constants[15] * v7);
    const double v30 = (0.5 * (constants[13] * v28));
    const double v32 = (((-0.5) * (v7 * (shared[0] * v12))) + ((-0.5) * (constants[12] * v28)));
    const double v33 = (v19 * (v3 * (constants[12] * v17)));
    const double v35 = (0.25 * (v19 * (v17 * (constants[12] * constants[12]))));
    const double v36 = (v35 + v35);
    const double v37 = (v19 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v3)));
    const double v38 = (v19 * (constants[4] * (constants[5] * constants[7])));
    const double v40 = (v9 * v19);
    const double v41 = (constants[15] * v19);
    const double v42 = ((-0.5) * (constants[13] * v40));
    const double v43 = (0.5 * (constants[12] * v40));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[27][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (local_column[2][i] + local_column[6][i]);
            const double v5 = (local_column[3][i] + local_column[7][i]);
            const double v8 = ((v6 * v5) - (v2 * v1));
            const double v11 = (v10 * (local_column[0][i] + local_column[4][i]));
            const double v14 = (v13 * (local_column[1][i] + local_column[5][i]));
            const double v15 = (v11 - v14);
            const double v16 = sin(v15);
            const double v18 = cos(v15);
            const double v21 = (v20 * v18);
            const double v23 = ((v20 * (v16 * (local_column[7][i] - local_column[3][i]))) + (v22 * ((v5 * v5) * v18)));
            const double v31 = (v30 + (v24 * (v5 * v16)));
            const double v34 = (v33 * v18);
            const double v39 = ((v33 * ((local_column[6][i] - local_column[2][i]) * v16)) + (v35 * (v18 * (v1 * v1))));
            const double v44 = (v43 + (v36 * (v1 * v16)));
            value[0][i] = (v0 * (constants[10] * v3));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v3)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v4 * (constants[11] * v3));
            value[5][i] = (0.5 * (constants[13] * v4));
            value[6][i] = (-(v4 * (constants[11] * v3)));
            value[7][i] = (0.5 * (constants[13] * v4));
            value[8][i] = (v10 * (v23 - (v27 * cos(v11))));
            value[9][i] = (-(v13 * v23));
            value[10][i] = (v25 + v32);
            value[11][i] = (v21 + v31);
            value[12][i] = (v10 * (v23 - (v27 * cos(v11))));
            value[13][i] = (-(v13 * v23));
            value[14][i] = (v32 - v25);
            value[15][i] = (v31 - v21);
            value[16][i] = (-(v26 * v1));
            value[17][i] = (v29 * v8);
            value[18][i] = (v10 * v39);
            value[19][i] = (-(v13 * ((v38 * cos(v14)) + v39)));
            value[20][i] = (v34 + v44);
            value[21][i] = (v37 + v42);
            value[22][i] = (v10 * v39);
            value[23][i] = (-(v13 * ((v38 * cos(v14)) + v39)));
            value[24][i] = (v44 - v34);
            value[25][i] = (v42 - v37);
            value[26][i] = (-(v41 * v8));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 27; j++) out[k * 27 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v1 = (1.0 / constants[9]);
    const double v3 = (1.0 / constants[18]);
    const double v4 = (0.5 * constants[10]);
    const double v6 = (0.5 * constants[11]);
    const double v10 = (constants[4] * (constants[3] * constants[5]));
    const double v12 = (1.0 / constants[19]);
    const double v13 = (v3 * (v1 * (constants[13] * v10)));
    const double v14 = (v3 * ((constants[13] * constants[13]) * v10));
    const double v15 = (0.25 * v14);
    const double v16 = (0.5 * (v3 * (constants[12] * constants[14])));
    const double v17 = (v12 * (v1 * (constants[12] * v10)));
    const double v18 = (v12 * (v10 * (constants[12] * constants[12])));
    const double v19 = (0.25 * v18);
    const double v20 = (v19 + v19);
    const double v24 = (v15 + v15);
    const double v25 = (0.5 * (constants[10] * v17));
    const double v28 = (0.5 * (constants[10] * v20));
    const double v30 = (0.5 * (constants[10] * v13));
    const double v33 = (constants[10] * constants[11]);
    const double v34 = (0.25 * v33);
    const double v36 = (0.5 * (constants[10] * v24));
    const double v38 = (0.5 * (constants[10] * ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))))));
    const double v39 = ((-0.5) * constants[11]);
    const double v40 = ((-0.5) * (constants[11] * v17));
    const double v42 = ((-0.5) * (constants[11] * v20));
    const double v44 = (0.5 * (constants[11] * (v12 * (constants[4] * (constants[5] * constants[7])))));
    const double v45 = ((-0.5) * (constants[11] * v13));
    const double v47 = ((-0.5) * (constants[11] * v24));
    const double v49 = ((-0.25) * v33);
    const double v50 = (0.5 * v18);
    const double v52 = ((-0.5) * (constants[12] * constants[15]));
    const double v53 = (0.5 * v14);
    const double v55 = (0.5 * (constants[13] * constants[15]));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[38][BLOCK] __attribute__((aligned(64)));
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
            const double v21 = (v9 * multipliers_column[3][i]);
            const double v22 = ((v3 * multipliers_column[2][i]) - (v12 * multipliers_column[3][i]));
            const double v23 = (v9 * multipliers_column[2][i]);
            const double v26 = (v25 * v21);
            const double v27 = (v0 * (v11 * multipliers_column[3][i]));
            const double v29 = (v28 * v27);
            const double v31 = (v30 * v23);
            const double v32 = ((v11 * ((v17 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v13 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) - (v9 * ((v19 * ((v0 * v0) * multipliers_column[3][i])) - (v15 * ((v2 * v2) * multipliers_column[2][i])))));
            const double v35 = (v2 * (v11 * multipliers_column[2][i]));
            const double v37 = (v36 * v35);
            const double v41 = (v40 * v21);
            const double v43 = (v42 * v27);
            const double v46 = (v45 * v23);
            const double v48 = (v47 * v35);
            const double v51 = ((v50 * (v11 * (v0 * multipliers_column[3][i]))) - (v17 * v21));
            const double v54 = ((v13 * v23) + (v53 * (v11 * (v2 * multipliers_column[2][i]))));
            value[0][i] = (v4 * ((v4 * v32) + (v38 * (sin(v5) * multipliers_column[2][i]))));
            value[1][i] = (-(v34 * v32));
            value[2][i] = (-(v6 * ((v39 * v32) - (v44 * (sin(v7) * multipliers_column[3][i])))));
            value[3][i] = (v29 - v26);
            value[4][i] = (v43 - v41);
            value[5][i] = (v20 * v21);
            value[6][i] = (-(v31 + v37));
            value[7][i] = (-(v46 + v48));
            value[8][i] = (-(v24 * v23));
            value[9][i] = (v4 * ((v4 * v32) + (v38 * (sin(v5) * multipliers_column[2][i]))));
            value[10][i] = (v49 * v32);
            value[11][i] = (v4 * v51);
            value[12][i] = (-(v4 * v54));
            value[13][i] = (v4 * ((v4 * v32) + (v38 * (sin(v5) * multipliers_column[2][i]))));
            value[14][i] = (-(v34 * v32));
            value[15][i] = (-(v6 * ((v39 * v32) - (v44 * (sin(v7) * multipliers_column[3][i])))));
            value[16][i] = (-(v6 * v51));
            value[17][i] = (v6 * v54);
            value[18][i] = (-(v34 * v32));
            value[19][i] = (-(v6 * ((v39 * v32) - (v44 * (sin(v7) * multipliers_column[3][i])))));
            value[20][i] = (v26 + v29);
            value[21][i] = (v41 + v43);
            value[22][i] = (v20 * v21);
            value[23][i] = (v26 + v29);
            value[24][i] = (v41 + v43);
            value[25][i] = (v20 * v21);
            value[26][i] = (v31 - v37);
            value[27][i] = (v46 - v48);
            value[28][i] = (-(v24 * v23));
            value[29][i] = (v31 - v37);
            value[30][i] = (v46 - v48);
            value[31][i] = (-(v24 * v23));
            value[32][i] = (-(v16 * multipliers_column[2][i]));
            value[33][i] = (-(v16 * multipliers_column[2][i]));
            value[34][i] = (v52 * v22);
            value[35][i] = (v55 * v22);
            value[36][i] = (v52 * v22);
            value[37][i] = (v55 * v22);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 38; j++) out[index[k * 38 + j]] += value[j][i];
        }
    }
}
