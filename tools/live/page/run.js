// run.js: one run of the page's scene in the Worker: its trees, its scene document, its simulation, its mesh.
import { sceneDocument, shapeOf, sourceKey, windVector } from './document.js';
import { Clock } from './clock.js';
import { Estimate } from './estimate.js';
import { Hands } from './hands.js';

const sides = 8; // of the thickest tube

export class Run {
    constructor(library) {
        this.library = library;
        this.files = new Map(); // id -> { name, bytes, used }
        this.trees = new Map(); // key of a source -> { tree, model, notes, used: by a run }
        this.kept = 0;
        this.scene = this.simulation = this.mesh = 0;
        this.number = 0; // of runs that began: the bodies of another are others
        this.hands = new Hands(this);
        this.clock = new Clock();
        this.estimate = new Estimate(this);
    }

    addFile(id, name, bytes) {
        this.files.set(id, { name, bytes: new Uint8Array(bytes) });
    }

    // Trees that a state is about to have; what is wrong with one that state says.
    prepare(sources) {
        for (const source of sources) {
            try {
                this.tree(source);
            } catch { /* apply() meets it again */ }
        }
    }
    tree(source) {
        const key = sourceKey(source);
        const found = this.trees.get(key);
        if (found) return Object.assign(found, { used: true });
        let made;
        if (source.kept) throw new Error('the pose that was kept is no longer in memory');
        if (source.species) {
            const tree = this.library.with(source.species, (name) => this.library.handle('grow', name, source.age ?? 0, source.bodies,
                source.seed, +source.leaves, +source.petals, +source.fruit));
            made = { tree, model: 0, notes: [], used: true };
        } else {
            const file = this.files.get(source.file);
            if (!file) throw new Error(`${source.name}: is not here; drop the file on the page again`);
            file.used = true;
            made = { ...this.library.readTree(file.bytes, file.name, source), used: true };
            made.cuttable = made.notes.length > 0; // a curve's file says what it is, and is cut to bodies here; a tree document has its own
        }
        this.trees.set(key, made);
        return made;
    }

    // The state from now on. What can change while it runs is changed; for all else a new run takes the motion over, but with restart. Where
    // something of it fails, all stays as it was.
    apply(state, restart) {
        const trees = state.trees.map((source) => this.tree(source));
        const change = restart || !this.simulation ? 'all' : changed(this.state, state);
        const notes = trees.flatMap((tree) => tree.notes);
        const shape = shapeOf(state), drawn = shape !== this.shape, others = drawn && change === 'all';
        if (change !== 'nothing' || drawn) this.#renew(state, trees, change, { restart, drawn });
        this.state = state;
        this.shape = shape;
        if (change === 'all') this.#begin(state, restart, others);
        if (change === 'all' || drawn) this.library.call('take_poses', this.mesh, this.simulation, 0);
        const mesh = drawn ? this.#shown() : null;
        return {
            notes, mesh, begun: restart || others, cuttable: trees.length > 0 && trees.every((tree) => tree.cuttable),
            bodies: this.bodies.count,
            transfer: mesh ? [mesh.vertex.buffer, mesh.color.buffer, mesh.index.buffer] : [],
        };
    }

    #renew(state, trees, change, { restart, drawn }) {
        const { library } = this, made = {};
        try {
            made.scene = this.#sceneOf(state, trees);
            if (change === 'wind') {
                const { wind } = state;
                library.call('set_wind', this.simulation, ...windVector(wind), wind.turbulence, wind.gustFactor, wind.gustPeriod, wind.seed);
            } else if (change === 'gravity') {
                library.call('set_gravity', this.simulation, state.gravity);
            } else if (change === 'all') {
                made.simulation = library.handle('simulate', made.scene, 1 / state.rate, state.precision === 'double' ? 1 : 0,
                    restart ? 0 : this.simulation);
                if (state.gravity !== state.drawnGravity) library.call('set_gravity', made.simulation, state.gravity);
            }
            if (drawn) made.mesh = this.#meshOf(state, trees, made.simulation ?? this.simulation, made.scene);
        } catch (error) {
            Object.values(made).forEach((handle) => library.release(handle));
            throw error;
        }
        this.estimate.drop();
        for (const [what, handle] of Object.entries(made)) {
            library.release(this[what]);
            this[what] = handle;
        }
    }
    #begin(state, restart, others) {
        this.bodies = this.library.bodies(this.simulation);
        this.clock.begin(1 / state.rate, restart);
        this.hands.begin(restart, others);
        if (restart) this.time = 0;
        if (restart || others) ++this.number;
    }

    #sceneOf(state, trees) {
        const { library } = this;
        const scene = library.with(JSON.stringify(sceneDocument(state)),
            (json, size) => library.with('scene', (name) => library.handle('scene', json, size - 1, name)));
        try {
            state.places.forEach((place, k) => library.call('put', scene, k, trees[place.tree].tree));
        } catch (error) {
            library.release(scene);
            throw error;
        }
        return scene;
    }

    // The mesh shows trees as they were first drawn; a pose that is kept moves the same one.
    #meshOf(state, trees, simulation, scene) {
        const model = state.places.length === 1 && state.ownMesh ? trees[0].model : 0;
        return this.library.handle('mesh', simulation, scene, model, sides);
    }
    #shown() {
        const { parent, kind, size, first } = this.bodies;
        return { ...this.library.meshArrays(this.mesh), parent, kind, size, first };
    }

    // Of trees and files those stay that the page can come back to: `known`, sources of all its history. Trees that can be made again stay where
    // they are `near`. What no run has had yet is about to have one.
    retain({ known, near }) {
        const own = this.state?.trees ?? [], keys = (sources) => new Set([...sources, ...own].map(sourceKey));
        const all = keys(known), soon = keys(near);
        for (const [key, made] of this.trees) {
            if (!made.used || soon.has(key) || (key.startsWith('kept ') && all.has(key))) continue;
            this.library.release(made.tree);
            this.library.release(made.model);
            this.trees.delete(key);
        }
        const files = new Set([...known, ...own].map((source) => (source.of ?? source).file));
        const gone = [...this.files].filter(([id, { used }]) => used && !files.has(id)).map(([id]) => id);
        gone.forEach((id) => this.files.delete(id));
        return { gone };
    }

    // Steps for so many seconds of the page's time, poses into the buffer, and what the meters show.
    frame({ seconds, single, buffer, targets }) {
        const { library, clock } = this;
        if (!this.simulation) return { poses: buffer, transfer: [buffer] };
        const said = { fast: 0, guarded: 0, broke: 0 };
        const steps = single ? clock.single() : clock.steps(seconds);
        this.hands.aim(targets, steps);
        for (let k = 0; k < steps; ++k) {
            const start = performance.now();
            const report = library.step(this.simulation);
            clock.took(performance.now() - start);
            for (const key in said) said[key] += report[key];
            library.call('take_poses', this.mesh, this.simulation, 1);
            this.time = report.time;
        }
        clock.spareTime(() => this.estimate.work());
        const count = this.bodies.count, at = library.allocate(32 * count);
        library.call('write_poses', this.mesh, clock.fraction(), at);
        const poses = buffer.byteLength === 32 * count ? new Float32Array(buffer) : new Float32Array(8 * count);
        poses.set(library.floats(at, 8 * count));
        library.free(at);
        return {
            poses: poses.buffer, time: this.time ?? 0, steps, ...said, ...clock.said(), estimate: this.estimate.found,
            hands: this.hands.forces(), lost: this.hands.lost(), transfer: [poses.buffer],
        };
    }

    // For tests: where bodies are, in the numbers of the run; what is held in memory.
    positions() {
        return this.library.positions(this.simulation);
    }
    memory() {
        return { ...this.library.memory(), trees: this.trees.size, files: this.files.size, hands: this.hands.all.size };
    }

    pick(ray, aperture) {
        const hit = this.simulation ? this.library.pick(this.simulation, ray, aperture) : null;
        return hit && { ...hit, run: this.number };
    }

    // The tree of each place as it stands now, as sources that apply() knows.
    keepPose() {
        const { library, state } = this;
        const sources = state.places.map(({ tree }) => state.trees[tree]);
        const made = [];
        try {
            state.places.forEach(({ yaw }, place) => made.push({
                tree: library.handle('posed_tree', this.simulation, place, this.tree(sources[place]).tree, yaw), model: 0, notes: [],
            }));
        } catch (error) {
            made.forEach(({ tree }) => library.release(tree));
            throw error;
        }
        return sources.map((source, k) => {
            const kept = { kept: ++this.kept, of: source.kept ? source.of : source };
            this.trees.set(sourceKey(kept), made[k]);
            return kept;
        });
    }

    // What another Worker needs to have the same trees: files, and poses that were kept as documents.
    sources() {
        const { trees } = this.state, ids = new Set(trees.map((source) => (source.of ?? source).file).filter((id) => id));
        return {
            files: [...ids].map((id) => ({ id, name: this.files.get(id).name, bytes: this.files.get(id).bytes.slice().buffer })),
            posed: trees.filter(({ kept }) => kept).map((source) => ({ source, bytes: this.library.taken('tree_document', this.tree(source).tree) })),
        };
    }
    addPosed(source, bytes) {
        this.trees.set(sourceKey(source), this.library.readTree(bytes, 'pose', {}));
    }

    // Each tree as a document, in safetensors.
    documents() {
        const all = this.state.trees.map((source) => this.library.taken('tree_document', this.tree(source).tree));
        return { trees: all, transfer: all.map((bytes) => bytes.buffer) };
    }

    glb({ seconds, fps, loop }) {
        const { state } = this;
        const steps = Math.max(1, Math.round(state.rate / fps));
        const frames = Math.max(2, Math.round(seconds * fps) + (loop ? 0 : 1));
        const bytes = this.library.taken('glb', this.scene, this.mesh, 1 / (fps * steps), state.precision === 'double' ? 1 : 0, fps,
            steps, frames, +loop);
        return { bytes, transfer: [bytes.buffer] };
    }
}

// 'nothing', 'wind', 'gravity' or 'all': what is different of two states.
function changed(before, after) {
    const rest = ({ wind, gravity, ...others }) => JSON.stringify(sceneDocument({ ...others, wind: {}, gravity: 0 })) +
        JSON.stringify([others.trees, others.places, others.rate, others.precision, wind.blows]);
    if (rest(before) !== rest(after)) return 'all';
    const wind = JSON.stringify(before.wind) !== JSON.stringify(after.wind), gravity = before.gravity !== after.gravity;
    return wind && gravity ? 'all' : wind ? 'wind' : gravity ? 'gravity' : 'nothing';
}
