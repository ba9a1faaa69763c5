// Documents read and written in memory or to /dev/null: 10 000 bodies. Bytes are those of the document.
#include "bench_tree.h"
#include "formats/documents/motion.h"
#include "formats/documents/tree.h"
#include <benchmark/benchmark.h>
#include <cstdlib>
#include <filesystem>
#include <unistd.h>

namespace {

using namespace bough;

std::string document(Form form) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("bough-bench-" + std::to_string(::getpid()));
    Output output(file.string());
    write_tree(output, bench::tree(), form);
    output.finish();
    std::string content = read_input(file.string());
    std::filesystem::remove(file);
    return content;
}

void read_document(benchmark::State& benchmark, Form form) {
    const std::string content = document(form);
    for (auto _ : benchmark) benchmark::DoNotOptimize(read_tree(content, "bench"));
    benchmark.SetBytesProcessed(benchmark.iterations() * std::int64_t(content.size()));
}

void write_document(benchmark::State& benchmark, Form form) {
    const std::size_t size = document(form).size();
    for (auto _ : benchmark) {
        Output output("/dev/null");
        write_tree(output, bench::tree(), form);
        output.finish();
    }
    benchmark.SetBytesProcessed(benchmark.iterations() * std::int64_t(size));
}

// A frame of poses as a line of JSON. Items are bodies.
void write_frames(benchmark::State& benchmark) {
    const Tree& tree = bench::tree();
    MotionFrame frame;
    for (std::size_t i = 0; i < tree.size_bodies(); ++i) {
        frame.position.push_back(tree.joint_position[i] * 1.000001 + Vec3(0.1, 0.2, 0.3));
        frame.rotation.push_back(tree.joint_rotation[i]);
    }
    MotionHeader header;
    header.bodies = std::int64_t(tree.size_bodies());
    header.fields.pose = true;
    Output output("/dev/null");
    MotionWriter writer(output, header, MotionForm::jsonl);
    for (auto _ : benchmark) {
        writer.write(frame);
        ++frame.frame;
    }
    writer.finish();
    output.finish();
    benchmark.SetItemsProcessed(benchmark.iterations() * std::int64_t(tree.size_bodies()));
}

const bool registered = [] {
    using benchmark::RegisterBenchmark;
    RegisterBenchmark("read/tree/json", read_document, Form::json);
    RegisterBenchmark("read/tree/safetensors", read_document, Form::safetensors);
    RegisterBenchmark("write/tree/json", write_document, Form::json);
    RegisterBenchmark("write/tree/safetensors", write_document, Form::safetensors);
    RegisterBenchmark("write/frame/jsonl", write_frames);
    return true;
}();

} // namespace
