#include "formats/imports/speedtree_mesh.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzzing::is_read(fuzzing::content_of(data, size), [](std::string_view content) {
        speedtree::has_mesh(content);
        const speedtree::File file = speedtree::parse(content, "file");
        speedtree::parse_mesh(content, "file", file.bones, Eigen::Affine3d::Identity());
    });
    return 0;
}
