#include "run.h"
#include "../analytic/analytic_lanes_stepper.h"
#include "../coupled/coupled_lanes_stepper.h"
#include "../plan/expand.h"
#include "../plan/pose.h"
#include "../plan/spring_torque.h"

namespace bough {
namespace {

std::string body_text(const Tree& tree, std::size_t i) {
    return "body " + std::to_string(i) + " (branch " + std::to_string(tree.branch[i]) + ")";
}

template <class T> std::string free_text(const World<T>& world, std::size_t k) {
    if (k < world.balls) return "ball " + std::to_string(k);
    return "what fell with " + body_text(*world.tree, std::size_t(world.free[k].parts.front().body));
}

// Of several trees, the place of the one that cannot stand, whose body and branch are counted as its own document counts them.
std::string text_of(const NoStart& wrong, const Assembly& assembly) {
    const std::vector<TreeRange>& trees = assembly.ranges;
    if (trees.size() < 2 || assembly.part.parts > 1) return wrong.what();
    std::size_t k = trees.size() - 1;
    while (k > 0 && trees[k].first_body > wrong.body) --k;
    const NoStart own(wrong.body - trees[k].first_body, wrong.branch - trees[k].first_branch, wrong.why);
    return "/trees/" + std::to_string(k) + ": " + own.what();
}

// tree: const Tree& or Tree&&, as make_plan takes it.
template <class T, class TreeType>
Plan<T> plan_of(TreeType&& tree, const Assembly& assembly, Wishes wishes, double dt,
                std::unique_ptr<Stepper<T>> stepper) {
    wishes.top = assembly.part.top;
    wishes.reach = assembly.part.reach;
    wishes.clocks = assembly.part.clocks;
    wishes.foliage = assembly.part.foliage;
    wishes.faces = assembly.part.faces;
    const std::string counted = assembly.whole ? " (bodies counted without the rigid ones)" : "";
    try {
        return make_plan<T>(std::forward<TreeType>(tree), assembly.ranges, assembly.scene, wishes, dt,
                            std::move(stepper));
    } catch (const std::out_of_range& error) {
        throw SceneError(error.what());
    } catch (const NoStart& wrong) {
        throw SceneError(text_of(wrong, assembly) + counted);
    } catch (const std::domain_error& error) {
        throw SceneError(error.what() + counted);
    }
}

} // namespace

template <class T> std::unique_ptr<Stepper<T>> stepper_of(const Assembly& assembly, StepChoice choice) {
    keep_to_the_whole(assembly.part, choice.method == Method::analytic, choice);
    return choice.method == Method::coupled
               ? fast::coupled_stepper<T>(assembly.scene, Scheme::p12, choice.simd, choice.sleep)
               : fast::analytic_stepper<T>(assembly.scene, choice.simd, choice.sleep);
}

template <class T>
Plan<T> plan_run(const Assembly& assembly, const Wishes& wishes, double dt, std::unique_ptr<Stepper<T>> stepper) {
    return plan_of<T>(assembly.tree, assembly, wishes, dt, std::move(stepper));
}

template <class T>
Plan<T> plan_run(Assembly&& assembly, const Wishes& wishes, double dt, std::unique_ptr<Stepper<T>> stepper) {
    return plan_of<T>(std::move(assembly.tree), assembly, wishes, dt, std::move(stepper));
}

template <class T> Run<T> start_run(Plan<T> plan, const Assembly& assembly) {
    Run<T> run{std::move(plan), {}, {}};
    run.state = make_state(run.plan);
    try {
        run.world = make_world(run.plan, assembly.tree, assembly.ranges);
    } catch (const std::out_of_range& error) {
        throw SceneError(error.what());
    } catch (const std::domain_error& error) {
        throw SceneError(error.what());
    }
    return run;
}

template <class T> std::string non_finite(Run<T>& run, const Tree& tree) {
    if (const std::optional<NonFinite> found = run.plan.stepper->non_finite(run.plan, run.state))
        return "stage " + found->what + ", " + body_text(tree, found->body);
    if (const std::optional<std::size_t> free = first_non_finite(run.world))
        return "stage contacts, " + free_text(run.world, *free);
    return {};
}

template <class T>
std::optional<std::size_t> fill_frame(const Plan<T>& plan, const State<T>& state, const MotionFields& fields,
                                      MotionFrame& out) {
    std::optional<std::size_t> broken;
    const auto copy = [&](bool wanted, const std::vector<Vector3<T>>& from, std::vector<Vec3>& to) {
        if (!wanted) return;
        to.resize(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) {
            to[i] = from[i].template cast<double>();
            if (!broken && !to[i].allFinite()) broken = i;
        }
    };
    copy(fields.pose, state.x_w, out.position);
    copy(fields.velocity, state.v_w, out.velocity);
    copy(fields.velocity, state.omega_w, out.angular_velocity);
    copy(fields.torque, state.torque_j, out.torque);
    copy(fields.angles, state.theta, out.theta);
    copy(fields.angles, state.theta_dot, out.theta_dot);
    if (fields.stress) bending_stresses(plan, state, out.stress);
    for (std::size_t i = 0; !broken && i < out.stress.size(); ++i)
        if (!std::isfinite(out.stress[i])) broken = i;
    if (!fields.pose) return broken;
    out.rotation.resize(state.R_wb.size());
    for (std::size_t i = 0; i < state.R_wb.size(); ++i)
        out.rotation[i] = positive(Quat(Mat3(state.R_wb[i].template cast<double>())));
    return broken;
}

template <class T> void show_all(const Assembly& assembly, const Run<T>& run, MotionFrame& frame) {
    if (assembly.whole) expand_frame(assembly.whole->places, assembly.whole->tree, run.plan, run.state, frame);
    place_free_bodies(run.world, frame);
}

#define BOUGH_INSTANTIATE(T)                                                                                           \
    template std::unique_ptr<Stepper<T>> stepper_of(const Assembly&, StepChoice);                                      \
    template Plan<T> plan_run(const Assembly&, const Wishes&, double, std::unique_ptr<Stepper<T>>);                    \
    template Plan<T> plan_run(Assembly&&, const Wishes&, double, std::unique_ptr<Stepper<T>>);                         \
    template Run<T> start_run(Plan<T>, const Assembly&);                                                               \
    template std::string non_finite(Run<T>&, const Tree&);                                                             \
    template std::optional<std::size_t> fill_frame(const Plan<T>&, const State<T>&, const MotionFields&,               \
                                                   MotionFrame&);                                                      \
    template void show_all(const Assembly&, const Run<T>&, MotionFrame&);
#include "../base/instantiate.inc"

} // namespace bough
