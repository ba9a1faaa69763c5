// state.js: what the page's scene is, as plain data: what undo goes back to, the address holds and a scene document is made of.

export const defaults = {
    trees: [], // sources: {species, age [years], bodies, seed, leaves, petals, fruit}, {file: id, name, material, maxBodies, unit} or {kept, of}
    places: [], // {tree: number in trees, position [m], yaw [deg], start [s]}
    base: {}, // fields of a scene document that the page has no controls for
    ownMesh: true, // a file's own mesh is shown where it has one
    wind: { speed: 4, direction: 0, rise: 0, turbulence: 0.15, gustFactor: 1.4, gustPeriod: 6, seed: 1 }, // m/s, deg from +x about the vertical, m/s upward; blows: false without air
    gravity: 9.81, // m/s^2
    drawnGravity: 9.81, // under which the drawn trees stand at rest
    stiffness: 1, damping: 1, // times the wood's own
    curves: { keys: { stiffness: [], damping: [] } }, // [radius m, factor] each, rising
    parts: [], // {place, body, stiffness, damping}: subtrees
    strength: 0, // MPa: wood breaks; 0: never
    least: 0, // m: thinner wood does not move by itself
    levels: 0, // of branches that move, 1 the trunks alone; 0: all
    only: [], // {place, body}: these subtrees alone move; none: all
    rate: 60, // steps a second
    precision: 'float',
};

export const copyOf = (state) => structuredClone(state);

// Other trees in the wind and of the wood that the user set; what belongs to the trees that were goes with them.
export function withOtherTrees(state, trees, places) {
    const { wind: { blows: _, ...wind }, gravity, drawnGravity } = state;
    const own = gravity === drawnGravity ? defaults.gravity : gravity;
    return { ...copyOf(state), trees, places, wind, base: {}, parts: [], only: [], gravity: own, drawnGravity: defaults.drawnGravity };
}

// The trees of files cut to so many bodies in all.
export function fewer(state, bodies) {
    const each = Math.max(20, Math.floor(bodies / state.places.length));
    return { ...copyOf(state), parts: [], only: [], trees: state.trees.map((source) => ({ ...(source.of ?? source), maxBodies: each })) };
}

const mostKept = 20; // poses in a history: each is a tree in memory

const keptIn = (states) => new Set(states.flatMap(({ trees }) => trees.filter(({ kept }) => kept).map(({ kept }) => kept))).size;

// States that were, and that were undone.
export class History {
    constructor(state) {
        this.past = [];
        this.future = [];
        this.present = copyOf(state);
    }
    add(state) {
        if (JSON.stringify(state) === JSON.stringify(this.present)) return false;
        this.past.push(this.present);
        while (this.past.length > 200 || keptIn(this.past) > mostKept) this.past.shift();
        this.future = [];
        this.present = copyOf(state);
        return true;
    }
    // What trees all of it has, and those of the states beside the present one.
    sources() {
        const of = (states) => states.flatMap(({ trees }) => trees);
        return { known: of([...this.past, this.present, ...this.future]), near: of([...this.past.slice(-1), this.present, ...this.future.slice(-1)]) };
    }
    undo() { return this.#go(this.past, this.future); }
    redo() { return this.#go(this.future, this.past); }
    #go(from, to) {
        if (from.length === 0) return null;
        to.push(this.present);
        this.present = from.pop();
        return copyOf(this.present);
    }
}

// Which bodies hang on one, itself among them.
export function subtreeOf(parent, body) {
    const inside = new Uint8Array(parent.length);
    inside[body] = 1;
    for (let i = body + 1; i < parent.length; ++i) if (parent[i] >= 0 && inside[parent[i]]) inside[i] = 1;
    return inside;
}
