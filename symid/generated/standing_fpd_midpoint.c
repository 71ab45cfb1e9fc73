// e244a497c5877d304ac7269904ef1f38
// {"name": "standing on a moving platform, FullStatePD interval", "m": 4, "n_local": 8, "n_shared": 10, "n_data": 3, "n_constants": 28, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 10], [2, 11], [2, 16], [2, 17], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 12], [3, 13], [3, 14], [3, 15], [3, 16], [3, 17]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 0], [4, 1], [4, 4], [5, 0], [5, 1], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 2], [6, 3], [6, 5], [6, 6], [7, 1], [7, 2], [7, 3], [7, 5], [7, 6], [7, 7], [8, 0], [8, 4], [9, 1], [9, 5], [10, 2], [10, 6], [11, 3], [11, 7], [12, 0], [12, 4], [13, 1], [13, 5], [14, 2], [14, 6], [15, 3], [15, 7], [16, 8], [16, 12], [17, 9], [17, 13]]}
// local[0]: ankle_angle#0
// local[1]: hip_angle#0
// local[2]: ankle_velocity#0
// local[3]: hip_velocity#0
// local[4]: ankle_angle#1
// local[5]: hip_angle#1
// local[6]: ankle_velocity#1
// local[7]: hip_velocity#1
// shared[0]: kp_aa
// shared[1]: kp_ah
// shared[2]: kd_aa
// shared[3]: kd_ah
// shared[4]: kp_ha
// shared[5]: kp_hh
// shared[6]: kd_ha
// shared[7]: kd_hh
// shared[8]: ref_ankle
// shared[9]: ref_hip
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
// constants[14]: scale kp_aa
// constants[15]: scale kp_ah
// constants[16]: scale kd_aa
// constants[17]: scale kd_ah
// constants[18]: scale kp_ha
// constants[19]: scale kp_hh
// constants[20]: scale kd_ha
// constants[21]: scale kd_hh
// constants[22]: scale ref_ankle
// constants[23]: scale ref_hip
// constants[24]: scale ankle_kinematics
// constants[25]: scale hip_kinematics
// constants[26]: scale ankle_balance
// constants[27]: scale hip_balance
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
    const double v0 = (1.0 / constants[24]);
    const double v2 = (0.5 * constants[12]);
    const double v3 = (1.0 / constants[9]);
    const double v4 = (constants[10] * v3);
    const double v5 = (1.0 / constants[25]);
    const double v7 = (0.5 * constants[13]);
    const double v9 = (constants[11] * v3);
    const double v10 = (1.0 / constants[26]);
    const double v11 = (0.5 * constants[10]);
    const double v15 = (constants[1] * constants[7]);
    const double v16 = (0.5 * constants[11]);
    const double v21 = (shared[8] * constants[22]);
    const double v23 = (shared[0] * constants[14]);
    const double v24 = (shared[9] * constants[23]);
    const double v26 = (shared[1] * constants[15]);
    const double v27 = (0.5 * (constants[16] * (shared[2] * constants[12])));
    const double v28 = (0.5 * (constants[17] * (shared[3] * constants[13])));
    const double v30 = (constants[4] * (constants[5] * constants[5]));
    const double v32 = (constants[4] * (constants[3] * constants[5]));
    const double v33 = (2.0 * v32);
    const double v34 = (v30 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v35 = (constants[12] * v3);
    const double v37 = (constants[6] + v30);
    const double v39 = (constants[13] * v3);
    const double v41 = (0.5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v42 = (1.0 / constants[27]);
    const double v43 = (constants[5] * constants[7]);
    const double v44 = (shared[4] * constants[18]);
    const double v45 = (shared[5] * constants[19]);
    const double v46 = (0.5 * (constants[20] * (shared[6] * constants[12])));
    const double v47 = (0.5 * (constants[21] * (shared[7] * constants[13])));
    const double v48 = (v37 * v39);
    const double v49 = (0.25 * (v32 * (constants[12] * constants[12])));
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
            const double v22 = (v12 - v21);
            const double v25 = (v17 - v24);
            const double v29 = (local_column[6][i] - local_column[2][i]);
            const double v31 = cos(v17);
            const double v36 = (local_column[7][i] - local_column[3][i]);
            const double v38 = (v37 + (v32 * v31));
            const double v40 = sin(v17);
            value[0][i] = (v0 * ((v2 * v1) - (v4 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v5 * (v8 - (v9 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v10 * ((v41 * (v40 * (v6 * (v8 + (constants[12] * v1))))) - ((v39 * (v36 * v38)) + ((v35 * (v29 * (v34 + (v33 * v31)))) + ((v28 * v6) + ((v27 * v1) + ((v26 * v25) + ((v23 * v22) + ((constants[4] * ((data_column[0][i] * ((constants[3] * v13) + (constants[5] * v20))) - (constants[7] * ((constants[3] * v14) + (constants[5] * v19))))) + (data_column[1][i] + (constants[0] * ((constants[1] * (data_column[0][i] * v13)) - (v15 * v14)))))))))))));
            value[3][i] = (-(v42 * ((v49 * (v40 * (v1 * v1))) + ((v48 * v36) + ((v35 * (v29 * v38)) + ((v47 * v6) + ((v46 * v1) + ((v45 * v25) + ((v44 * v22) + (data_column[2][i] + (constants[4] * ((constants[5] * (data_column[0][i] * v20)) - (v43 * v19)))))))))))));
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
    const double v0 = (1.0 / constants[24]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (1.0 / constants[25]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (1.0 / constants[26]);
    const double v7 = (0.5 * constants[10]);
    const double v9 = (0.5 * constants[11]);
    const double v13 = (shared[8] * constants[22]);
    const double v15 = (shared[9] * constants[23]);
    const double v18 = (constants[4] * (constants[5] * constants[5]));
    const double v20 = (constants[4] * (constants[3] * constants[5]));
    const double v21 = (2.0 * v20);
    const double v22 = (v18 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v23 = (constants[12] * v2);
    const double v24 = (constants[6] + v18);
    const double v26 = (constants[13] * v2);
    const double v29 = (1.0 / constants[27]);
    const double v30 = (v6 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v31 = (0.5 * v30);
    const double v33 = (0.5 * (constants[12] * v30));
    const double v34 = (v6 * v26);
    const double v36 = (v20 * v34);
    const double v37 = (v6 * v23);
    const double v39 = (2.0 * (v20 * v37));
    const double v40 = ((-0.5) * (v6 * (constants[17] * (shared[3] * constants[13]))));
    const double v41 = (0.5 * (constants[13] * (constants[17] * v6)));
    const double v42 = ((-0.5) * (v6 * (constants[16] * (shared[2] * constants[12]))));
    const double v44 = (0.5 * (constants[12] * (constants[16] * v6)));
    const double v45 = (v6 * (shared[1] * constants[15]));
    const double v46 = (constants[15] * v6);
    const double v47 = (v6 * (shared[0] * constants[14]));
    const double v48 = (constants[14] * v6);
    const double v49 = (constants[4] * v6);
    const double v50 = (constants[5] * v49);
    const double v52 = (constants[7] * v49);
    const double v53 = (constants[5] * v52);
    const double v55 = (constants[0] * v6);
    const double v56 = ((constants[3] * v52) + ((constants[1] * constants[7]) * v55));
    const double v57 = ((constants[3] * v49) + (constants[1] * v55));
    const double v58 = (0.25 * (constants[13] * v30));
    const double v60 = ((-0.25) * (v29 * (v20 * (constants[12] * constants[12]))));
    const double v61 = (v60 + v60);
    const double v62 = (v29 * (v24 * v26));
    const double v63 = (v23 * v29);
    const double v65 = ((-0.5) * (v29 * (constants[21] * (shared[7] * constants[13]))));
    const double v66 = (0.5 * (constants[13] * (constants[21] * v29)));
    const double v67 = ((-0.5) * (v29 * (constants[20] * (shared[6] * constants[12]))));
    const double v69 = (0.5 * (constants[12] * (constants[20] * v29)));
    const double v70 = (v29 * (shared[5] * constants[19]));
    const double v71 = (constants[19] * v29);
    const double v72 = (v29 * (shared[4] * constants[18]));
    const double v73 = (constants[18] * v29);
    const double v74 = (constants[4] * v29);
    const double v75 = ((constants[5] * constants[7]) * v74);
    const double v76 = (constants[5] * v74);
    const double v77 = (v20 * v63);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double value[36][BLOCK] __attribute__((aligned(64)));
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
            const double v14 = (v8 - v13);
            const double v16 = (v10 - v15);
            const double v17 = (local_column[6][i] - local_column[2][i]);
            const double v19 = cos(v10);
            const double v25 = (v24 + (v20 * v19));
            const double v27 = ((v5 * v4) + (constants[12] * v1));
            const double v28 = sin(v10);
            const double v32 = (v4 * v28);
            const double v35 = (v34 * v25);
            const double v38 = (v37 * (v22 + (v21 * v19)));
            const double v43 = (v42 + (v33 * v32));
            const double v51 = (data_column[0][i] * sin(v11));
            const double v54 = ((v50 * v51) + (v53 * v12));
            const double v59 = ((v40 + (v31 * (v27 * v28))) + (v58 * v32));
            const double v64 = (v63 * v25);
            const double v68 = (v67 + (v61 * (v1 * v28)));
            const double v78 = ((v76 * v51) + (v75 * v12));
            value[0][i] = (v0 * (constants[10] * v2));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v2)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v3 * (constants[11] * v2));
            value[5][i] = (0.5 * (constants[13] * v3));
            value[6][i] = (-(v3 * (constants[11] * v2)));
            value[7][i] = (0.5 * (constants[13] * v3));
            value[8][i] = (v7 * (((v54 - v47) + (v56 * cos(v8))) + (v57 * (data_column[0][i] * sin(v8)))));
            value[9][i] = (v9 * ((((v31 * (v19 * (v4 * v27))) + (v28 * ((v36 * (local_column[7][i] - local_column[3][i])) + (v39 * v17)))) - v45) + v54));
            value[10][i] = (v38 + v43);
            value[11][i] = (v35 + v59);
            value[12][i] = (v7 * (((v54 - v47) + (v56 * cos(v8))) + (v57 * (data_column[0][i] * sin(v8)))));
            value[13][i] = (v9 * ((((v31 * (v19 * (v4 * v27))) + (v28 * ((v36 * (local_column[7][i] - local_column[3][i])) + (v39 * v17)))) - v45) + v54));
            value[14][i] = (v43 - v38);
            value[15][i] = (v59 - v35);
            value[16][i] = (-(v48 * v14));
            value[17][i] = (-(v46 * v16));
            value[18][i] = (-(v44 * v1));
            value[19][i] = (-(v41 * v4));
            value[20][i] = (constants[22] * v47);
            value[21][i] = (constants[23] * v45);
            value[22][i] = (v7 * (v78 - v72));
            value[23][i] = (v9 * ((((v60 * (v19 * (v1 * v1))) + (v77 * (v17 * v28))) - v70) + v78));
            value[24][i] = (v64 + v68);
            value[25][i] = (v62 + v65);
            value[26][i] = (v7 * (v78 - v72));
            value[27][i] = (v9 * ((((v60 * (v19 * (v1 * v1))) + (v77 * (v17 * v28))) - v70) + v78));
            value[28][i] = (v68 - v64);
            value[29][i] = (v65 - v62);
            value[30][i] = (-(v73 * v14));
            value[31][i] = (-(v71 * v16));
            value[32][i] = (-(v69 * v1));
            value[33][i] = (-(v66 * v4));
            value[34][i] = (constants[22] * v72);
            value[35][i] = (constants[23] * v70);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 36; j++) out[k * 36 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v1 = (1.0 / constants[9]);
    const double v3 = (0.5 * constants[13]);
    const double v5 = (1.0 / constants[26]);
    const double v6 = (0.5 * constants[10]);
    const double v8 = (0.5 * constants[11]);
    const double v13 = (constants[4] * (constants[3] * constants[5]));
    const double v14 = (constants[12] * v1);
    const double v17 = (1.0 / constants[27]);
    const double v18 = (v5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v19 = (0.5 * v18);
    const double v20 = (constants[12] * v18);
    const double v21 = (0.5 * v20);
    const double v22 = (v5 * (constants[13] * v1));
    const double v23 = (v13 * v22);
    const double v24 = (v5 * v14);
    const double v25 = (2.0 * (v13 * v24));
    const double v26 = (0.5 * (constants[13] * (constants[17] * v5)));
    const double v27 = (0.5 * (constants[12] * (constants[16] * v5)));
    const double v28 = (constants[15] * v5);
    const double v29 = (constants[14] * v5);
    const double v30 = (constants[4] * v5);
    const double v31 = (constants[5] * v30);
    const double v32 = (constants[7] * v30);
    const double v33 = (constants[5] * v32);
    const double v34 = (constants[0] * v5);
    const double v35 = (0.25 * (constants[13] * v18));
    const double v36 = (v17 * (v13 * (constants[12] * constants[12])));
    const double v37 = (0.25 * v36);
    const double v38 = (v14 * v17);
    const double v39 = (0.5 * (constants[13] * (constants[21] * v17)));
    const double v40 = (0.5 * (constants[12] * (constants[20] * v17)));
    const double v41 = (constants[19] * v17);
    const double v42 = (constants[18] * v17);
    const double v43 = (constants[4] * v17);
    const double v44 = ((constants[5] * constants[7]) * v43);
    const double v45 = (constants[5] * v43);
    const double v46 = (v13 * v38);
    const double v48 = (v37 + v37);
    const double v51 = (0.5 * (constants[10] * v42));
    const double v52 = (0.5 * (constants[10] * v29));
    const double v54 = (0.25 * (constants[10] * constants[11]));
    const double v55 = (0.5 * (constants[10] * ((constants[3] * v32) + ((constants[1] * constants[7]) * v34))));
    const double v56 = (0.5 * (constants[10] * ((constants[3] * v30) + (constants[1] * v34))));
    const double v57 = (constants[11] * v13);
    const double v58 = (0.5 * (constants[11] * v48));
    const double v59 = (0.5 * (v38 * v57));
    const double v60 = (0.5 * (constants[11] * v41));
    const double v62 = (constants[11] * v18);
    const double v63 = (0.25 * v62);
    const double v65 = (0.25 * (constants[11] * v20));
    const double v67 = (0.5 * (v22 * v57));
    const double v69 = (v24 * v57);
    const double v71 = (0.5 * (constants[11] * v28));
    const double v72 = (0.25 * (constants[11] * constants[11]));
    const double v73 = (0.125 * (constants[13] * v62));
    const double v75 = (0.5 * v36);
    const double v76 = (v35 + v35);
    const double v77 = (constants[22] * v29);
    const double v78 = (constants[23] * v28);
    const double v79 = (constants[22] * v42);
    const double v80 = (constants[23] * v41);
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[3][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[48][BLOCK] __attribute__((aligned(64)));
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
            const double v47 = (v16 * multipliers_column[3][i]);
            const double v49 = (v16 * multipliers_column[2][i]);
            const double v50 = (data_column[0][i] * multipliers_column[2][i]);
            const double v53 = ((cos(v10) * ((v45 * (data_column[0][i] * multipliers_column[3][i])) + (v31 * v50))) - (sin(v10) * ((v44 * multipliers_column[3][i]) + (v33 * multipliers_column[2][i]))));
            const double v61 = (v12 * multipliers_column[2][i]);
            const double v64 = (v2 * v61);
            const double v66 = ((v65 * v64) - (v58 * (v0 * (v12 * multipliers_column[3][i]))));
            const double v68 = (v67 * v49);
            const double v70 = ((v59 * v47) + (v69 * v49));
            const double v74 = ((v63 * (v15 * v61)) + (v73 * v64));
            value[0][i] = (v6 * (((v6 * v53) - (v55 * (sin(v7) * multipliers_column[2][i]))) + (v56 * (cos(v7) * v50))));
            value[1][i] = (v54 * v53);
            value[2][i] = (v72 * (v53 + ((v12 * ((v13 * ((v38 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v37 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[3][i] = (v66 - v70);
            value[4][i] = (-(v48 * v47));
            value[5][i] = (v74 - v68);
            value[6][i] = (v21 * v49);
            value[7][i] = (v76 * v49);
            value[8][i] = (v6 * (((v6 * v53) - (v55 * (sin(v7) * multipliers_column[2][i]))) + (v56 * (cos(v7) * v50))));
            value[9][i] = (v54 * v53);
            value[10][i] = (v6 * (((v6 * v53) - (v55 * (sin(v7) * multipliers_column[2][i]))) + (v56 * (cos(v7) * v50))));
            value[11][i] = (v54 * v53);
            value[12][i] = (v72 * (v53 + ((v12 * ((v13 * ((v38 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v37 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[13][i] = (v8 * ((v12 * ((v21 * (v2 * multipliers_column[2][i])) - (v75 * (v0 * multipliers_column[3][i])))) - (v16 * ((v46 * multipliers_column[3][i]) + (v25 * multipliers_column[2][i])))));
            value[14][i] = (v8 * ((v19 * (v12 * (multipliers_column[2][i] * (v4 + v15)))) - (v23 * v49)));
            value[15][i] = (v54 * v53);
            value[16][i] = (v72 * (v53 + ((v12 * ((v13 * ((v38 * (v11 * multipliers_column[3][i])) + (v22 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) + (v25 * (v11 * multipliers_column[2][i])))) - (v16 * ((v19 * ((v2 * v15) * multipliers_column[2][i])) - (v37 * ((v0 * v0) * multipliers_column[3][i])))))));
            value[17][i] = (v66 + v70);
            value[18][i] = (-(v48 * v47));
            value[19][i] = (v21 * v49);
            value[20][i] = (v66 + v70);
            value[21][i] = (-(v48 * v47));
            value[22][i] = (v68 + v74);
            value[23][i] = (v21 * v49);
            value[24][i] = (v76 * v49);
            value[25][i] = (v68 + v74);
            value[26][i] = (v21 * v49);
            value[27][i] = (v76 * v49);
            value[28][i] = (-(v52 * multipliers_column[2][i]));
            value[29][i] = (-(v52 * multipliers_column[2][i]));
            value[30][i] = (-(v71 * multipliers_column[2][i]));
            value[31][i] = (-(v71 * multipliers_column[2][i]));
            value[32][i] = (-(v27 * multipliers_column[2][i]));
            value[33][i] = (-(v27 * multipliers_column[2][i]));
            value[34][i] = (-(v26 * multipliers_column[2][i]));
            value[35][i] = (-(v26 * multipliers_column[2][i]));
            value[36][i] = (-(v51 * multipliers_column[3][i]));
            value[37][i] = (-(v51 * multipliers_column[3][i]));
            value[38][i] = (-(v60 * multipliers_column[3][i]));
            value[39][i] = (-(v60 * multipliers_column[3][i]));
            value[40][i] = (-(v40 * multipliers_column[3][i]));
            value[41][i] = (-(v40 * multipliers_column[3][i]));
            value[42][i] = (-(v39 * multipliers_column[3][i]));
            value[43][i] = (-(v39 * multipliers_column[3][i]));
            value[44][i] = (v77 * multipliers_column[2][i]);
            value[45][i] = (v79 * multipliers_column[3][i]);
            value[46][i] = (v78 * multipliers_column[2][i]);
            value[47][i] = (v80 * multipliers_column[3][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 48; j++) out[index[k * 48 + j]] += value[j][i];
        }
    }
}
