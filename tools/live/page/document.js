// document.js: the page's state as a bough-scene document, which treesim reads too, and back.

const rad = Math.PI / 180;

// What a source of a tree is told by. A file's bytes stand elsewhere, by its id.
export const sourceKey = (source) => source.kept ? `kept ${source.kept}` : JSON.stringify(source);

// What is drawn of a state: trees where they stand, as first drawn. A pose that was kept has the shape it was made of.
export const shapeOf = (state) => JSON.stringify([
    state.places.map(({ tree, position, yaw }) => [sourceKey(state.trees[tree].of ?? state.trees[tree]), position, yaw]),
    state.ownMesh,
]);

export const treeFile = (number) => `trees/tree_${number + 1}.safetensors`;

export function windVector({ speed, direction, rise }) {
    return [speed * Math.cos(direction * rad), rise, -speed * Math.sin(direction * rad)];
}

function curvesOf(state) {
    const curves = [];
    const { keys } = state.curves;
    const own = (values) => values.map((value) => Math.max(1e-6, value));
    if (keys.stiffness.length > 0)
        curves.push({ radius: keys.stiffness.map(([r]) => r), stiffness: own(keys.stiffness.map(([, f]) => f)), relative: true });
    if (keys.damping.length > 0)
        curves.push({ radius: keys.damping.map(([r]) => r), damping: keys.damping.map(([, f]) => f), relative: true });
    for (const part of state.parts)
        curves.push({
            on: { tree: part.place, body: part.body },
            radius: [0], stiffness: [part.stiffness], damping: [part.damping], relative: true,
        });
    return curves;
}

// gravity: that of the drawn pose; what it was changed to while it ran is the run's alone.
export function sceneDocument(state, gravity = state.drawnGravity) {
    const { wind } = state;
    const document = { format: 'bough-scene', version: 1, ...state.base };
    document.trees = state.places.map(({ tree, position, yaw, start }) => ({ file: treeFile(tree), position, yaw, start: start ?? 0 }));
    document.gravity = [0, -gravity, 0];
    if (wind.blows !== false)
        document.wind = {
            ...state.base.wind, velocity: windVector(wind), turbulence: wind.turbulence, gust_factor: wind.gustFactor,
            gust_period: wind.gustPeriod, seed: wind.seed,
        };
    document.stiffness_scale = state.stiffness;
    document.damping_scale = state.damping;
    const curves = [...(state.base.wood?.curves ?? []), ...curvesOf(state)];
    if (state.base.wood || curves.length > 0) document.wood = { ...state.base.wood, curves };
    if (state.strength > 0) document.fracture = { ...state.base.fracture, strength: 1e6 * state.strength };
    const moves = {};
    if (state.least > 0) moves.radius = state.least;
    if (state.levels > 0) moves.last_level = state.levels - 1;
    if (state.only.length > 0) moves.subtrees = state.only.map(({ place, body }) => ({ tree: place, body }));
    if (Object.keys(moves).length > 0) document.simulate = { ...state.base.simulate, ...moves };
    return document;
}

// A scene document of another's, which the library has read: what the page has controls for becomes theirs, all else stays as it is. treeOf(file):
// the number of that tree in `trees`, which the caller has found. presets: the library's winds that have a name.
export function stateOfScene(document, trees, treeOf, { defaults, presets }) {
    const { trees: entries = [], gravity = [0, -9.81, 0], wind, stiffness_scale, damping_scale, ...base } = document;
    delete base.format;
    delete base.version;
    const places = entries.flatMap(({ file, places: several, ...own }) => (several ?? [own]).map((place) => ({
        tree: treeOf(file), position: place.position ?? [0, 0, 0], yaw: place.yaw ?? 0, start: place.start ?? 0,
    })));
    if (Math.hypot(gravity[0], gravity[2]) > 0)
        throw new Error('/gravity: does not point down, which this page has no control for');
    const state = {
        ...structuredClone(defaults), trees, places, base,
        gravity: -gravity[1], drawnGravity: -gravity[1],
        stiffness: stiffness_scale ?? 1, damping: damping_scale ?? 1,
    };
    const taken = (section, field, otherwise = 0) => { // from the document, and where that leaves an empty section, with it
        const value = base[section]?.[field];
        if (value === undefined) return otherwise;
        const { [field]: _, ...others } = base[section];
        if (Object.keys(others).length > 0) base[section] = others;
        else delete base[section];
        return value;
    };
    state.strength = taken('fracture', 'strength') / 1e6;
    state.least = taken('simulate', 'radius');
    state.levels = taken('simulate', 'last_level', -1) + 1;
    const bodies = base.simulate?.subtrees?.every(({ body, point, ...on }) => body !== undefined && !point && Object.keys(on).every((key) => key === 'tree'));
    if (bodies) state.only = taken('simulate', 'subtrees').map(({ tree, body }) => ({ place: tree ?? 0, body }));
    state.wind = windOf(wind, base, presets);
    return state;
}

// A wind by its preset's name, by its fields, or none: then nothing has drag, until the user has it blow. What has no control goes to `base`.
function windOf(wind, base, presets) {
    const usual = { speed: 0, direction: 0, rise: 0, turbulence: 0, gustFactor: 1, gustPeriod: 6, seed: 1 };
    if (wind === undefined) return { ...usual, blows: false };
    if (typeof wind === 'string') return { ...usual, ...presets[wind] };
    const { velocity, turbulence = 0, gust_factor: gustFactor = 1, gust_period: gustPeriod = 6, seed = 1, ...others } = wind;
    if (Object.keys(others).length > 0) base.wind = others;
    const [x, y, z] = velocity, direction = Math.atan2(-z, x) / rad;
    return { speed: Math.hypot(x, z), direction: direction < 0 ? direction + 360 : direction, rise: y, turbulence, gustFactor, gustPeriod, seed };
}
