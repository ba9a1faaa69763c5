// app.js: the page as a whole: its state, how it comes to the Worker, frame after frame.
import { stateOfAddress, updateAddress } from './address.js';
import { Bar } from './bar.js';
import { first, youngMaple } from './builtins.js';
import { Files } from './files.js';
import { busy, problem, say, unsay } from './messages.js';
import { Meters } from './meters.js';
import { Panel } from './panel.js';
import { Pointers } from './pointers.js';
import { saveMotion, saveScene } from './save.js';
import { copyOf, defaults, fewer, History, subtreeOf, withOtherTrees } from './state.js';

const tooSlow = 12; // ms a step beyond which 60 frames a second have no room

export class App {
    // another(): a promise of another Worker's client.
    constructor({ client, view, known, another, times }) {
        this.client = client;
        this.another = another;
        this.presets = known.presets;
        this.state = copyOf(defaults);
        this.thickest = 0.2; // m, radius
        this.paused = false;
        this.speed = 1;
        this.picked = null;
        this.problem = problem;
        this.view = view;
        this.meters = new Meters();
        this.files = new Files(this);
        this.panel = new Panel(this, known);
        this.bar = new Bar(this);
        this.pointers = new Pointers({ client, view: this.view, problem, say, picked: (body) => this.pick(body) });
        this.times = Object.assign(times, { built: performance.now() });
        this.frames = 0;
        addEventListener('resize', () => this.fit());
    }
    async begin() {
        const given = new URLSearchParams(location.search).has('open') ? await this.#given() : [];
        this.fit();
        this.state = await this.#first(given);
        this.good = this.state;
        this.history = new History(this.state);
        if (!await this.apply(true, this.files.scene ?? 'The address')) { // what an address or a file says may not run
            await this.open(first);
            this.history = new History(this.state);
            this.#stand();
        }
        addEventListener('hashchange', () => this.#addressed());
        requestAnimationFrame((now) => this.frame(now));
    }
    // What is shown first: what the address holds, with the files that tools/live/live was started with where it names them; else those; else a built-in tree.
    async #first(given) {
        try {
            const state = await stateOfAddress();
            if (state) return await this.#withFiles(state, given);
        } catch (error) {
            problem(`${error.message}. ${given.length > 0 ? 'What the page was started with' : 'A built-in tree'} is shown.`);
        }
        try {
            if (given.length > 0) return await this.files.stateOf(given);
        } catch (error) {
            problem(error.message);
        }
        return this.files.builtin(first);
    }
    async #given() {
        const answer = await fetch('open.json');
        if (!answer.ok) return []; // another server's page, whose address says so
        return Promise.all((await answer.json()).map(async ({ name, at }) => new File([await (await fetch(at)).arrayBuffer()], name)));
    }
    // An address's state, whose files the page has or was given.
    async #withFiles(state, given = []) {
        for (const { file, name } of state.trees) {
            if (!file || this.files.known.has(file)) continue;
            const found = given.find((one) => one.name === name);
            if (file === youngMaple.file) await this.files.needYoungMaple();
            else if (found) await this.files.add(file, name, await found.arrayBuffer());
            else throw new Error(`The address names the file ${name}, which it cannot hold: drop that file on the page`);
        }
        return state;
    }
    // Another address, put where this one was.
    async #addressed() {
        try {
            const state = await stateOfAddress();
            if (state && await this.opened(await this.#withFiles(state), { name: 'The address' })) return;
        } catch (error) {
            problem(`${error.message}. The tree stays as it was.`);
        }
        updateAddress(this.state);
    }
    fit() {
        const panel = document.getElementById('panel').getBoundingClientRect();
        const below = panel.width >= innerWidth, closed = panel.height === 0;
        const bar = 64; // px at the bottom
        this.view.inset = closed ? [0, bar] : below ? [0, panel.height + bar] : [panel.width, bar];
        if (this.view.skinned) this.view.fit();
    }

    // edit(state) changes it; done: a step of the history.
    change(edit, done) {
        const next = copyOf(this.state);
        edit(next);
        if (JSON.stringify(next.wind) !== JSON.stringify(this.state.wind)) delete next.wind.blows; // there is air from now on
        this.state = next;
        this.apply(false).then((right) => {
            if (right && done) this.#remember();
        });
        if (done) this.panel.show(this.state);
    }
    #remember() {
        this.history.add(this.state);
        this.#stand();
        unsay('slow');
        this.slow = 0;
    }
    // again: another of the same kind, which the user goes on looking at. name: where it comes from.
    async opened(state, { again = false, name } = {}) {
        this.state = state;
        this.pick(null);
        if (!again) this.view.orbit.touched = false;
        const right = await this.apply(true, name);
        if (right) this.#remember();
        return right;
    }
    async open(name) {
        try {
            await this.opened(await this.files.builtin(name));
        } catch (error) {
            problem(error.message);
        }
    }
    grow(source) {
        return this.opened(withOtherTrees(this.state, [source], [{ tree: 0, position: [0, 0, 0], yaw: 0, start: 0 }]), { again: true });
    }
    async undo(redo = false) {
        const state = redo ? this.history.redo() : this.history.undo();
        if (!state) return;
        this.state = state;
        await this.apply(false);
        this.#stand();
    }
    // Where the history stands: what of it the Worker keeps, what can be undone, the address.
    #stand() {
        this.client.ask('retain', this.history.sources()).then(({ gone }) => gone.forEach((id) => this.files.known.delete(id)));
        this.bar.show(this.history);
        updateAddress(this.state).then((fits) => {
            if (!fits && !this.tooLong) problem('The scene is too long for an address, which has an earlier one. This tab keeps it; "Scene for treesim" saves all of it.');
            this.tooLong = !fits;
        });
    }
    redo() { return this.undo(true); }
    restart() { return this.apply(true); }
    async keep() {
        try {
            const trees = await this.client.ask('keep');
            this.pointers.letGoAll();
            this.change((state) => {
                state.trees = trees;
                state.places.forEach((place, k) => { place.tree = k; });
            }, true);
            say('The tree is now at rest as it stands.');
        } catch (error) {
            problem(error.message);
        }
    }

    // The state to the Worker, the latest one where several come while one is made. Whether it runs. name: what is refused is of that.
    apply(restart, name = 'The scene') {
        this.wanted = { restart: restart || Boolean(this.wanted?.restart), name };
        this.applying ??= this.#applyAll().finally(() => { this.applying = null; });
        return this.applying;
    }
    async #applyAll() {
        let right = true;
        while (this.wanted) {
            const { restart, name } = this.wanted, state = copyOf(this.state);
            this.wanted = null;
            try {
                const { mesh, bodies, notes, begun, cuttable } = await busy('Growing, cutting, compiling …', () => this.client.ask('apply', { state, restart }));
                this.good = state;
                this.halted = false;
                Object.assign(this, { bodies, cuttable });
                if (begun) this.pointers.letGoAll(); // the run has: its bodies are others, or begin at rest
                if (mesh) this.#shown(mesh);
                if (mesh) this.panel.showNotes(notes);
                if (!this.wanted) this.panel.show(this.state);
                this.times.applied ??= performance.now();
                right = true;
            } catch (error) {
                if (error.inWorker) console.error(error.inWorker);
                problem(error.message.replace(/^(scene: |(?=\/|nothing is left))/, `${name}: `));
                right = false;
                if (this.wanted) continue;
                this.state = copyOf(this.good);
                this.panel.show(this.state);
            }
        }
        return right;
    }
    #shown(mesh) {
        this.mesh = { parent: mesh.parent, kind: mesh.kind, size: mesh.size, first: mesh.first };
        this.thickest = 0;
        for (let i = 0; i < mesh.kind.length; ++i) if (mesh.kind[i] === 0) this.thickest = Math.max(this.thickest, mesh.size[3 * i + 1]);
        this.view.show(mesh);
        this.pick(null);
    }

    // A body of the trees, by its number in all of them, or null.
    pick(body) {
        if (body === null || body === undefined) {
            this.picked = null;
            this.view.skinned?.mark(null);
        } else {
            const inside = subtreeOf(this.mesh.parent, body);
            const [place, own] = this.#placeOf(body);
            this.picked = { body, place, own, count: inside.reduce((sum, one) => sum + one, 0), radius: this.mesh.size[3 * body + 1] };
            this.view.skinned.mark(inside);
        }
        this.panel.showPicked(this.picked);
        if (this.good) this.panel.show(this.state);
    }
    #placeOf(body) { // places' bodies stand one after another; which they are the Worker says with the mesh
        const { first } = this.mesh;
        let place = 0;
        while (place + 1 < first.length - 1 && first[place + 1] <= body) ++place;
        return [place, body - first[place]];
    }

    single() {
        this.bar.toggle(true);
        this.oneStep = true;
    }
    async frame(now) {
        requestAnimationFrame((next) => this.frame(next));
        const start = performance.now(), passed = this.last === undefined ? 1 / 60 : (now - this.last) / 1000; // it moves in its first picture
        this.last = now;
        this.unasked = (this.unasked ?? 0) + passed;
        if (!this.asking && this.bodies && !this.halted) this.#ask(now);
        this.pointers.arrows();
        this.panel.dial.follow(this.view.orbit.azimuth);
        this.view.draw();
        this.script = performance.now() - start; // ms of JavaScript, drawing calls among it
        ++this.frames;
        this.frameTime = 1000 * passed;
        if (this.frames > 2 && this.frames < 200 && this.view.sun.castShadow) this.#spare(this.frameTime);
    }
    // Where pictures are drawn without a graphics card shadows are more than half of the work.
    #spare(ms) {
        this.late = ms > 70 ? (this.late ?? 0) + 1 : 0;
        if (this.late !== 5) return;
        this.view.shadows(false);
        say('Pictures are drawn slowly here: shadows are off (Computing).');
    }
    #ask(now) {
        const size = 32 * this.bodies;
        const buffer = this.buffer?.byteLength === size ? this.buffer : new ArrayBuffer(size);
        this.buffer = null;
        const seconds = this.paused ? 0 : this.unasked * this.speed, single = Boolean(this.oneStep);
        this.unasked = 0;
        this.oneStep = false;
        this.asking = this.client.ask('frame', { seconds, single, buffer, targets: this.pointers.targets() }, [buffer])
            .then((answer) => this.#taken(answer, now))
            .catch((error) => this.#halt(error))
            .finally(() => { this.asking = null; });
    }
    // A step failed: none is asked for until what is applied runs. Behind what the library did not expect its memory is not to be trusted.
    #halt(error) {
        this.halted = true;
        this.bar.toggle(true);
        if (error.known) return problem(`${error.message}. It stands still; Restart begins again.`);
        console.error(error.inWorker ?? error);
        say(`The library failed: ${error.message}. It stands still.`, { key: 'halted', error: true, actions: [['Load the page again', () => location.reload()]] });
    }
    #taken(answer, now) {
        const started = performance.now();
        this.buffer = answer.poses;
        this.view.take(new Float32Array(answer.poses));
        if (answer.steps > 0) this.times.moved ??= performance.now();
        if (answer.hands?.length) document.getElementById('hint').classList.add('gone');
        this.pointers.showForces(answer.hands ?? []);
        for (const hand of answer.lost ?? []) this.pointers.lost(hand);
        this.answer = { ...answer, poses: null };
        if (this.frameTime)
            this.meters.add({ at: now / 1000, frame: this.frameTime, ms: answer.ms, steps: answer.steps, dropped: answer.dropped, bodies: this.bodies, estimate: answer.estimate });
        if (answer.steps > 0) this.#watch(answer.ms);
        this.taking = performance.now() - started;
    }
    // What is too large says so, and what can be done.
    #watch(ms) {
        this.slow = ms > Math.min(tooSlow, 800 / this.state.rate) ? (this.slow ?? 0) + 1 : 0;
        if (this.slow !== 90) return;
        const alone = this.state.trees.length === 1 && (this.state.trees[0].of ?? this.state.trees[0]);
        const actions = [['Move only thicker wood', () => this.change((state) => { state.least = Math.max(2 * state.least, 0.02 * this.thickest); }, true)]];
        if (alone?.species) actions.unshift(['Half the bodies', () => this.grow({ ...alone, bodies: Math.round(alone.bodies / 2) })]);
        else if (this.cuttable) actions.unshift(['Half the bodies', () => this.opened(fewer(this.state, Math.round(this.bodies / 2)), { again: true })]);
        if (this.state.rate > 30) actions.push(['30 steps a second', () => this.change((state) => { state.rate = 30; }, true)]);
        say(`A step of these ${this.bodies.toLocaleString('en')} bodies takes ${ms.toFixed(1)} ms: too long for ${this.state.rate} a second. It moves slower than real.`,
            { key: 'slow', error: true, actions });
    }

    async copyAddress() {
        const fits = await updateAddress(this.state);
        const file = this.state.trees.some((source) => (source.of ?? source).file && (source.of ?? source).file !== youngMaple.file);
        const kept = this.state.trees.some((source) => source.kept);
        if (!fits) return problem('The scene is too long for an address; "Scene for treesim" saves all of it.');
        if (file) return problem('The address cannot hold a file that was dropped, only its name; "Scene for treesim" saves all of it.');
        const holds = `The address holds the scene (${location.href.length} characters)${kept ? ', but for the pose that was kept' : ''}`;
        try {
            await navigator.clipboard.writeText(location.href); // which a page has not that came by plain http
            say(`${holds}; it is copied.`);
        } catch {
            say(`${holds}. The browser lets this page copy nothing: take it from here.`, { key: 'address', text: location.href });
        }
    }
    async saveScene() {
        await busy('Writing the trees …', () => saveScene(this)).then(() => this.#tellGravity(), (error) => problem(error.message));
    }
    // What is saved begins at rest, under the gravity that the drawn trees bear.
    #tellGravity() {
        const { gravity, drawnGravity } = this.state;
        if (gravity !== drawnGravity) problem(`What is saved has the gravity that the trees were drawn under, ${drawnGravity} m/s², not the ${gravity} that it was changed to.`);
    }
    async saveMotion(seconds, loop) {
        if (this.saving) return say('A motion is being written.');
        this.saving = saveMotion(this, { seconds, loop })
            .then((bytes) => {
                if (bytes === null) return;
                say(`${(bytes / 1e6).toFixed(1)} MB written.`);
                this.#tellGravity();
            }).catch((error) => problem(error.message))
            .finally(() => { this.saving = null; });
        return this.saving;
    }
}
