// save.js: what goes out: the scene with its trees for treesim, the motion as .glb, the address.
import { addressOf } from './address.js';
import { sceneDocument, treeFile } from './document.js';
import { zipOf } from './zip.js';

function download(name, blob) {
    const link = Object.assign(document.createElement('a'), { href: URL.createObjectURL(blob), download: name });
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

const notes = (state) => `The scene of this folder, as the page began it (after "Restart"):

    treesim scene.json --fps ${state.rate} --precision ${state.precision} --settle 0 --seconds 4 -o motion.glb

scene.json        what stands where, wind, wood (bough-scene)
trees/            the trees, as they are drawn (bough-tree, safetensors)
${state.gravity !== state.drawnGravity ? '\nGravity was changed while it ran; the scene has the one under which the trees are drawn.\n' : ''}`;

export async function saveScene(app) {
    const { state, client } = app;
    const { trees } = await client.ask('documents');
    download('scene.zip', zipOf([
        ['scene.json', JSON.stringify(sceneDocument(state), null, 1) + '\n'],
        ...trees.map((bytes, k) => [treeFile(k), bytes]),
        ['README.txt', notes(state)],
    ]));
}

export async function saveMotion(app, { seconds, loop }) {
    const { bytes } = await app.client.ask('glb', { seconds, loop, fps: 30 });
    download(loop ? 'loop.glb' : 'motion.glb', new Blob([bytes], { type: 'model/gltf-binary' }));
    return bytes.length;
}

// Puts the scene into the address; whether it fits.
export async function updateAddress(state) {
    const hash = await addressOf(state);
    history.replaceState(null, '', hash ?? location.pathname + location.search);
    return hash !== null;
}
