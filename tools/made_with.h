// made_with.h: what a timing or a result was made with.
#pragma once

namespace bough {

const char* bough_version();
const char* compiler_name();  // "GNU 12.2.0"
const char* compiler_flags(); // of the library
const char* simd_target();    // what --simd auto takes: baseline, avx2, avx512, off

} // namespace bough
