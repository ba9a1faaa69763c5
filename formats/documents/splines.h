// splines.h: the splines document, "bough-splines" (formats/documents/README.md), JSON or safetensors by content.
#pragma once
#include "formats/open.h"
#include "lib/model/splines.h"

namespace bough {

bool is_splines(std::string_view content);                               // looks at the head only
Splines read_splines(std::string_view content, const std::string& name); // checked; throws InputError
void write_splines(Output&, const Splines&, Form);

} // namespace bough
