// main.js: the page begins: what the browser must have, the Worker with the library, the first scene.
import { stateOfAddress } from './address.js';
import { App } from './app.js';
import { builtinState, first } from './builtins.js';
import { Client } from './client.js';
import { problem } from './messages.js';
import { View } from './view.js';

// A module of one function that adds two vectors: whether the browser takes it says whether it has SIMD.
const simd = Uint8Array.of(0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15, 253, 98, 11);

function lacking() {
    if (typeof WebAssembly !== 'object' || !WebAssembly.validate(simd))
        return 'This browser has no WebAssembly SIMD, which bough is compiled for (Chrome and Edge 91, Firefox 89, Safari 16.4 have it).';
    if (!document.createElement('canvas').getContext('webgl2'))
        return 'This browser gives no WebGL2 picture: it is switched off, or the graphics driver is not known to it (chrome://gpu, about:support say why).';
    if (typeof CompressionStream !== 'function')
        return 'This browser has no CompressionStream, with which the address holds the scene (Chrome and Edge 103, Firefox 113, Safari 16.4 have it).';
    return null;
}

const inside = globalThis.boughInside, begun = globalThis.boughBegun;

// The library: compiled, or as bytes where the page is one file.
async function library() {
    if (inside) return { bytes: Uint8Array.from(atob(inside.wasm), (c) => c.charCodeAt(0)).buffer };
    if (!begun) throw new Error('a browser lets no page read files beside it; open bough_live.html, which has all in one, or run tools/live/live');
    const { module, error } = await begun.wasm;
    if (error) throw new Error(`bough.wasm could not be read: ${error.message}`);
    return { module };
}

function worker() {
    return new Worker(inside ? URL.createObjectURL(new Blob([inside.worker], { type: 'text/javascript' })) : 'worker.js');
}

// The trees that are about to be shown, as far as they are grown: the Worker makes them while the page's own things are made.
async function firstTrees() {
    const state = await stateOfAddress().catch(() => null);
    if (!state && new URLSearchParams(location.search).has('open')) return [];
    return (state ?? builtinState(first)).trees.filter(({ species }) => species);
}

async function begin() {
    const times = { read: performance.now() }, now = (what) => () => { times[what] = performance.now(); }; // ms since the address was opened
    const missing = lacking();
    if (missing) return problem(missing);
    try {
        const wasm = await library();
        now('compiled')();
        const client = new Client(begun?.worker ?? worker());
        const started = client.ask('start', wasm);
        client.ask('prepare', { trees: await firstTrees() }).then(now('grown'), () => {}); // start says what is wrong
        const view = new View(document.getElementById('picture'));
        now('view')();
        const known = await started;
        const another = async () => {
            const client = new Client(worker());
            await client.ask('start', wasm);
            return client;
        };
        const app = globalThis.bough = new App({ client, view, known, another, times });
        await app.begin();
    } catch (error) {
        console.error(error, error.inWorker);
        problem(`The page could not begin: ${error.message}`);
    }
}

begin();
