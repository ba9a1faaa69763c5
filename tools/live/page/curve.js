// curve.js: a curve over radius to be drawn by hand: keys that are dragged, the library's own monotone cubic between them (the Worker gives it).
import { element, svg } from './widgets.js';

const box = { left: 30, top: 8, width: 236, height: 104, bottom: 22 };
const lowest = 1 / 16, highest = 16; // factors; the height is logarithmic
const samples = 80;

const textOf = ([radius, factor]) => `${Number((100 * radius).toPrecision(2))} cm: ${Number(factor.toPrecision(3))} ×`;

export class CurveEditor {
    // change(keys, done); ask(x, y, from, to, samples): a promise of the curve.
    constructor({ label, change, ask }) {
        Object.assign(this, { change, ask, keys: [], thickest: 0.2 });
        this.line = svg('path', { class: 'curve' });
        this.points = svg('g');
        this.axis = svg('g', { class: 'axis' });
        this.picture = svg('svg', {
            class: 'editor', viewBox: `0 0 ${box.left + box.width + 12} ${box.top + box.height + box.bottom}`, 'aria-label': `${label} over radius`,
        }, this.axis, this.line, this.points);
        this.picture.addEventListener('dblclick', (event) => this.#twice(event));
        this.picture.addEventListener('pointermove', (event) => this.#drag(event, false));
        for (const end of ['pointerup', 'pointercancel']) this.picture.addEventListener(end, (event) => this.#drag(event, true));
        this.row = element('div', { class: 'curve-row' }, element('div', { class: 'curve-head' },
            element('span', {}, `${label} over radius`), this.value = element('output', { class: 'unit' }),
            element('button', { type: 'button', class: 'small', onclick: () => this.#start(), title: 'Three keys to begin with' }, 'Edit'),
            element('button', { type: 'button', class: 'small', onclick: () => this.#changed([], true), title: 'The wood\'s own' }, 'Clear')), this.picture);
    }
    set(keys, thickest) {
        this.keys = keys.map((key) => [...key]);
        this.thickest = thickest;
        this.draw();
    }
    #start() {
        if (this.keys.length > 0) return;
        this.#changed([[0.05, 1], [0.35, 1], [0.9, 1]].map(([share, factor]) => [share * this.thickest, factor]), true);
    }
    #x(radius) { return box.left + box.width * radius / this.thickest; }
    #y(factor) { return box.top + box.height * (1 - Math.log(factor / lowest) / Math.log(highest / lowest)); }
    #at(event) {
        const own = this.picture.getBoundingClientRect(), scale = this.picture.viewBox.baseVal.width / own.width;
        const x = (event.clientX - own.left) * scale, y = (event.clientY - own.top) * scale;
        const share = Math.min(1, Math.max(0, (x - box.left) / box.width)), high = Math.min(1, Math.max(0, 1 - (y - box.top) / box.height));
        return [share * this.thickest, Number((lowest * (highest / lowest) ** high).toPrecision(3))];
    }
    #place([radius, factor]) { return [this.#x(radius), this.#y(factor)]; }
    #remove(k) { this.#changed(this.keys.filter((_, i) => i !== k), true); }
    #changed(keys, done) {
        this.keys = keys;
        this.draw();
        this.change(keys.map((key) => [...key]), done);
    }
    // On a key, which has not the event itself: the picture has captured its pointer.
    #twice(event) {
        const key = this.#at(event), [x, y] = this.#place(key);
        const far = this.keys.map((own) => Math.hypot(this.#place(own)[0] - x, this.#place(own)[1] - y)), near = far.indexOf(Math.min(...far));
        if (far[near] < 8) return this.#remove(near);
        if (this.keys.some(([radius]) => Math.abs(radius - key[0]) < 0.02 * this.thickest)) return;
        this.#changed([...this.keys, key].sort((a, b) => a[0] - b[0]), true);
    }
    #drag(event, done) {
        const { held } = this;
        if (!held) return;
        if (done) this.held = null;
        held.drawn ||= Math.hypot(event.clientX - held.x, event.clientY - held.y) > 2; // a press that stays where it is changes nothing
        if (held.drawn) this.#move(held.k, this.#at(event), done);
    }
    #move(k, [radius, factor], done) { // between the keys beside it
        const keys = this.keys.map((key) => [...key]), gap = 0.01 * this.thickest;
        keys[k] = [Math.min((keys[k + 1]?.[0] ?? Infinity) - gap, Math.max((keys[k - 1]?.[0] ?? -Infinity) + gap, radius)), factor];
        this.#changed(keys, done);
    }
    #press(event, k) {
        const way = { ArrowLeft: [-0.02, 1], ArrowRight: [0.02, 1], ArrowUp: [0, 1.1], ArrowDown: [0, 1 / 1.1] }[event.key];
        if (!way && event.key !== 'Delete') return;
        event.preventDefault(); // the panel does not scroll
        if (!way) return this.#remove(k);
        const [radius, factor] = this.keys[k];
        this.#move(k, [Math.min(this.thickest, Math.max(0, radius + way[0] * this.thickest)),
            Number(Math.min(highest, Math.max(lowest, factor * way[1])).toPrecision(3))], true);
    }
    async draw() {
        const focused = [...this.points.children].indexOf(document.activeElement);
        this.axis.replaceChildren(
            svg('rect', { x: box.left, y: box.top, width: box.width, height: box.height }),
            ...[0.0625, 0.25, 1, 4, 16].flatMap((factor) => [
                svg('line', { x1: box.left, x2: box.left + box.width, y1: this.#y(factor), y2: this.#y(factor), class: factor === 1 ? 'one' : '' }),
                Object.assign(svg('text', { x: box.left - 4, y: this.#y(factor) + 3, 'text-anchor': 'end' }), { textContent: factor < 1 ? `1/${1 / factor}` : factor }),
            ]),
            ...[0, 0.5, 1].map((share) => Object.assign(svg('text', { x: this.#x(share * this.thickest), y: box.top + box.height + 14, 'text-anchor': share === 1 ? 'end' : 'middle' }),
                { textContent: `${Number((100 * share * this.thickest).toPrecision(2))} cm` })));
        this.points.replaceChildren(...this.keys.map(([radius, factor], k) => {
            const point = svg('circle', {
                class: 'key', cx: this.#x(radius), cy: this.#y(factor), r: 6, tabindex: 0, role: 'slider', 'aria-label': `Key ${k + 1}`,
                'aria-valuemin': lowest, 'aria-valuemax': highest, 'aria-valuenow': factor, 'aria-valuetext': textOf(this.keys[k]),
            });
            point.addEventListener('pointerdown', (event) => {
                this.picture.setPointerCapture(event.pointerId);
                this.held = { k, x: event.clientX, y: event.clientY };
                event.preventDefault();
                point.focus();
            });
            point.addEventListener('focus', () => { this.value.textContent = textOf(this.keys[k]); });
            point.addEventListener('blur', () => { this.value.textContent = ''; });
            point.addEventListener('keydown', (event) => this.#press(event, k));
            return point;
        }));
        this.points.children[focused]?.focus(); // as the one that stood there had it
        if (this.keys.length === 0) {
            this.line.setAttribute('d', `M${box.left},${this.#y(1)}h${box.width}`);
            return;
        }
        const turn = this.turn = (this.turn ?? 0) + 1;
        const values = await this.ask(this.keys.map(([r]) => r), this.keys.map(([, f]) => f), 0, this.thickest, samples);
        if (turn !== this.turn) return; // a later one is asked for
        const way = values.map((value, k) => `${this.#x(this.thickest * k / (samples - 1)).toFixed(1)},${this.#y(Math.max(lowest, value)).toFixed(1)}`);
        this.line.setAttribute('d', 'M' + way.join('L'));
    }
}
