#include "lib/study/machine_limits.h"
#include "lib/lanes/row.h"
#include "lib/lanes/target.h"
#include "lib/study/machine_kernels.h"
#include <catch2/catch.hpp>
#include <cmath>

using namespace bough;
using namespace bough::fast;

namespace {

std::vector<Target> targets() {
    std::vector<Target> there;
    for (const Target target : all_targets)
        if (available(target)) there.push_back(target);
    return there;
}

struct Floats {
    explicit Floats(std::size_t n) : rows((n + 15) / 16), size(n) {}
    RowVector<float> rows;
    std::size_t size;
    float* data() { return rows.front().lane; }
};

} // namespace

TEST_CASE("the reading loop adds every value once") {
    for (const Target target : targets()) {
        const MemoryKernels kernels = memory_kernels_for(target);
        for (const std::size_t n : {0, 1, 15, 16, 127, 128, 129, 1000, 4096}) {
            CAPTURE(target_name(target), n);
            Floats array(std::max<std::size_t>(n, 1));
            double expected = 0;
            for (std::size_t i = 0; i < n; ++i) {
                array.data()[i] = float(i);
                expected += double(i);
            }
            CHECK(kernels.sum(array.data(), n) == expected);
            std::size_t unread = 0;
            for (std::size_t i = 0; i < n; ++i) { // each value changed by itself is seen
                array.data()[i] += 3;
                unread += kernels.sum(array.data(), n) != expected + 3;
                array.data()[i] -= 3;
            }
            CHECK(unread == 0);
        }
    }
}

TEST_CASE("the writing loops write every value, and nothing beside") {
    for (const Target target : targets()) {
        CAPTURE(target_name(target));
        const MemoryKernels kernels = memory_kernels_for(target);
        Floats from(160), to(192);
        for (std::size_t i = 0; i < 160; ++i) from.data()[i] = float(i) + 0.5f;
        std::fill(to.data(), to.data() + 192, -1.0f);
        kernels.copy(to.data() + 16, from.data(), 160);
        for (std::size_t i = 0; i < 192; ++i)
            CHECK(to.data()[i] == (i < 16 || i >= 176 ? -1.0f : float(i - 16) + 0.5f));
        kernels.fill(to.data() + 16, 160, 7);
        for (std::size_t i = 0; i < 192; ++i) CHECK(to.data()[i] == (i < 16 || i >= 176 ? -1.0f : 7.0f));
    }
}

// x_n = a^n x_0 + b (1 - a^n) / (1 - a)
TEMPLATE_TEST_CASE("the multiply-adds are all done", "", float, double) {
    using T = TestType;
    for (const Target target : targets()) {
        const ArithmeticKernel<T> kernel = arithmetic_kernel_for<T>(target);
        CAPTURE(target_name(target), kernel.reals);
        REQUIRE(kernel.reals > 0);
        for (const int times : {0, 1, 2, 9}) {
            const double n = kernel.reals, power = std::pow(0.75, times);
            const double expected = power * n * (n - 1) / 2 + n * 0.5 * (1 - power) / 0.25;
            CAPTURE(times);
            CHECK(kernel.multiply_add(T(0.75), T(0.5), std::uint64_t(times)) ==
                  Approx(expected).epsilon(sizeof(T) == 4 ? 1e-5 : 1e-13));
        }
    }
}

TEST_CASE("limits are measured for any number of threads, and a small array") {
    for (const int threads : {1, 2, 3}) {
        const MachineLimits limits = measure_limits(best_target().value(), threads, 1 << 20);
        for (const double figure : {limits.read, limits.write, limits.copy, limits.peak_float, limits.peak_double})
            CHECK((std::isfinite(figure) && figure > 0));
    }
    CHECK(measure_limits(Target::baseline, 3, 0).read > 0);
    CHECK(default_array() > 0);
}
