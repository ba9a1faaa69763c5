// pointers.js: mice, fingers and pens on the picture. One on a branch takes it in hand, for as long as it is down; one beside turns the camera, two
// beside come nearer and shift; a short press on a branch picks it. What is under a pointer the Worker says, some milliseconds later: what
// the pointer does meanwhile is kept.
import * as THREE from 'three';

const radius = { touch: 18, pen: 10, mouse: 5 }; // [px] within which a branch is meant
const press = { time: 350, way: 6 }; // [ms], [px]: what is longer is no press

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
        if (event.button > 0 || event.shiftKey || this.#beside().length > 0) {
            pointer.does = event.button > 0 || event.shiftKey ? 'shifts' : 'turns';
            return;
        }
        const ray = view.ray(pointer.x, pointer.y);
        const hit = await client.ask('pick', {
            ray: [...ray.origin.toArray(), ...ray.direction.toArray()],
            aperture: view.aperture(radius[event.pointerType] ?? radius.mouse),
        }).catch((error) => this.page.problem(error.message));
        pointer.body = hit ? hit.body : null;
        if (!hit) {
            pointer.does = 'turns';
            if (!down()) this.#pressed(pointer);
            return;
        }
        if (!down()) return this.#pressed(pointer);
        pointer.does = 'holds';
        pointer.world = new THREE.Vector3(...hit.world);
        pointer.drawn = view.skinned.drawn(hit.body, pointer.world);
        pointer.plane = view.depthPlane(pointer.world);
        view.canvas.classList.add('holds');
        const reach = await client.ask('grab', { hand, body: hit.body, point: hit.point, run: hit.run }).catch((error) => this.page.problem(error.message));
        if (!reach) this.#letGo(hand, pointer);
        else pointer.way = reach.way; // [m] that the hand goes at most
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
        const did = pointer.does;
        if (did === 'holds') this.#letGo(event.pointerId, pointer);
        if (did !== 'asks' && event.type === 'pointerup') this.#pressed(pointer);
    }
    #beside() { return [...this.all.values()].filter(({ does }) => does === 'turns'); }
    #pressed(pointer) {
        const short = performance.now() - pointer.at < press.time;
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
        if (this.all.get(hand) === pointer || !this.all.has(hand)) this.page.client.ask('letGo', { hand });
        this.page.view.removeArrow(hand);
        const holds = [...this.all.values()].some(({ does }) => does === 'holds');
        this.page.view.canvas.classList.toggle('holds', holds);
    }
}
