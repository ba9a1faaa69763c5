// main.js: the page begins: what the browser must have, the Worker with the library, the first scene.
import { App } from './app.js';
import { Client } from './client.js';
import { problem } from './messages.js';

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

async function wasmBytes() {
    const inside = globalThis.boughInside?.wasm;
    if (inside) return Uint8Array.from(atob(inside), (c) => c.charCodeAt(0)).buffer;
    const answer = await fetch('bough.wasm').catch((error) => {
        throw new Error(location.protocol === 'file:'
            ? 'a browser lets no page read files beside it; open bough_live.html, which has all in one, or run tools/live/live'
            : `bough.wasm could not be read: ${error.message}`);
    });
    if (!answer.ok) throw new Error(`bough.wasm: the server answers ${answer.status}, expected the file beside the page`);
    return answer.arrayBuffer();
}

function worker() {
    const inside = globalThis.boughInside?.worker;
    return new Worker(inside ? URL.createObjectURL(new Blob([inside], { type: 'text/javascript' })) : 'worker.js');
}

async function begin() {
    const missing = lacking();
    if (missing) return problem(missing);
    try {
        const wasm = await wasmBytes();
        const another = async () => {
            const client = new Client(worker());
            return { client, known: await client.ask('start', { wasm }) };
        };
        const { client, known } = await another();
        const app = globalThis.bough = new App(client, known, async () => (await another()).client);
        await app.begin();
    } catch (error) {
        console.error(error, error.inWorker);
        problem(`The page could not begin: ${error.message}`);
    }
}

begin();
