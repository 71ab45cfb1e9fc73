// 7bff87159984e9535b8df6d84f54ea7a
// {"name": "double pendulum on a bench objective", "m": 1, "n_local": 4, "n_shared": 2, "n_data": 2, "n_constants": 17, "jacobian": [[0, 0], [0, 1]], "hessian": [[0, 0], [1, 1]]}
// local[0]: link1_angle
// local[1]: link2_angle
// local[2]: link1_velocity
// local[3]: link2_velocity
// shared[0]: viscous_friction_joint1_coefficient_Nms_rad
// shared[1]: viscous_friction_joint2_coefficient_Nms_rad
// data[0]: measured_link1_angle#recorded
// data[1]: measured_link2_angle#recorded
// constants[0]: m1
// constants[1]: a1
// constants[2]: I1
// constants[3]: L1
// constants[4]: m2
// constants[5]: a2
// constants[6]: I2
// constants[7]: gravity
// constants[8]: friction_speed
// constants[9]: scale link1_angle
// constants[10]: scale link2_angle
// constants[11]: scale link1_velocity
// constants[12]: scale link2_velocity
// constants[13]: scale viscous_friction_joint1_coefficient_Nms_rad
// constants[14]: scale viscous_friction_joint2_coefficient_Nms_rad
// constants[15]: measured_link1_angle#weight
// constants[16]: measured_link2_angle#weight
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
            value[0][i] = ((constants[15] * (v0 * v0)) + (constants[16] * (v1 * v1)));
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
    const double v0 = (constants[10] * (constants[16] + constants[16]));
    const double v1 = (constants[9] * (constants[15] + constants[15]));
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
    const double v0 = (constants[9] * (constants[9] * (constants[15] + constants[15])));
    const double v1 = (constants[10] * (constants[10] * (constants[16] + constants[16])));
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
