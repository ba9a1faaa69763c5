// mtg_code.h: the text of a multiscale tree graph (MTG, of AMAPmod and OpenAlea) as vertices in the order of the file,
// each with the vertex it comes from; what columns mean is left to mtg.cpp. A line is a vertex: its last entity, which
// alone can have features.
//
// A file has the sections CODE, CLASSES (a letter and its scale), DESCRIPTION, FEATURES and MTG, whose first line is
// ENTITY-CODE or TOPO and the names of features, each on a column of its own. A line of code is indented by tabs and
// strings entities together: an edge, '/' (is a part of), '<' (goes on) or '+' (branches off), a class, an index; "<<"
// stands for all indices up to this one. The features of a line are those of its last entity. A line goes on from the last
// entity of the line before with its indentation if it begins with '^' or '<', else from where that line began. This is the
// reading of openalea.mtg (io.py). Lines that begin with '*' are the same entity at another date.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace bough::mtg {

struct Vertex {
    // Vertex it comes from: for '<' and '+' of its own or a finer scale, for '/' the whole; -1: none
    std::int32_t from = -1;
    std::size_t line = 0;
    std::string_view row; // the line, for the last entity of it; else empty
};

struct File {
    std::vector<std::string_view> features; // names, in the order of columns
    std::size_t first_feature = 0;          // cell of the first, counted by tabs
    std::size_t line_of_features = 0;
    std::vector<Vertex> vertices;
    std::size_t entities = 0, dates = 0; // entities: with those that "<<" stands for; dates: lines left out
};

// Throws InputError FILE:LINE for a missing section, an unknown class, a broken string or indentation. O(size).
File parse(std::string_view content, const std::string& name);

// The cell of a feature in a vertex' row, trimmed; empty where the row ends before.
std::string_view cell(const File&, const Vertex&, std::size_t feature);

} // namespace bough::mtg
