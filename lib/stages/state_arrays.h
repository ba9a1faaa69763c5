// state_arrays.h: the one list of a state's arrays, with what each is for: the plan counts them, make_state allocates them.
#pragma once
#include "plan.h"
#include "state.h"
#include <string>

namespace bough {

// visit(name, array, on, reason) for every array over bodies.
template <class T, class StateType, class Visit> void visit_arrays(const Plan<T>& plan, StateType& s, Visit&& visit) {
    const std::string always = "every scene", solver = std::string("solver ") + solver_name(plan.solver);
    const bool analytic = plan.solver == Solver::analytic, coupled = plan.solver == Solver::coupled;
    const std::string fast = "the fast path";
    const std::string composite = !analytic ? solver : plan.lanes.on ? fast : always, pass = coupled ? always : solver;
    const bool real = scheme_of(plan.scheme).real, plain = coupled && !plan.lanes.on;
    const std::string work = coupled && plan.lanes.on ? fast : pass;
    const bool joints = analytic && !plan.lanes.on; // one by one, by the plain step
    const bool air = joints && plan.wind, loads = joints && plan.forces;
    const std::string wind = !plan.wind ? "no wind" : air ? "/wind" : analytic ? fast : solver;
    const std::string forces = plan.forces && !analytic ? solver : plan.forces && !joints ? fast : forces_text(plan);
    const std::string lagged = plan.fictitious ? "/fictitious" : "no lagged fictitious terms";
    const std::string velocity = air               ? "/wind (drag)"
                                 : plan.fictitious ? "/fictitious"
                                 : plan.velocity   ? "output field velocity"
                                                   : "no wind, no output field velocity";
    const std::string torque = plan.torque ? "output field torque" : "no output field torque";
    const std::string unread = "in lanes; no poses, velocities, torques asked for";
    const std::string read = plan.pose ? always : unread;
    visit("theta", s.theta, plan.pose, read);
    visit("theta_dot", s.theta_dot, plan.pose, read);
    visit("scaled_rate", s.scaled_rate, !coupled && plan.pose, coupled ? solver : read);
    visit("theta_change", s.theta_change, coupled && plan.pose, coupled ? read : pass);
    visit("theta_dot_change", s.theta_dot_change, coupled && plan.pose, coupled ? read : pass);
    visit("R_wb", s.R_wb, plan.pose, read);
    visit("x_w", s.x_w, plan.pose, read);
    visit("omega_w", s.omega_w, plan.velocity, velocity);
    visit("v_w", s.v_w, plan.velocity, velocity);
    visit("f_w", s.f_w, loads, forces);
    visit("tau_w", s.tau_w, loads, forces);
    visit("drag_f_w", s.drag_f_w, air, wind);
    visit("drag_tau_w", s.drag_tau_w, air, wind);
    visit("drag_bound", s.drag_bound, air, wind);
    visit("wind_bound", s.wind_bound, air, wind);
    visit("turn_bound", s.turn_bound, air, wind);
    visit("c_h_w", s.c_h_w, joints, composite);
    visit("c_J_w", s.c_J_w, joints, composite);
    visit("c_f_w", s.c_f_w, loads, forces);
    visit("c_tau_w", s.c_tau_w, loads, forces);
    visit("c_drag_f_w", s.c_drag_f_w, air, wind);
    visit("c_drag_tau_w", s.c_drag_tau_w, air, wind);
    visit("c_drag", s.c_drag, air, wind);
    visit("c_drag_row", s.c_drag_row, air, wind);
    visit("c_wind", s.c_wind, air, wind);
    visit("c_wind_row", s.c_wind_row, air, wind);
    visit("c_turn", s.c_turn, air, wind);
    visit("c_turn_row", s.c_turn_row, air, wind);
    visit("spin_dot", s.spin_dot, plan.fictitious, lagged);
    visit("alpha_w", s.alpha_w, plan.fictitious, lagged);
    visit("a_w", s.a_w, plan.fictitious, lagged);
    visit("fictitious_w", s.fictitious_w, plan.fictitious, lagged);
    visit("coupled", s.coupled, plain, work);
    visit("resolvent", s.resolvent, plain && !real, coupled && real ? "a scheme of a real pole" : work);
    visit("resolvent_real", s.resolvent_real, coupled && (real || plan.joint_limit),
          !coupled           ? solver
          : real             ? pass
          : plan.joint_limit ? "/joint_limit"
                             : "a scheme of complex poles, no joint limit");
    visit("guard", s.guard, plain, work);
    visit("torque_j", s.torque_j, plan.torque, torque);
}

} // namespace bough
