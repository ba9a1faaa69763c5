#include "assimp_scene.h"
#include "collada_check.h"
#include "fbx_check.h"
#include <algorithm>
#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <optional>
#include <stdexcept>

namespace bough {
namespace {

const char* ending(AssimpKind kind) {
    switch (kind) {
    case AssimpKind::obj:
        return "obj";
    case AssimpKind::fbx:
        return "fbx";
    default:
        return "dae";
    }
}

// No other file is opened, whatever the content names (an OBJ its mtllib, of any path): colours are not asked for, and textures are found by us.
class NoFiles : public Assimp::IOSystem {
public:
    bool Exists(const char*) const override { return false; }
    char getOsSeparator() const override { return '/'; }
    Assimp::IOStream* Open(const char*, const char*) override { return nullptr; }
    void Close(Assimp::IOStream*) override {}
};

// Only the readers that take this ending stay: assimp would try others by a look at the content.
void keep_reader(Assimp::Importer& importer, const std::string& wanted) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* about = importer.GetImporterInfo(i);
        const std::string list = about && about->mFileExtensions ? " " + std::string(about->mFileExtensions) + " " : "";
        if (list.find(" " + wanted + " ") == std::string::npos) importer.UnregisterLoader(importer.GetImporter(i));
    }
}

std::optional<double> metadata(const aiScene& scene, const char* key) {
    if (!scene.mMetaData) return {};
    double real = 0;
    float single = 0;
    std::int32_t whole = 0;
    if (scene.mMetaData->Get(key, real)) return real;
    if (scene.mMetaData->Get(key, single)) return single;
    if (scene.mMetaData->Get(key, whole)) return whole;
    return {};
}

// Which file axis, with which sign, points right, up and to the viewer; unit in centimetres.
ModelFrame fbx_frame(const aiScene& scene) {
    Mat3 axes = Mat3::Zero();
    const char* const names[3][2] = {
        {"CoordAxis", "CoordAxisSign"}, {"UpAxis", "UpAxisSign"}, {"FrontAxis", "FrontAxisSign"}};
    for (int row = 0; row < 3; ++row) {
        const auto axis = metadata(scene, names[row][0]), sign = metadata(scene, names[row][1]);
        if (axis && *axis >= 0 && *axis <= 2) axes(row, static_cast<int>(*axis)) = sign && *sign < 0 ? -1 : 1;
    }
    ModelFrame frame;
    if (std::abs(axes.determinant()) > 0.5) frame.axes = axes;
    const double scale = metadata(scene, "UnitScaleFactor").value_or(1);
    frame.unit = scale > 0 ? 0.01 * scale : 0;
    return frame;
}

} // namespace

const aiScene* load_by_assimp(Assimp::Importer& importer, std::string_view content, AssimpKind kind, bool up_given) {
    const std::string wanted = ending(kind);
    if (kind == AssimpKind::dae) check_collada(content);
    if (kind == AssimpKind::fbx) check_fbx(content);
    keep_reader(importer, wanted);
    importer.SetIOHandler(new NoFiles); // the importer's own; it reads the content beside it
    importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, up_given);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    const unsigned flags = aiProcess_Triangulate;
    const aiScene* scene = importer.ReadFileFromMemory(content.data(), content.size(), flags, wanted.c_str());
    if (!scene || !scene->mRootNode) {
        std::string why = importer.GetErrorString();
        std::replace_if(
            why.begin(), why.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        throw std::runtime_error(why.empty() ? "no scene in it" : why);
    }
    return scene;
}

ModelFrame stated_frame(const aiScene& scene, AssimpKind kind) {
    if (kind == AssimpKind::fbx) return fbx_frame(scene);
    ModelFrame frame;
    if (kind != AssimpKind::obj) frame.unit = 1;
    return frame;
}

} // namespace bough
