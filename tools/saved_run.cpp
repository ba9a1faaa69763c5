#include "saved_run.h"
#include "exits.h"
#include "formats/documents/motion.h"
#include "formats/open.h"
#include "lib/simulation/saved.h"

namespace bough {

template <class T> void restore(const TreesimOptions& o, const Setting& setting, const SavedState& saved, Run<T>& run) {
    const auto refuse = [&](const std::string& field, const std::string& found, const std::string& expected) {
        if (found != expected)
            throw InputError(input_name(o.resume), "/" + field + ": is " + found + ", but this run has " + expected);
    };
    refuse("precision", saved.precision, o.run.precision);
    refuse("solver", saved.solver, o.run.solver);
    refuse("scheme", saved.scheme, scheme_name(o.run));
    refuse("substeps", std::to_string(saved.substeps), std::to_string(o.run.substeps));
    if (saved.fps != o.run.fps) throw InputError(input_name(o.resume), "/fps: differs from this run's (--fps)");
    refuse("theta", std::to_string(saved.theta.size()) + " bodies", std::to_string(run.plan.bodies) + " bodies");
    if (saved.fingerprint != setting.fingerprint)
        throw InputError(input_name(o.resume), "/fingerprint: is " + hash_text(saved.fingerprint) +
                                                   ", but this run's tree and scene have " +
                                                   hash_text(setting.fingerprint));
    refuse("whole", saved.whole, setting.part.parts > 1 ? hash_text(setting.part.whole) : "");
    try {
        restore_run(saved, saved.frame * o.run.substeps, run);
    } catch (const SceneError& error) {
        throw InputError(input_name(o.resume), error.what());
    }
}

template <class T> void save(const TreesimOptions& o, const Setting& setting, Run<T>& run, std::int64_t frame) {
    SavedState saved;
    save_run(run, frame, saved);
    saved.fps = o.run.fps;
    saved.substeps = o.run.substeps;
    saved.precision = o.run.precision;
    saved.solver = o.run.solver;
    saved.scheme = scheme_name(o.run);
    saved.fingerprint = setting.fingerprint;
    saved.part = setting.part.part;
    saved.parts = setting.part.parts;
    if (setting.part.parts > 1) saved.whole = hash_text(setting.part.whole);
    saved.source = with_command_line(setting.source, o.common);
    Output output(o.save_state);
    write_state(output, saved, form_of_name(o.save_state));
    output.finish();
}

template void restore(const TreesimOptions&, const Setting&, const SavedState&, Run<float>&);
template void restore(const TreesimOptions&, const Setting&, const SavedState&, Run<double>&);
template void save(const TreesimOptions&, const Setting&, Run<float>&, std::int64_t);
template void save(const TreesimOptions&, const Setting&, Run<double>&, std::int64_t);

} // namespace bough
