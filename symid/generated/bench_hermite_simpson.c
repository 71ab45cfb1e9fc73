// 45f90a2feca4733297ae408bd8db1707
// {"name": "double pendulum on a bench interval", "m": 16, "n_local": 20, "n_shared": 0, "n_data": 2, "n_constants": 18, "jacobian": [[0, 2], [0, 4], [1, 3], [1, 5], [2, 0], [2, 1], [2, 3], [2, 6], [2, 7], [3, 0], [3, 1], [3, 2], [3, 6], [3, 7], [4, 2], [4, 6], [4, 8], [4, 10], [4, 14], [5, 3], [5, 7], [5, 9], [5, 11], [5, 15], [6, 0], [6, 1], [6, 3], [6, 4], [6, 5], [6, 7], [6, 8], [6, 9], [6, 10], [6, 11], [6, 12], [6, 13], [6, 15], [7, 0], [7, 1], [7, 2], [7, 4], [7, 5], [7, 6], [7, 8], [7, 9], [7, 10], [7, 11], [7, 12], [7, 13], [7, 14], [8, 12], [8, 18], [9, 13], [9, 19], [10, 14], [10, 15], [10, 16], [10, 17], [10, 19], [11, 14], [11, 15], [11, 16], [11, 17], [11, 18], [12, 0], [12, 4], [12, 8], [12, 12], [12, 16], [13, 1], [13, 5], [13, 9], [13, 13], [13, 17], [14, 2], [14, 6], [14, 10], [14, 14], [14, 18], [15, 3], [15, 7], [15, 11], [15, 15], [15, 19]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 0], [2, 1], [2, 2], [3, 0], [3, 1], [3, 3], [4, 0], [4, 1], [4, 2], [4, 3], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 0], [6, 1], [6, 2], [6, 4], [6, 5], [6, 6], [7, 0], [7, 1], [7, 3], [7, 4], [7, 5], [7, 7], [8, 0], [8, 1], [8, 2], [8, 3], [8, 4], [8, 5], [8, 6], [8, 7], [8, 8], [9, 0], [9, 1], [9, 2], [9, 3], [9, 4], [9, 5], [9, 6], [9, 7], [9, 8], [9, 9], [10, 0], [10, 1], [10, 2], [10, 4], [10, 5], [10, 6], [10, 8], [10, 9], [10, 10], [11, 0], [11, 1], [11, 3], [11, 4], [11, 5], [11, 7], [11, 8], [11, 9], [11, 11], [12, 0], [12, 1], [12, 2], [12, 3], [12, 4], [12, 5], [12, 6], [12, 7], [12, 8], [12, 9], [12, 10], [12, 11], [12, 12], [13, 0], [13, 1], [13, 2], [13, 3], [13, 4], [13, 5], [13, 6], [13, 7], [13, 8], [13, 9], [13, 10], [13, 11], [13, 12], [13, 13], [14, 0], [14, 1], [14, 2], [14, 4], [14, 5], [14, 6], [14, 8], [14, 9], [14, 10], [14, 12], [14, 13], [14, 14], [15, 0], [15, 1], [15, 3], [15, 4], [15, 5], [15, 7], [15, 8], [15, 9], [15, 11], [15, 12], [15, 13], [15, 15], [16, 14], [16, 15], [16, 16], [17, 14], [17, 15], [17, 16], [17, 17], [18, 16], [18, 17], [18, 18], [19, 16], [19, 17], [19, 19]]}
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
    const double v1 = (1.0 / constants[9]);
    const double v2 = (constants[10] * v1);
    const double v3 = (1.0 / constants[15]);
    const double v4 = (constants[11] * v1);
    const double v5 = (1.0 / constants[16]);
    const double v8 = (constants[4] * (constants[3] * constants[7]));
    const double v9 = (constants[0] * (constants[1] * constants[7]));
    const double v10 = (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1));
    const double v14 = (constants[4] * (constants[3] * constants[5]));
    const double v15 = ((constants[13] * constants[13]) * v14);
    const double v17 = (v1 * (constants[13] * v14));
    const double v19 = (1.0 / constants[17]);
    const double v20 = (constants[4] * (constants[5] * constants[7]));
    const double v21 = ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1));
    const double v22 = (v14 * (constants[12] * constants[12]));
    const double v23 = (v1 * (constants[12] * v14));
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
            const double v6 = (constants[10] * local_column[0][i]);
            const double v7 = sin(v6);
            const double v11 = (constants[11] * local_column[1][i]);
            const double v12 = (v6 - v11);
            const double v13 = sin(v12);
            const double v16 = cos(v12);
            const double v18 = (data_column[1][i] - data_column[0][i]);
            const double v24 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v25 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v26 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v27 = sin(v26);
            const double v28 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v29 = (v26 - v28);
            const double v30 = sin(v29);
            const double v31 = cos(v29);
            const double v32 = (constants[10] * local_column[16][i]);
            const double v33 = sin(v32);
            const double v34 = (constants[11] * local_column[17][i]);
            const double v35 = (v32 - v34);
            const double v36 = sin(v35);
            const double v37 = cos(v35);
            value[0][i] = (v0 * ((constants[12] * local_column[2][i]) - (v2 * local_column[4][i])));
            value[1][i] = (v3 * ((constants[13] * local_column[3][i]) - (v4 * local_column[5][i])));
            value[2][i] = (v5 * (((((v18 - (v8 * v7)) - (v9 * v7)) - (v10 * local_column[6][i])) - (v15 * ((local_column[3][i] * local_column[3][i]) * v13))) - (v17 * (local_column[7][i] * v16))));
            value[3][i] = (v19 * (((v22 * (v13 * (local_column[2][i] * local_column[2][i]))) - ((v21 * local_column[7][i]) + (data_column[1][i] + (v20 * sin(v11))))) - (v23 * (local_column[6][i] * v16))));
            value[4][i] = (v0 * ((constants[12] * v24) - (v2 * local_column[8][i])));
            value[5][i] = (v3 * ((constants[13] * v25) - (v4 * local_column[9][i])));
            value[6][i] = (v5 * (((((v18 - (v8 * v27)) - (v9 * v27)) - (v10 * local_column[10][i])) - (v15 * ((v25 * v25) * v30))) - (v17 * (local_column[11][i] * v31))));
            value[7][i] = (v19 * (((v22 * (v30 * (v24 * v24))) - ((v21 * local_column[11][i]) + (data_column[1][i] + (v20 * sin(v28))))) - (v23 * (local_column[10][i] * v31))));
            value[8][i] = (v0 * ((constants[12] * local_column[18][i]) - (v2 * local_column[12][i])));
            value[9][i] = (v3 * ((constants[13] * local_column[19][i]) - (v4 * local_column[13][i])));
            value[10][i] = (v5 * (((((v18 - (v8 * v33)) - (v9 * v33)) - (v10 * local_column[14][i])) - (v15 * ((local_column[19][i] * local_column[19][i]) * v36))) - (v17 * (local_column[15][i] * v37))));
            value[11][i] = (v19 * (((v22 * (v36 * (local_column[18][i] * local_column[18][i]))) - ((v21 * local_column[15][i]) + (data_column[1][i] + (v20 * sin(v34))))) - (v23 * (local_column[14][i] * v37))));
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
    const double v0 = (1.0 / constants[14]);
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[15]);
    const double v3 = (1.0 / constants[16]);
    const double v8 = (constants[4] * (constants[3] * constants[5]));
    const double v10 = (1.0 / constants[17]);
    const double v23 = (constants[12] * v0);
    const double v24 = (constants[13] * v2);
    const double v25 = (v3 * (v1 * (constants[13] * v8)));
    const double v27 = (v3 * ((constants[13] * constants[13]) * v8));
    const double v29 = (v27 + v27);
    const double v30 = ((v3 * (constants[0] * (constants[1] * constants[7]))) + (v3 * (constants[4] * (constants[3] * constants[7]))));
    const double v31 = (v10 * (v1 * (constants[12] * v8)));
    const double v32 = (v10 * (v8 * (constants[12] * constants[12])));
    const double v33 = (v32 + v32);
    const double v34 = (v10 * (constants[4] * (constants[5] * constants[7])));
    const double v39 = ((-0.041666666666666664) * constants[11]);
    const double v40 = (0.20833333333333334 * constants[11]);
    const double v41 = (0.3333333333333333 * constants[11]);
    const double v44 = ((-0.041666666666666664) * constants[10]);
    const double v45 = (0.20833333333333334 * constants[10]);
    const double v46 = (0.3333333333333333 * constants[10]);
    const double v47 = ((-0.041666666666666664) * v29);
    const double v48 = (0.20833333333333334 * v29);
    const double v49 = (0.3333333333333333 * v29);
    const double v53 = ((-0.041666666666666664) * v33);
    const double v54 = (0.20833333333333334 * v33);
    const double v55 = (0.3333333333333333 * v33);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double value[84][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 20; j++) local_column[j][i] = local[k * stride + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[0][i]);
            const double v5 = (constants[11] * local_column[1][i]);
            const double v6 = (v4 - v5);
            const double v7 = sin(v6);
            const double v9 = cos(v6);
            const double v11 = (((-0.041666666666666664) * local_column[14][i]) + ((0.20833333333333334 * local_column[6][i]) + (local_column[2][i] + (0.3333333333333333 * local_column[10][i]))));
            const double v12 = (((-0.041666666666666664) * local_column[15][i]) + ((0.20833333333333334 * local_column[7][i]) + (local_column[3][i] + (0.3333333333333333 * local_column[11][i]))));
            const double v13 = (constants[10] * (((-0.041666666666666664) * local_column[12][i]) + ((0.20833333333333334 * local_column[4][i]) + (local_column[0][i] + (0.3333333333333333 * local_column[8][i])))));
            const double v14 = (constants[11] * (((-0.041666666666666664) * local_column[13][i]) + ((0.20833333333333334 * local_column[5][i]) + (local_column[1][i] + (0.3333333333333333 * local_column[9][i])))));
            const double v15 = (v13 - v14);
            const double v16 = sin(v15);
            const double v17 = cos(v15);
            const double v18 = (constants[10] * local_column[16][i]);
            const double v19 = (constants[11] * local_column[17][i]);
            const double v20 = (v18 - v19);
            const double v21 = sin(v20);
            const double v22 = cos(v20);
            const double v26 = (v25 * (local_column[7][i] * v7));
            const double v28 = (v27 * ((local_column[3][i] * local_column[3][i]) * v9));
            const double v35 = ((v31 * (local_column[6][i] * v7)) + (v32 * (v9 * (local_column[2][i] * local_column[2][i]))));
            const double v36 = (v25 * (local_column[11][i] * v16));
            const double v37 = (v27 * ((v12 * v12) * v17));
            const double v38 = (v37 - v36);
            const double v42 = (v12 * v16);
            const double v43 = ((v36 - v37) - (v30 * cos(v13)));
            const double v50 = (v11 * v16);
            const double v51 = ((v31 * (local_column[10][i] * v16)) + (v32 * (v17 * (v11 * v11))));
            const double v52 = ((v34 * cos(v14)) + v51);
            const double v56 = (v25 * (local_column[15][i] * v21));
            const double v57 = (v27 * ((local_column[19][i] * local_column[19][i]) * v22));
            const double v58 = ((v31 * (local_column[14][i] * v21)) + (v32 * (v22 * (local_column[18][i] * local_column[18][i]))));
            value[0][i] = v23;
            value[1][i] = (-(v0 * (constants[10] * v1)));
            value[2][i] = v24;
            value[3][i] = (-(v2 * (constants[11] * v1)));
            value[4][i] = (constants[10] * ((v26 - v28) - (v30 * cos(v4))));
            value[5][i] = (constants[11] * (v28 - v26));
            value[6][i] = (-(v29 * (local_column[3][i] * v7)));
            value[7][i] = (-(v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))));
            value[8][i] = (-(v25 * v9));
            value[9][i] = (constants[10] * v35);
            value[10][i] = (-(constants[11] * ((v34 * cos(v5)) + v35)));
            value[11][i] = (v33 * (local_column[2][i] * v7));
            value[12][i] = (-(v31 * v9));
            value[13][i] = (-(v10 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))));
            value[14][i] = v23;
            value[15][i] = (0.20833333333333334 * v23);
            value[16][i] = (-(v0 * (constants[10] * v1)));
            value[17][i] = (0.3333333333333333 * v23);
            value[18][i] = ((-0.041666666666666664) * v23);
            value[19][i] = v24;
            value[20][i] = (0.20833333333333334 * v24);
            value[21][i] = (-(v2 * (constants[11] * v1)));
            value[22][i] = (0.3333333333333333 * v24);
            value[23][i] = ((-0.041666666666666664) * v24);
            value[24][i] = (constants[10] * v43);
            value[25][i] = (constants[11] * v38);
            value[26][i] = (-(v29 * v42));
            value[27][i] = (v45 * v43);
            value[28][i] = (v40 * v38);
            value[29][i] = (-(v48 * v42));
            value[30][i] = (v46 * v43);
            value[31][i] = (v41 * v38);
            value[32][i] = (-(v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))));
            value[33][i] = (-((v25 * v17) + (v49 * v42)));
            value[34][i] = (v44 * v43);
            value[35][i] = (v39 * v38);
            value[36][i] = (-(v47 * v42));
            value[37][i] = (constants[10] * v51);
            value[38][i] = (-(constants[11] * v52));
            value[39][i] = (v33 * v50);
            value[40][i] = (v45 * v51);
            value[41][i] = (-(v40 * v52));
            value[42][i] = (v54 * v50);
            value[43][i] = (v46 * v51);
            value[44][i] = (-(v41 * v52));
            value[45][i] = ((v55 * v50) - (v31 * v17));
            value[46][i] = (-(v10 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))));
            value[47][i] = (v44 * v51);
            value[48][i] = (-(v39 * v52));
            value[49][i] = (v53 * v50);
            value[50][i] = (-(v0 * (constants[10] * v1)));
            value[51][i] = v23;
            value[52][i] = (-(v2 * (constants[11] * v1)));
            value[53][i] = v24;
            value[54][i] = (-(v3 * (((constants[4] * (constants[3] * constants[3])) + (constants[2] + (constants[0] * (constants[1] * constants[1])))) * (constants[12] * v1))));
            value[55][i] = (-(v25 * v22));
            value[56][i] = (constants[10] * ((v56 - v57) - (v30 * cos(v18))));
            value[57][i] = (constants[11] * (v57 - v56));
            value[58][i] = (-(v29 * (local_column[19][i] * v21)));
            value[59][i] = (-(v31 * v22));
            value[60][i] = (-(v10 * ((constants[6] + (constants[4] * (constants[5] * constants[5]))) * (constants[13] * v1))));
            value[61][i] = (constants[10] * v58);
            value[62][i] = (-(constants[11] * ((v34 * cos(v19)) + v58)));
            value[63][i] = (v33 * (local_column[18][i] * v21));
            value[64][i] = (-1.0);
            value[65][i] = (-0.16666666666666666);
            value[66][i] = (-0.6666666666666666);
            value[67][i] = (-0.16666666666666666);
            value[68][i] = 1.0;
            value[69][i] = (-1.0);
            value[70][i] = (-0.16666666666666666);
            value[71][i] = (-0.6666666666666666);
            value[72][i] = (-0.16666666666666666);
            value[73][i] = 1.0;
            value[74][i] = (-1.0);
            value[75][i] = (-0.16666666666666666);
            value[76][i] = (-0.6666666666666666);
            value[77][i] = (-0.16666666666666666);
            value[78][i] = 1.0;
            value[79][i] = (-1.0);
            value[80][i] = (-0.16666666666666666);
            value[81][i] = (-0.6666666666666666);
            value[82][i] = (-0.16666666666666666);
            value[83][i] = 1.0;
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 84; j++) out[k * 84 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[16]);
    const double v6 = (constants[4] * (constants[3] * constants[5]));
    const double v8 = (1.0 / constants[17]);
    const double v21 = (v1 * (v0 * (constants[13] * v6)));
    const double v22 = (v1 * ((constants[13] * constants[13]) * v6));
    const double v23 = (v22 + v22);
    const double v24 = (v8 * (v0 * (constants[12] * v6)));
    const double v25 = (v8 * (v6 * (constants[12] * constants[12])));
    const double v26 = (v25 + v25);
    const double v27 = ((-0.041666666666666664) * constants[11]);
    const double v28 = (0.20833333333333334 * constants[11]);
    const double v29 = (0.3333333333333333 * constants[11]);
    const double v30 = ((-0.041666666666666664) * constants[10]);
    const double v31 = (0.20833333333333334 * constants[10]);
    const double v32 = (0.3333333333333333 * constants[10]);
    const double v33 = ((-0.041666666666666664) * v23);
    const double v34 = (0.20833333333333334 * v23);
    const double v35 = (0.3333333333333333 * v23);
    const double v36 = ((-0.041666666666666664) * v26);
    const double v37 = (0.20833333333333334 * v26);
    const double v38 = (0.3333333333333333 * v26);
    const double v47 = (constants[10] * v24);
    const double v49 = (constants[10] * v26);
    const double v50 = (constants[10] * v21);
    const double v54 = (constants[10] * constants[11]);
    const double v55 = ((-0.041666666666666664) * v54);
    const double v56 = (0.20833333333333334 * v54);
    const double v57 = (0.3333333333333333 * v54);
    const double v59 = (constants[10] * v23);
    const double v61 = (constants[10] * ((v1 * (constants[0] * (constants[1] * constants[7]))) + (v1 * (constants[4] * (constants[3] * constants[7])))));
    const double v63 = ((-0.041666666666666664) * v59);
    const double v64 = (0.20833333333333334 * v59);
    const double v65 = (0.3333333333333333 * v59);
    const double v66 = ((-0.041666666666666664) * v49);
    const double v67 = (0.20833333333333334 * v49);
    const double v68 = (0.3333333333333333 * v49);
    const double v70 = (constants[10] * v25);
    const double v76 = (constants[10] * v22);
    const double v78 = (constants[11] * v24);
    const double v79 = (constants[11] * v26);
    const double v81 = (constants[11] * (v8 * (constants[4] * (constants[5] * constants[7]))));
    const double v82 = (constants[11] * v21);
    const double v85 = (constants[11] * v23);
    const double v86 = ((-0.041666666666666664) * v85);
    const double v87 = (0.20833333333333334 * v85);
    const double v88 = (0.3333333333333333 * v85);
    const double v89 = ((-0.041666666666666664) * v79);
    const double v90 = (0.20833333333333334 * v79);
    const double v91 = (0.3333333333333333 * v79);
    const double v92 = (constants[11] * v25);
    const double v94 = (constants[11] * v22);
    const double v97 = ((-0.08333333333333333) * v92);
    const double v98 = (0.4166666666666667 * v92);
    const double v99 = (0.6666666666666666 * v92);
    const double v100 = ((-0.08333333333333333) * v70);
    const double v101 = (0.4166666666666667 * v70);
    const double v102 = (0.6666666666666666 * v70);
    const double v104 = ((-0.08333333333333333) * v94);
    const double v105 = (0.4166666666666667 * v94);
    const double v106 = (0.6666666666666666 * v94);
    const double v107 = ((-0.08333333333333333) * v76);
    const double v108 = (0.4166666666666667 * v76);
    const double v109 = (0.6666666666666666 * v76);
    const double v110 = (0.20833333333333334 * v47);
    const double v111 = (0.20833333333333334 * v50);
    const double v112 = ((-0.008680555555555556) * v54);
    const double v113 = (0.04340277777777778 * v54);
    const double v114 = (0.06944444444444445 * v54);
    const double v115 = (0.20833333333333334 * v61);
    const double v117 = ((-0.008680555555555556) * v59);
    const double v118 = (0.04340277777777778 * v59);
    const double v119 = (0.06944444444444445 * v59);
    const double v120 = ((-0.008680555555555556) * v49);
    const double v121 = (0.04340277777777778 * v49);
    const double v122 = (0.06944444444444445 * v49);
    const double v123 = ((-0.20833333333333334) * constants[11]);
    const double v124 = ((-0.20833333333333334) * v78);
    const double v125 = (0.20833333333333334 * v81);
    const double v126 = ((-0.20833333333333334) * v82);
    const double v128 = (0.008680555555555556 * v54);
    const double v129 = ((-0.06944444444444445) * v54);
    const double v130 = (0.008680555555555556 * v85);
    const double v131 = ((-0.04340277777777778) * v85);
    const double v132 = ((-0.06944444444444445) * v85);
    const double v133 = (0.008680555555555556 * v79);
    const double v134 = ((-0.04340277777777778) * v79);
    const double v135 = ((-0.06944444444444445) * v79);
    const double v136 = ((-0.017361111111111112) * v92);
    const double v137 = (0.1388888888888889 * v92);
    const double v138 = ((-0.017361111111111112) * v70);
    const double v139 = (0.1388888888888889 * v70);
    const double v140 = ((-0.008680555555555556) * v26);
    const double v141 = (0.04340277777777778 * v26);
    const double v142 = (0.06944444444444445 * v26);
    const double v143 = ((-0.017361111111111112) * v94);
    const double v144 = (0.1388888888888889 * v94);
    const double v145 = ((-0.017361111111111112) * v76);
    const double v146 = (0.1388888888888889 * v76);
    const double v147 = ((-0.008680555555555556) * v23);
    const double v148 = (0.04340277777777778 * v23);
    const double v149 = (0.06944444444444445 * v23);
    const double v150 = (0.3333333333333333 * v47);
    const double v151 = (0.3333333333333333 * v50);
    const double v152 = ((-0.013888888888888888) * v54);
    const double v153 = (0.1111111111111111 * v54);
    const double v154 = (0.3333333333333333 * v61);
    const double v156 = ((-0.013888888888888888) * v59);
    const double v157 = (0.1111111111111111 * v59);
    const double v158 = ((-0.013888888888888888) * v49);
    const double v159 = (0.1111111111111111 * v49);
    const double v160 = ((-0.3333333333333333) * constants[11]);
    const double v161 = ((-0.3333333333333333) * v78);
    const double v162 = (0.3333333333333333 * v81);
    const double v163 = ((-0.3333333333333333) * v82);
    const double v165 = (0.013888888888888888 * v54);
    const double v166 = (0.013888888888888888 * v85);
    const double v167 = ((-0.1111111111111111) * v85);
    const double v168 = (0.013888888888888888 * v79);
    const double v169 = ((-0.1111111111111111) * v79);
    const double v170 = (0.6666666666666666 * v25);
    const double v172 = ((-0.013888888888888888) * v26);
    const double v173 = (0.1111111111111111 * v26);
    const double v174 = (0.6666666666666666 * v22);
    const double v176 = ((-0.013888888888888888) * v23);
    const double v177 = (0.1111111111111111 * v23);
    const double v178 = (0.001736111111111111 * v54);
    const double v179 = ((-0.041666666666666664) * v61);
    const double v180 = (0.001736111111111111 * v59);
    const double v181 = (0.001736111111111111 * v49);
    const double v182 = (0.041666666666666664 * constants[11]);
    const double v183 = ((-0.041666666666666664) * v81);
    const double v184 = ((-0.001736111111111111) * v85);
    const double v185 = ((-0.001736111111111111) * v79);
    const double v186 = (0.001736111111111111 * v26);
    const double v187 = (0.001736111111111111 * v23);
    const double v189 = (v70 + v70);
    const double v194 = (v76 + v76);
    const double v195 = (v92 + v92);
    const double v196 = (v94 + v94);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[20][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[16][BLOCK] __attribute__((aligned(64)));
        double value[133][BLOCK] __attribute__((aligned(64)));
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
            const double v39 = (v19 * multipliers_column[11][i]);
            const double v40 = (v19 * multipliers_column[10][i]);
            const double v41 = (v14 * multipliers_column[7][i]);
            const double v42 = (v14 * multipliers_column[6][i]);
            const double v43 = (v5 * multipliers_column[3][i]);
            const double v44 = (v25 * v43);
            const double v45 = (v5 * multipliers_column[2][i]);
            const double v46 = (v22 * v45);
            const double v48 = (v9 * (v15 * multipliers_column[7][i]));
            const double v51 = (v15 * ((v24 * (local_column[10][i] * multipliers_column[7][i])) + (v21 * (local_column[11][i] * multipliers_column[6][i]))));
            const double v52 = (v14 * ((v25 * ((v9 * v9) * multipliers_column[7][i])) - (v22 * ((v10 * v10) * multipliers_column[6][i]))));
            const double v53 = (v51 - v52);
            const double v58 = (v10 * (v15 * multipliers_column[6][i]));
            const double v60 = (sin(v11) * multipliers_column[6][i]);
            const double v62 = ((constants[10] * v53) + (v61 * v60));
            const double v69 = (local_column[2][i] * (v7 * multipliers_column[3][i]));
            const double v71 = (v70 * v69);
            const double v72 = (v7 * ((v24 * (local_column[6][i] * multipliers_column[3][i])) + (v21 * (local_column[7][i] * multipliers_column[2][i]))));
            const double v73 = (v5 * ((v25 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) - (v22 * ((local_column[3][i] * local_column[3][i]) * multipliers_column[2][i]))));
            const double v74 = (v72 - v73);
            const double v75 = (local_column[3][i] * (v7 * multipliers_column[2][i]));
            const double v77 = (v76 * v75);
            const double v80 = (sin(v12) * multipliers_column[7][i]);
            const double v83 = (v52 - v51);
            const double v84 = ((constants[11] * v83) - (v81 * v80));
            const double v93 = (v92 * v69);
            const double v95 = (v94 * v75);
            const double v96 = (v15 * (v9 * multipliers_column[7][i]));
            const double v103 = (v15 * (v10 * multipliers_column[6][i]));
            const double v116 = ((v31 * v53) + (v115 * v60));
            const double v127 = ((v123 * v53) - (v125 * v80));
            const double v155 = ((v32 * v53) + (v154 * v60));
            const double v164 = ((v160 * v53) - (v162 * v80));
            const double v171 = ((v24 * v41) + (v170 * v96));
            const double v175 = ((v21 * v42) - (v174 * v103));
            const double v188 = (local_column[18][i] * (v20 * multipliers_column[11][i]));
            const double v190 = (v20 * ((v24 * (local_column[14][i] * multipliers_column[11][i])) + (v21 * (local_column[15][i] * multipliers_column[10][i]))));
            const double v191 = (v19 * ((v25 * ((local_column[18][i] * local_column[18][i]) * multipliers_column[11][i])) - (v22 * ((local_column[19][i] * local_column[19][i]) * multipliers_column[10][i]))));
            const double v192 = (v190 - v191);
            const double v193 = (local_column[19][i] * (v20 * multipliers_column[10][i]));
            value[0][i] = (constants[10] * (v62 + ((constants[10] * v74) + (v61 * (sin(v2) * multipliers_column[2][i])))));
            value[1][i] = (-(v54 * (v53 + v74)));
            value[2][i] = (-(constants[11] * (v84 + ((constants[11] * (v73 - v72)) - (v81 * (sin(v3) * multipliers_column[3][i]))))));
            value[3][i] = (v71 + ((v49 * v48) + v71));
            value[4][i] = (-(v93 + ((v79 * v48) + v93)));
            value[5][i] = (v44 + (v44 + (v26 * v41)));
            value[6][i] = (-(v77 + ((v59 * v58) + v77)));
            value[7][i] = (v95 + ((v85 * v58) + v95));
            value[8][i] = (-(v46 + (v46 + (v23 * v42))));
            value[9][i] = (v31 * v62);
            value[10][i] = (v56 * v83);
            value[11][i] = (v101 * v96);
            value[12][i] = (-(v108 * v103));
            value[13][i] = (v31 * v116);
            value[14][i] = (-(v56 * v53));
            value[15][i] = (-(v28 * v84));
            value[16][i] = (-(v98 * v96));
            value[17][i] = (v105 * v103);
            value[18][i] = (-(v113 * v53));
            value[19][i] = (-(v28 * v127));
            value[20][i] = ((v67 * v48) + (v47 * v43));
            value[21][i] = (-((v90 * v48) + (v78 * v43)));
            value[22][i] = (v37 * v41);
            value[23][i] = (v121 * v48);
            value[24][i] = (v134 * v48);
            value[25][i] = (v141 * v41);
            value[26][i] = ((v50 * v45) - (v64 * v58));
            value[27][i] = ((v87 * v58) - (v82 * v45));
            value[28][i] = (-(v34 * v42));
            value[29][i] = (-(v118 * v58));
            value[30][i] = (-(v131 * v58));
            value[31][i] = (-(v148 * v42));
            value[32][i] = (v32 * v62);
            value[33][i] = (v57 * v83);
            value[34][i] = (v102 * v96);
            value[35][i] = (-(v109 * v103));
            value[36][i] = (v32 * v116);
            value[37][i] = (v129 * v53);
            value[38][i] = (v139 * v96);
            value[39][i] = (-(v146 * v103));
            value[40][i] = (v32 * v155);
            value[41][i] = (-(v57 * v53));
            value[42][i] = (-(v29 * v84));
            value[43][i] = (-(v99 * v96));
            value[44][i] = (v106 * v103);
            value[45][i] = (-(v114 * v53));
            value[46][i] = (-(v29 * v127));
            value[47][i] = (-(v137 * v96));
            value[48][i] = (v144 * v103);
            value[49][i] = (-(v153 * v53));
            value[50][i] = (-(v29 * v164));
            value[51][i] = ((v47 * v41) + (v68 * v48));
            value[52][i] = (-((v78 * v41) + (v91 * v48)));
            value[53][i] = (v38 * v41);
            value[54][i] = ((v110 * v41) + (v122 * v48));
            value[55][i] = ((v124 * v41) + (v135 * v48));
            value[56][i] = (v142 * v41);
            value[57][i] = ((v150 * v41) + (v159 * v48));
            value[58][i] = ((v161 * v41) + (v169 * v48));
            value[59][i] = (v173 * v41);
            value[60][i] = ((v50 * v42) - (v65 * v58));
            value[61][i] = ((v88 * v58) - (v82 * v42));
            value[62][i] = (-(v35 * v42));
            value[63][i] = ((v111 * v42) - (v119 * v58));
            value[64][i] = ((v126 * v42) - (v132 * v58));
            value[65][i] = (-(v149 * v42));
            value[66][i] = ((v151 * v42) - (v157 * v58));
            value[67][i] = ((v163 * v42) - (v167 * v58));
            value[68][i] = (-(v177 * v42));
            value[69][i] = (v30 * v62);
            value[70][i] = (v55 * v83);
            value[71][i] = (v100 * v96);
            value[72][i] = (-(v107 * v103));
            value[73][i] = (v30 * v116);
            value[74][i] = (v128 * v53);
            value[75][i] = (v138 * v96);
            value[76][i] = (-(v145 * v103));
            value[77][i] = (v30 * v155);
            value[78][i] = (v165 * v53);
            value[79][i] = (v30 * v171);
            value[80][i] = (v30 * v175);
            value[81][i] = (v30 * ((v30 * v53) + (v179 * v60)));
            value[82][i] = (-(v55 * v53));
            value[83][i] = (-(v27 * v84));
            value[84][i] = (-(v97 * v96));
            value[85][i] = (v104 * v103);
            value[86][i] = (-(v112 * v53));
            value[87][i] = (-(v27 * v127));
            value[88][i] = (-(v136 * v96));
            value[89][i] = (v143 * v103);
            value[90][i] = (-(v152 * v53));
            value[91][i] = (-(v27 * v164));
            value[92][i] = (-(v27 * v171));
            value[93][i] = (-(v27 * v175));
            value[94][i] = (-(v178 * v53));
            value[95][i] = (-(v27 * ((v182 * v53) - (v183 * v80))));
            value[96][i] = (v66 * v48);
            value[97][i] = (-(v89 * v48));
            value[98][i] = (v36 * v41);
            value[99][i] = (v120 * v48);
            value[100][i] = (v133 * v48);
            value[101][i] = (v140 * v41);
            value[102][i] = (v158 * v48);
            value[103][i] = (v168 * v48);
            value[104][i] = (v172 * v41);
            value[105][i] = (v181 * v48);
            value[106][i] = (v185 * v48);
            value[107][i] = (v186 * v41);
            value[108][i] = (-(v63 * v58));
            value[109][i] = (v86 * v58);
            value[110][i] = (-(v33 * v42));
            value[111][i] = (-(v117 * v58));
            value[112][i] = (-(v130 * v58));
            value[113][i] = (-(v147 * v42));
            value[114][i] = (-(v156 * v58));
            value[115][i] = (-(v166 * v58));
            value[116][i] = (-(v176 * v42));
            value[117][i] = (-(v180 * v58));
            value[118][i] = (-(v184 * v58));
            value[119][i] = (-(v187 * v42));
            value[120][i] = (v47 * v39);
            value[121][i] = (v50 * v40);
            value[122][i] = (constants[10] * ((constants[10] * v192) + (v61 * (sin(v16) * multipliers_column[10][i]))));
            value[123][i] = (-(v78 * v39));
            value[124][i] = (-(v82 * v40));
            value[125][i] = (-(v54 * v192));
            value[126][i] = (-(constants[11] * ((constants[11] * (v191 - v190)) - (v81 * (sin(v17) * multipliers_column[11][i])))));
            value[127][i] = (v189 * v188);
            value[128][i] = (-(v195 * v188));
            value[129][i] = (v26 * v39);
            value[130][i] = (-(v194 * v193));
            value[131][i] = (v196 * v193);
            value[132][i] = (-(v23 * v40));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 133; j++) out[index[k * 133 + j]] += value[j][i];
        }
    }
}
