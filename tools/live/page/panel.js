// panel.js: the controls at the side. Each changes the app's state; show(state) sets them to one.
import { builtins } from './builtins.js';
import { CurveEditor } from './curve.js';
import { Dial } from './dial.js';
import { plain } from './messages.js';
import { button, choice, element, section, slider } from './widgets.js';

const grown = { age: 10, bodies: 3000, seed: 1 }; // of a species that is chosen

const short = (value) => String(Number(value.toPrecision(3)));

export class Panel {
    // app: { change(edit, done), open(name), grow(source), files, client, picked, ... }
    constructor(app, { species, presets }) {
        this.app = app;
        this.presets = presets;
        this.element = document.getElementById('panel');
        this.controls = [];
        this.element.append(
            element('h1', {}, 'bough live'),
            section('Tree', true, ...this.#tree(species)),
            section('Wind', true, ...this.#wind()),
            section('Wood', false, ...this.#wood()),
            this.pickedSection = section('Picked branch', false, ...this.#picked()),
            section('Meters', true, app.meters.element),
            section('Computing', false, ...this.#computing()),
            section('Save and share', false, ...this.#save()));
    }
    // A slider bound to a number of the state.
    #bound(options, get, put) {
        const made = slider({ ...options, change: (value, done) => this.app.change((state) => put(state, value), done) });
        this.controls.push((state) => made.set(get(state)));
        return made.row;
    }
    #tree(species) {
        const { app } = this;
        this.builtin = choice({
            label: 'Example', options: [['', '–'], ...Object.entries(builtins).map(([name, { label }]) => [name, label])],
            change: (name) => name && app.open(name),
        });
        const kind = choice({ label: 'Grow', options: species.map((name) => [name, name]), change: () => grow() });
        const age = slider({
            label: 'Age', unit: 'years', min: 1, max: 40, digits: 2, allowed: [0, 1000], help: '0: a mature tree; a willow older than 20 takes seconds to grow',
            change: (_, done) => done && grow(),
        });
        const bodies = slider({ label: 'Bodies', min: 100, max: 50000, log: true, digits: 2, allowed: [50, 1000000], change: (_, done) => done && grow() });
        const seed = slider({ label: 'Seed', min: 0, max: 100, allowed: [0, 2 ** 31], change: (_, done) => done && grow() });
        const with_ = (label, checked) => {
            const box = element('input', { type: 'checkbox', checked, onchange: () => grow() });
            return [box, element('label', { class: 'check' }, box, label)];
        };
        const [leaves, leavesRow] = with_('Leaves', true), [fruit, fruitRow] = with_('Fruit', false), [petals, petalsRow] = with_('Petals', false);
        const grow = () => app.grow({
            species: kind.select.value, age: age.get(), bodies: Math.round(bodies.get()), seed: Math.round(seed.get()), leaves: leaves.checked, petals: petals.checked, fruit: fruit.checked,
        });
        age.set(grown.age);
        bodies.set(grown.bodies);
        seed.set(grown.seed);
        this.controls.push((state) => {
            const one = state.trees.length === 1 ? state.trees[0].of ?? state.trees[0] : {};
            if (!one.species) return;
            kind.set(one.species);
            age.set(one.age ?? 0);
            bodies.set(one.bodies);
            seed.set(one.seed);
            Object.assign(leaves, { checked: one.leaves });
            Object.assign(fruit, { checked: one.fruit });
            Object.assign(petals, { checked: one.petals });
        });
        this.notes = element('div', { class: 'note' });
        return [
            this.builtin.row, element('div', { class: 'buttons' }, button('Open a file…', () => app.files.choose(), { id: 'open' })),
            element('p', { class: 'note' }, 'Or drop one anywhere: a bough tree or scene, SpeedTree XML, glTF, a scan\'s skeleton.'),
            kind.row, age.row, bodies.row, seed.row, element('div', { class: 'buttons' }, leavesRow, fruitRow, petalsRow), this.notes,
        ];
    }
    #wind() {
        const { app } = this;
        this.dial = new Dial((speed, direction, done) => app.change(({ wind }) => Object.assign(wind, { speed, direction }), done));
        const presets = Object.entries(this.presets).map(([name, preset]) =>
            button(name[0].toUpperCase() + name.slice(1), () => app.change(({ wind }) => Object.assign(wind, preset), true), { id: `wind-${name}` }));
        this.controls.push(({ wind }) => this.dial.set(wind.speed, wind.direction));
        return [
            element('div', { class: 'wind-box' }, this.dial.picture, element('div', { class: 'buttons' }, ...presets)),
            this.#bound({ label: 'Speed', unit: 'm/s', min: 0, max: 25, allowed: [0, 60], help: 'mean, 10 m above the ground' },
                ({ wind }) => wind.speed, ({ wind }, value) => { wind.speed = value; }),
            this.#bound({ label: 'Direction', unit: '°', min: 0, max: 360, help: 'towards which it blows, from +x about the vertical' },
                ({ wind }) => wind.direction, ({ wind }, value) => { wind.direction = value; }),
            this.#bound({ label: 'Rise', unit: 'm/s', min: -10, max: 10, allowed: [-60, 60], help: 'upward, as above a warm slope; below 0 downward' },
                ({ wind }) => wind.rise, ({ wind }, value) => { wind.rise = value; }),
            this.#bound({ label: 'Turbulence', min: 0, max: 0.5, allowed: [0, 2], help: 'standard deviation over the mean' },
                ({ wind }) => wind.turbulence, ({ wind }, value) => { wind.turbulence = value; }),
            this.#bound({ label: 'Gusts', unit: '×', min: 1, max: 3, allowed: [1, 10], help: 'a gust\'s peak over the mean' },
                ({ wind }) => wind.gustFactor, ({ wind }, value) => { wind.gustFactor = value; }),
            this.#bound({ label: 'Gust every', unit: 's', min: 1, max: 20, allowed: [0.1, 1000] },
                ({ wind }) => wind.gustPeriod, ({ wind }, value) => { wind.gustPeriod = value; }),
        ];
    }
    #wood() {
        const { app } = this;
        const levels = choice({
            label: 'Moves', options: [[0, 'all wood'], [1, 'the trunk alone'], [2, 'two levels of branches'], [3, 'three levels of branches']],
            change: (value) => app.change((state) => { state.levels = Number(value); }, true),
        });
        const ask = (x, y, from, to, samples) => app.client.ask('curve', { x, y, from, to, samples });
        const editor = (key, label) => {
            const made = new CurveEditor({ label, ask, change: (keys, done) => app.change(({ curves }) => { curves.keys[key] = keys; }, done) });
            made.row.id = `curve-${key}`;
            this.controls.push((state) => made.set(state.curves.keys[key], app.thickest));
            return made.row;
        };
        this.controls.push((state) => levels.set(state.levels));
        return [
            this.#bound({ label: 'Stiffness', unit: '×', min: 1 / 32, max: 32, log: true, allowed: [1e-4, 1e6] },
                ({ stiffness }) => stiffness, (state, value) => { state.stiffness = value; }),
            this.#bound({ label: 'Damping', unit: '×', min: 1 / 32, max: 32, log: true, allowed: [0, 1e4] },
                ({ damping }) => damping, (state, value) => { state.damping = value; }),
            editor('stiffness', 'Stiffness'), editor('damping', 'Damping'),
            element('p', { class: 'note' }, 'Draw a key; press twice to add one or to remove it.'),
            this.#bound({ label: 'Gravity', unit: 'm/s²', min: 0, max: 30, allowed: [0, 200], help: 'The tree as it is drawn is at rest under the scene\'s own' },
                ({ gravity }) => gravity, (state, value) => { state.gravity = value; }),
            this.#bound({ label: 'Breaks at', unit: 'MPa', min: 0, max: 100, allowed: [0, 1e4], help: 'bending stress that the wood stands; 0: never breaks' },
                ({ strength }) => strength, (state, value) => { state.strength = value; }),
            this.#bound({ label: 'Rigid below', unit: 'm', min: 0, max: 0.05, digits: 2, allowed: [0, 10], help: 'wood that is thinner (radius) does not bend by itself; 0: all bends' },
                ({ least }) => least, (state, value) => { state.least = value; }),
            levels.row,
        ];
    }
    #picked() {
        const { app } = this;
        this.pickedText = element('p', { class: 'note' }, 'Press a branch shortly to pick it and all that it bears.');
        const part = (state) => app.picked && state.parts.find(({ place, body }) => place === app.picked.place && body === app.picked.own);
        const put = (key) => (state, value) => {
            if (!app.picked) return;
            let own = part(state);
            if (!own) state.parts.push(own = { place: app.picked.place, body: app.picked.own, stiffness: 1, damping: 1 });
            own[key] = value;
            if (own.stiffness === 1 && own.damping === 1) state.parts.splice(state.parts.indexOf(own), 1);
        };
        const only = element('input', {
            type: 'checkbox', id: 'only',
            onchange: () => app.change((state) => { state.only = only.checked && app.picked ? [{ place: app.picked.place, body: app.picked.own }] : []; }, true),
        });
        const isOnly = (state) => Boolean(app.picked) && state.only.some(({ place, body }) => place === app.picked.place && body === app.picked.own);
        const parts = element('ul', { class: 'note', id: 'parts' });
        let listed = '[[],[]]';
        this.controls.push((state) => {
            only.checked = isOnly(state);
            if (JSON.stringify([state.parts, state.only]) === listed) return; // a button that is pressed stays the one that has the focus
            listed = JSON.stringify([state.parts, state.only]);
            const line = ({ place, body }, says) => element('li', {}, button(
                `Body ${body}${state.places.length > 1 ? ` of tree ${place + 1}` : ''}: ${says}`, () => app.pick(app.mesh.first[place] + body), { class: 'small' }));
            parts.replaceChildren(...state.only.map((one) => line(one, 'only this moves')),
                ...state.parts.map((one) => line(one, `stiffness ${short(one.stiffness)} ×, damping ${short(one.damping)} ×`)));
        });
        this.pickedBox = element('div', { hidden: true },
            this.#bound({ label: 'Stiffness', unit: '×', min: 1 / 32, max: 32, log: true, allowed: [1e-4, 1e6] }, (state) => part(state)?.stiffness ?? 1, put('stiffness')),
            this.#bound({ label: 'Damping', unit: '×', min: 1 / 32, max: 32, log: true, allowed: [0, 1e4] }, (state) => part(state)?.damping ?? 1, put('damping')),
            element('label', { class: 'check' }, only, 'Only this moves, with all that it bears'),
            element('div', { class: 'buttons' }, button('Let go of it', () => app.pick(null))));
        return [this.pickedText, this.pickedBox, parts];
    }
    showPicked(picked) {
        this.pickedBox.hidden = !picked;
        this.pickedSection.open = this.pickedSection.open || Boolean(picked);
        this.pickedText.textContent = !picked ? 'Press a branch shortly to pick it and all that it bears.'
            : `Body ${picked.own}${this.app.state.places.length > 1 ? ` of tree ${picked.place + 1}` : ''}, radius ${(1000 * picked.radius).toPrecision(3)} mm; ` +
              `bears ${picked.count - 1} others.`;
    }
    #computing() {
        const { app } = this;
        const rate = choice({
            label: 'Steps', options: [[30, '30 a second'], [60, '60 a second'], [120, '120 a second'], [240, '240 a second']],
            change: (value) => app.change((state) => { state.rate = Number(value); }, true),
        });
        const precision = choice({
            label: 'Numbers', options: [['float', 'single precision'], ['double', 'double precision']],
            change: (value) => app.change((state) => { state.precision = value; }, true),
        });
        const own = element('input', { type: 'checkbox', onchange: () => app.change((state) => { state.ownMesh = own.checked; }, true) });
        const shadow = element('input', { type: 'checkbox', checked: !app.view.slow, onchange: () => { app.view.shadows(shadow.checked); } });
        app.view.shadowsChanged = (on) => { shadow.checked = on; };
        this.controls.push((state) => {
            rate.set(state.rate);
            precision.set(state.precision);
            own.checked = state.ownMesh;
        });
        return [
            rate.row, precision.row, element('label', { class: 'check' }, own, 'A file\'s own mesh, where it has one'),
            element('label', { class: 'check' }, shadow, 'Shadows'),
        ];
    }
    #save() {
        const { app } = this;
        const seconds = slider({ label: 'Length', unit: 's', min: 1, max: 20, digits: 2, allowed: [0.1, 120], change: () => {} });
        seconds.set(4);
        const loop = element('input', { type: 'checkbox' });
        return [
            element('div', { class: 'buttons' }, button('Copy the address', () => app.copyAddress(), { id: 'share' }), button('Scene for treesim', () => app.saveScene(), { id: 'save-scene' })),
            seconds.row, element('label', { class: 'check' }, loop, 'A loop: its end meets its beginning'),
            element('div', { class: 'buttons' }, button('Motion as .glb', () => app.saveMotion(seconds.get(), loop.checked), { id: 'save-glb' })),
        ];
    }
    show(state) {
        for (const set of this.controls) set(state);
        const name = Object.keys(builtins).find((key) => JSON.stringify(builtins[key].trees) === JSON.stringify(state.trees));
        this.builtin.set(name ?? '');
    }
    showNotes(lines) {
        this.notes.replaceChildren(...(lines.length === 0 ? [] : [element('ul', {}, ...lines.map((line) => element('li', {}, plain(line))))]));
    }
}

