// MuJoCo's steps of the vehicle, in compiled loops. World: x to the right, z up, turning about -y.
#include <mujoco/mujoco.h>
#include <string.h>

enum { BASE = 3, MOST = 9 };

static mjModel *model;
static mjData *data;
static int imposed;
// Thrust at rest, then kp, ki, kd of altitude and of roll.
static double hover[7];

static double determinant(double a[BASE][BASE]) {
    return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
           a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

// Solves a x = b for the base's three coordinates, by Cramer's rule.
static void solve3(double a[BASE][BASE], const double b[BASE], double x[BASE]) {
    const double whole = determinant(a);
    for (int i = 0; i < BASE; i++) {
        double c[BASE][BASE];
        memcpy(c, a, sizeof c);
        for (int j = 0; j < BASE; j++) c[j][i] = b[j];
        x[i] = determinant(c) / whole;
    }
}

// Columns of the mass matrix that belong to the base.
static void base_columns(const mjModel *m, mjData *d, double columns[BASE][MOST], double base[BASE][BASE]) {
    for (int i = 0; i < BASE; i++) {
        double unit[MOST] = {0};
        unit[i] = 1;
        mj_mulM(m, d, columns[i], unit);
        for (int j = 0; j < BASE; j++) base[j][i] = columns[i][j];
    }
}

// The hover law in every stage; if the rates are imposed, the torques that keep them.
static void control(const mjModel *m, mjData *d) {
    const double roll = d->qpos[2], *sums = d->act;
    const double thrust = hover[0] - hover[1] * d->qpos[1] - hover[2] * sums[0] - hover[3] * d->qvel[1];
    double *force = d->qfrc_applied;
    force[0] = -mju_sin(roll) * thrust;
    force[1] = mju_cos(roll) * thrust;
    force[2] = -hover[4] * roll - hover[5] * sums[1] - hover[6] * d->qvel[2];
    d->ctrl[0] = d->qpos[1];
    d->ctrl[1] = roll;
    if (!imposed) return;
    double columns[BASE][MOST], base[BASE][BASE], push[BASE], acceleration[BASE];
    base_columns(m, d, columns, base);
    for (int i = 0; i < BASE; i++) push[i] = force[i] - d->qfrc_bias[i];
    solve3(base, push, acceleration);
    for (int j = BASE; j < m->nv; j++) {
        force[j] = d->qfrc_bias[j];
        for (int i = 0; i < BASE; i++) force[j] += columns[i][j] * acceleration[i];
    }
}

// Reads the model; the law of the autopilot as above. Not 0: it cannot.
int peers_mujoco_load(const char *path, const double *law) {
    char error[500];
    model = mj_loadXML(path, NULL, error, sizeof error);
    if (!model || model->nv > MOST || model->na != 2) return 1;
    data = mj_makeData(model);
    memcpy(hover, law, sizeof hover);
    mjcb_control = control;
    return !data;
}

// At rest. With rates: the joints jump to these, are to keep them, and no momentum comes of it.
void peers_mujoco_start(const double *joints, const double *rates) {
    imposed = rates != NULL;
    mj_resetData(model, data);
    for (int i = BASE; i < model->nv; i++) data->qpos[i] = joints[i - BASE];
    if (!imposed) return;
    mj_forward(model, data);
    double columns[BASE][MOST], base[BASE][BASE], momentum[BASE] = {0}, velocity[BASE];
    base_columns(model, data, columns, base);
    for (int i = 0; i < BASE; i++)
        for (int j = BASE; j < model->nv; j++) momentum[i] -= columns[i][j] * rates[j - BASE];
    solve3(base, momentum, velocity);
    memcpy(data->qvel, velocity, sizeof velocity);
    memcpy(data->qvel + BASE, rates, (model->nv - BASE) * sizeof(double));
}

void peers_mujoco_run(int runge_kutta, double step, int steps) {
    model->opt.integrator = runge_kutta ? mjINT_RK4 : mjINT_EULER;
    model->opt.timestep = step;
    for (int i = 0; i < steps; i++) mj_step(model, data);
}

// Base and joints.
void peers_mujoco_place(double *coordinates) { memcpy(coordinates, data->qpos, model->nv * sizeof(double)); }
