// Scenes written and read again, in both forms, against what was in memory; and small ones written by hand.
#include "formats/documents/scene.h"
#include "tests/support/random_documents.h"

using namespace bough;
using namespace bough::test;

namespace {

std::string scene_text(const Scene& scene, Form form) {
    return written([&](Output& o) { write_scene(o, scene, form); });
}

} // namespace

TEST_CASE("what a scene simulates comes back from both forms") {
    Random random;
    Scene scene;
    Simulate simulate;
    simulate.first_level = 1;
    simulate.last_level = 3;
    simulate.radius = random.fraction();
    Selector at;
    at.body = 4;
    at.point = random.vector();
    simulate.subtrees = {at, {}};
    simulate.box = Simulate::Box{Vec3(-1, 0.1, -3), Vec3(2, 5, 1e-3)};
    simulate.error = random.fraction();
    simulate.view = Simulate::View{random.vector(), 35.5, 2160};
    scene.simulate = simulate;
    for (const Form form : {Form::json, Form::safetensors}) {
        const Scene read = read_scene_document(scene_text(scene, form), "s").scene;
        REQUIRE(read.simulate);
        const Simulate& s = *read.simulate;
        CHECK((s.first_level == 1 && s.last_level == 3));
        CHECK(same(s.radius, simulate.radius));
        REQUIRE(s.subtrees.size() == 2);
        REQUIRE(s.subtrees[0].point);
        CHECK(same(*s.subtrees[0].point, *at.point));
        CHECK((s.subtrees[0].body == 4 && !s.subtrees[1].point));
        REQUIRE((s.box && s.view));
        CHECK((same(s.box->least, simulate.box->least) && same(s.box->most, simulate.box->most)));
        CHECK(same(s.error, simulate.error));
        CHECK((same(s.view->from, simulate.view->from) && s.view->angle == 35.5 && s.view->pixels == 2160));
    }
    const Scene few =
        read_scene_document(R"({"format": "bough-scene", "version": 1, "simulate": {"last_level": 1}})", "s").scene;
    REQUIRE(few.simulate);
    CHECK((!few.simulate->first_level && few.simulate->last_level == 1 && !few.simulate->box && !few.simulate->view));
    CHECK_FALSE(read_scene_document(R"({"format": "bough-scene", "version": 1})", "s").scene.simulate);
}

TEST_CASE("scenes come back from both forms") {
    Random random;
    Scene scene;
    scene.trees = {{"oak.json", {1, 0, -0.1}, 30}, {"birch.safetensors", {0, 0, 1e-300}, -7.5}};
    scene.gravity = {0, -1.62, 0};
    Wind wind;
    wind.velocity = {3, 0, 1};
    wind.reference_height = 8;
    wind.profile = 0.2;
    wind.turbulence = 0.3;
    wind.gust_factor = 1.5;
    wind.gust_period = 4;
    wind.seed = 18446744073709551615u;
    scene.wind = wind;
    WindGrid grid;
    grid.x = -3.5;
    grid.z = 0.1;
    grid.cell = 2;
    grid.columns = 2;
    grid.rows = 1;
    grid.velocity = {Vec3(1, 0.1, 1e-300), Vec3(-4, 0, 2)};
    grid.octaves = {3};
    grid.persistence = {0.25, 0.1};
    grid.frequency = 0.7;
    scene.wind->grid = grid;
    WindSwirl swirl;
    swirl.x = 0.3;
    swirl.z = -0.2;
    swirl.radius = {1};
    swirl.angle = {12.5};
    swirl.period = 2.5;
    swirl.wavelength = 6;
    scene.wind->swirl = swirl;
    scene.wind->shelter = WindShelter{0.7};
    scene.wind->period = 60;
    scene.air_density = 1.1;
    scene.pose = Pose::settled;
    scene.joint_inertia = JointInertia::paper;
    scene.stiffness_scale = 0.5;
    scene.damping_scale = 2;
    scene.joint_limit = random_joint_limit(random);
    scene.fracture = Fracture();
    scene.fracture->leaf = 1e-4;
    scene.fracture->strength = 4e7;
    scene.fracture->spread = 0.3;
    scene.fracture->seed = 18446744073709551615u;
    scene.fracture->joints = {{{Selector::By::level, 0, 0, {}, 0, 1, Vec3::Zero(), 2}, 3.5}, {{}, Fracture::never}};
    scene.balls.resize(2);
    scene.balls[1].position = random.place();
    scene.balls[1].velocity = random.place();
    scene.balls[1].angular_velocity = random.vector();
    scene.balls[1].radius = 0.1 / 3;
    scene.balls[1].mass = 7;
    scene.contact = Contact{ContactModel::penalty, 0.7, 0.1, 0.05, 20, false, true, false, -1.5};
    scene.leaves = LeafAir{random.fraction(), random.fraction(), 1 + random.fraction(), random.fraction()};
    scene.wood.emplace();
    scene.wood->branch = {1.0 / 3, 0, 1e-300};
    scene.wood->petal = {random.fraction(), random.fraction(), 1 + random.fraction()};
    scene.wood->curves.resize(2);
    scene.wood->curves[0] = {
        Selector{Selector::By::level, 0, 0, {}, 0, 1, Vec3::Zero(), 2}, {0, 0.1}, {0, 1.0 / 3}, {}, true};
    scene.wood->curves[1] = {std::nullopt, {0.7}, {}, {random.fraction()}, false};
    scene.wood->fork = WoodFork{1 / 0.7, 0.1 / 3};
    scene.load = StaticLoad{random.fraction(), 1e-300, 0, 7};
    scene.fictitious = Fictitious{random.fraction(), 0, 0.1 / 3};
    Pull pull;
    pull.time = {0, 1.5};
    pull.force = {{0, 0, 1}, {0.1, 0.2, 0.3}};
    pull.on.by = Selector::By::branch;
    pull.on.tree = 1, pull.on.branch = 12, pull.on.at = 0.8;
    scene.pulls.push_back(pull);
    pull.on = {};
    pull.on.by = Selector::By::nearest;
    pull.on.nearest = {1, 2, 3};
    scene.pulls.push_back(pull);
    pull.on = {};
    pull.on.by = Selector::By::level;
    pull.on.level = 2;
    scene.pulls.push_back(pull);
    pull.on = {};
    pull.on.body = 57;
    pull.in_body = true;
    scene.pulls.push_back(pull);
    scene.attachments.resize(2);
    scene.attachments[0].on = pull.on;
    scene.attachments[0].target = random.place();
    scene.attachments[0].stiffness = 1e12 / 3;
    scene.attachments[0].from = 0.1 / 3;
    scene.attachments[0].to = 2.5;
    scene.attachments[1].on = pull.on;
    scene.attachments[1].with = Selector();
    scene.attachments[1].with->tree = 0;
    scene.attachments[1].with->body = 1;
    scene.attachments[1].with->point = random.vector();
    scene.attachments[1].time = {0, 0.7, 1 / 0.7};
    scene.attachments[1].position = {random.place(), random.place(), random.place()};
    scene.attachments[1].damping = 0.7;
    scene.root_motion.resize(2);
    scene.root_motion[0] = random_root_motion(1, 5, true, true, random);
    scene.root_motion[1] = random_root_motion(0, 2, false, true, random);

    for (const Form form : {Form::json, Form::safetensors}) {
        const std::string text = scene_text(scene, form);
        INFO(text);
        CHECK(is_scene(text));
        const Scene read = read_scene_document(text, "s").scene;
        REQUIRE(read.trees.size() == 2);
        CHECK(read.trees[1].file == "birch.safetensors");
        CHECK(same(read.trees[1].position, scene.trees[1].position));
        CHECK(read.trees[0].yaw == 30);
        CHECK(same(read.gravity, scene.gravity));
        REQUIRE((read.wood && read.load && read.fictitious));
        const auto factors = [](const WoodFactors& f) { return Vec3(f.stiffness, f.damping, f.density); };
        CHECK(same(factors(read.wood->branch), factors(scene.wood->branch)));
        CHECK(same(factors(read.wood->leaf), Vec3(1, 1, 1)));
        CHECK(same(factors(read.wood->petal), factors(scene.wood->petal)));
        REQUIRE(read.wood->curves.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            const WoodCurve &a = read.wood->curves[k], &b = scene.wood->curves[k];
            CHECK((same(a.radius, b.radius) && same(a.stiffness, b.stiffness) && same(a.damping, b.damping)));
            CHECK((a.relative == b.relative && a.on.has_value() == b.on.has_value()));
        }
        CHECK(read.wood->curves[0].on->level == 2);
        CHECK((same(read.wood->fork->factor, 1 / 0.7) && same(read.wood->fork->length, 0.1 / 3)));
        CHECK((same(read.load->branch, scene.load->branch) && same(read.load->leaf, 1e-300) && read.load->fruit == 7));
        CHECK(same(read.fictitious->acceleration, scene.fictitious->acceleration));
        CHECK((read.fictitious->turning == 0 && same(read.fictitious->gyroscopic, 0.1 / 3)));
        REQUIRE(read.wind);
        CHECK(same(read.wind->velocity, scene.wind->velocity));
        CHECK(read.wind->reference_height == 8);
        CHECK(read.wind->profile == 0.2);
        CHECK(read.wind->turbulence == 0.3);
        CHECK(read.wind->gust_factor == 1.5);
        CHECK(read.wind->gust_period == 4);
        CHECK(read.wind->seed == scene.wind->seed);
        REQUIRE((read.wind->grid && read.wind->swirl && read.wind->shelter));
        const WindGrid& cells = *read.wind->grid;
        CHECK((cells.x == grid.x && cells.z == grid.z && cells.cell == 2 && cells.columns == 2 && cells.rows == 1));
        CHECK((cells.velocity == grid.velocity && cells.octaves == grid.octaves && cells.phase == grid.phase));
        CHECK((cells.persistence == grid.persistence && cells.frequency == grid.frequency));
        const WindSwirl& turn = *read.wind->swirl;
        CHECK((turn.x == swirl.x && turn.z == swirl.z && turn.radius == swirl.radius && turn.angle == swirl.angle));
        CHECK((turn.period == swirl.period && turn.wavelength == swirl.wavelength));
        CHECK(read.wind->shelter->cell == 0.7);
        CHECK(read.wind->period == 60);
        CHECK(read.air_density == 1.1);
        CHECK(read.pose == Pose::settled);
        CHECK(read.joint_inertia == JointInertia::paper);
        CHECK(read.stiffness_scale == 0.5);
        CHECK(read.damping_scale == 2);
        REQUIRE(read.leaves);
        CHECK(same(read.leaves->kappa, scene.leaves->kappa));
        CHECK(same(read.leaves->air_resistance, scene.leaves->air_resistance));
        CHECK(same(read.leaves->drag_ratio, scene.leaves->drag_ratio));
        CHECK(same(read.leaves->offset, scene.leaves->offset));
        REQUIRE(read.joint_limit);
        CHECK(same(*read.joint_limit, *scene.joint_limit));
        REQUIRE((read.fracture && read.contact));
        CHECK((read.fracture->leaf == 1e-4 && read.fracture->strength == 4e7 && read.fracture->spread == 0.3));
        CHECK((read.fracture->branch == Fracture::never && read.fracture->fruit == Fracture::never));
        CHECK(read.fracture->seed == scene.fracture->seed);
        REQUIRE(read.fracture->joints.size() == 2);
        CHECK(read.fracture->joints[0].on.by == Selector::By::level);
        CHECK(read.fracture->joints[0].on.level == 2);
        CHECK(read.fracture->joints[0].torque == 3.5);
        CHECK(read.fracture->joints[1].torque == Fracture::never);
        REQUIRE(read.balls.size() == 2);
        const Ball &thrown = read.balls[1], &meant = scene.balls[1];
        CHECK((same(thrown.position, meant.position) && same(thrown.velocity, meant.velocity)));
        CHECK((same(thrown.angular_velocity, meant.angular_velocity) && same(thrown.radius, meant.radius)));
        CHECK(thrown.mass == 7);
        CHECK((read.contact->model == ContactModel::penalty && read.contact->restitution == 0.7));
        CHECK((read.contact->friction == 0.1 && read.contact->penalty == 20 && read.contact->ground_height == -1.5));
        CHECK((!read.contact->trees && read.contact->leaves && !read.contact->ground));
        REQUIRE(read.pulls.size() == 4);
        CHECK((!read.pulls[0].in_body && read.pulls[3].in_body));
        CHECK(same(read.pulls[0].time, pull.time));
        CHECK(same(read.pulls[0].force, pull.force));
        CHECK(read.pulls[0].on.by == Selector::By::branch);
        CHECK(read.pulls[0].on.tree == 1);
        CHECK(read.pulls[0].on.branch == 12);
        CHECK(read.pulls[0].on.at == 0.8);
        CHECK(read.pulls[1].on.by == Selector::By::nearest);
        CHECK(same(read.pulls[1].on.nearest, Vec3(1, 2, 3)));
        CHECK(read.pulls[2].on.by == Selector::By::level);
        CHECK(read.pulls[2].on.level == 2);
        CHECK(read.pulls[3].on.by == Selector::By::body);
        CHECK(read.pulls[3].on.body == 57);
        REQUIRE(read.attachments.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) {
            const Attachment &found = read.attachments[k], &written = scene.attachments[k];
            CHECK(found.on.body == 57);
            REQUIRE(found.with.has_value() == written.with.has_value());
            if (written.with)
                CHECK(
                    (found.with->tree == 0 && found.with->body == 1 && same(*found.with->point, *written.with->point)));
            CHECK(found.target.has_value() == written.target.has_value());
            if (written.target) CHECK(same(*found.target, *written.target));
            CHECK(same(found.time, written.time));
            CHECK(same(found.position, written.position));
            CHECK((found.stiffness == written.stiffness && found.damping == written.damping));
            CHECK((found.from == written.from && found.to == written.to));
        }
        REQUIRE(read.root_motion.size() == 2);
        for (std::size_t k = 0; k < 2; ++k) CHECK(same(read.root_motion[k], scene.root_motion[k]));
    }
}

TEST_CASE("a scene of two lines has the defaults") {
    const Scene defaults, read = read_scene_document(R"({"format": "bough-scene", "version": 1})", "s").scene;
    CHECK(read.trees.empty());
    CHECK_FALSE(read.wind);
    CHECK(read.pulls.empty());
    CHECK(read.attachments.empty());
    CHECK(read.root_motion.empty());
    CHECK_FALSE(read.joint_limit);
    CHECK_FALSE(read.fracture);
    CHECK_FALSE(read.contact);
    CHECK(read.balls.empty());
    CHECK_FALSE(read.leaves);
    CHECK(read.gravity == defaults.gravity);
    CHECK(read.pose == Pose::drawn);

    const Scene gusty = read_scene_document(R"({"format": "bough-scene", "version": 1, "wind": "gusty"})", "s").scene;
    REQUIRE(gusty.wind);
    CHECK(gusty.wind->velocity.norm() == Approx(8));
    const Wind wind = read_wind(R"({"format": "bough-wind", "version": 1, "velocity": [3, 0, 4]})", "w");
    CHECK(wind.velocity == Vec3(3, 0, 4));
    CHECK(wind.gust_factor == 1);
}

TEST_CASE("a joint limit may be one number, or one for a kind") {
    const auto read = [](const std::string& limit) {
        return read_scene_document(R"({"format": "bough-scene", "version": 1, "joint_limit": )" + limit + "}", "s")
            .scene.joint_limit;
    };
    const Vec3 none = Vec3::Constant(180), all = Vec3::Constant(30.5);
    REQUIRE(read("30.5"));
    CHECK(same(*read("30.5"), JointLimit{all, all, all}));
    CHECK(same(*read(R"({"branch": 30.5})"), JointLimit{all, none, none}));
    CHECK(same(*read(R"({"leaf": [10, 20, 180], "fruit": 30.5})"), JointLimit{none, Vec3(10, 20, 180), all}));
    CHECK(same(*read("{}"), JointLimit{}));
}
