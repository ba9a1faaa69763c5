// save.js: what goes out: the scene with its trees for treesim, the motion as .glb.
import { sceneDocument, treeFile } from './document.js';
import { progress } from './messages.js';
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

// In a Worker of its own, so that what is shown goes on, with the trees made again there. Its size [B], or null where it was given up.
export async function saveMotion(app, { seconds, loop }) {
    while (app.applying) await app.applying;
    const { state } = app, fps = 30;
    const { files, posed } = await app.client.ask('sources');
    const given = { up: false }, sign = progress('Motion: making the trees …', () => {
        given.up = true;
        client?.end();
    });
    let client;
    try {
        client = await app.another();
        client.progress = ({ done, of }) => sign.say(of > 0 ? `Motion: ${Math.round(100 * done / of)} % written` : `Motion: ${(done / fps).toFixed(0)} s run until it repeats`);
        if (given.up) return null;
        for (const file of files) await client.ask('file', file, [file.bytes]);
        await client.ask('apply', { state: { ...state, trees: state.trees.map((source) => source.of ?? source) }, restart: true });
        for (const tree of posed) await client.ask('posed', tree);
        if (posed.length > 0) await client.ask('apply', { state, restart: true });
        const { bytes } = await client.ask('glb', { seconds, loop, fps });
        download(loop ? 'loop.glb' : 'motion.glb', new Blob([bytes], { type: 'model/gltf-binary' }));
        return bytes.length;
    } catch (error) {
        if (given.up) return null;
        throw error;
    } finally {
        client?.end();
        sign.end();
    }
}
