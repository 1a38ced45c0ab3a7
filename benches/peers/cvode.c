/* An oscillator between walls by CVODE with root-finding, called from Python through ctypes
 * (peer_cvode_c.py): from impact to impact, as event_driven in scene.py. */
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>
#include <time.h>

struct wall {
    double sign, position, restitution, stiffness; /* restitution below 0: elastic */
};

struct scene {
    double m, c, k, constant;
    int harmonics, walls;
    const double *harmonic; /* amplitude, angular frequency, phase of each */
    const struct wall *wall;
    int *touching; /* of each wall: 1 while an elastic one is touched */
};

static int rate(realtype t, N_Vector y, N_Vector d, void *data) {
    const struct scene *s = data;
    const double u = NV_Ith_S(y, 0), v = NV_Ith_S(y, 1);
    double f = s->constant - s->c * v - s->k * u;
    for (int i = 0; i < s->harmonics; i++) {
        const double *h = s->harmonic + 3 * i;
        f += h[0] * sin(h[1] * t + h[2]);
    }
    for (int i = 0; i < s->walls; i++)
        if (s->touching[i]) f -= s->wall[i].stiffness * (u - s->wall[i].position);
    NV_Ith_S(d, 0) = v;
    NV_Ith_S(d, 1) = f / s->m;
    return 0;
}

static int jacobian(realtype t, N_Vector y, N_Vector fy, SUNMatrix j, void *data, N_Vector a, N_Vector b, N_Vector c) {
    const struct scene *s = data;
    double k = s->k;
    for (int i = 0; i < s->walls; i++)
        if (s->touching[i]) k += s->wall[i].stiffness;
    SM_ELEMENT_D(j, 0, 0) = 0;
    SM_ELEMENT_D(j, 0, 1) = 1;
    SM_ELEMENT_D(j, 1, 0) = -k / s->m;
    SM_ELEMENT_D(j, 1, 1) = -s->c / s->m;
    return 0;
}

static int reach(realtype t, N_Vector y, realtype *out, void *data) {
    const struct scene *s = data;
    for (int i = 0; i < s->walls; i++) out[i] = NV_Ith_S(y, 0) - s->wall[i].position;
    return 0;
}

static void directions(void *cvode, const struct scene *s) {
    int direction[16];
    for (int i = 0; i < s->walls; i++)
        direction[i] = (s->wall[i].sign > 0 ? 1 : -1) * (s->touching[i] ? -1 : 1);
    CVodeSetRootDirection(cvode, direction);
}

/* Runs from (u, v) to `end`. With rows > 0 it writes the displacements at i end/rows to
 * out[0..rows]. Returns the seconds that stepping took, -1 if CVODE failed, -2 if impacts
 * accumulate. */
double simulate(int adams, double rtol, double atol, const struct scene *s, double u, double v, double end, int rows,
                double *out) {
    SUNContext context;
    SUNContext_Create(NULL, &context);
    N_Vector y = N_VNew_Serial(2, context);
    NV_Ith_S(y, 0) = u;
    NV_Ith_S(y, 1) = v;
    for (int i = 0; i < s->walls; i++) s->touching[i] = 0;
    void *cvode = CVodeCreate(adams ? CV_ADAMS : CV_BDF, context);
    CVodeInit(cvode, rate, 0, y);
    CVodeSetUserData(cvode, (void *)s);
    CVodeSStolerances(cvode, rtol, atol);
    SUNMatrix matrix = SUNDenseMatrix(2, 2, context);
    SUNLinearSolver linear = SUNLinSol_Dense(y, matrix, context);
    SUNNonlinearSolver fixed = SUNNonlinSol_FixedPoint(y, 0, context);
    if (adams) {
        CVodeSetNonlinearSolver(cvode, fixed);
    } else {
        CVodeSetLinearSolver(cvode, linear, matrix);
        CVodeSetJacFn(cvode, jacobian);
    }
    CVodeRootInit(cvode, s->walls, reach);
    directions(cvode, s);
    CVodeSetMaxNumSteps(cvode, 10000000);
    CVodeSetStopTime(cvode, end);
    if (rows > 0) out[0] = u;

    struct timespec from, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    double t = 0, failed = 0;
    int row = 1, events = 0;
    while (t < end) {
        const double ahead = rows > 0 && row < rows ? end * row / rows : end;
        const int flag = CVode(cvode, ahead, y, &t, CV_NORMAL);
        if (flag < 0) {
            failed = -1;
            break;
        }
        if (flag != CV_ROOT_RETURN) {
            if (rows > 0) out[row] = NV_Ith_S(y, 0);
            row++;
            continue;
        }
        if (++events > 100000) {
            failed = -2;
            break;
        }
        int found[16];
        CVodeGetRootInfo(cvode, found);
        for (int i = 0; i < s->walls; i++) {
            if (!found[i]) continue;
            NV_Ith_S(y, 0) = s->wall[i].position;
            if (s->wall[i].restitution < 0) {
                s->touching[i] = !s->touching[i];
            } else {
                NV_Ith_S(y, 1) *= -s->wall[i].restitution;
                if (fabs(NV_Ith_S(y, 1)) < 1e-9) failed = -2;
            }
        }
        if (failed < 0) break;
        CVodeReInit(cvode, t, y);
        directions(cvode, s);
    }
    clock_gettime(CLOCK_MONOTONIC, &to);
    CVodeFree(&cvode);
    N_VDestroy(y);
    SUNMatDestroy(matrix);
    SUNLinSolFree(linear);
    SUNNonlinSolFree(fixed);
    SUNContext_Free(&context);
    return failed < 0 ? failed : (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
}
