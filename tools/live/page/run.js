// run.js: one run of the page's scene in the Worker: its trees, its scene document, its simulation, its mesh.
import { sceneDocument, shapeOf, sourceKey } from './document.js';
import { Clock } from './clock.js';
import { Estimate } from './estimate.js';
import { Hands } from './hands.js';

const sides = 8; // of the thickest tube

export class Run {
    constructor(library) {
        this.library = library;
        this.files = new Map(); // id -> { name, bytes }
        this.trees = new Map(); // key of a source -> { tree, model, notes }
        this.kept = 0;
        this.scene = this.simulation = this.mesh = 0;
        this.hands = new Hands(this);
        this.clock = new Clock();
        this.estimate = new Estimate(this);
    }

    addFile(id, name, bytes) {
        this.files.set(id, { name, bytes: new Uint8Array(bytes) });
    }

    tree(source) {
        const key = sourceKey(source);
        const found = this.trees.get(key);
        if (found) return found;
        let made;
        if (source.kept) throw new Error('the pose that was kept is no longer in memory');
        if (source.species) {
            const tree = this.library.with(source.species, (name) => this.library.handle('grow', name, source.bodies,
                source.seed, +source.leaves, +source.petals, +source.fruit));
            made = { tree, model: 0, notes: [] };
        } else {
            const file = this.files.get(source.file);
            if (!file) throw new Error(`${source.name}: is not here; drop the file on the page again`);
            made = this.library.readTree(file.bytes, file.name, source);
        }
        this.trees.set(key, made);
        return made;
    }

    // The state from now on. What can change while it runs is changed; for all else a new run takes the motion over, but with restart.
    apply(state, restart) {
        const trees = state.trees.map((source) => this.tree(source));
        const change = restart || !this.simulation ? 'all' : changed(this.state, state);
        const notes = trees.flatMap((tree) => tree.notes);
        if (change !== 'nothing') this.#renew(state, trees, change, restart);
        this.state = state;
        const mesh = this.#renewMesh(state, trees, change);
        return {
            notes, mesh,
            bodies: this.bodies.count,
            transfer: mesh ? [mesh.vertex.buffer, mesh.color.buffer, mesh.index.buffer] : [],
        };
    }

    #renew(state, trees, change, restart) {
        const { library } = this;
        const scene = this.#sceneOf(state, trees);
        try {
            if (change === 'wind') {
                const { wind } = state, angle = wind.direction * Math.PI / 180;
                library.call('set_wind', this.simulation, wind.speed * Math.cos(angle), 0, -wind.speed * Math.sin(angle),
                    wind.turbulence, wind.gustFactor, wind.gustPeriod, wind.seed);
            } else if (change === 'gravity') {
                library.call('set_gravity', this.simulation, state.gravity);
            } else if (change === 'all') {
                const simulation = library.handle('simulate', scene, 1 / state.rate, state.precision === 'double' ? 1 : 0,
                    restart ? 0 : this.simulation);
                try {
                    if (state.gravity !== state.drawnGravity) library.call('set_gravity', simulation, state.gravity);
                } catch (error) {
                    library.release(simulation);
                    throw error;
                }
                library.release(this.simulation);
                this.simulation = simulation;
                this.bodies = library.bodies(simulation);
                this.clock.begin(1 / state.rate, restart);
                this.hands.begin(restart);
            }
        } catch (error) {
            library.release(scene);
            throw error;
        }
        library.release(this.scene);
        this.scene = scene;
        this.estimate.drop();
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
    #renewMesh(state, trees, change) {
        const { library } = this, shape = shapeOf(state);
        if (shape === this.shape) {
            if (change === 'all') library.call('take_poses', this.mesh, this.simulation, 0);
            return null;
        }
        const model = state.places.length === 1 && state.ownMesh ? trees[0].model : 0;
        const mesh = library.handle('mesh', this.simulation, this.scene, model, sides);
        library.release(this.mesh);
        this.mesh = mesh;
        this.shape = shape;
        library.call('take_poses', mesh, this.simulation, 0);
        return { ...library.meshArrays(mesh), parent: this.bodies.parent, kind: this.bodies.kind, size: this.bodies.size, first: this.bodies.first };
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

    // Where bodies are and how they are turned, in the numbers of the run: for tests.
    positions() {
        return this.library.positions(this.simulation);
    }

    pick(ray, aperture) {
        return this.simulation ? this.library.pick(this.simulation, ray, aperture) : null;
    }

    // The tree of each place as it stands now, as sources that apply() knows.
    keepPose() {
        const { library, state } = this;
        const sources = state.places.map(({ tree }) => state.trees[tree]);
        const made = state.places.map(({ yaw }, place) => ({
            tree: library.handle('posed_tree', this.simulation, place, this.tree(sources[place]).tree, yaw), model: 0, notes: [],
        }));
        return sources.map((source, k) => {
            const kept = { kept: ++this.kept, of: source.kept ? source.of : source };
            this.trees.set(sourceKey(kept), made[k]);
            return kept;
        });
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
        JSON.stringify([others.trees, others.places, others.rate, others.precision]);
    if (rest(before) !== rest(after)) return 'all';
    const wind = JSON.stringify(before.wind) !== JSON.stringify(after.wind), gravity = before.gravity !== after.gravity;
    return wind && gravity ? 'all' : wind ? 'wind' : gravity ? 'gravity' : 'nothing';
}
