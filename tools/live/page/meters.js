// meters.js: what a step costs, how many bodies, how wrong a step is, what was dropped; and the last seconds of it as a plot.
import { element } from './widgets.js';

const seconds = 10;

export class Meters {
    constructor() {
        this.lines = {};
        const row = (key, label, help) => {
            this.lines[key] = element('span', { class: 'value', id: `meter-${key}` }, '–');
            return element('div', { class: 'meter', title: help }, element('span', {}, label), this.lines[key]);
        };
        this.plot = element('canvas', { class: 'plot', width: 560, height: 120 });
        this.element = element('div', { class: 'meters' },
            row('bodies', 'Bodies', 'rigid pieces of wood, leaves and fruit'),
            row('step', 'One step', 'time that the library takes for one, in the mean'),
            row('frames', 'Frames', 'that are drawn in a second, and how many came late (over 25 ms) in the last ten seconds'),
            row('dropped', 'Time dropped', 'motion that there was no time to compute, in the last ten seconds: it then moves slower than real'),
            row('error', 'Error of the step', 'of the ends of branches over half a second, from a companion with steps a quarter as long: RMS, and its share of their deflection'),
            this.plot,
            element('p', { class: 'legend' }, element('i', { class: 'of-frame' }), 'ms a frame ', element('i', { class: 'of-step' }), 'ms of steps in it'));
        this.frames = []; // { at [s], frame [ms], steps [ms], dropped [s] }
        this.shown = 0;
    }
    add({ at, frame, ms, steps, dropped, bodies, estimate }) {
        this.frames.push({ at, frame, steps: ms * steps, dropped });
        while (this.frames[0].at < at - seconds) this.frames.shift();
        if (at - this.shown < 0.25) return;
        this.shown = at;
        const { lines, frames } = this, late = frames.filter((one) => one.frame > 25).length;
        const lost = frames.reduce((sum, one) => sum + one.dropped, 0);
        const mean = frames.reduce((sum, one) => sum + one.frame, 0) / frames.length;
        lines.bodies.textContent = bodies.toLocaleString('en');
        lines.step.textContent = ms > 0 ? `${ms.toFixed(2)} ms` : '–';
        lines.frames.textContent = `${(1000 / mean).toFixed(mean > 100 ? 1 : 0)} /s, ${late} late`;
        lines.dropped.textContent = `${lost.toFixed(2)} s`;
        lines.dropped.classList.toggle('bad', lost > 0.5);
        lines.error.textContent = !estimate ? (ms > 3 ? 'too large to measure beside' : 'measuring')
            : estimate.refused ? `not known: ${estimate.refused}`
            : !estimate.known ? 'unknown: steps do not resolve it'
            : `${metres(estimate.rms)}${estimate.deflection > 0 ? `, ${(100 * estimate.rms / estimate.deflection).toPrecision(2)} %` : ''}`;
        this.draw(at);
    }
    draw(now) {
        const { plot, frames } = this, pen = plot.getContext('2d'), top = 50; // ms
        const x = (at) => plot.width * (1 - (now - at) / seconds), y = (ms) => plot.height * (1 - Math.min(ms, top) / top);
        pen.clearRect(0, 0, plot.width, plot.height);
        pen.lineWidth = 1;
        pen.strokeStyle = '#c8cdd0';
        for (const ms of [16.7, 33.3]) {
            pen.beginPath();
            pen.moveTo(0, y(ms));
            pen.lineTo(plot.width, y(ms));
            pen.stroke();
        }
        pen.lineWidth = 2;
        for (const [key, color] of [['frame', '#8a9aa6'], ['steps', '#2f6f4e']]) {
            pen.strokeStyle = color;
            pen.beginPath();
            frames.forEach((one, k) => k === 0 ? pen.moveTo(x(one.at), y(one[key])) : pen.lineTo(x(one.at), y(one[key])));
            pen.stroke();
        }
    }
}

export function metres(length) {
    return length >= 0.1 ? `${length.toPrecision(2)} m` : length >= 1e-3 ? `${(1000 * length).toPrecision(2)} mm` : `${(1e6 * length).toPrecision(2)} µm`;
}
