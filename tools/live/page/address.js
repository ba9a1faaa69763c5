// address.js: the scene in the page's address: what differs from the defaults, as JSON, deflated, in base64 that an address bears. A file that was
// dropped is in it by its name alone, a pose that was kept as the tree it was made of.
import { defaults } from './state.js';

const longest = 2000; // characters, which every program passes on

async function through(bytes, stream) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

function difference(state, from) {
    const entries = Object.entries(state).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(from[key]));
    return Object.fromEntries(entries);
}

export async function addressOf(state) {
    const own = difference(state, defaults);
    own.trees = state.trees.map((source) => source.kept ? source.of : source);
    const bytes = await through(new TextEncoder().encode(JSON.stringify(own)), new CompressionStream('deflate-raw'));
    const text = '#s=' + btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
    return text.length <= longest ? text : null;
}

const isNumber = (value) => typeof value === 'number' && Number.isFinite(value);

// Throws for an address that holds no scene.
export async function stateOfAddress(hash) {
    if (!hash.startsWith('#s=')) return null;
    let own;
    try {
        const bytes = Uint8Array.from(atob(hash.slice(3).replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
        own = JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw'))));
    } catch {
        throw new Error('The address holds no scene that can be read (it was cut off, or changed)');
    }
    const unknown = Object.keys(own).filter((key) => !(key in defaults));
    if (unknown.length > 0) throw new Error(`The address holds "${unknown[0]}", which this page does not know`);
    const state = { ...structuredClone(defaults), ...own, wind: { ...defaults.wind, ...own.wind } };
    const whole = Array.isArray(state.trees) && Array.isArray(state.places) && state.places.length > 0 &&
        state.places.every(({ tree, position }) => state.trees[tree] && Array.isArray(position) && position.every(isNumber)) &&
        ['gravity', 'stiffness', 'damping', 'strength', 'least', 'levels', 'rate'].every((key) => isNumber(state[key])) && Array.isArray(state.only);
    if (!whole) throw new Error('The address holds a scene without trees, or with something that is no number');
    return state;
}
