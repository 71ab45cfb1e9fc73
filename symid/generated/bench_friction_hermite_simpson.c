// 641f6b70f315ff0cbfcd792c8bcc45c7
// {"name": "double pendulum on a bench interval", "m": 16, "n_local": 20, "n_shared": 2, "n_data": 2, "n_constants": 20, "jacobian": [[0, 2], [0, 4], [1, 3], [1, 5], [2, 0], [2, 1], [2, 2], [2, 3], [2, 6], [2, 7], [2, 20], [2, 21], [3, 0], [3, 1], [3, 2], [3, 3], [3, 6], [3, 7], [3, 21], [4, 2], [4, 6], [4, 8], [4, 10], [4, 14], [5, 3], [5, 7], [5, 9], [5, 11], [5, 15], [6, 0], [6, 1], [6, 2], [6, 3], [6, 4], [6, 5], [6, 6], [6, 7], [6, 8], [6, 9], [6, 10], [6, 11], [6, 12], [6, 13], [6, 14], [6, 15], [6, 20], [6, 21], [7, 0], [7, 1], [7, 2], [7, 3], [7, 4], [7, 5], [7, 6], [7, 7], [7, 8], [7, 9], [7, 10], [7, 11], [7, 12], [7, 13], [7, 14], [7, 15], [7, 21], [8, 12], [8, 18], [9, 13], [9, 19], [10, 14], [10, 15], [10, 16], [10, 17], [10, 18], [10, 19], [10, 20], [10, 21], [11, 14], [11, 15], [11, 16], [11, 17], [11, 18], [11, 19], [11, 21], [12, 0], [12, 4], [12, 8], [12, 12], [12, 16], [13, 1], [13, 5], [13, 9], [13, 13], [13, 17], [14, 2], [14, 6], [14, 10], [14, 14], [14, 18], [15, 3], [15, 7], [15, 11], [15, 15], [15, 19]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 0], [4, 1], [4, 2], [4, 3], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 2], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 3], [7, 4], [7, 5], [7, 7], [8, 0], [8, 1], [8, 2], [8, 3], [8, 4], [8, 5], [8, 6], [8, 7], [8, 8], [9, 0], [9, 1], [9, 2], [9, 3], [9, 4], [9, 5], [9, 6], [9, 7], [9, 8], [9, 9], [10, 0], [10, 1], [10, 2], [10, 4], [10, 5], [10, 6], [10, 8], [10, 9], [10, 10], [11, 0], [11, 1], [11, 3], [11, 4], [11, 5], [11, 7], [11, 8], [11, 9], [11, 11], [12, 0], [12, 1], [12, 2], [12, 3], [12, 4], [12, 5], [12, 6], [12, 7], [12, 8], [12, 9], [12, 10], [12, 11], [12, 12], [13, 0], [13, 1], [13, 2], [13, 3], [13, 4], [13, 5], [13, 6], [13, 7], [13, 8], [13, 9], [13, 10], [13, 11], [13, 12], [13, 13], [14, 0], [14, 1], [14, 2], [14, 4], [14, 5], [14, 6], [14, 8], [14, 9], [14, 10], [14, 12], [14, 13], [14, 14], [15, 0], [15, 1], [15, 3], [15, 4], [15, 5], [15, 7], [15, 8], [15, 9], [15, 11], [15, 12], [15, 13], [15, 15], [16, 14], [16, 15], [16, 16], [17, 14], [17, 15], [17, 16], [17, 17], [18, 16], [18, 17], [18, 18], [19, 16], [19, 17], [19, 19], [20, 2], [20, 6], [20, 10], [20, 14], [20, 18], [21, 2], [21, 3], [21, 6], [21, 7], [21, 10], [21, 11], [21, 14], [21, 15], [21, 18], [21, 19]]}
// local[0]: link1_angle#0
// local[1]: link2_angle#0
// local[2]: link1_velocity#0
// local[3]: link2_velocity#0
// local[4]: link1_angle#1
// local[5]: link2_angle#1
// local[6]: link1_velocity#1
// local[7]: link2_velocity#1
// local[8]: link1_angle#2
// local[9]: link2_angle#2
// local[10]: link1_velocity#2
// local[11]: link2_velocity#2
// local[12]: link1_angle#3
// local[13]: link2_angle#3
// local[14]: link1_velocity#3
// local[15]: link2_velocity#3
// local[16]: link1_angle#4
// local[17]: link2_angle#4
// local[18]: link1_velocity#4
// local[19]: link2_velocity#4
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
    const double v15 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v2));
    const double v19 = (constants[4] * (constants[3] * constants[5]));
    const double v20 = ((constants[13] * constants[13]) * v19);
    const double v22 = (v2 * (constants[13] * v19));
    const double v24 = (1.0 / constants[19]);
    const double v25 = (constants[4] * (constants[5] * constants[7]));
    const double v26 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v2));
    const double v27 = (v19 * (constants[12] * constants[12]));
    const double v28 = (v2 * (constants[12] * v19));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[16][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (constants[12] * local_column[2][i]);
            const double v5 = (constants[13] * local_column[3][i]);
            const double v9 = (v8 * (v5 - v1));
            const double v10 = (constants[10] * local_column[0][i]);
            const double v11 = sin(v10);
            const double v16 = (constants[11] * local_column[1][i]);
            const double v17 = (v10 - v16);
            const double v18 = sin(v17);
            const double v21 = cos(v17);
            const double v23 = (data_column[1][i] - data_column[0][i]);
            const double v29 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v30 = (constants[12] * v29);
            const double v31 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v32 = (constants[13] * v31);
            const double v33 = (v8 * (v32 - v30));
            const double v34 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v35 = sin(v34);
            const double v36 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v37 = (v34 - v36);
            const double v38 = sin(v37);
            const double v39 = cos(v37);
            const double v40 = (constants[12] * local_column[18][i]);
            const double v41 = (constants[13] * local_column[19][i]);
            const double v42 = (v8 * (v41 - v40));
            const double v43 = (constants[10] * local_column[16][i]);
            const double v44 = sin(v43);
            const double v45 = (constants[11] * local_column[17][i]);
            const double v46 = (v43 - v45);
            const double v47 = sin(v46);
            const double v48 = cos(v46);
            value[0][i] = (v0 * (v1 - (v3 * local_column[4][i])));
            value[1][i] = (v4 * (v5 - (v6 * local_column[5][i])));
            value[2][i] = (v7 * (((((((v9 + v23) - (v12 * v11)) - (v13 * v11)) - (v14 * local_column[2][i])) - (v15 * local_column[6][i])) - (v20 * ((local_column[3][i] * local_column[3][i]) * v18))) - (v22 * (local_column[7][i] * v21))));
            value[3][i] = (v24 * (((v27 * (v18 * (local_column[2][i] * local_column[2][i]))) - ((v26 * local_column[7][i]) + ((v25 * sin(v16)) + (data_column[1][i] + v9)))) - (v28 * (local_column[6][i] * v21))));
            value[4][i] = (v0 * (v30 - (v3 * local_column[8][i])));
            value[5][i] = (v4 * (v32 - (v6 * local_column[9][i])));
            value[6][i] = (v7 * (((((((v23 + v33) - (v12 * v35)) - (v13 * v35)) - (v15 * local_column[10][i])) - (v14 * v29)) - (v20 * ((v31 * v31) * v38))) - (v22 * (local_column[11][i] * v39))));
            value[7][i] = (v24 * (((v27 * (v38 * (v29 * v29))) - ((v26 * local_column[11][i]) + ((v25 * sin(v36)) + (data_column[1][i] + v33)))) - (v28 * (local_column[10][i] * v39))));
            value[8][i] = (v0 * (v40 - (v3 * local_column[12][i])));
            value[9][i] = (v4 * (v41 - (v6 * local_column[13][i])));
            value[10][i] = (v7 * (((((((v23 + v42) - (v12 * v44)) - (v13 * v44)) - (v15 * local_column[14][i])) - (v14 * local_column[18][i])) - (v20 * ((local_column[19][i] * local_column[19][i]) * v47))) - (v22 * (local_column[15][i] * v48))));
            value[11][i] = (v24 * (((v27 * (v47 * (local_column[18][i] * local_column[18][i]))) - ((v26 * local_column[15][i]) + ((v25 * sin(v45)) + (data_column[1][i] + v42)))) - (v28 * (local_column[14][i] * v48))));
            value[12][i] = (((-0.6666666666666666) * local_column[8][i]) + (((-0.16666666666666666) * local_column[12][i]) + (((-0.16666666666666666) * local_column[4][i]) + (local_column[16][i] - local_column[0][i]))));
            value[13][i] = (((-0.6666666666666666) * local_column[9][i]) + (((-0.16666666666666666) * local_column[13][i]) + (((-0.16666666666666666) * local_column[5][i]) + (local_column[17][i] - local_column[1][i]))));
            value[14][i] = (((-0.6666666666666666) * local_column[10][i]) + (((-0.16666666666666666) * local_column[14][i]) + (((-0.16666666666666666) * local_column[6][i]) + (local_column[18][i] - local_column[2][i]))));
            value[15][i] = (((-0.6666666666666666) * local_column[11][i]) + (((-0.16666666666666666) * local_column[15][i]) + (((-0.16666666666666666) * local_column[7][i]) + (local_column[19][i] - local_column[3][i]))));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 16; j++) out[k * 16 + j] = value[j][i];
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
    const double v28 = (constants[12] * v0);
    const double v29 = (constants[13] * v2);
    const double v30 = (v3 * (v1 * (constants[13] * v11)));
    const double v32 = (v3 * ((constants[13] * constants[13]) * v11));
    const double v34 = (v32 + v32);
    const double v35 = (v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1)));
    const double v36 = (v3 * v7);
    const double v37 = ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))));
    const double v38 = (v3 * v5);
    const double v39 = (constants[15] * v3);
    const double v40 = (constants[13] * v38);
    const double v41 = ((v3 * (shared[0] * v7)) + (constants[12] * v38));
    const double v42 = (v13 * (v1 * (constants[12] * v11)));
    const double v43 = (v13 * (v11 * (constants[12] * constants[12])));
    const double v44 = (v43 + v43);
    const double v45 = (v13 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1)));
    const double v46 = (v13 * (constants[4] * (constants[5] * constants[7])));
    const double v48 = (v5 * v13);
    const double v49 = (constants[15] * v13);
    const double v50 = (constants[13] * v48);
    const double v51 = (constants[12] * v48);
    const double v55 = ((-0.041666666666666664) * constants[11]);
    const double v56 = (0.20833333333333334 * constants[11]);
    const double v57 = (0.3333333333333333 * constants[11]);
    const double v59 = ((-0.041666666666666664) * constants[10]);
    const double v60 = (0.20833333333333334 * constants[10]);
    const double v61 = (0.3333333333333333 * constants[10]);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double value[103][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = ((constants[13] * local_column[3][i]) - (constants[12] * local_column[2][i]));
            const double v6 = (constants[10] * local_column[0][i]);
            const double v8 = (constants[11] * local_column[1][i]);
            const double v9 = (v6 - v8);
            const double v10 = sin(v9);
            const double v12 = cos(v9);
            const double v14 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v15 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v16 = ((constants[13] * v15) - (constants[12] * v14));
            const double v17 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v18 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v19 = (v17 - v18);
            const double v20 = sin(v19);
            const double v21 = cos(v19);
            const double v22 = ((constants[13] * local_column[19][i]) - (constants[12] * local_column[18][i]));
            const double v23 = (constants[10] * local_column[16][i]);
            const double v24 = (constants[11] * local_column[17][i]);
            const double v25 = (v23 - v24);
            const double v26 = sin(v25);
            const double v27 = cos(v25);
            const double v31 = (v30 * (local_column[7][i] * v10));
            const double v33 = (v32 * ((local_column[3][i] * local_column[3][i]) * v12));
            const double v47 = ((v42 * (local_column[6][i] * v10)) + (v43 * (v12 * (local_column[2][i] * local_column[2][i]))));
            const double v52 = (v30 * (local_column[11][i] * v20));
            const double v53 = (v32 * ((v15 * v15) * v21));
            const double v54 = (v53 - v52);
            const double v58 = ((v52 - v53) - (v37 * cos(v17)));
            const double v62 = (v40 - (v34 * (v15 * v20)));
            const double v63 = ((v42 * (local_column[10][i] * v20)) + (v43 * (v21 * (v14 * v14))));
            const double v64 = ((v46 * cos(v18)) + v63);
            const double v65 = (v51 + (v44 * (v14 * v20)));
            const double v66 = (v30 * (local_column[15][i] * v26));
            const double v67 = (v32 * ((local_column[19][i] * local_column[19][i]) * v27));
            const double v68 = ((v42 * (local_column[14][i] * v26)) + (v43 * (v27 * (local_column[18][i] * local_column[18][i]))));
            value[0][i] = v28;
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = v29;
            value[3][i] = (-(v2 * (constants[11] * v1)));
            value[4][i] = (constants[10] * ((v31 - v33) - (v37 * cos(v6))));
            value[5][i] = (constants[11] * (v33 - v31));
            value[6][i] = (-v41);
            value[7][i] = (v40 - (v34 * (local_column[3][i] * v10)));
            value[8][i] = (-v35);
            value[9][i] = (-(v30 * v12));
            value[10][i] = (-(v36 * local_column[2][i]));
            value[11][i] = (v39 * v4);
            value[12][i] = (constants[10] * v47);
            value[13][i] = (-(constants[11] * ((v46 * cos(v8)) + v47)));
            value[14][i] = (v51 + (v44 * (local_column[2][i] * v10)));
            value[15][i] = (-v50);
            value[16][i] = (-(v42 * v12));
            value[17][i] = (-v45);
            value[18][i] = (-(v49 * v4));
            value[19][i] = v28;
            value[20][i] = (0.20833333333333334 * v28);
            value[21][i] = (-(v0 * (constants[10] * v1)));
            value[22][i] = (0.3333333333333333 * v28);
            value[23][i] = ((-0.041666666666666664) * v28);
            value[24][i] = v29;
            value[25][i] = (0.20833333333333334 * v29);
            value[26][i] = (-(v2 * (constants[11] * v1)));
            value[27][i] = (0.3333333333333333 * v29);
            value[28][i] = ((-0.041666666666666664) * v29);
            value[29][i] = (constants[10] * v58);
            value[30][i] = (constants[11] * v54);
            value[31][i] = (-v41);
            value[32][i] = v62;
            value[33][i] = (v60 * v58);
            value[34][i] = (v56 * v54);
            value[35][i] = ((-0.20833333333333334) * v41);
            value[36][i] = (0.20833333333333334 * v62);
            value[37][i] = (v61 * v58);
            value[38][i] = (v57 * v54);
            value[39][i] = (((-0.3333333333333333) * v41) - v35);
            value[40][i] = ((0.3333333333333333 * v62) - (v30 * v21));
            value[41][i] = (v59 * v58);
            value[42][i] = (v55 * v54);
            value[43][i] = (0.041666666666666664 * v41);
            value[44][i] = ((-0.041666666666666664) * v62);
            value[45][i] = (-(v36 * v14));
            value[46][i] = (v39 * v16);
            value[47][i] = (constants[10] * v63);
            value[48][i] = (-(constants[11] * v64));
            value[49][i] = v65;
            value[50][i] = (-v50);
            value[51][i] = (v60 * v63);
            value[52][i] = (-(v56 * v64));
            value[53][i] = (0.20833333333333334 * v65);
            value[54][i] = ((-0.20833333333333334) * v50);
            value[55][i] = (v61 * v63);
            value[56][i] = (-(v57 * v64));
            value[57][i] = ((0.3333333333333333 * v65) - (v42 * v21));
            value[58][i] = (((-0.3333333333333333) * v50) - v45);
            value[59][i] = (v59 * v63);
            value[60][i] = (-(v55 * v64));
            value[61][i] = ((-0.041666666666666664) * v65);
            value[62][i] = (0.041666666666666664 * v50);
            value[63][i] = (-(v49 * v16));
            value[64][i] = (-(v0 * (constants[10] * v1)));
            value[65][i] = v28;
            value[66][i] = (-(v2 * (constants[11] * v1)));
            value[67][i] = v29;
            value[68][i] = (-v35);
            value[69][i] = (-(v30 * v27));
            value[70][i] = (constants[10] * ((v66 - v67) - (v37 * cos(v23))));
            value[71][i] = (constants[11] * (v67 - v66));
            value[72][i] = (-v41);
            value[73][i] = (v40 - (v34 * (local_column[19][i] * v26)));
            value[74][i] = (-(v36 * local_column[18][i]));
            value[75][i] = (v39 * v22);
            value[76][i] = (-(v42 * v27));
            value[77][i] = (-v45);
            value[78][i] = (constants[10] * v68);
            value[79][i] = (-(constants[11] * ((v46 * cos(v24)) + v68)));
            value[80][i] = (v51 + (v44 * (local_column[18][i] * v26)));
            value[81][i] = (-v50);
            value[82][i] = (-(v49 * v22));
            value[83][i] = (-1.0);
            value[84][i] = (-0.16666666666666666);
            value[85][i] = (-0.6666666666666666);
            value[86][i] = (-0.16666666666666666);
            value[87][i] = 1.0;
            value[88][i] = (-1.0);
            value[89][i] = (-0.16666666666666666);
            value[90][i] = (-0.6666666666666666);
            value[91][i] = (-0.16666666666666666);
            value[92][i] = 1.0;
            value[93][i] = (-1.0);
            value[94][i] = (-0.16666666666666666);
            value[95][i] = (-0.6666666666666666);
            value[96][i] = (-0.16666666666666666);
            value[97][i] = 1.0;
            value[98][i] = (-1.0);
            value[99][i] = (-0.16666666666666666);
            value[100][i] = (-0.6666666666666666);
            value[101][i] = (-0.16666666666666666);
            value[102][i] = 1.0;
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 103; j++) out[k * 103 + j] = value[j][i];
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
    const double v21 = (v1 * (v0 * (constants[13] * v6)));
    const double v22 = (v1 * ((constants[13] * constants[13]) * v6));
    const double v23 = (v22 + v22);
    const double v24 = (v1 * (constants[12] * constants[14]));
    const double v25 = (v8 * (v0 * (constants[12] * v6)));
    const double v26 = (v8 * (v6 * (constants[12] * constants[12])));
    const double v27 = (v26 + v26);
    const double v28 = ((-0.041666666666666664) * constants[11]);
    const double v29 = (0.20833333333333334 * constants[11]);
    const double v30 = (0.3333333333333333 * constants[11]);
    const double v31 = ((-0.041666666666666664) * constants[10]);
    const double v32 = (0.20833333333333334 * constants[10]);
    const double v33 = (0.3333333333333333 * constants[10]);
    const double v44 = (constants[10] * v25);
    const double v46 = (constants[10] * v27);
    const double v47 = (constants[10] * v21);
    const double v51 = (constants[10] * constants[11]);
    const double v52 = ((-0.041666666666666664) * v51);
    const double v53 = (0.20833333333333334 * v51);
    const double v54 = (0.3333333333333333 * v51);
    const double v56 = (constants[10] * v23);
    const double v58 = (constants[10] * ((v1 * (constants[0] * (constants[1] * constants[7]))) + (v1 * (constants[4] * (constants[3] * constants[7])))));
    const double v60 = ((-0.041666666666666664) * v56);
    const double v61 = (0.20833333333333334 * v56);
    const double v62 = (0.3333333333333333 * v56);
    const double v63 = ((-0.041666666666666664) * v46);
    const double v64 = (0.20833333333333334 * v46);
    const double v65 = (0.3333333333333333 * v46);
    const double v67 = (constants[10] * v26);
    const double v73 = (constants[10] * v22);
    const double v75 = (constants[11] * v25);
    const double v76 = (constants[11] * v27);
    const double v78 = (constants[11] * (v8 * (constants[4] * (constants[5] * constants[7]))));
    const double v79 = (constants[11] * v21);
    const double v82 = (constants[11] * v23);
    const double v83 = ((-0.041666666666666664) * v82);
    const double v84 = (0.20833333333333334 * v82);
    const double v85 = (0.3333333333333333 * v82);
    const double v86 = ((-0.041666666666666664) * v76);
    const double v87 = (0.20833333333333334 * v76);
    const double v88 = (0.3333333333333333 * v76);
    const double v89 = (constants[11] * v26);
    const double v91 = (constants[11] * v22);
    const double v94 = ((-0.08333333333333333) * v89);
    const double v95 = (0.4166666666666667 * v89);
    const double v96 = (0.6666666666666666 * v89);
    const double v97 = ((-0.08333333333333333) * v67);
    const double v98 = (0.4166666666666667 * v67);
    const double v99 = (0.6666666666666666 * v67);
    const double v100 = ((-0.041666666666666664) * v27);
    const double v101 = (0.20833333333333334 * v27);
    const double v102 = (0.3333333333333333 * v27);
    const double v104 = (constants[12] * constants[15]);
    const double v106 = ((-0.08333333333333333) * v91);
    const double v107 = (0.4166666666666667 * v91);
    const double v108 = (0.6666666666666666 * v91);
    const double v109 = ((-0.08333333333333333) * v73);
    const double v110 = (0.4166666666666667 * v73);
    const double v111 = (0.6666666666666666 * v73);
    const double v112 = ((-0.041666666666666664) * v23);
    const double v113 = (0.20833333333333334 * v23);
    const double v114 = (0.3333333333333333 * v23);
    const double v115 = (constants[13] * constants[15]);
    const double v116 = (0.20833333333333334 * v44);
    const double v117 = (0.20833333333333334 * v47);
    const double v118 = ((-0.008680555555555556) * v51);
    const double v119 = (0.04340277777777778 * v51);
    const double v120 = (0.06944444444444445 * v51);
    const double v121 = (0.20833333333333334 * v58);
    const double v123 = ((-0.008680555555555556) * v56);
    const double v124 = (0.04340277777777778 * v56);
    const double v125 = (0.06944444444444445 * v56);
    const double v126 = ((-0.008680555555555556) * v46);
    const double v127 = (0.04340277777777778 * v46);
    const double v128 = (0.06944444444444445 * v46);
    const double v129 = ((-0.20833333333333334) * constants[11]);
    const double v130 = ((-0.20833333333333334) * v75);
    const double v131 = (0.20833333333333334 * v78);
    const double v132 = ((-0.20833333333333334) * v79);
    const double v134 = (0.008680555555555556 * v51);
    const double v135 = ((-0.06944444444444445) * v51);
    const double v136 = (0.008680555555555556 * v82);
    const double v137 = ((-0.04340277777777778) * v82);
    const double v138 = ((-0.06944444444444445) * v82);
    const double v139 = (0.008680555555555556 * v76);
    const double v140 = ((-0.04340277777777778) * v76);
    const double v141 = ((-0.06944444444444445) * v76);
    const double v142 = ((-0.017361111111111112) * v89);
    const double v143 = (0.1388888888888889 * v89);
    const double v144 = ((-0.017361111111111112) * v67);
    const double v145 = (0.1388888888888889 * v67);
    const double v146 = ((-0.008680555555555556) * v27);
    const double v147 = (0.04340277777777778 * v27);
    const double v148 = (0.06944444444444445 * v27);
    const double v149 = (0.20833333333333334 * v24);
    const double v150 = ((-0.20833333333333334) * v104);
    const double v151 = ((-0.017361111111111112) * v91);
    const double v152 = (0.1388888888888889 * v91);
    const double v153 = ((-0.017361111111111112) * v73);
    const double v154 = (0.1388888888888889 * v73);
    const double v155 = ((-0.008680555555555556) * v23);
    const double v156 = (0.04340277777777778 * v23);
    const double v157 = (0.06944444444444445 * v23);
    const double v158 = (0.20833333333333334 * v115);
    const double v159 = (0.3333333333333333 * v44);
    const double v160 = (0.3333333333333333 * v47);
    const double v161 = ((-0.013888888888888888) * v51);
    const double v162 = (0.1111111111111111 * v51);
    const double v163 = (0.3333333333333333 * v58);
    const double v165 = ((-0.013888888888888888) * v56);
    const double v166 = (0.1111111111111111 * v56);
    const double v167 = ((-0.013888888888888888) * v46);
    const double v168 = (0.1111111111111111 * v46);
    const double v169 = ((-0.3333333333333333) * constants[11]);
    const double v170 = ((-0.3333333333333333) * v75);
    const double v171 = (0.3333333333333333 * v78);
    const double v172 = ((-0.3333333333333333) * v79);
    const double v174 = (0.013888888888888888 * v51);
    const double v175 = (0.013888888888888888 * v82);
    const double v176 = ((-0.1111111111111111) * v82);
    const double v177 = (0.013888888888888888 * v76);
    const double v178 = ((-0.1111111111111111) * v76);
    const double v179 = (0.6666666666666666 * v26);
    const double v181 = ((-0.013888888888888888) * v27);
    const double v182 = (0.1111111111111111 * v27);
    const double v183 = (0.3333333333333333 * v24);
    const double v184 = ((-0.3333333333333333) * v104);
    const double v185 = (0.6666666666666666 * v22);
    const double v187 = ((-0.013888888888888888) * v23);
    const double v188 = (0.1111111111111111 * v23);
    const double v189 = (0.3333333333333333 * v115);
    const double v190 = (0.001736111111111111 * v51);
    const double v191 = ((-0.041666666666666664) * v58);
    const double v192 = (0.001736111111111111 * v56);
    const double v193 = (0.001736111111111111 * v46);
    const double v194 = (0.041666666666666664 * constants[11]);
    const double v195 = ((-0.041666666666666664) * v78);
    const double v196 = ((-0.001736111111111111) * v82);
    const double v197 = ((-0.001736111111111111) * v76);
    const double v198 = (0.001736111111111111 * v27);
    const double v199 = ((-0.041666666666666664) * v24);
    const double v200 = (0.041666666666666664 * v104);
    const double v201 = (0.001736111111111111 * v23);
    const double v202 = ((-0.041666666666666664) * v115);
    const double v204 = (v67 + v67);
    const double v209 = (v73 + v73);
    const double v210 = (v89 + v89);
    const double v211 = (v91 + v91);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[16][BLOCK] __attribute__((aligned(64)));
        double value[148][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 16; j++) multipliers_column[j][i] = multipliers[k * 16 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[0][i]);
            const double v3 = (constants[11] * local_column[1][i]);
            const double v4 = (v2 - v3);
            const double v5 = sin(v4);
            const double v7 = cos(v4);
            const double v9 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v10 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v11 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v12 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v13 = (v11 - v12);
            const double v14 = sin(v13);
            const double v15 = cos(v13);
            const double v16 = (constants[10] * local_column[16][i]);
            const double v17 = (constants[11] * local_column[17][i]);
            const double v18 = (v16 - v17);
            const double v19 = sin(v18);
            const double v20 = cos(v18);
            const double v34 = (v19 * multipliers_column[11][i]);
            const double v35 = ((v1 * multipliers_column[10][i]) - (v8 * multipliers_column[11][i]));
            const double v36 = (v19 * multipliers_column[10][i]);
            const double v37 = (v14 * multipliers_column[7][i]);
            const double v38 = ((v1 * multipliers_column[6][i]) - (v8 * multipliers_column[7][i]));
            const double v39 = (v14 * multipliers_column[6][i]);
            const double v40 = (v5 * multipliers_column[3][i]);
            const double v41 = (v26 * v40);
            const double v42 = (v5 * multipliers_column[2][i]);
            const double v43 = (v22 * v42);
            const double v45 = (v9 * (v15 * multipliers_column[7][i]));
            const double v48 = (v15 * ((v25 * (local_column[10][i] * multipliers_column[7][i])) + (v21 * (local_column[11][i] * multipliers_column[6][i]))));
            const double v49 = (v14 * ((v26 * ((v9 * v9) * multipliers_column[7][i])) - (v22 * ((v10 * v10) * multipliers_column[6][i]))));
            const double v50 = (v48 - v49);
            const double v55 = (v10 * (v15 * multipliers_column[6][i]));
            const double v57 = (sin(v11) * multipliers_column[6][i]);
            const double v59 = ((constants[10] * v50) + (v58 * v57));
            const double v66 = (local_column[2][i] * (v7 * multipliers_column[3][i]));
            const double v68 = (v67 * v66);
            const double v69 = (v7 * ((v25 * (local_column[6][i] * multipliers_column[3][i])) + (v21 * (local_column[7][i] * multipliers_column[2][i]))));
            const double v70 = (v5 * ((v26 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) - (v22 * ((local_column[3][i] * local_column[3][i]) * multipliers_column[2][i]))));
            const double v71 = (v69 - v70);
            const double v72 = (local_column[3][i] * (v7 * multipliers_column[2][i]));
            const double v74 = (v73 * v72);
            const double v77 = (sin(v12) * multipliers_column[7][i]);
            const double v80 = (v49 - v48);
            const double v81 = ((constants[11] * v80) - (v78 * v77));
            const double v90 = (v89 * v66);
            const double v92 = (v91 * v72);
            const double v93 = (v15 * (v9 * multipliers_column[7][i]));
            const double v103 = (v38 + ((v1 * multipliers_column[2][i]) - (v8 * multipliers_column[3][i])));
            const double v105 = (v15 * (v10 * multipliers_column[6][i]));
            const double v122 = ((v32 * v50) + (v121 * v57));
            const double v133 = ((v129 * v50) - (v131 * v77));
            const double v164 = ((v33 * v50) + (v163 * v57));
            const double v173 = ((v169 * v50) - (v171 * v77));
            const double v180 = ((v25 * v37) + (v179 * v93));
            const double v186 = ((v21 * v39) - (v185 * v105));
            const double v203 = (local_column[18][i] * (v20 * multipliers_column[11][i]));
            const double v205 = (v20 * ((v25 * (local_column[14][i] * multipliers_column[11][i])) + (v21 * (local_column[15][i] * multipliers_column[10][i]))));
            const double v206 = (v19 * ((v26 * ((local_column[18][i] * local_column[18][i]) * multipliers_column[11][i])) - (v22 * ((local_column[19][i] * local_column[19][i]) * multipliers_column[10][i]))));
            const double v207 = (v205 - v206);
            const double v208 = (local_column[19][i] * (v20 * multipliers_column[10][i]));
            value[0][i] = (constants[10] * (v59 + ((constants[10] * v71) + (v58 * (sin(v2) * multipliers_column[2][i])))));
            value[1][i] = (-(v51 * (v50 + v71)));
            value[2][i] = (-(constants[11] * (v81 + ((constants[11] * (v70 - v69)) - (v78 * (sin(v3) * multipliers_column[3][i]))))));
            value[3][i] = (v68 + ((v46 * v45) + v68));
            value[4][i] = (-(v90 + ((v76 * v45) + v90)));
            value[5][i] = (v41 + (v41 + (v27 * v37)));
            value[6][i] = (-(v74 + ((v56 * v55) + v74)));
            value[7][i] = (v92 + ((v82 * v55) + v92));
            value[8][i] = (-(v43 + (v43 + (v23 * v39))));
            value[9][i] = (v32 * v59);
            value[10][i] = (v53 * v80);
            value[11][i] = (v98 * v93);
            value[12][i] = (-(v110 * v105));
            value[13][i] = (v32 * v122);
            value[14][i] = (-(v53 * v50));
            value[15][i] = (-(v29 * v81));
            value[16][i] = (-(v95 * v93));
            value[17][i] = (v107 * v105);
            value[18][i] = (-(v119 * v50));
            value[19][i] = (-(v29 * v133));
            value[20][i] = ((v64 * v45) + (v44 * v40));
            value[21][i] = (-((v87 * v45) + (v75 * v40)));
            value[22][i] = (v101 * v37);
            value[23][i] = (v127 * v45);
            value[24][i] = (v140 * v45);
            value[25][i] = (v147 * v37);
            value[26][i] = ((v47 * v42) - (v61 * v55));
            value[27][i] = ((v84 * v55) - (v79 * v42));
            value[28][i] = (-(v113 * v39));
            value[29][i] = (-(v124 * v55));
            value[30][i] = (-(v137 * v55));
            value[31][i] = (-(v156 * v39));
            value[32][i] = (v33 * v59);
            value[33][i] = (v54 * v80);
            value[34][i] = (v99 * v93);
            value[35][i] = (-(v111 * v105));
            value[36][i] = (v33 * v122);
            value[37][i] = (v135 * v50);
            value[38][i] = (v145 * v93);
            value[39][i] = (-(v154 * v105));
            value[40][i] = (v33 * v164);
            value[41][i] = (-(v54 * v50));
            value[42][i] = (-(v30 * v81));
            value[43][i] = (-(v96 * v93));
            value[44][i] = (v108 * v105);
            value[45][i] = (-(v120 * v50));
            value[46][i] = (-(v30 * v133));
            value[47][i] = (-(v143 * v93));
            value[48][i] = (v152 * v105);
            value[49][i] = (-(v162 * v50));
            value[50][i] = (-(v30 * v173));
            value[51][i] = ((v44 * v37) + (v65 * v45));
            value[52][i] = (-((v75 * v37) + (v88 * v45)));
            value[53][i] = (v102 * v37);
            value[54][i] = ((v116 * v37) + (v128 * v45));
            value[55][i] = ((v130 * v37) + (v141 * v45));
            value[56][i] = (v148 * v37);
            value[57][i] = ((v159 * v37) + (v168 * v45));
            value[58][i] = ((v170 * v37) + (v178 * v45));
            value[59][i] = (v182 * v37);
            value[60][i] = ((v47 * v39) - (v62 * v55));
            value[61][i] = ((v85 * v55) - (v79 * v39));
            value[62][i] = (-(v114 * v39));
            value[63][i] = ((v117 * v39) - (v125 * v55));
            value[64][i] = ((v132 * v39) - (v138 * v55));
            value[65][i] = (-(v157 * v39));
            value[66][i] = ((v160 * v39) - (v166 * v55));
            value[67][i] = ((v172 * v39) - (v176 * v55));
            value[68][i] = (-(v188 * v39));
            value[69][i] = (v31 * v59);
            value[70][i] = (v52 * v80);
            value[71][i] = (v97 * v93);
            value[72][i] = (-(v109 * v105));
            value[73][i] = (v31 * v122);
            value[74][i] = (v134 * v50);
            value[75][i] = (v144 * v93);
            value[76][i] = (-(v153 * v105));
            value[77][i] = (v31 * v164);
            value[78][i] = (v174 * v50);
            value[79][i] = (v31 * v180);
            value[80][i] = (v31 * v186);
            value[81][i] = (v31 * ((v31 * v50) + (v191 * v57)));
            value[82][i] = (-(v52 * v50));
            value[83][i] = (-(v28 * v81));
            value[84][i] = (-(v94 * v93));
            value[85][i] = (v106 * v105);
            value[86][i] = (-(v118 * v50));
            value[87][i] = (-(v28 * v133));
            value[88][i] = (-(v142 * v93));
            value[89][i] = (v151 * v105);
            value[90][i] = (-(v161 * v50));
            value[91][i] = (-(v28 * v173));
            value[92][i] = (-(v28 * v180));
            value[93][i] = (-(v28 * v186));
            value[94][i] = (-(v190 * v50));
            value[95][i] = (-(v28 * ((v194 * v50) - (v195 * v77))));
            value[96][i] = (v63 * v45);
            value[97][i] = (-(v86 * v45));
            value[98][i] = (v100 * v37);
            value[99][i] = (v126 * v45);
            value[100][i] = (v139 * v45);
            value[101][i] = (v146 * v37);
            value[102][i] = (v167 * v45);
            value[103][i] = (v177 * v45);
            value[104][i] = (v181 * v37);
            value[105][i] = (v193 * v45);
            value[106][i] = (v197 * v45);
            value[107][i] = (v198 * v37);
            value[108][i] = (-(v60 * v55));
            value[109][i] = (v83 * v55);
            value[110][i] = (-(v112 * v39));
            value[111][i] = (-(v123 * v55));
            value[112][i] = (-(v136 * v55));
            value[113][i] = (-(v155 * v39));
            value[114][i] = (-(v165 * v55));
            value[115][i] = (-(v175 * v55));
            value[116][i] = (-(v187 * v39));
            value[117][i] = (-(v192 * v55));
            value[118][i] = (-(v196 * v55));
            value[119][i] = (-(v201 * v39));
            value[120][i] = (v44 * v34);
            value[121][i] = (v47 * v36);
            value[122][i] = (constants[10] * ((constants[10] * v207) + (v58 * (sin(v16) * multipliers_column[10][i]))));
            value[123][i] = (-(v75 * v34));
            value[124][i] = (-(v79 * v36));
            value[125][i] = (-(v51 * v207));
            value[126][i] = (-(constants[11] * ((constants[11] * (v206 - v205)) - (v78 * (sin(v17) * multipliers_column[11][i])))));
            value[127][i] = (v204 * v203);
            value[128][i] = (-(v210 * v203));
            value[129][i] = (v27 * v34);
            value[130][i] = (-(v209 * v208));
            value[131][i] = (v211 * v208);
            value[132][i] = (-(v23 * v36));
            value[133][i] = (-(v24 * (multipliers_column[2][i] + multipliers_column[6][i])));
            value[134][i] = (-(v149 * multipliers_column[6][i]));
            value[135][i] = (-(v183 * multipliers_column[6][i]));
            value[136][i] = (-(v199 * multipliers_column[6][i]));
            value[137][i] = (-(v24 * multipliers_column[10][i]));
            value[138][i] = (-(v104 * v103));
            value[139][i] = (v115 * v103);
            value[140][i] = (v150 * v38);
            value[141][i] = (v158 * v38);
            value[142][i] = (v184 * v38);
            value[143][i] = (v189 * v38);
            value[144][i] = (v200 * v38);
            value[145][i] = (v202 * v38);
            value[146][i] = (-(v104 * v35));
            value[147][i] = (v115 * v35);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 148; j++) out[index[k * 148 + j]] += value[j][i];
        }
    }
}
