// 0f35200cb5aab669c94f665632a25184
// {"name": "standing on a moving platform, PD interval", "m": 4, "n_local": 8, "n_shared": 6, "n_data": 4, "n_constants": 24, "jacobian": [[0, 0], [0, 2], [0, 4], [0, 6], [1, 1], [1, 3], [1, 5], [1, 7], [2, 0], [2, 1], [2, 2], [2, 3], [2, 4], [2, 5], [2, 6], [2, 7], [2, 8], [2, 9], [2, 12], [3, 0], [3, 1], [3, 2], [3, 3], [3, 4], [3, 5], [3, 6], [3, 7], [3, 10], [3, 11], [3, 13]], "hessian": [[0, 0], [1, 0], [1, 1], [2, 1], [2, 2], [3, 1], [3, 2], [3, 3], [4, 4], [5, 2], [5, 3], [5, 4], [5, 5], [6, 1], [6, 5], [6, 6], [7, 1], [7, 5], [7, 6], [7, 7], [8, 0], [8, 4], [9, 2], [9, 6], [10, 1], [10, 5], [11, 3], [11, 7], [12, 8], [13, 10]]}
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
// data[1]: platform_acceleration#1
// data[2]: ankle_torque_noise
// data[3]: hip_torque_noise
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
    const double v1 = (0.5 * constants[12]);
    const double v2 = (1.0 / constants[9]);
    const double v3 = (constants[10] * v2);
    const double v4 = (1.0 / constants[21]);
    const double v5 = (0.5 * constants[13]);
    const double v6 = (constants[11] * v2);
    const double v7 = (1.0 / constants[22]);
    const double v11 = (constants[1] * constants[7]);
    const double v12 = ((-0.5) * constants[0]);
    const double v20 = ((-0.5) * constants[4]);
    const double v25 = (shared[4] * constants[18]);
    const double v26 = ((-0.5) * (shared[0] * constants[14]));
    const double v27 = ((-0.5) * (constants[15] * (shared[1] * constants[12])));
    const double v29 = (constants[4] * (constants[5] * constants[5]));
    const double v31 = (constants[4] * (constants[3] * constants[5]));
    const double v32 = (2.0 * v31);
    const double v33 = (v29 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v34 = ((-0.5) * (constants[12] * v2));
    const double v37 = (constants[6] + v29);
    const double v39 = (constants[13] * v2);
    const double v40 = ((-0.5) * v39);
    const double v42 = (2.0 * constants[12]);
    const double v44 = (0.5 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v46 = (1.0 / constants[23]);
    const double v47 = (constants[5] * constants[7]);
    const double v48 = (shared[5] * constants[19]);
    const double v49 = ((-0.5) * (shared[2] * constants[16]));
    const double v50 = ((-0.5) * (constants[17] * (shared[3] * constants[13])));
    const double v51 = (v37 * v39);
    const double v52 = ((-0.5) * (v31 * (constants[12] * constants[12])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double value[4][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v8 = (constants[10] * local_column[0][i]);
            const double v9 = cos(v8);
            const double v10 = sin(v8);
            const double v13 = (constants[10] * local_column[4][i]);
            const double v14 = cos(v13);
            const double v15 = sin(v13);
            const double v16 = (constants[11] * local_column[1][i]);
            const double v17 = (v8 + v16);
            const double v18 = sin(v17);
            const double v19 = cos(v17);
            const double v21 = (constants[11] * local_column[5][i]);
            const double v22 = (v13 + v21);
            const double v23 = sin(v22);
            const double v24 = cos(v22);
            const double v28 = (local_column[6][i] - local_column[2][i]);
            const double v30 = cos(v16);
            const double v35 = cos(v21);
            const double v36 = (local_column[7][i] - local_column[3][i]);
            const double v38 = (v37 + (v31 * v30));
            const double v41 = (v37 + (v31 * v35));
            const double v43 = sin(v16);
            const double v45 = sin(v21);
            value[0][i] = (v0 * ((v1 * (local_column[2][i] + local_column[6][i])) - (v3 * (local_column[4][i] - local_column[0][i]))));
            value[1][i] = (v4 * ((v5 * (local_column[3][i] + local_column[7][i])) - (v6 * (local_column[5][i] - local_column[1][i]))));
            value[2][i] = (v7 * ((v44 * (v45 * (local_column[7][i] * ((constants[13] * local_column[7][i]) + (v42 * local_column[6][i]))))) + ((v44 * (v43 * (local_column[3][i] * ((constants[13] * local_column[3][i]) + (v42 * local_column[2][i]))))) + ((v40 * (v36 * v41)) + ((v40 * (v36 * v38)) + ((v34 * (v28 * (v33 + (v32 * v35)))) + ((v34 * (v28 * (v33 + (v32 * v30)))) + ((v27 * local_column[6][i]) + ((v27 * local_column[2][i]) + ((v26 * (v13 - v25)) + ((v26 * (v8 - v25)) + ((v20 * ((data_column[1][i] * ((constants[3] * v14) + (constants[5] * v24))) - (constants[7] * ((constants[3] * v15) + (constants[5] * v23))))) + ((v20 * ((data_column[0][i] * ((constants[3] * v9) + (constants[5] * v19))) - (constants[7] * ((constants[3] * v10) + (constants[5] * v18))))) + ((v12 * ((constants[1] * (data_column[1][i] * v14)) - (v11 * v15))) + ((v12 * ((constants[1] * (data_column[0][i] * v9)) - (v11 * v10))) - data_column[2][i])))))))))))))));
            value[3][i] = (v46 * ((v52 * (v45 * (local_column[6][i] * local_column[6][i]))) + ((v52 * (v43 * (local_column[2][i] * local_column[2][i]))) + (((v34 * (v28 * v41)) + ((v34 * (v28 * v38)) + ((v50 * local_column[7][i]) + ((v50 * local_column[3][i]) + ((v49 * (v21 - v48)) + ((v49 * (v16 - v48)) + ((v20 * ((constants[5] * (data_column[1][i] * v24)) - (v47 * v23))) + ((v20 * ((constants[5] * (data_column[0][i] * v19)) - (v47 * v18))) - data_column[3][i])))))))) - (v51 * v36)))));
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
    const double v1 = (1.0 / constants[9]);
    const double v2 = (1.0 / constants[21]);
    const double v3 = (1.0 / constants[22]);
    const double v12 = (shared[4] * constants[18]);
    const double v14 = (constants[4] * (constants[5] * constants[5]));
    const double v16 = (constants[4] * (constants[3] * constants[5]));
    const double v17 = (2.0 * v16);
    const double v18 = (v14 + ((constants[4] * (constants[3] * constants[3])) + ((constants[0] * (constants[1] * constants[1])) + (constants[2] + constants[6]))));
    const double v19 = (constants[12] * v1);
    const double v21 = (constants[6] + v14);
    const double v22 = (constants[13] * v1);
    const double v23 = (2.0 * constants[12]);
    const double v28 = (1.0 / constants[23]);
    const double v29 = (shared[5] * constants[19]);
    const double v30 = (v3 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v31 = (0.5 * v30);
    const double v33 = (constants[12] * v30);
    const double v34 = (0.5 * (constants[13] * v30));
    const double v36 = (v3 * v22);
    const double v37 = ((-0.5) * v36);
    const double v38 = ((-0.5) * (v16 * v36));
    const double v41 = (v3 * v19);
    const double v42 = ((-0.5) * v41);
    const double v43 = (v16 * v41);
    const double v46 = ((-0.5) * (v3 * (constants[15] * (shared[1] * constants[12]))));
    const double v47 = ((-0.5) * (constants[12] * (constants[15] * v3)));
    const double v48 = (v3 * (shared[0] * constants[14]));
    const double v49 = ((-0.5) * v48);
    const double v50 = (0.5 * v48);
    const double v51 = ((-0.5) * (constants[14] * v3));
    const double v52 = (constants[4] * v3);
    const double v53 = ((-0.5) * (constants[5] * v52));
    const double v55 = (constants[7] * v52);
    const double v56 = (0.5 * (constants[5] * v55));
    const double v60 = (constants[0] * v3);
    const double v61 = ((0.5 * (constants[3] * v55)) + (0.5 * ((constants[1] * constants[7]) * v60)));
    const double v62 = (((-0.5) * (constants[3] * v52)) + ((-0.5) * (constants[1] * v60)));
    const double v63 = ((-0.5) * (v28 * (v16 * (constants[12] * constants[12]))));
    const double v64 = (v63 + v63);
    const double v65 = (v28 * (v21 * v22));
    const double v66 = (v19 * v28);
    const double v67 = ((-0.5) * v66);
    const double v69 = ((-0.5) * (v28 * (constants[17] * (shared[3] * constants[13]))));
    const double v70 = ((-0.5) * (constants[13] * (constants[17] * v28)));
    const double v71 = (v28 * (shared[2] * constants[16]));
    const double v72 = ((-0.5) * v71);
    const double v73 = (0.5 * v71);
    const double v74 = ((-0.5) * (constants[16] * v28));
    const double v75 = (constants[4] * v28);
    const double v76 = (0.5 * ((constants[5] * constants[7]) * v75));
    const double v77 = ((-0.5) * (constants[5] * v75));
    const double v78 = ((-0.5) * (v16 * v66));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double value[30][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v4 = (constants[10] * local_column[0][i]);
            const double v5 = (constants[10] * local_column[4][i]);
            const double v6 = (constants[11] * local_column[1][i]);
            const double v7 = (v4 + v6);
            const double v8 = cos(v7);
            const double v9 = (constants[11] * local_column[5][i]);
            const double v10 = (v5 + v9);
            const double v11 = cos(v10);
            const double v13 = (local_column[6][i] - local_column[2][i]);
            const double v15 = cos(v6);
            const double v20 = cos(v9);
            const double v24 = ((constants[13] * local_column[3][i]) + (v23 * local_column[2][i]));
            const double v25 = sin(v6);
            const double v26 = ((constants[13] * local_column[7][i]) + (v23 * local_column[6][i]));
            const double v27 = sin(v9);
            const double v32 = (local_column[7][i] * v27);
            const double v35 = (local_column[3][i] * v25);
            const double v39 = ((v21 + (v16 * v15)) + (v21 + (v16 * v20)));
            const double v40 = (v37 * v39);
            const double v44 = ((v38 * (local_column[7][i] - local_column[3][i])) - (v43 * v13));
            const double v45 = (v42 * ((v18 + (v17 * v15)) + (v18 + (v17 * v20))));
            const double v54 = (data_column[1][i] * sin(v10));
            const double v57 = ((v56 * v11) - (v53 * v54));
            const double v58 = (data_column[0][i] * sin(v7));
            const double v59 = ((v56 * v8) - (v53 * v58));
            const double v68 = (v67 * v39);
            const double v79 = ((v76 * v11) - (v77 * v54));
            const double v80 = ((v76 * v8) - (v77 * v58));
            value[0][i] = (v0 * (constants[10] * v1));
            value[1][i] = (0.5 * (constants[12] * v0));
            value[2][i] = (-(v0 * (constants[10] * v1)));
            value[3][i] = (0.5 * (constants[12] * v0));
            value[4][i] = (v2 * (constants[11] * v1));
            value[5][i] = (0.5 * (constants[13] * v2));
            value[6][i] = (-(v2 * (constants[11] * v1)));
            value[7][i] = (0.5 * (constants[13] * v2));
            value[8][i] = (constants[10] * (((v49 + v59) + (v61 * cos(v4))) - (v62 * (data_column[0][i] * sin(v4)))));
            value[9][i] = (constants[11] * (((v31 * (v15 * (local_column[3][i] * v24))) - (v25 * v44)) + v59));
            value[10][i] = (v46 + ((v33 * v35) - v45));
            value[11][i] = (((v31 * (v24 * v25)) + (v34 * v35)) - v40);
            value[12][i] = (constants[10] * (((v49 + v57) + (v61 * cos(v5))) - (v62 * (data_column[1][i] * sin(v5)))));
            value[13][i] = (constants[11] * (((v31 * (v20 * (local_column[7][i] * v26))) - (v27 * v44)) + v57));
            value[14][i] = (v46 + ((v33 * v32) + v45));
            value[15][i] = (((v31 * (v26 * v27)) + (v34 * v32)) + v40);
            value[16][i] = (v51 * ((v4 - v12) + (v5 - v12)));
            value[17][i] = (v47 * (local_column[2][i] + local_column[6][i]));
            value[18][i] = (constants[18] * (v50 + v50));
            value[19][i] = (constants[10] * v80);
            value[20][i] = (constants[11] * (((v72 + (v63 * (v15 * (local_column[2][i] * local_column[2][i])))) - (v78 * (v13 * v25))) + v80));
            value[21][i] = ((v64 * (local_column[2][i] * v25)) - v68);
            value[22][i] = (v65 + v69);
            value[23][i] = (constants[10] * v79);
            value[24][i] = (constants[11] * (((v72 + (v63 * (v20 * (local_column[6][i] * local_column[6][i])))) - (v78 * (v13 * v27))) + v79));
            value[25][i] = ((v64 * (local_column[6][i] * v27)) + v68);
            value[26][i] = (v69 - v65);
            value[27][i] = (v74 * ((v6 - v29) + (v9 - v29)));
            value[28][i] = (v70 * (local_column[3][i] + local_column[7][i]));
            value[29][i] = (constants[19] * (v73 + v73));
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
    const double v0 = (1.0 / constants[9]);
    const double v1 = (1.0 / constants[22]);
    const double v10 = (constants[4] * (constants[3] * constants[5]));
    const double v11 = (constants[12] * v0);
    const double v13 = (2.0 * constants[12]);
    const double v18 = (1.0 / constants[23]);
    const double v19 = (v1 * (constants[4] * (constants[5] * (constants[3] * constants[13]))));
    const double v20 = (0.5 * v19);
    const double v21 = (constants[12] * v19);
    const double v22 = (constants[13] * v19);
    const double v23 = (0.5 * v22);
    const double v24 = (v1 * (constants[13] * v0));
    const double v25 = ((-0.5) * v24);
    const double v26 = (v1 * v11);
    const double v27 = (v10 * v26);
    const double v28 = ((-0.5) * (constants[12] * (constants[15] * v1)));
    const double v29 = (constants[14] * v1);
    const double v30 = ((-0.5) * v29);
    const double v31 = (constants[4] * v1);
    const double v32 = ((-0.5) * (constants[5] * v31));
    const double v33 = (constants[7] * v31);
    const double v34 = (constants[0] * v1);
    const double v35 = ((-0.5) * (v18 * (v10 * (constants[12] * constants[12]))));
    const double v36 = (v35 + v35);
    const double v37 = (v11 * v18);
    const double v38 = ((-0.5) * v37);
    const double v39 = ((-0.5) * (constants[13] * (constants[17] * v18)));
    const double v40 = (constants[16] * v18);
    const double v41 = ((-0.5) * v40);
    const double v42 = (constants[4] * v18);
    const double v43 = ((-0.5) * (constants[5] * v42));
    const double v44 = ((-0.5) * (v10 * v37));
    const double v47 = ((-0.5) * ((constants[5] * constants[7]) * v42));
    const double v52 = ((-0.5) * (constants[5] * v33));
    const double v55 = ((-0.5) * (constants[10] * v29));
    const double v57 = (constants[10] * constants[11]);
    const double v58 = (constants[10] * (((-0.5) * (constants[3] * v33)) + ((-0.5) * ((constants[1] * constants[7]) * v34))));
    const double v59 = (constants[10] * (((-0.5) * (constants[3] * v31)) + ((-0.5) * (constants[1] * v34))));
    const double v60 = (constants[11] * v10);
    const double v61 = (constants[11] * v36);
    const double v62 = ((-0.5) * (v37 * v60));
    const double v64 = ((-0.5) * (constants[11] * v40));
    const double v66 = (0.5 * (constants[11] * v19));
    const double v68 = (constants[11] * v21);
    const double v69 = (0.5 * (constants[11] * v22));
    const double v70 = ((-0.5) * (v24 * v60));
    const double v72 = (v26 * v60);
    const double v74 = (constants[11] * constants[11]);
    const double v75 = (v23 + v23);
    const double v76 = ((-0.5) * (constants[11] * (v10 * v24)));
    const double v80 = (constants[18] * (v30 + v30));
    const double v81 = (constants[19] * (v41 + v41));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[8][BLOCK] __attribute__((aligned(64)));
        double data_column[4][BLOCK] __attribute__((aligned(64)));
        double multipliers_column[4][BLOCK] __attribute__((aligned(64)));
        double value[30][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 8; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 4; j++) data_column[j][i] = data[k * 4 + j];
            for (int j = 0; j < 4; j++) multipliers_column[j][i] = multipliers[k * 4 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v2 = (constants[10] * local_column[0][i]);
            const double v3 = (constants[10] * local_column[4][i]);
            const double v4 = (constants[11] * local_column[1][i]);
            const double v5 = (v2 + v4);
            const double v6 = (constants[11] * local_column[5][i]);
            const double v7 = (v3 + v6);
            const double v8 = (local_column[6][i] - local_column[2][i]);
            const double v9 = cos(v4);
            const double v12 = cos(v6);
            const double v14 = ((constants[13] * local_column[3][i]) + (v13 * local_column[2][i]));
            const double v15 = sin(v4);
            const double v16 = ((constants[13] * local_column[7][i]) + (v13 * local_column[6][i]));
            const double v17 = sin(v6);
            const double v45 = (v17 * multipliers_column[3][i]);
            const double v46 = (v15 * multipliers_column[3][i]);
            const double v48 = (v17 * multipliers_column[2][i]);
            const double v49 = (v15 * multipliers_column[2][i]);
            const double v50 = ((v10 * ((v38 * (v8 * multipliers_column[3][i])) + (v25 * ((local_column[7][i] - local_column[3][i]) * multipliers_column[2][i])))) - (v27 * (v8 * multipliers_column[2][i])));
            const double v51 = (data_column[1][i] * multipliers_column[2][i]);
            const double v53 = ((v47 * multipliers_column[3][i]) + (v52 * multipliers_column[2][i]));
            const double v54 = (data_column[0][i] * multipliers_column[2][i]);
            const double v56 = ((cos(v5) * ((v43 * (data_column[0][i] * multipliers_column[3][i])) + (v32 * v54))) - (sin(v5) * v53));
            const double v63 = (v62 * v46);
            const double v65 = (v9 * multipliers_column[2][i]);
            const double v67 = (local_column[3][i] * v65);
            const double v71 = (v70 * v49);
            const double v73 = (v72 * v49);
            const double v77 = ((cos(v7) * ((v43 * (data_column[1][i] * multipliers_column[3][i])) + (v32 * v51))) - (sin(v7) * v53));
            const double v78 = (v12 * multipliers_column[2][i]);
            const double v79 = (local_column[7][i] * v78);
            value[0][i] = (constants[10] * (((v58 * (sin(v2) * multipliers_column[2][i])) - (constants[10] * v56)) - (v59 * (cos(v2) * v54))));
            value[1][i] = (-(v57 * v56));
            value[2][i] = (-(v74 * (v56 + ((v15 * ((v35 * ((local_column[2][i] * local_column[2][i]) * multipliers_column[3][i])) + (v20 * ((local_column[3][i] * v14) * multipliers_column[2][i])))) + (v9 * v50)))));
            value[3][i] = (((v61 * (local_column[2][i] * (v9 * multipliers_column[3][i]))) + (v68 * v67)) + (v63 - v73));
            value[4][i] = (v36 * v46);
            value[5][i] = (((v66 * (v14 * v65)) + (v69 * v67)) + v71);
            value[6][i] = (v21 * v49);
            value[7][i] = (v75 * v49);
            value[8][i] = (constants[10] * (((v58 * (sin(v3) * multipliers_column[2][i])) - (constants[10] * v77)) - (v59 * (cos(v3) * v51))));
            value[9][i] = (-(constants[11] * (v17 * ((v27 * multipliers_column[2][i]) - (v44 * multipliers_column[3][i])))));
            value[10][i] = (v76 * v48);
            value[11][i] = (-(v57 * v77));
            value[12][i] = (-(v74 * (v77 + ((v17 * ((v35 * ((local_column[6][i] * local_column[6][i]) * multipliers_column[3][i])) + (v20 * ((local_column[7][i] * v16) * multipliers_column[2][i])))) + (v12 * v50)))));
            value[13][i] = (v73 - v63);
            value[14][i] = (((v61 * (local_column[6][i] * (v12 * multipliers_column[3][i]))) + (v68 * v79)) + ((v72 * v48) - (v62 * v45)));
            value[15][i] = (v36 * v45);
            value[16][i] = (-v71);
            value[17][i] = (((v66 * (v16 * v78)) + (v69 * v79)) - (v70 * v48));
            value[18][i] = (v21 * v48);
            value[19][i] = (v75 * v48);
            value[20][i] = (v55 * multipliers_column[2][i]);
            value[21][i] = (v55 * multipliers_column[2][i]);
            value[22][i] = (v28 * multipliers_column[2][i]);
            value[23][i] = (v28 * multipliers_column[2][i]);
            value[24][i] = (v64 * multipliers_column[3][i]);
            value[25][i] = (v64 * multipliers_column[3][i]);
            value[26][i] = (v39 * multipliers_column[3][i]);
            value[27][i] = (v39 * multipliers_column[3][i]);
            value[28][i] = (-(v80 * multipliers_column[2][i]));
            value[29][i] = (-(v81 * multipliers_column[3][i]));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 30; j++) out[index[k * 30 + j]] += value[j][i];
        }
    }
}
