// dial.js: the wind as an arrow on a dial, seen from above with what is before the camera up: its tip is drawn to where the wind blows, the
// farther out the faster.
import { svg } from './widgets.js';

const radius = 46, fastest = 25; // units of the drawing; m/s at the rim

export class Dial {
    // change(speed, direction, done)
    constructor(change) {
        this.turn = 0; // [rad] of the camera
        this.line = svg('line', { class: 'wind', x1: 0, y1: 0 });
        this.tip = svg('circle', { class: 'tip', r: 7 });
        const rings = [5, 10, 15, 20].map((speed) => svg('circle', { class: 'ring', r: radius * speed / fastest }));
        this.picture = svg('svg', {
            class: 'dial', viewBox: '-54 -54 108 108', tabindex: 0, role: 'slider', 'aria-label': 'Wind: direction and speed', 'aria-valuemin': 0, 'aria-valuemax': fastest,
        },
            svg('circle', { class: 'rim', r: radius }), ...rings, this.line, this.tip);
        const take = (event, done) => {
            const box = this.picture.getBoundingClientRect();
            const x = 108 * (event.clientX - box.left) / box.width - 54, y = 108 * (event.clientY - box.top) / box.height - 54;
            const speed = Math.min(fastest, fastest * Math.hypot(x, y) / radius);
            const direction = (Math.atan2(-y, x) + this.turn) * 180 / Math.PI;
            change(Math.round(2 * speed) / 2, Math.round(((direction % 360) + 360) % 360), done);
        };
        this.picture.addEventListener('pointerdown', (event) => {
            this.picture.setPointerCapture(event.pointerId);
            this.held = true;
            take(event, false);
        });
        this.picture.addEventListener('pointermove', (event) => this.held && take(event, false));
        this.picture.addEventListener('pointerup', (event) => {
            if (this.held) take(event, true);
            this.held = false;
        });
        this.picture.addEventListener('pointercancel', () => { this.held = false; });
        this.picture.addEventListener('keydown', (event) => {
            const way = { ArrowLeft: [0, 10], ArrowRight: [0, -10], ArrowUp: [1, 0], ArrowDown: [-1, 0] }[event.key];
            if (!way) return;
            event.preventDefault(); // the panel does not scroll
            change(Math.min(Math.max(fastest, this.speed), Math.max(0, this.speed + way[0])), (this.direction + way[1] + 360) % 360, true);
        });
    }
    set(speed, direction) {
        Object.assign(this, { speed, direction });
        this.picture.setAttribute('aria-valuenow', speed);
        this.picture.setAttribute('aria-valuetext', `${Number(speed.toPrecision(3))} m/s towards ${Math.round(direction)}°`);
        this.draw();
    }
    follow(azimuth) { // of the camera, which looks along -z at 0
        if (Math.abs(azimuth - this.turn) < 1e-3) return;
        this.turn = azimuth;
        this.draw();
    }
    draw() {
        const angle = this.direction * Math.PI / 180 - this.turn, length = radius * Math.min(1, this.speed / fastest);
        const x = length * Math.cos(angle), y = -length * Math.sin(angle);
        this.line.setAttribute('x2', x);
        this.line.setAttribute('y2', y);
        this.tip.setAttribute('cx', x);
        this.tip.setAttribute('cy', y);
    }
}
