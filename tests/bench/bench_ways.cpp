// What a tree costs on its way in and out, as the tools do it, by form of document: grown and written; read, cut into bodies and written; read and run
// to its first frame. In memory or to /dev/null, on one thread. Items are bodies.
#include "formats/documents/splines.h"
#include "formats/documents/tree.h"
#include "formats/files.h"
#include "lib/base/parallel.h"
#include "lib/bough.h"
#include <benchmark/benchmark.h>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace bough;

template <class Write> std::string document(Write&& write) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("bough-bench-ways-" + std::to_string(::getpid()));
    Output output(file.string());
    write(output);
    output.finish();
    std::string content = read_input(file.string());
    std::filesystem::remove(file);
    return content;
}

Splines grown(std::int64_t bodies) {
    return grow("apple", {.bodies = bodies, .seed = 1});
}

void treegen(benchmark::State& benchmark, Form form) {
    const ThreadLimit one(1);
    for (auto _ : benchmark) {
        Output output("/dev/null");
        write_splines(output, grown(benchmark.range(0)), form);
        output.finish();
    }
    benchmark.SetItemsProcessed(benchmark.iterations() * benchmark.range(0));
}

void treeconvert(benchmark::State& benchmark, Form form) {
    const ThreadLimit one(1);
    const std::string content =
        document([&](Output& output) { write_splines(output, grown(benchmark.range(0)), form); });
    for (auto _ : benchmark) {
        Output output("/dev/null");
        write_tree(output, convert(read_splines(content, "bench")), form);
        output.finish();
    }
    benchmark.SetItemsProcessed(benchmark.iterations() * benchmark.range(0));
}

void first_frame(benchmark::State& benchmark, Form form) {
    const ThreadLimit one(1);
    const std::string content =
        document([&](Output& output) { write_tree(output, convert(grown(benchmark.range(0))), form); });
    for (auto _ : benchmark) {
        Scene scene;
        scene.add(read_tree(content, "bench"));
        scene.wind = *wind_preset("gusty");
        Simulation simulation(std::move(scene), {.precision = Precision::single, .threads = 1});
        benchmark::DoNotOptimize(simulation.step());
        benchmark::DoNotOptimize(simulation.positions());
    }
    benchmark.SetItemsProcessed(benchmark.iterations() * benchmark.range(0));
}

const bool registered = [] {
    struct Way {
        const char* name;
        void (*run)(benchmark::State&, Form);
    };
    for (const Form form : {Form::json, Form::safetensors})
        for (const Way& way :
             {Way{"treegen", treegen}, Way{"treeconvert", treeconvert}, Way{"first_frame", first_frame}})
            benchmark::RegisterBenchmark(
                (std::string("way/") + way.name + (form == Form::json ? "/json" : "/safetensors")).c_str(), way.run,
                form)
                ->Arg(1000000)
                ->Unit(benchmark::kMillisecond);
    return true;
}();

} // namespace
