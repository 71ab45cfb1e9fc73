// a7bd0bc57638a5f14598afcbde32df75
// {"name": "standing on a moving platform, FullStatePD objective", "m": 1, "n_local": 4, "n_shared": 10, "n_data": 2, "n_constants": 25, "jacobian": [[0, 0], [0, 1]], "hessian": [[0, 0], [1, 1]]}
// local[0]: ankle_angle
// local[1]: hip_angle
// local[2]: ankle_velocity
// local[3]: hip_velocity
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
// data[0]: measured_ankle_angle#recorded
// data[1]: measured_hip_angle#recorded
// constants[0]: leg_mass
// constants[1]: leg_com
// constants[2]: leg_inertia
// constants[3]: leg_length
// constants[4]: trunk_mass
// constants[5]: trunk_com
// constants[6]: trunk_inertia
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: scale ankle_angle
// constants[10]: scale hip_angle
// constants[11]: scale ankle_velocity
// constants[12]: scale hip_velocity
// constants[13]: scale kp_aa
// constants[14]: scale kp_ah
// constants[15]: scale kd_aa
// constants[16]: scale kd_ah
// constants[17]: scale kp_ha
// constants[18]: scale kp_hh
// constants[19]: scale kd_ha
// constants[20]: scale kd_hh
// constants[21]: scale ref_ankle
// constants[22]: scale ref_hip
// constants[23]: measured_ankle_angle#weight
// constants[24]: measured_hip_angle#weight
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

    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[4][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[1][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 4; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            const double v0 = ((constants[9] * local_column[0][i]) - data_column[0][i]);
            const double v1 = ((constants[10] * local_column[1][i]) - data_column[1][i]);
            value[0][i] = ((constants[23] * (v0 * v0)) + (constants[24] * (v1 * v1)));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 1; j++) out[k * 1 + j] = value[j][i];
        }
    }
}


void jacobian(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (constants[10] * (constants[24] + constants[24]));
    const double v1 = (constants[9] * (constants[23] + constants[23]));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double local_column[4][BLOCK] __attribute__((aligned(64)));
        double data_column[2][BLOCK] __attribute__((aligned(64)));
        double value[2][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 4; j++) local_column[j][i] = local[k * stride + j];
            for (int j = 0; j < 2; j++) data_column[j][i] = data[k * 2 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            value[0][i] = (v1 * ((constants[9] * local_column[0][i]) - data_column[0][i]));
            value[1][i] = (v0 * ((constants[10] * local_column[1][i]) - data_column[1][i]));
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 2; j++) out[k * 2 + j] = value[j][i];
        }
    }
}


void hessian_into(ptrdiff_t n, const double *restrict local, ptrdiff_t stride, const double *restrict shared,
        const double *restrict data, const double *restrict constants,
        const double *restrict multipliers, double *restrict out, const int *restrict index)
{
    const double v0 = (constants[9] * (constants[9] * (constants[23] + constants[23])));
    const double v1 = (constants[10] * (constants[10] * (constants[24] + constants[24])));
    for (ptrdiff_t first = 0; first < n; first += BLOCK) {
        const int count = n - first < BLOCK ? (int)(n - first) : BLOCK;
        double multipliers_column[1][BLOCK] __attribute__((aligned(64)));
        double value[2][BLOCK] __attribute__((aligned(64)));
        for (int i = 0; i < BLOCK; i++) {
            const ptrdiff_t k = first + (i < count ? i : count - 1);
            for (int j = 0; j < 1; j++) multipliers_column[j][i] = multipliers[k * 1 + j];
        }
        #pragma omp simd
        for (int i = 0; i < BLOCK; i++) {
            value[0][i] = (v0 * multipliers_column[0][i]);
            value[1][i] = (v1 * multipliers_column[0][i]);
        }
        for (int i = 0; i < count; i++) {
            const ptrdiff_t k = first + i;
            for (int j = 0; j < 2; j++) out[index[k * 2 + j]] += value[j][i];
        }
    }
}
