// 281ab4cfbdc7ae695b291ab48bd6b9d7
// {"name": "standing on a moving platform, PD interval", "m": 4, "n_local": 8, "n_shared": 6, "n_data": 3, "n_constants": 24, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 12], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 10], [3, 11], [3, 13]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 0], [4, 1], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 2], [6, 3], [6, 5], [6, 6], [7, 1], [7, 2], [7, 3], [7, 5], [7, 6], [7, 7], [8, 0], [8, 4], [9, 2], [9, 6], [10, 1], [10, 5], [11, 3], [11, 7], [12, 8], [13, 10]]}
// local[0]: ankle_angle#0
// local[1]: hip_angle#0
// local[2]: ankle_velocity#0
// local[3]: hip_velocity#0
// local[4]: ankle_angle#1
// local[5]: hip_angle#1
// local[6]: ankle_velocity#1
// local[7]: hip_velocity#1
// shared[0]: kp_ankle
// shared[1]: kd_ankle
// shared[2]: kp_hip
// shared[3]: kd_hip
// shared[4]: ref_ankle
// shared[5]: ref_hip
// data[0]: platform_acceleration#0
// data[1]: ankle_torque_noise
// data[2]: hip_torque_noise
// constants[0]: leg_mass
// constants[1]: leg_com
// constants[2]: leg_inertia
// constants[3]: leg_length
// constants[4]: trunk_mass
// constants[5]: trunk_com
// constants[6]: trunk_inertia
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: step h
// constants[10]: scale ankle_angle
// constants[11]: scale hip_angle
// constants[12]: scale ankle_velocity
// constants[13]: scale hip_velocity
// constants[14]: scale kp_ankle
// constants[15]: scale kd_ankle
// constants[16]: scale kp_hip
// constants[17]: scale kd_hip
// constants[18]: scale ref_ankle
// constants[19]: scale ref_hip
// constants[20]: scale ankle_kinematics
// constants[21]: scale hip_kinematics
// constants[22]: scale ankle_balance
// constants[23]: scale hip_balance
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
    const double v0 = (1.0 / constants[20]);
    const double v2 = (0.5 * constants[12]);
    const double v3 = (1.0 / constants[9]);
    const double v4 = (constants[10] * v3);
    const double v5 = (1.0 / constants[21]);
    const double v7 = (0.5 * constants[13]);
    const double v9 = (constants[11] * v3);
    const double v10 = (1.0 / constants[22]);
    const double v11 = (0.5 * constants[10]);
    const double v15 = (constants[1] * constants[7]);
    const double v16 = (0.5 * constants[11]);
    const double v21 = (shared[4] * constants[18]);
    const double v22 = (shared[0] * constants[14]);
    const double v23 = (0.5 * (constants[15] * (shared[1] * constants[12])));
    const double v25 = (constants[4] * (constants[5] * constants[5]));
    const double v27 = (constants[4] * (constants[3] * constants[5]));
    const double v28 = (2.0 * v27);
    const double v29 = (v25 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v30 = (constants[12] * v3);
    const double v32 = (constants[6] + v25);
    const double v34 = (constants[13] * v3);
    const double v36 = (0.5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v37 = (1.0 / constants[23]);
    const double v38 = (constants[5] * constants[7]);
    const double v39 = (shared[5] * constants[19]);
    const double v40 = (shared[2] * constants[16]);
    const double v41 = (0.5 * (constants[17] * (shared[3] * constants[13])));
    const double v42 = (v32 * v34);
    const double v43 = (0.25 * (v27 * (constants[12] * constants[12])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (local_column[2][i] + local_column[6][i]);
            const double v6 = (local_column[3][i] + local_column[7][i]);
            const double v8 = (v7 * v6);
            const double v12 = (v11 * (local_column[0][i] + local_column[4][i]));
            const double v13 = cos(v12);
            const double v14 = sin(v12);
            const double v17 = (v16 * (local_column[1][i] + local_column[5][i]));
            const double v18 = (v12 + v17);
            const double v19 = sin(v18);
            const double v20 = cos(v18);
            const double v24 = (local_column[6][i] - local_column[2][i]);
            const double v26 = cos(v17);
            const double v31 = (local_column[7][i] - local_column[3][i]);
            const double v33 = (v32 + (v27 * v26));
            const double v35 = sin(v17);
            value[0][i] = (v0 * ((v2 * v1) - (v4 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v5 * (v8 - (v9 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v10 * ((v36 * (v35 * (v6 * (v8 + (constants[12] * v1))))) - ((v34 * (v31 * v33)) + ((v30 * (v24 * (v29 + (v28 * v26)))) + ((v23 * v1) + ((v22 * (v12 - v21)) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v13) + (constants[5] * v20))) - (constants[7] * ((constants[3] * v14) + (constants[5] * v19))))) + (data_column[1][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v13)) - (v15 * v14)))))))))));
            value[3][i] = (-(v37 * ((v43 * (v35 * (v1 * v1))) + ((v42 * v31) + ((v30 * (v24 * v33)) + ((v41 * v6) + ((v40 * (v17 - v39)) + (data_column[2][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v20)) - (v38 * v19)))))))))));
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
    const double v0 = (1.0 / constants[20]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (1.0 / constants[21]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (1.0 / constants[22]);
    const double v7 = (0.5 * constants[10]);
    const double v9 = (0.5 * constants[11]);
    const double v13 = (shared[4] * constants[18]);
    const double v15 = (constants[4] * (constants[5] * constants[5]));
    const double v17 = (constants[4] * (constants[3] * constants[5]));
    const double v18 = (2.0 * v17);
    const double v19 = (v15 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v20 = (constants[12] * v2);
    const double v21 = (constants[6] + v15);
    const double v23 = (constants[13] * v2);
    const double v26 = (1.0 / constants[23]);
    const double v27 = (shared[5] * constants[19]);
    const double v28 = (v6 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v29 = (0.5 * v28);
    const double v31 = (0.5 * (constants[12] * v28));
    const double v32 = (v6 * v23);
    const double v34 = (v17 * v32);
    const double v35 = (v6 * v20);
    const double v37 = (2.0 * (v17 * v35));
    const double v38 = ((-0.5) * (v6 * (constants[15] * (shared[1] * constants[12]))));
    const double v40 = (0.5 * (constants[12] * (constants[15] * v6)));
    const double v41 = (v6 * (shared[0] * constants[14]));
    const double v42 = (constants[14] * v6);
    const double v43 = (constants[4] * v6);
    const double v44 = (constants[5] * v43);
    const double v46 = (constants[7] * v43);
    const double v47 = (constants[5] * v46);
    const double v49 = (constants[0] * v6);
    const double v50 = ((constants[3] * v46) + ((constants[1] * constants[7]) * v49));
    const double v51 = ((constants[3] * v43) + (constants[1] * v49));
    const double v52 = (0.25 * (constants[13] * v28));
    const double v54 = ((-0.25) * (v26 * (v17 * (constants[12] * constants[12]))));
    const double v55 = (v54 + v54);
    const double v57 = (v26 * (v21 * v23));
    const double v58 = (v20 * v26);
    const double v60 = ((-0.5) * (v26 * (constants[17] * (shared[3] * constants[13]))));
    const double v61 = (0.5 * (constants[13] * (constants[17] * v26)));
    const double v62 = (v26 * (shared[2] * constants[16]));
    const double v63 = (constants[16] * v26);
    const double v64 = (constants[4] * v26);
    const double v65 = ((constants[5] * constants[7]) * v64);
    const double v66 = (constants[5] * v64);
    const double v67 = (v17 * v58);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[30][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v1 = (local_column[2][i] + local_column[6][i]);
            const double v4 = (local_column[3][i] + local_column[7][i]);
            const double v8 = (v7 * (local_column[0][i] + local_column[4][i]));
            const double v10 = (v9 * (local_column[1][i] + local_column[5][i]));
            const double v11 = (v8 + v10);
            const double v12 = cos(v11);
            const double v14 = (local_column[6][i] - local_column[2][i]);
            const double v16 = cos(v10);
            const double v22 = (v21 + (v17 * v16));
            const double v24 = ((v5 * v4) + (constants[12] * v1));
            const double v25 = sin(v10);
            const double v30 = (v4 * v25);
            const double v33 = (v32 * v22);
            const double v36 = (v35 * (v19 + (v18 * v16)));
            const double v39 = (v38 + (v31 * v30));
            const double v45 = (data_column[0][i] * sin(v11));
            const double v48 = ((v44 * v45) + (v47 * v12));
            const double v53 = ((v29 * (v24 * v25)) + (v52 * v30));
            const double v56 = (v55 * (v1 * v25));
            const double v59 = (v58 * v22);
            const double v68 = ((v66 * v45) + (v65 * v12));
            value[0][i] = (v0 * (constants[10] * v2));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v2)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v3 * (constants[11] * v2));
            value[5][i] = (0.5 * (constants[13] * v3));
            value[6][i] = (-(v3 * (constants[11] * v2)));
            value[7][i] = (0.5 * (constants[13] * v3));
            value[8][i] = (v7 * (((v48 - v41) + (v50 * cos(v8))) + (v51 * (data_column[0][i] * sin(v8)))));
            value[9][i] = (v9 * (((v29 * (v16 * (v4 * v24))) + (v25 * ((v34 * (local_column[7][i] - local_column[3][i])) + (v37 * v14)))) + v48));
            value[10][i] = (v36 + v39);
            value[11][i] = (v33 + v53);
            value[12][i] = (v7 * (((v48 - v41) + (v50 * cos(v8))) + (v51 * (data_column[0][i] * sin(v8)))));
            value[13][i] = (v9 * (((v29 * (v16 * (v4 * v24))) + (v25 * ((v34 * (local_column[7][i] - local_column[3][i])) + (v37 * v14)))) + v48));
            value[14][i] = (v39 - v36);
            value[15][i] = (v53 - v33);
            value[16][i] = (-(v42 * (v8 - v13)));
            value[17][i] = (-(v40 * v1));
            value[18][i] = (constants[18] * v41);
            value[19][i] = (v7 * v68);
            value[20][i] = (v9 * ((((v54 * (v16 * (v1 * v1))) - v62) + (v67 * (v14 * v25))) + v68));
            value[21][i] = (v56 + v59);
            value[22][i] = (v57 + v60);
            value[23][i] = (v7 * v68);
            value[24][i] = (v9 * ((((v54 * (v16 * (v1 * v1))) - v62) + (v67 * (v14 * v25))) + v68));
            value[25][i] = (v56 - v59);
            value[26][i] = (v60 - v57);
            value[27][i] = (-(v63 * (v10 - v27)));
            value[28][i] = (-(v61 * v4));
            value[29][i] = (constants[19] * v62);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 30; j++) out[k * 30 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v1 = (1.0 / constants[9]);
    const double v3 = (0.5 * constants[13]);
    const double v5 = (1.0 / constants[22]);
    const double v6 = (0.5 * constants[10]);
    const double v8 = (0.5 * constants[11]);
    const double v13 = (constants[4] * (constants[3] * constants[5]));
    const double v14 = (constants[12] * v1);
    const double v17 = (1.0 / constants[23]);
    const double v18 = (v5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v19 = (0.5 * v18);
    const double v20 = (constants[12] * v18);
    const double v21 = (0.5 * v20);
    const double v22 = (v5 * (constants[13] * v1));
    const double v23 = (v13 * v22);
    const double v24 = (v5 * v14);
    const double v25 = (2.0 * (v13 * v24));
    const double v26 = (0.5 * (constants[12] * (constants[15] * v5)));
    const double v27 = (constants[14] * v5);
    const double v28 = (constants[4] * v5);
    const double v29 = (constants[5] * v28);
    const double v30 = (constants[7] * v28);
    const double v31 = (constants[5] * v30);
    const double v32 = (constants[0] * v5);
    const double v33 = (0.25 * (constants[13] * v18));
    const double v34 = (v17 * (v13 * (constants[12] * constants[12])));
    const double v35 = (0.25 * v34);
    const double v36 = (v14 * v17);
    const double v37 = (0.5 * (constants[13] * (constants[17] * v17)));
    const double v38 = (constants[16] * v17);
    const double v39 = (constants[4] * v17);
    const double v40 = ((constants[5] * constants[7]) * v39);
    const double v41 = (constants[5] * v39);
    const double v42 = (v13 * v36);
    const double v44 = (v35 + v35);
    const double v47 = (0.5 * (constants[10] * v27));
    const double v49 = (0.25 * (constants[10] * constants[11]));
    const double v50 = (0.5 * (constants[10] * ((constants[3] * v30) + ((constants[1] * constants[7]) * v32))));
    const double v51 = (0.5 * (constants[10] * ((constants[3] * v28) + (constants[1] * v32))));
    const double v52 = (constants[11] * v13);
    const double v53 = (0.5 * (constants[11] * v44));
    const double v54 = (0.5 * (v36 * v52));
    const double v55 = (0.5 * (constants[11] * v38));
    const double v57 = (constants[11] * v18);
    const double v58 = (0.25 * v57);
    const double v60 = (0.25 * (constants[11] * v20));
    const double v62 = (0.5 * (v22 * v52));
    const double v64 = (v24 * v52);
    const double v66 = (0.25 * (constants[11] * constants[11]));
    const double v67 = (0.125 * (constants[13] * v57));
    const double v69 = (0.5 * v34);
    const double v70 = (v33 + v33);
    const double v71 = (constants[18] * v27);
    const double v72 = (constants[19] * v38);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[38][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 3; j++) data_column[j][i] = data[k * 3 + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v0 = (local_column[2][i] + local_column[6][i]);
            const double v2 = (local_column[3][i] + local_column[7][i]);
            const double v4 = (v3 * v2);
            const double v7 = (v6 * (local_column[0][i] + local_column[4][i]));
            const double v9 = (v8 * (local_column[1][i] + local_column[5][i]));
            const double v10 = (v7 + v9);
            const double v11 = (local_column[6][i] - local_column[2][i]);
            const double v12 = cos(v9);
            const double v15 = (v4 + (constants[12] * v0));
            const double v16 = sin(v9);
            const double v43 = (v16 * multipliers_column[3][i]);
            const double v45 = (v16 * multipliers_column[2][i]);
            const double v46 = (data_column[0][i] * multipliers_column[2][i]);
            const double v48 = ((cos(v10) * ((v41 * (data_column[0][i] * multipliers_column[3][i])) + (v29 * v46))) - (sin(v10) * ((v40 * multipliers_column[3][i]) + (v31 * multipliers_column[2][i]))));
            const double v56 = (v12 * multipliers_column[2][i]);
            const double v59 = (v2 * v56);
            const double v61 = ((v60 * v59) - (v53 * (v0 * (v12 * multipliers_column[3][i]))));
            const double v63 = (v62 * v45);
            const double v65 = ((v54 * v43) + (v64 * v45));
            const double v68 = ((v58 * (v15 * v56)) + (v67 * v59));
            value[0][i] = (v6 * (((v6 * v48) - (v50 * (sin(v7) * multipliers_column[2][i]))) + (v51 * (cos(v7) * v46))));
            value[1][i] = (v49 * v48);
            value[2][i] = (v66 * (v48 + ((v12 * ((v13 * ((v36 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v35 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[3][i] = (v61 - v65);
            value[4][i] = (-(v44 * v43));
            value[5][i] = (v68 - v63);
            value[6][i] = (v21 * v45);
            value[7][i] = (v70 * v45);
            value[8][i] = (v6 * (((v6 * v48) - (v50 * (sin(v7) * multipliers_column[2][i]))) + (v51 * (cos(v7) * v46))));
            value[9][i] = (v49 * v48);
            value[10][i] = (v6 * (((v6 * v48) - (v50 * (sin(v7) * multipliers_column[2][i]))) + (v51 * (cos(v7) * v46))));
            value[11][i] = (v49 * v48);
            value[12][i] = (v66 * (v48 + ((v12 * ((v13 * ((v36 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v35 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[13][i] = (v8 * ((v12 * ((v21 * (v2 * multipliers_column[2][i])) - (v69 * (v0 * multipliers_column[3][i])))) - (v16 * ((v42 * multipliers_column[3][i]) + (v25 * multipliers_column[2][i])))));
            value[14][i] = (v8 * ((v19 * (v12 * (multipliers_column[2][i] * (v4 + v15)))) - (v23 * v45)));
            value[15][i] = (v49 * v48);
            value[16][i] = (v66 * (v48 + ((v12 * ((v13 * ((v36 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v35 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[17][i] = (v61 + v65);
            value[18][i] = (-(v44 * v43));
            value[19][i] = (v21 * v45);
            value[20][i] = (v61 + v65);
            value[21][i] = (-(v44 * v43));
            value[22][i] = (v63 + v68);
            value[23][i] = (v21 * v45);
            value[24][i] = (v70 * v45);
            value[25][i] = (v63 + v68);
            value[26][i] = (v21 * v45);
            value[27][i] = (v70 * v45);
            value[28][i] = (-(v47 * multipliers_column[2][i]));
            value[29][i] = (-(v47 * multipliers_column[2][i]));
            value[30][i] = (-(v26 * multipliers_column[2][i]));
            value[31][i] = (-(v26 * multipliers_column[2][i]));
            value[32][i] = (-(v55 * multipliers_column[3][i]));
            value[33][i] = (-(v55 * multipliers_column[3][i]));
            value[34][i] = (-(v37 * multipliers_column[3][i]));
            value[35][i] = (-(v37 * multipliers_column[3][i]));
            value[36][i] = (v71 * multipliers_column[2][i]);
            value[37][i] = (v72 * multipliers_column[3][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 38; j++) out[index[k * 38 + j]] += value[j][i];
        }
    }
}
