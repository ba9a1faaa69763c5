#include "formats/models/envelope_mesh.h"
#include "formats/models/model_kind.h"
#include "fuzzing.h"

using namespace bough;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view content = fuzzing::content_of(data, size);
    const std::optional<AssimpKind> kind = model_kind(content);
    if (kind != AssimpKind::gltf && kind != AssimpKind::glb) return 0;
    fuzzing::is_read(content, [](std::string_view bytes) {
        const EnvelopeMesh mesh = triangles_of_gltf(bytes, "", "file");
        for (const Triangle& triangle : mesh.triangle)
            for (const auto vertex : triangle)
                if (std::size_t(vertex) >= mesh.vertex.size())
                    fuzzing::fail("a triangle of a vertex that is not there");
    });
    return 0;
}
