// wasm.js: the library in the Worker: its module, its memory, its calls. Handles are numbers; a call that fails throws LibraryError with the
// library's own message.
import createModule from 'bough-module';

export class LibraryError extends Error {}

export class Library {
    // Of the module, compiled or as bytes. progress(done, of): how far a motion is that is written.
    static async open({ module, bytes }, progress) {
        const compiled = module ?? await WebAssembly.compile(bytes);
        return new Promise((done, failed) => {
            const instantiateWasm = (imports, made) => {
                WebAssembly.instantiate(compiled, imports).then((instance) => made(instance, compiled), failed);
                return {}; // comes later
            };
            createModule({ instantiateWasm, progress, printErr: (text) => console.error(text) }).then((own) => done(new Library(own)), failed);
        });
    }
    constructor(module) {
        this.module = module;
        this.scratch = module._malloc(4096); // of calls' arguments and results, one call at a time
        this.decoder = new TextDecoder();
        this.encoder = new TextEncoder();
    }
    // Views are made for each use: memory that grew has another buffer.
    bytes(at, count) { return new Uint8Array(this.module.HEAPU8.buffer, at, count); }
    words(at, count) { return new Uint32Array(this.module.HEAPU8.buffer, at, count); }
    integers(at, count) { return new Int32Array(this.module.HEAPU8.buffer, at, count); }
    floats(at, count) { return new Float32Array(this.module.HEAPU8.buffer, at, count); }
    doubles(at, count) { return new Float64Array(this.module.HEAPU8.buffer, at, count); }
    text(at) {
        const heap = this.module.HEAPU8;
        let end = at;
        while (heap[end] !== 0) ++end;
        return this.decoder.decode(heap.subarray(at, end));
    }
    lines(at) {
        const text = this.text(at);
        return text === '' ? [] : text.split('\n');
    }
    allocate(count) {
        const at = this.module._malloc(Math.max(1, count));
        if (at === 0) throw new LibraryError(`out of memory: ${count} bytes do not fit`);
        return at;
    }
    free(at) { this.module._free(at); }
    // work(pointer, size) with bytes, or a text with the 0 at its end, in the library's memory for so long.
    with(content, work) {
        const bytes = typeof content === 'string' ? this.encoder.encode(content + '\0') : content;
        const at = this.allocate(bytes.length);
        this.bytes(at, bytes.length).set(bytes);
        try {
            return work(at, bytes.length);
        } finally {
            this.free(at);
        }
    }
    withNumbers(numbers, work) {
        const at = this.allocate(8 * numbers.length);
        this.doubles(at, numbers.length).set(numbers);
        try {
            return work(at);
        } finally {
            this.free(at);
        }
    }
    fail() { throw new LibraryError(this.text(this.module._bough_error()) || 'the library says nothing of what is wrong'); }
    handle(name, ...args) { // of what a call makes
        return this.module[`_live_${name}`](...args) || this.fail();
    }
    call(name, ...args) { // one that gives a bough_result
        if (this.module[`_live_${name}`](...args) !== 0) this.fail();
    }
    release(handle) {
        if (handle) this.module._bough_free(handle);
    }
    names(call) { return this.lines(this.module[`_live_${call}`]()); }

    attach(simulation, body, point, stiffness, damping) {
        this.doubles(this.scratch, 3).set(point);
        return this.handle('attach', simulation, body, this.scratch, stiffness, damping);
    }
    moveAttachment(simulation, attachment, target, steps) {
        this.doubles(this.scratch, 3).set(target);
        this.call('move', simulation, attachment, this.scratch, steps);
    }
    attachmentForce(simulation, attachment) {
        this.call('attachment_force', simulation, attachment, this.scratch);
        return Array.from(this.doubles(this.scratch, 3));
    }
    step(simulation) {
        const at = this.scratch;
        this.call('step', simulation, at);
        const [steps, time, fast, guarded, broke, landed] = this.doubles(at, 6);
        return { steps, time, fast, guarded, broke, landed };
    }
    pick(simulation, ray, aperture) {
        const at = this.scratch;
        this.doubles(at, 6).set(ray);
        const found = this.module._live_pick(simulation, at, aperture, at + 48);
        if (found < 0) this.fail();
        if (found === 0) return null;
        const all = Array.from(this.doubles(at + 48, 8));
        return { body: all[0], point: all.slice(1, 4), world: all.slice(4, 7), distance: all[7] };
    }
    reach(simulation, body, point, stiffness) {
        const at = this.scratch;
        this.doubles(at, 3).set(point);
        this.call('reach', simulation, body, at, stiffness, at + 24);
        const [compliance, most, x, y, z] = this.doubles(at + 24, 5);
        return { compliance, most, at: [x, y, z] };
    }
    curve(x, y, from, to, samples) {
        const out = this.allocate(8 * samples);
        try {
            this.withNumbers([...x, ...y], (at) => this.call('curve', at, at + 8 * x.length, x.length, from, to, samples, out));
            return Array.from(this.doubles(out, samples));
        } finally {
            this.free(out);
        }
    }
    windPreset(name) {
        return this.with(name, (at) => {
            this.call('wind_preset', at, this.scratch);
            const [speed, turbulence, gustFactor, gustPeriod] = this.doubles(this.scratch, 4);
            return { speed, rise: 0, turbulence, gustFactor, gustPeriod };
        });
    }
    readTree(bytes, name, { material = '', segmentLength = 0, maxBodies = 0, unit = 0 }) {
        const at = this.scratch;
        this.with(bytes, (content, size) => this.with(name, (label) => this.with(material, (wood) =>
            this.call('read_tree', content, size, label, wood, segmentLength, maxBodies, unit, at))));
        const [tree, model] = this.words(at, 2);
        return { tree, model, notes: this.names('notes') };
    }
    // A scene document as it came: what is wrong with it is said as treesim says it.
    checkScene(bytes, name) {
        this.release(this.with(bytes, (at, size) => this.with(name, (label) => this.handle('scene', at, size, label))));
    }
    // A copy of bytes that the library gave, which then has them no more.
    taken(name, ...args) {
        const at = this.module[`_live_${name}`](...args, this.scratch) || this.fail();
        try {
            return this.bytes(at, this.words(this.scratch, 1)[0]).slice();
        } finally {
            this.free(at);
        }
    }
    bodies(simulation) {
        const array = (which) => {
            const at = this.module._live_bodies(simulation, which, this.scratch) || this.fail();
            return [at, this.words(this.scratch, 1)[0]];
        };
        const [parentAt, count] = array(0);
        return {
            count,
            parent: this.integers(parentAt, count).slice(),
            kind: this.bytes(array(1)[0], count).slice(),
            size: this.doubles(array(2)[0], 3 * count).slice(),
            mass: this.doubles(array(3)[0], count).slice(),
            first: Array.from(this.words(...array(5))),
        };
    }
    memory() { return { heap: this.module.HEAPU8.length, used: this.module._live_memory() }; }
    positions(simulation) {
        this.call('positions', simulation, this.scratch);
        const [at, count] = this.words(this.scratch, 2);
        return this.doubles(at, 3 * count).slice();
    }
    meshArrays(mesh) {
        const at = this.scratch;
        this.call('mesh_counts', mesh, at);
        const [vertices, triangles, parts, bodies] = this.words(at, 4);
        const sizes = [36 * vertices, 4 * vertices, 12 * triangles, 12 * parts];
        const first = this.allocate(sizes.reduce((a, b) => a + b, 0));
        try {
            const where = sizes.map((size, k) => first + sizes.slice(0, k).reduce((a, b) => a + b, 0));
            this.call('mesh_arrays', mesh, ...where);
            const part = this.words(where[3], 3 * parts).slice();
            return {
                bodies,
                vertex: this.floats(where[0], 9 * vertices).slice(),
                color: this.bytes(where[1], 4 * vertices).slice(),
                index: this.words(where[2], 3 * triangles).slice(),
                parts: Array.from({ length: parts }, (_, k) => ({
                    name: this.text(this.module._live_mesh_part(mesh, k)),
                    first: part[3 * k + 1],
                    triangles: part[3 * k + 2],
                })),
            };
        } finally {
            this.free(first);
        }
    }
}
