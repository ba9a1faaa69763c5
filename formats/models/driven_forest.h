// driven_forest.h: a user's own model once for each of several trees that move it, and such models together, as one glTF document.
//
// Each tree has the model's nodes and skins for itself, under a node that stands where the scene puts the tree; meshes, materials, textures and their
// arrays are shared (joined_gltf.h). The motions of all are one animation, "motion", the first.
#pragma once
#include "driven_model.h"

namespace bough {

// A tree whose bodies move a model.
struct DrivenStand {
    std::string name;
    Tree tree; // drawn where the scene puts it
    DrivenPlace place;
};

class DrivenForest {
public:
    // Takes the model's document for itself. options: place is each tree's own. Throws as DrivenModel does. Notes: its, once.
    DrivenForest(UserModel, const std::vector<DrivenStand>&, DrivenOptions, std::vector<std::string>& notes);
    std::size_t trees() const { return stand_.size(); }
    // The next frame of tree k, which its own motion is.
    void write(std::size_t k, const MotionFrame& frame) { stand_[k].write(frame); }
    // Behind what a document draws, and its animation "motion" with that one's. Once.
    void join_to(GltfDocument&);
    std::size_t bones() const;        // of all trees
    std::size_t keys() const;         // of all bones and frames
    std::size_t keys_written() const; // of these, once joined

private:
    UserModel model_;
    DrivenOptions options_;
    std::vector<std::string> name_;
    std::vector<DrivenPlace> place_;
    std::vector<DrivenModel> stand_;
};

// A .glb, as bytes, with the forests behind what it draws: a .glb of ours, "" for none. Throws InputError for a model that cannot be put beside
// others, OutputError beyond 4 GiB.
std::string glb_with(const std::string& glb, std::vector<DrivenForest>&, const std::string& generator,
                     const std::string& source, const std::string& output_name);

} // namespace bough
