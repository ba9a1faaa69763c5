// files.js: files that come in: trees of any program, a scene with its trees; dropped anywhere, or chosen.
import { builtinState, youngMaple } from './builtins.js';
import { stateOfScene } from './document.js';
import { check } from './shape.js';
import { defaults, withOtherTrees } from './state.js';
import { filesOfZip, isZip } from './zip.js';

const largest = 512e6; // bytes: beyond, a page has no memory for what is made of it

export class Files {
    // app: { client, state, opened(state, notes), problem(text) }
    constructor(app) {
        this.app = app;
        this.known = new Map(); // id -> name
        this.number = 0;
        const target = document.body;
        target.addEventListener('dragover', (event) => {
            event.preventDefault();
            target.classList.add('dropping');
        });
        target.addEventListener('dragleave', (event) => event.relatedTarget === null && target.classList.remove('dropping'));
        target.addEventListener('drop', (event) => {
            event.preventDefault();
            target.classList.remove('dropping');
            this.open([...event.dataTransfer.files]);
        });
    }
    choose() {
        const input = Object.assign(document.createElement('input'), { type: 'file', multiple: true });
        input.onchange = () => this.open([...input.files]);
        input.click();
    }
    async add(id, name, bytes) {
        await this.app.client.ask('file', { id, name, bytes });
        this.known.set(id, name);
        this.number = Math.max(this.number, parseInt(id) || 0); // an address brings its own
    }
    // One tree, or a scene with the trees that it names; several trees stand side by side.
    async open(files) {
        if (files.length === 0) return; // a text was dropped, or none was chosen
        try {
            await this.app.opened(await this.stateOf(files), { name: this.scene });
        } catch (error) {
            this.app.problem(error.message);
        }
    }
    async stateOf(files) {
        const read = [];
        for (const file of files) {
            if (file.size > largest) throw new Error(`${file.name}: has ${Math.round(file.size / 1e6)} MB, expected at most ${largest / 1e6}`);
            if (file.size === 0) throw new Error(`${file.name}: is empty, or a folder`);
            const bytes = await file.arrayBuffer();
            if (isZip(bytes)) read.push(...unpacked(file.name, bytes));
            else read.push({ name: file.name, bytes });
        }
        const scene = read.map(({ name, bytes }) => sceneOf(name, bytes)).find((found) => found);
        this.scene = scene?.name; // what the library says of it begins so
        return scene ? this.#stateOfScene(scene, read) : this.#stateOfTrees(read);
    }
    async #source({ name, bytes }) {
        const source = { file: `${++this.number} ${name}`, name };
        await this.add(source.file, name, bytes);
        return source;
    }
    async #stateOfTrees(read) {
        const trees = [];
        for (const file of read) trees.push(await this.#source(file));
        const across = 12; // m, between trees that come together
        const places = trees.map((_, k) => ({ tree: k, position: [across * (k - (trees.length - 1) / 2), 0, 0], yaw: 0, start: 0 }));
        return withOtherTrees(this.app.state, trees, places);
    }
    async #stateOfScene({ name, bytes, document }, read) {
        await this.app.client.ask('checkScene', { bytes, name });
        const bare = (path) => path.split(/[/\\]/).pop();
        const trees = [], numbers = new Map();
        for (const { file } of document.trees ?? []) {
            if (numbers.has(file)) continue;
            const found = read.find((one) => one.name === bare(file));
            if (!found) throw new Error(`${name}: /trees names '${file}', which was not dropped with it; drop the scene and its trees together`);
            numbers.set(file, trees.length);
            trees.push(await this.#source(found));
        }
        if (trees.length === 0) throw new Error(`${name}: /trees: is empty, expected at least one tree`);
        const { rate, precision, ownMesh } = this.app.state; // of which a scene says nothing
        try {
            const state = stateOfScene(document, trees, (file) => numbers.get(file), { defaults: { ...defaults, rate, precision, ownMesh }, presets: this.app.presets });
            check(state);
            return state;
        } catch (error) {
            throw new Error(`${name}: ${error.message.replace(/^\/wind\/(speed|rise)/, '/wind/velocity')}`);
        }
    }
    async builtin(name) {
        const state = builtinState(name);
        if (state.trees.some(({ file }) => file === youngMaple.file)) await this.needYoungMaple();
        return state;
    }
    async needYoungMaple() {
        if (this.known.has(youngMaple.file)) return;
        const inside = globalThis.boughInside?.youngMaple;
        const answer = inside ? null : await fetch(youngMaple.name);
        if (answer && !answer.ok) throw new Error(`${youngMaple.name}: the server answers ${answer.status}, expected the file beside the page`);
        await this.add(youngMaple.file, youngMaple.name, inside ? new TextEncoder().encode(inside).buffer : await answer.arrayBuffer());
    }
}

// Trees and scenes of an archive, as they would be dropped.
function unpacked(name, bytes) {
    try {
        const files = filesOfZip(bytes).filter(([file]) => !/(^|\/)README\.txt$/.test(file));
        if (files.length === 0) throw new Error('has no tree in it');
        return files.map(([file, content]) => ({ name: file.split('/').pop(), bytes: content }));
    } catch (error) {
        throw new Error(`${name}: ${error.message}`);
    }
}

// A scene document, or null; another document of ours is the library's to read.
function sceneOf(name, bytes) {
    const head = new TextDecoder().decode(bytes.slice(0, 4096));
    if (!/^\s*\{/.test(head) || !head.includes('bough-scene')) return null;
    try {
        const document = JSON.parse(new TextDecoder().decode(bytes));
        return document.format === 'bough-scene' ? { name, bytes, document } : null;
    } catch (error) {
        throw new Error(`${name}: is no JSON: ${error.message}`);
    }
}
