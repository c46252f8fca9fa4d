// DAQP on many small problems, each set up and solved: in one call, or in memory that is kept.
#include <api.h>
#include <string.h>
#include <utils.h>

enum { MOST = 16, EQUALITY = 5 };

// `count` problems of n variables one after the other: hessian, slope, rows of the equations, bounds of variables
// and equations (all lower ones, then all upper ones). How many are not solved.
int peers_daqp(int n, int equations, int count, const double *numbers, int keep, double *x) {
    const int m = n + equations, size = n * n + n + equations * n + 2 * m;
    const int all = DAQP_UPDATE_Rinv + DAQP_UPDATE_M + DAQP_UPDATE_v + DAQP_UPDATE_d + DAQP_UPDATE_sense;
    int failures = 0, sense[MOST] = {0};
    for (int i = n; i < m; i++) sense[i] = EQUALITY;
    double multipliers[MOST];
    DAQPWorkspace work;
    for (int k = 0; k < count; k++, numbers += size) {
        DAQPProblem problem;
        memset(&problem, 0, sizeof problem);
        problem.n = n, problem.m = m, problem.ms = n, problem.sense = sense;
        problem.H = (double *)numbers;
        problem.f = problem.H + n * n;
        problem.A = problem.f + n;
        problem.blower = problem.A + equations * n;
        problem.bupper = problem.blower + m;
        DAQPResult result;
        memset(&result, 0, sizeof result);
        result.x = x + k * n, result.lam = multipliers;
        if (!keep) {
            daqp_quadprog(&result, &problem, NULL);
        } else {
            int ready = 0;
            if (k == 0) {
                memset(&work, 0, sizeof work);
                ready = setup_daqp(&problem, &work, NULL);
            } else {
                ready = daqp_update_ldp(all, &work, &problem);
            }
            result.exitflag = ready;
            if (ready >= 0) daqp_solve(&result, &work);
        }
        failures += result.exitflag != DAQP_EXIT_OPTIMAL;
    }
    if (keep) {
        free_daqp_workspace(&work);
        free_daqp_ldp(&work);
    }
    return failures;
}
