// near_pairs.h: which parts of free bodies may meet which bodies of the trees in a step, for all free bodies at once. This is the broad phase of the
// search for contacts (contact.h) where many fly.
//
// A single free body is looked for along the tree (subtree.h), in about a thousand tests where it flies within a crown. Hundreds are looked for the
// other way round. The boxes that their parts pass through go into a grid of cells, and each body of the trees looks into the cells that its own box
// passes through. Boxes hold what moves through them from the step's start to its end. They are wider by the error that angles in float may have, so
// that no meeting is lost: the result is that of looking at every body. Bodies look in blocks, which threads share out. The pairs are sorted, so
// nothing depends on who found them.
// Cost: O(bodies + cells that boxes overlap) a step, however many free bodies there are; 28 bytes a body.
#pragma once
#include "../model/tree.h"
#include "../plan/state.h"
#include "free_body.h"
#include "subtree.h"
#include <optional>

namespace bough {

struct NearPair {
    std::uint32_t free, rank, part; // rank: of the tree's body, in the order in which a search along the tree comes by
};

template <class T> class NearPairs {
public:
    // Called before a step whose pairs are asked for. Notes where the bodies stand, unless that is known. Presents the state.
    void begin(const Plan<T>&, State<T>&, const Tree&, const Subtrees&);
    // Called after the step. Returns the pairs by free body, rank and part, until the next call. ends[k]: where free body k would be at the step's
    // end; empty: it is not looked for. Bodies without contacts are left out: free bodies at rest, trees' bodies that fell, leaves unless
    // contact.leaves.
    // Called again after the same step, it takes the trees as they stand after it, all the way. Presents the state.
    const std::vector<NearPair>& find(const Plan<T>&, State<T>&, const Tree&, const Contact& contact,
                                      const std::vector<FreeBody>& free,
                                      const std::vector<std::optional<FreeMotion>>& ends);
    void forget() { at_ = -1; } // the state was set from outside
    std::size_t body_of(std::uint32_t rank) const { return order_[rank]; }
    std::size_t bytes() const;

private:
    struct Ends {
        Vector3<float> a, b; // [m] of a capsule's axis, world
    };
    struct Box {
        Vector3<float> low, high; // [m]
    };
    struct PartBox {
        Box box;
        std::uint32_t free, part;
    };
    using Cell = Eigen::Array3i;

    static Box box_of(const Ends& from, const Ends& to, double radius);
    static bool finite(const Box&);
    void add_parts(const FreeBody&, std::size_t k, const FreeMotion& end);
    void make_grid();
    Cell cell_at(const Vector3<float>&) const;
    template <class Visit> void visit_cells(const Box&, Visit&&) const;
    void look(std::uint32_t rank, const Box&, std::vector<NearPair>&) const;
    Ends ends_of(const State<T>&, const Tree&, std::size_t body) const;

    std::vector<std::uint32_t> order_; // bodies by rank
    std::vector<Ends> ends_;           // by rank
    std::int64_t at_ = -1;             // the state's step that they are of
    std::vector<PartBox> parts_;
    Box all_;                                    // of the parts together
    float size_ = 1;                             // [m] of a cell
    Cell count_ = Cell::Ones();                  // of cells
    std::vector<std::uint32_t> first_, in_cell_; // parts of each cell
    std::vector<std::vector<NearPair>> found_;   // of each block of bodies
    std::vector<NearPair> pairs_;
};

} // namespace bough
