// The generalized Jacobian of a floating arm with Pinocchio: centroidal map, frame Jacobian, solve.
#include <pinocchio/algorithm/centroidal.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>

using namespace pinocchio;
using Eigen::Vector3d;

static Model model;
static Data *data;
static FrameIndex tip;

// uav: mass, inertia; mount: x, y; links: mass, length, com, inertia of each.
extern "C" void peers_pinocchio_load(const double *uav, const double *mount, const double *links, int count) {
    model = Model();
    auto at = [](double x, double y) { return SE3(Eigen::Matrix3d::Identity(), Vector3d(x, 0, y)); };
    const JointModelRevoluteUnaligned turn(Vector3d(0, -1, 0));
    auto parent = model.addJoint(0, JointModelPX(), at(0, 0), "x");
    parent = model.addJoint(parent, JointModelPZ(), at(0, 0), "y");
    parent = model.addJoint(parent, turn, at(0, 0), "roll");
    model.appendBodyToJoint(parent, Inertia(uav[0], Vector3d::Zero(), uav[1] * Eigen::Matrix3d::Identity()));
    double x = mount[0], y = mount[1];
    for (int i = 0; i < count; i++) {
        const double *link = links + 4 * i;
        parent = model.addJoint(parent, turn, at(x, y), "joint" + std::to_string(i));
        const Inertia body(link[0], Vector3d(0, 0, -link[2]), link[3] * Eigen::Matrix3d::Identity());
        model.appendBodyToJoint(parent, body);
        x = 0, y = -link[1];
    }
    tip = model.addFrame(Frame("tip", parent, at(x, y), OP_FRAME));
    delete data;
    data = new Data(model);
}

// Rates of three joints with which the end effector moves as wanted, while the system has this momentum;
// `times` over, each time from slightly turned joints.
extern "C" void peers_pinocchio_rates(const double *coordinates, const double *momentum, const double *wanted,
                                      double turn, int times, double *rates) {
    Eigen::Matrix<double, 6, 1> q = Eigen::Map<const Eigen::Matrix<double, 6, 1>>(coordinates);
    const Eigen::Matrix<double, 6, 1> v = Eigen::Matrix<double, 6, 1>::Zero();
    const Vector3d h(momentum[0], momentum[1], momentum[2]);
    const Eigen::Vector2d target(wanted[0], wanted[1]);
    Data::Matrix6x jacobian(6, model.nv);
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < times; i++) {
        q.tail<3>().array() += turn;
        ccrba(model, *data, q, v);
        jacobian.setZero();
        getFrameJacobian(model, *data, tip, LOCAL_WORLD_ALIGNED, jacobian);
        Eigen::Matrix<double, 3, 6> map;
        map << data->Ag.row(0), data->Ag.row(2), -data->Ag.row(4);
        Eigen::Matrix<double, 2, 6> path;
        path << jacobian.row(0), jacobian.row(2);
        // Both momenta are those about the common centre of mass.
        const Eigen::Matrix3d inverse = map.leftCols<3>().inverse();
        const Eigen::Matrix<double, 2, 3> base = path.leftCols<3>() * inverse;
        const Eigen::Matrix<double, 2, 3> generalized = path.rightCols<3>() - base * map.rightCols<3>();
        const Eigen::Vector2d missing = target - base * h;
        sum += generalized.transpose() * (generalized * generalized.transpose()).inverse() * missing;
    }
    for (int i = 0; i < 3; i++) rates[i] = sum[i] / times;
}
