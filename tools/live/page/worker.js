// worker.js: the Worker: answers calls [number, name, arguments] with [number, error, result], in order. Number 0: how far a long one is.
import { Library, LibraryError } from './wasm.js';
import { Run } from './run.js';

let run = null;

const answers = {
    async start(wasm) {
        const library = await Library.open(wasm, (done, of) => postMessage([0, null, { done, of }]));
        run = new Run(library);
        return {
            species: library.names('species'),
            materials: library.names('materials'),
            presets: Object.fromEntries(['calm', 'breeze', 'gusty', 'storm'].map((name) => [name, library.windPreset(name)])),
        };
    },
    prepare: ({ trees }) => run.prepare(trees),
    apply: ({ state, restart }) => run.apply(state, restart),
    checkScene: ({ bytes, name }) => run.library.checkScene(new Uint8Array(bytes), name),
    file: ({ id, name, bytes }) => run.addFile(id, name, bytes),
    frame: (asked) => run.frame(asked),
    pick: ({ ray, aperture }) => run.pick(ray, aperture),
    grab: ({ hand, body, point, run: number }) => run.hands.grab(hand, body, point, number),
    letGo: ({ hand }) => run.hands.letGo(hand),
    curve: ({ x, y, from, to, samples }) => run.library.curve(x, y, from, to, samples),
    keep: () => run.keepPose(),
    retain: (sources) => run.retain(sources),
    documents: () => run.documents(),
    sources: () => run.sources(),
    posed: ({ source, bytes }) => run.addPosed(source, bytes),
    glb: (asked) => run.glb(asked),
    positions: () => run.positions(),
    memory: () => run.memory(),
};

let last = Promise.resolve();
onmessage = ({ data }) => { last = last.then(() => answer(data)); };

async function answer([number, name, asked]) {
    try {
        const result = await answers[name](asked ?? {});
        const transfer = result?.transfer ?? [];
        if (result) delete result.transfer;
        postMessage([number, null, result], transfer);
    } catch (error) {
        const known = error instanceof LibraryError;
        postMessage([number, { message: error.message, known, stack: known ? '' : error.stack }]);
    }
}
