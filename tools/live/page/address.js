// address.js: the scene in the page's address: what differs from the defaults, as JSON, deflated, in base64 that an address bears. A file that was
// dropped is in it by its name alone, a pose that was kept as the tree it was made of.
import { check } from './shape.js';
import { defaults } from './state.js';

const longest = 2000; // characters, which every program passes on

async function through(bytes, stream) {
    return new Uint8Array(await new Response(new Blob([bytes]).stream().pipeThrough(stream)).arrayBuffer());
}

function difference(state, from) {
    const entries = Object.entries(state).filter(([key, value]) => JSON.stringify(value) !== JSON.stringify(from[key]));
    return Object.fromEntries(entries);
}

// Puts the scene into the address; whether it fits. Where it does not the address stays as it was, and the tab's history has the scene for when it is
// loaded again.
export async function updateAddress(state) {
    const own = difference(state, defaults);
    own.trees = state.trees.map((source) => source.kept ? source.of : source);
    const bytes = await through(new TextEncoder().encode(JSON.stringify(own)), new CompressionStream('deflate-raw'));
    const text = '#s=' + btoa(String.fromCharCode(...bytes)).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
    const fits = text.length <= longest;
    history.replaceState(fits ? null : { scene: own }, '', fits ? text : location.href);
    return fits;
}

async function sceneIn(hash) {
    try {
        const bytes = Uint8Array.from(atob(hash.slice(3).replaceAll('-', '+').replaceAll('_', '/')), (c) => c.charCodeAt(0));
        return JSON.parse(new TextDecoder().decode(await through(bytes, new DecompressionStream('deflate-raw'))));
    } catch {
        throw new Error('holds no scene that can be read (it was cut off, or changed)');
    }
}

// Null where there is none. Throws for an address that holds no scene.
export async function stateOfAddress() {
    try {
        const { hash } = location;
        const own = history.state?.scene ?? (hash.startsWith('#s=') ? await sceneIn(hash) : undefined);
        if (own === undefined) return null;
        check(own, { open: {} });
        const state = { ...structuredClone(defaults), ...own };
        if (own.wind instanceof Object) state.wind = { ...defaults.wind, ...own.wind };
        check(state);
        return state;
    } catch (error) {
        throw new Error(`The address: ${error.message}`);
    }
}
