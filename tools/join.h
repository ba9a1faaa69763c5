// join.h: treesim join: the parts that --shard made, put together into what the whole scene gives.
//
// Motions become one motion, frame by frame, so that no more than a frame of each (of JSON: the whole part) is in memory; in each, bodies
// stand in the scene's order. Saved states become the hash of the whole run. The parts may come in any order; all of them must be there, and belong
// together.
#pragma once
#include "common.h"

namespace bough {

struct JoinOptions {
    std::vector<std::string> parts;
    bool hash = false;
};

// format: jsonl, json or safetensors. Returns the line with the hash, empty of motions. Throws UsageError, InputError, OutputError.
std::string join_parts(const JoinOptions&, const CommonOptions&, const std::string& format);

} // namespace bough
