// What a simulation refuses to begin: one kind of exception, with the place as treesim prints it.
#include "lib/simulation/simulation.h"
#include "tests/support/make_tree.h"
#include "tests/support/simulations.h"

using namespace bough;
using namespace simulations;

TEST_CASE("what cannot be run is refused once, with its place") {
    const Tree tree = make_tree::branched();
    CHECK(refusal(Scene()).find("/trees: is empty") == 0);
    CHECK(refusal(one(Tree())).find("/trees/0: /parent: is empty") == 0);
    Tree broken = tree;
    broken.mass[3] = NAN;
    CHECK(refusal(one(broken)).find("/trees/0: /mass/3: is ") == 0);
    Scene named;
    named.trees.push_back({"oak.json", Vec3::Zero(), 0, 0, nullptr});
    CHECK(refusal(named).find("/trees/0: only names a file, 'oak.json'") == 0);
    Scene wind = one(tree, "gusty");
    wind.wind->velocity.x() = NAN;
    CHECK(refusal(wind).find("/wind/velocity: ") == 0);
    for (double Wind::*ahead : {&Wind::turbulence_ahead, &Wind::gust_ahead}) {
        wind = one(tree, "gusty");
        (*wind.wind).*ahead = NAN;
        CHECK(refusal(wind).find("/wind/") == 0);
    }
    Scene breaking = one(tree);
    breaking.fracture.emplace().joints.resize(2);
    breaking.fracture->joints[1].on.body = 1000000;
    breaking.fracture->joints[0].torque = breaking.fracture->joints[1].torque = 1;
    CHECK(refusal(breaking).find("/fracture/joints/1/on: body 1000000") == 0);
    Scene pulled = one(tree);
    pulled.pulls.push_back({});
    pulled.pulls[0].on.body = 1000000;
    pulled.pulls[0].time = {0, 1};
    pulled.pulls[0].force = {Vec3::Zero(), Vec3::Zero()};
    CHECK_THAT(refusal(pulled), Catch::Contains("pulls/0"));
    for (const double step : {0.0, -1.0, double(NAN), double(INFINITY)}) {
        SimulationOptions o;
        o.step = step;
        CHECK(refusal(one(tree), o).find("step is") == 0);
    }
    SimulationOptions o;
    o.sleep = NAN;
    CHECK(refusal(one(tree), o).find("sleep is") == 0);
    o = {};
    o.threads = -1;
    CHECK(refusal(one(tree), o).find("threads is") == 0);
    o = {};
    o.precision = Precision(7);
    CHECK(refusal(one(tree), o) == "precision is 7, expected Precision::single or Precision::double_");
    o = {};
    o.method = Method(7);
    CHECK(refusal(one(tree), o) == "method is 7, expected Method::coupled or Method::analytic");
    Scene posed = one(tree);
    posed.pose = Pose(9);
    CHECK(refusal(posed) == "/pose: is 9, expected one of drawn, settled, rest");
    Scene jointed = one(tree);
    jointed.joint_inertia = JointInertia(2);
    CHECK(refusal(jointed) == "/joint_inertia: is 2, expected one of branch, paper");
    Scene meeting = one(tree);
    meeting.contact.emplace().model = ContactModel(2);
    CHECK(refusal(meeting) == "/contact/model: is 2, expected one of impulse, penalty");
    pulled.pulls[0].on.by = Selector::By(4);
    CHECK(refusal(pulled) == "/pulls/0/on/by: is 4, expected one of body, branch, nearest, level");
    CHECK(refusal(one(tree)).empty());
}

TEST_CASE("a tree that cannot stand is named with its place, and its body as its own document counts it") {
    const Tree tree = make_tree::branched();
    Tree soft = tree;
    for (Vec3& K : soft.stiffness) K *= 1e-9;
    const std::string alone = refusal(one(soft));
    CHECK_THAT(alone, Catch::StartsWith("body ") && Catch::Contains(" of branch ") &&
                          Catch::Contains(" is too soft to carry its weight"));
    Scene two = one(tree);
    two.add(soft, Vec3(20, 0, 0));
    CHECK(refusal(two) == "/trees/1: " + alone);
}
