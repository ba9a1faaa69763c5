// pointers.js: mice, fingers and pens on the picture. One on a branch takes it in hand, for as long as it is down; one beside turns the camera, two
// beside come nearer and shift; a short press on a branch picks it. What is under a pointer the Worker says, some milliseconds later: what
// the pointer does meanwhile is kept.
import * as THREE from 'three';
import { element } from './widgets.js';

const radius = { touch: 18, pen: 10, mouse: 5 }; // [px] within which a branch is meant
const press = { time: 350, way: 6 }; // [ms], [px]: what is longer is no press
const pinch = { time: 300, way: 12 }; // [ms], [px]: a second finger that comes before the first has done more comes for both

const newtons = (force) => force >= 1000 ? `${Number((force / 1000).toPrecision(2))} kN` : force >= 1 ? `${Number(force.toPrecision(2))} N` : `${Math.round(1000 * force)} mN`;

export class Pointers {
    // page: { client, view, picked(body or null), held(hands), problem(text) }
    constructor(page) {
        this.page = page;
        this.all = new Map();
        const { canvas } = page.view;
        canvas.addEventListener('pointerdown', (event) => this.down(event));
        canvas.addEventListener('pointermove', (event) => this.move(event));
        for (const end of ['pointerup', 'pointercancel']) canvas.addEventListener(end, (event) => this.up(event));
        canvas.addEventListener('wheel', (event) => {
            event.preventDefault();
            page.view.orbit.nearer(Math.exp(-0.0015 * event.deltaY));
        }, { passive: false });
        canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    }
    async down(event) {
        const { view, client } = this.page;
        view.canvas.setPointerCapture(event.pointerId);
        const hand = event.pointerId;
        const pointer = { x: event.offsetX, y: event.offsetY, from: [event.offsetX, event.offsetY], at: performance.now(), does: 'asks' };
        this.all.set(hand, pointer);
        const down = () => this.all.get(hand) === pointer; // another press may have followed meanwhile
        pointer.kind = event.pointerType;
        if (event.button > 0 || event.shiftKey || this.#beside().length > 0 || this.#pinches(hand)) {
            pointer.does = event.button > 0 || event.shiftKey ? 'shifts' : 'turns';
            return;
        }
        const ray = view.ray(pointer.x, pointer.y);
        const hit = await client.ask('pick', {
            ray: [...ray.origin.toArray(), ...ray.direction.toArray()],
            aperture: view.aperture(radius[event.pointerType] ?? radius.mouse),
        }).catch((error) => this.page.problem(error.message));
        if (pointer.does !== 'asks') return; // a second finger came for both, or the press was taken away
        pointer.body = hit ? hit.body : null;
        if (!hit) pointer.does = 'turns';
        if (!down()) return this.#pressed(pointer);
        if (!hit) return;
        pointer.does = 'holds';
        pointer.world = new THREE.Vector3(...hit.world);
        pointer.drawn = view.skinned.drawn(hit.body, pointer.world);
        pointer.plane = view.depthPlane(pointer.world);
        view.canvas.classList.add('holds');
        const reach = await client.ask('grab', { hand, body: hit.body, point: hit.point, run: hit.run }).catch((error) => this.page.problem(error.message));
        if (!reach && pointer.does === 'holds') this.#letGo(hand, pointer);
        else if (reach) pointer.way = reach.way; // [m] that the hand goes at most
    }
    move(event) {
        const pointer = this.all.get(event.pointerId);
        if (!pointer) return;
        const { view } = this.page, dx = event.offsetX - pointer.x, dy = event.offsetY - pointer.y;
        const turning = this.#beside();
        const apart = (two) => Math.hypot(two[0].x - two[1].x, two[0].y - two[1].y);
        const before = turning.length === 2 ? apart(turning) : 0;
        pointer.x += dx;
        pointer.y += dy;
        if (pointer.does === 'shifts') view.orbit.shift(dx, dy, view.camera, view.canvas.clientHeight);
        if (pointer.does !== 'turns') return;
        if (turning.length === 2) {
            view.orbit.nearer(Math.max(0.5, Math.min(2, apart(turning) / before)));
            view.orbit.shift(dx / 2, dy / 2, view.camera, view.canvas.clientHeight);
        } else {
            view.orbit.turn(dx, dy);
        }
    }
    up(event) {
        const pointer = this.all.get(event.pointerId);
        if (!pointer) return;
        this.all.delete(event.pointerId);
        pointer.lasted = performance.now() - pointer.at;
        const did = pointer.does;
        if (did === 'holds') this.#letGo(event.pointerId, pointer);
        if (event.type !== 'pointerup') pointer.does = 'nothing';
        else if (did !== 'asks') this.#pressed(pointer);
    }
    // A finger beside another that has hardly begun: both turn and come nearer, wherever they stand. Two that pull a branch each come one after the other.
    #pinches(hand) {
        const [other, ...more] = [...this.all].filter(([id, { kind }]) => id !== hand && kind === 'touch');
        if (this.all.get(hand).kind !== 'touch' || !other || more.length > 0) return false;
        const [first, pointer] = other, way = Math.hypot(pointer.x - pointer.from[0], pointer.y - pointer.from[1]);
        if (!['asks', 'holds'].includes(pointer.does) || (performance.now() - pointer.at > pinch.time && way > pinch.way)) return false;
        if (pointer.does === 'holds') this.#letGo(first, pointer);
        pointer.does = 'turns';
        pointer.pinches = this.all.get(hand).pinches = true;
        return true;
    }
    #beside() { return [...this.all.values()].filter(({ does }) => does === 'turns'); }
    #pressed(pointer) {
        const short = pointer.lasted < press.time && !pointer.pinches;
        const near = Math.hypot(pointer.x - pointer.from[0], pointer.y - pointer.from[1]) < press.way;
        if (short && near && pointer.does !== 'shifts') this.page.picked(pointer.body ?? null);
    }
    // Where hands pull to: the pointer at the depth at which it took the branch.
    targets() {
        const { view } = this.page, all = [];
        for (const [hand, pointer] of this.all) {
            if (pointer.does !== 'holds') continue;
            const to = view.ray(pointer.x, pointer.y).intersectPlane(pointer.plane, new THREE.Vector3());
            if (to) pointer.target = to;
            if (pointer.target) all.push([hand, pointer.target.toArray()]);
        }
        return all;
    }
    arrows() {
        const { view } = this.page;
        for (const [hand, pointer] of this.all)
            if (pointer.does === 'holds' && pointer.target) view.arrow(hand, view.skinned.moved(pointer.body, pointer.drawn), pointer.target);
    }
    // forces: [hand, newtons] each, shown beside what pulls.
    showForces(forces) {
        for (const [hand, force] of forces) {
            const pointer = this.all.get(hand);
            if (pointer?.does !== 'holds') continue;
            if (!pointer.label) document.body.append(pointer.label = element('div', { class: 'force' }));
            pointer.label.textContent = newtons(force);
            pointer.label.style.transform = `translate(${Math.min(pointer.x + 16, innerWidth - 70)}px, ${Math.max(pointer.y - 30, 4)}px)`;
        }
    }
    // What was held broke off.
    lost(hand) {
        const pointer = this.all.get(hand);
        if (pointer?.does !== 'holds') return;
        this.#letGo(hand, pointer);
        this.page.say('What was held broke off.');
    }
    letGoAll() {
        for (const [hand, pointer] of this.all) if (pointer.does === 'holds') this.#letGo(hand, pointer);
    }
    #letGo(hand, pointer) {
        pointer.does = 'nothing';
        pointer.label?.remove();
        if (this.all.get(hand) === pointer || !this.all.has(hand)) this.page.client.ask('letGo', { hand });
        this.page.view.removeArrow(hand);
        const holds = [...this.all.values()].some(({ does }) => does === 'holds');
        this.page.view.canvas.classList.toggle('holds', holds);
    }
}
