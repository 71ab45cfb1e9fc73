// f3cad9f6bf526f612c4bcf9b8a47b0fa
// {"name": "double pendulum on a bench interval", "m": 4, "n_local": 8, "n_shared": 2, "n_data": 2, "n_constants": 20, "jacobian": [[0, 0], [0, 4], [0, 6], [1, 1], [1, 5], [1, 7], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 9]], "hessian": [[4, 2], [4, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 4], [6, 5], [6, 6], [7, 4], [7, 5], [7, 7], [8, 6], [9, 6], [9, 7]]}
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
    const double v2 = (1.0 / constants[9]);
    const double v3 = (constants[10] * v2);
    const double v4 = (1.0 / constants[17]);
    const double v6 = (constants[11] * v2);
    const double v7 = (1.0 / constants[18]);
    const double v8 = (shared[1] * constants[15]);
    const double v12 = (constants[4] * (constants[3] * constants[7]));
    const double v13 = (constants[0] * (constants[1] * constants[7]));
    const double v14 = (shared[0] * (constants[12] * constants[14]));
    const double v16 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2));
    const double v20 = (constants[4] * (constants[3] * constants[5]));
    const double v21 = ((constants[13] * constants[13]) * v20);
    const double v24 = (v2 * (constants[13] * v20));
    const double v25 = (1.0 / constants[19]);
    const double v26 = (constants[4] * (constants[5] * constants[7]));
    const double v27 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2));
    const double v28 = (v20 * (constants[12] * constants[12]));
    const double v29 = (v2 * (constants[12] * v20));
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
            const double v1 = (constants[12] * local_column[6][i]);
            const double v5 = (constants[13] * local_column[7][i]);
            const double v9 = (v8 * (v5 - v1));
            const double v10 = (constants[10] * local_column[4][i]);
            const double v11 = sin(v10);
            const double v15 = (local_column[6][i] - local_column[2][i]);
            const double v17 = (constants[11] * local_column[5][i]);
            const double v18 = (v10 - v17);
            const double v19 = sin(v18);
            const double v22 = (local_column[7][i] - local_column[3][i]);
            const double v23 = cos(v18);
            value[0][i] = (v0 * (v1 - (v3 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v4 * (v5 - (v6 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v7 * (((((((v9 + (data_column[1][i] - data_column[0][i])) - (v12 * v11)) - (v13 * v11)) - (v14 * local_column[6][i])) - (v16 * v15)) - (v21 * ((local_column[7][i] * local_column[7][i]) * v19))) - (v24 * (v22 * v23))));
            value[3][i] = (v25 * (((v28 * (v19 * (local_column[6][i] * local_column[6][i]))) - ((v27 * v22) + ((v26 * sin(v17)) + (data_column[1][i] + v9)))) - (v29 * (v15 * v23))));
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
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[17]);
    const double v3 = (1.0 / constants[18]);
    const double v5 = (shared[1] * constants[15]);
    const double v7 = (constants[12] * constants[14]);
    const double v11 = (constants[4] * (constants[3] * constants[5]));
    const double v13 = (1.0 / constants[19]);
    const double v14 = (v3 * (v1 * (constants[13] * v11)));
    const double v16 = (v3 * ((constants[13] * constants[13]) * v11));
    const double v19 = (v3 * v7);
    const double v20 = ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))));
    const double v21 = (v3 * v5);
    const double v22 = (constants[15] * v3);
    const double v23 = (constants[13] * v21);
    const double v24 = (v13 * (v1 * (constants[12] * v11)));
    const double v25 = (v13 * (v11 * (constants[12] * constants[12])));
    const double v26 = (v25 + v25);
    const double v27 = (v13 * (constants[4] * (constants[5] * constants[7])));
    const double v29 = (v5 * v13);
    const double v30 = (constants[15] * v13);
    const double v31 = (constants[12] * v29);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double value[21][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = ((constants[13] * local_column[7][i]) - (constants[12] * local_column[6][i]));
            const double v6 = (constants[10] * local_column[4][i]);
            const double v8 = (constants[11] * local_column[5][i]);
            const double v9 = (v6 - v8);
            const double v10 = sin(v9);
            const double v12 = cos(v9);
            const double v15 = (v14 * (v10 * (local_column[7][i] - local_column[3][i])));
            const double v17 = (v16 * ((local_column[7][i] * local_column[7][i]) * v12));
            const double v18 = (v16 * (local_column[7][i] * v10));
            const double v28 = ((v24 * ((local_column[6][i] - local_column[2][i]) * v10)) + (v25 * (v12 * (local_column[6][i] * local_column[6][i]))));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = (constants[12] * v0);
            value[3][i] = (v2 * (constants[11] * v1));
            value[4][i] = (-(v2 * (constants[11] * v1)));
            value[5][i] = (constants[13] * v2);
            value[6][i] = (v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1)));
            value[7][i] = (v14 * v12);
            value[8][i] = (constants[10] * ((v15 - v17) - (v20 * cos(v6))));
            value[9][i] = (constants[11] * (v17 - v15));
            value[10][i] = (-(((v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))) + (v3 * (shared[0] * v7))) + (constants[12] * v21)));
            value[11][i] = (v23 - (v18 + ((v14 * v12) + v18)));
            value[12][i] = (-(v19 * local_column[6][i]));
            value[13][i] = (v22 * v4);
            value[14][i] = (v24 * v12);
            value[15][i] = (v13 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1)));
            value[16][i] = (constants[10] * v28);
            value[17][i] = (-(constants[11] * ((v27 * cos(v8)) + v28)));
            value[18][i] = (v31 + ((v26 * (local_column[6][i] * v10)) - (v24 * v12)));
            value[19][i] = (-((v13 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))) + (constants[13] * v29)));
            value[20][i] = (-(v30 * v4));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 21; j++) out[k * 21 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[18]);
    const double v6 = (constants[4] * (constants[3] * constants[5]));
    const double v8 = (1.0 / constants[19]);
    const double v9 = (v1 * (v0 * (constants[13] * v6)));
    const double v10 = (v1 * ((constants[13] * constants[13]) * v6));
    const double v11 = (v1 * (constants[12] * constants[14]));
    const double v12 = (v8 * (v0 * (constants[12] * v6)));
    const double v13 = (v8 * (v6 * (constants[12] * constants[12])));
    const double v14 = (v13 + v13);
    const double v18 = (constants[11] * v12);
    const double v19 = (constants[10] * v12);
    const double v21 = (constants[11] * v9);
    const double v22 = (constants[10] * v9);
    const double v25 = (constants[10] * v14);
    const double v29 = (constants[10] * constants[11]);
    const double v31 = (constants[10] * v10);
    const double v33 = (constants[10] * ((v1 * (constants[0] * (constants[1] * constants[7]))) + (v1 * (constants[4] * (constants[3] * constants[7])))));
    const double v34 = (constants[11] * v14);
    const double v35 = (constants[11] * (v8 * (constants[4] * (constants[5] * constants[7]))));
    const double v36 = (constants[11] * v10);
    const double v38 = (constants[12] * constants[15]);
    const double v39 = (v10 + v10);
    const double v40 = (constants[13] * constants[15]);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[16][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[4][i]);
            const double v3 = (constants[11] * local_column[5][i]);
            const double v4 = (v2 - v3);
            const double v5 = sin(v4);
            const double v7 = cos(v4);
            const double v15 = (v5 * multipliers_column[3][i]);
            const double v16 = ((v1 * multipliers_column[2][i]) - (v8 * multipliers_column[3][i]));
            const double v17 = (v5 * multipliers_column[2][i]);
            const double v20 = (v19 * v15);
            const double v23 = (v22 * v17);
            const double v24 = (local_column[6][i] * (v7 * multipliers_column[3][i]));
            const double v26 = (v7 * ((v12 * ((local_column[6][i] - local_column[2][i]) * multipliers_column[3][i])) + (v9 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i]))));
            const double v27 = (v5 * ((v13 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) - (v10 * ((local_column[7][i] * local_column[7][i]) * multipliers_column[2][i]))));
            const double v28 = (v26 - v27);
            const double v30 = (local_column[7][i] * (v7 * multipliers_column[2][i]));
            const double v32 = (v31 * v30);
            const double v37 = (v36 * v30);
            value[0][i] = (-v20);
            value[1][i] = (-v23);
            value[2][i] = (constants[10] * ((constants[10] * v28) + (v33 * (sin(v2) * multipliers_column[2][i]))));
            value[3][i] = (v18 * v15);
            value[4][i] = (v21 * v17);
            value[5][i] = (-(v29 * v28));
            value[6][i] = (-(constants[11] * ((constants[11] * (v27 - v26)) - (v35 * (sin(v3) * multipliers_column[3][i])))));
            value[7][i] = (v20 + (v25 * v24));
            value[8][i] = (-((v18 * v15) + (v34 * v24)));
            value[9][i] = (v14 * v15);
            value[10][i] = (-(v32 + (v32 - v23)));
            value[11][i] = (v37 - ((v21 * v17) - v37));
            value[12][i] = (-(v39 * v17));
            value[13][i] = (-(v11 * multipliers_column[2][i]));
            value[14][i] = (-(v38 * v16));
            value[15][i] = (v40 * v16);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 16; j++) out[index[k * 16 + j]] += value[j][i];
        }
    }
}
