// stress.mjs: the page used by chance: some hundred things that a user does, in an order that a seed gives. After each the page says nothing that it
// should not, its Worker answers, every pose is finite, hands are held by pointers that are down and by no others, and memory stays bounded.
// BOUGH_LIVE_SEED (1), BOUGH_LIVE_ACTIONS (150) in the environment. What fails says with which seed, and what was done last.
import fs from 'node:fs';
import path from 'node:path';
import { closePage, drop, expect, openPage } from './browser.mjs';

const seed = Number(process.env.BOUGH_LIVE_SEED ?? 1), actions = Number(process.env.BOUGH_LIVE_ACTIONS ?? 150);
const mostBodies = 3000; // of a tree that is grown: what is stressed is the page, not the processor
const mostHeap = 600e6; // bytes
const sizes = [[1280, 800], [390, 844], [1024, 768], [1920, 1080], [320, 480], [844, 390]];

// What the page may say of what is done here: files that are broken, wood that broke, and what is too slow for this machine.
const expected = [/half\.xml/, /empty\.json/, /picture\.png/, /A step of these/, /broke(n)? (off|in this run)/, /joints broke/, /too long for an address/,
    /shadows are off/, /What was held/, /pose cannot be kept/, /too soft to carry its weight/, /nothing would move/, /is rigid: it cannot/, /What is saved has the gravity/, /stands beside/,
    /address (holds the scene|cannot hold a file|names the file)/, /at rest as it stands/, /MB written/, /^Motion: /, /A motion is being written/];

function mulberry(state) { // uniform in [0, 1)
    return () => {
        state = (state + 0x6d2b79f5) | 0;
        let t = Math.imul(state ^ (state >>> 15), 1 | state);
        t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
        return ((t ^ (t >>> 14)) >>> 0) / 4294967296;
    };
}

class Monkey {
    constructor(page, url, top, browser, random) {
        Object.assign(this, { page, url, top, browser, random });
        this.done = [];
        this.touches = new Map(); // id -> [x, y]
        this.mouseDown = false;
        this.mostUsed = 0;
    }
    one(all) { return all[Math.floor(this.random() * all.length)]; }
    between(low, high) { return low + (high - low) * this.random(); }
    chance(share) { return this.random() < share; }
    place() { // mostly where the tree is
        const { width, height } = this.page.viewportSize();
        return [Math.round(width * this.between(0.05, 0.7)), Math.round(height * this.between(0.1, 0.7))];
    }
    async touch(type) {
        this.cdp ??= await this.page.context().newCDPSession(this.page);
        await this.cdp.send('Input.dispatchTouchEvent', { type, touchPoints: [...this.touches].map(([id, [x, y]]) => ({ x, y, id })) });
    }

    async away(type) {
        if (this.touches.size === 0) return;
        this.touches.clear();
        await this.touch(type);
    }

    kinds() {
        return {
            open: [3, () => this.page.evaluate((name) => { bough.open(name); }, this.one(['maple', 'willow', 'apple', 'park', 'young_maple']))],
            grow: [6, () => this.page.evaluate((source) => { bough.grow(source); }, {
                species: this.one(['maple', 'willow', 'apple', 'birch', 'cherry']), age: this.between(2, 8), bodies: Math.round(this.between(60, mostBodies)), seed: Math.floor(this.between(0, 99)),
                leaves: this.chance(0.6), petals: this.chance(0.2), fruit: this.chance(0.3),
            })],
            load: [4, () => {
                const name = this.one(['young_maple.xml', 'fixtures/meshed_tree.xml', 'fixtures/shuffled.swc', 'fixtures/lines.obj', 'fixtures/shrub.mtg', 'fixtures/simpleforest_small.csv']);
                return drop(this.page, [[path.basename(name), fs.readFileSync(path.join(this.top, 'data', name))]]);
            }],
            load_broken: [2, () => {
                const maple = fs.readFileSync(path.join(this.top, 'data/young_maple.xml'));
                return drop(this.page, [this.one([['half.xml', maple.subarray(0, maple.length / 2)], ['empty.json', Buffer.alloc(0)],
                    ['picture.png', Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0])]])]);
            }],
            pull: [14, async () => {
                if (!this.mouseDown) {
                    await this.page.mouse.move(...this.place());
                    await this.page.mouse.down();
                    this.mouseDown = true;
                }
                await this.page.mouse.move(...this.place(), { steps: 5 });
            }],
            let_go: [8, async () => {
                await this.page.mouse.up();
                this.mouseDown = false;
            }],
            press_fast: [4, async () => { // again before the page has answered
                const [x, y] = this.place();
                await this.page.mouse.up();
                this.mouseDown = false;
                await this.page.mouse.click(x, y, { clickCount: 2 });
                await this.page.mouse.down();
                this.mouseDown = true;
            }],
            finger: [8, async () => {
                const id = this.one([1, 2, 3]), down = this.touches.has(id);
                this.touches.set(id, this.place());
                await this.touch(down ? 'touchMove' : 'touchStart');
            }],
            fingers_up: [5, async () => {
                await this.away('touchEnd');
            }],
            fingers_lost: [1, async () => { // the system takes them
                await this.away('touchCancel');
            }],
            wheel: [3, async () => this.page.mouse.wheel(0, this.between(-2000, 2000))],
            wind: [6, () => this.page.evaluate((id) => document.getElementById(id).click(), this.one(['wind-calm', 'wind-breeze', 'wind-gusty', 'wind-storm']))],
            cut: [4, () => this.set('Breaks at', this.one([0, 0.2, 1, 5, 20]))],
            slide: [12, () => this.slide()],
            type: [6, () => this.type()],
            check: [3, () => this.page.evaluate((k) => {
                const all = [...document.querySelectorAll('#panel input[type=checkbox]')];
                all[Math.floor(k * all.length)].click();
            }, this.random())],
            choose: [3, () => this.page.evaluate(([k, l]) => {
                const all = [...document.querySelectorAll('select')], select = all[Math.floor(k * all.length)];
                select.selectedIndex = Math.floor(l * select.options.length);
                select.dispatchEvent(new Event('change'));
            }, [this.random(), this.random()])],
            curve: [3, () => this.curve()],
            key: [10, () => this.page.keyboard.press(this.one([' ', '.', 'r', 'k', 'Escape', 'Control+z', 'Control+z', 'Control+Shift+Z']))],
            keep: [2, () => this.page.evaluate(() => document.getElementById('keep').click())],
            resize: [4, async () => {
                const [width, height] = this.one(sizes);
                await this.page.setViewportSize({ width, height });
            }],
            sheet: [1, () => this.page.evaluate(() => document.getElementById('sheet').click())],
            hide: [1, () => this.page.evaluate(() => { // a tab that comes back after a while
                bough.last -= 30000;
            })],
            save: [1, () => this.page.evaluate((id) => document.getElementById(id).click(), this.one(['save-scene', 'share']))],
            film: [1, async () => {
                await this.set('Length', 0.5);
                await this.page.evaluate(() => document.getElementById('save-glb').click());
            }],
            close: [1, () => this.reopen()],
            wait: [4, () => new Promise((done) => setTimeout(done, this.between(50, 800)))],
        };
    }
    set(label, value) {
        return this.page.evaluate(([label, value]) => {
            const input = document.querySelector(`input[aria-label="${label}, number"]`);
            input.value = String(value);
            input.dispatchEvent(new Event('change'));
        }, [label, value]);
    }
    slide() { // any slider, in some moves; how a tree is grown is another action's
        return this.page.evaluate(([k, ways]) => {
            const all = [...document.querySelectorAll('#panel input[type=range]')].filter((one) => !['Age', 'Bodies'].includes(one.getAttribute('aria-label')));
            const range = all[Math.floor(k * all.length)];
            for (const way of ways) {
                range.value = 1000 * way;
                range.dispatchEvent(new Event('input'));
            }
            range.dispatchEvent(new Event('change'));
        }, [this.random(), Array.from({ length: 1 + Math.floor(this.between(0, 4)) }, () => this.random())]);
    }
    type() { // any number's field: ends of what it allows, and what is none
        return this.page.evaluate(([k, text]) => {
            const all = [...document.querySelectorAll('#panel input.number')].filter((one) => !/^(Age|Bodies|Length)/.test(one.getAttribute('aria-label')));
            const input = all[Math.floor(k * all.length)];
            input.value = text;
            input.dispatchEvent(new Event('change'));
        }, [this.random(), this.one(['', '0', '-1', '1e99', 'abc', '0,5', '1', '2', '60', '1e-4', '10000', 'NaN', 'Infinity', '200'])]);
    }
    curve() {
        return this.page.evaluate(([row, k, x, y, does]) => {
            const picture = document.querySelectorAll('.editor')[row];
            for (let up = picture.parentElement; up; up = up.parentElement) if (up.tagName === 'DETAILS') up.open = true;
            const [edit, clear] = picture.parentElement.querySelectorAll('button'), box = picture.getBoundingClientRect();
            if (box.width === 0) return; // the panel is closed: nobody reaches it
            const at = { clientX: box.left + x * box.width, clientY: box.top + y * box.height, pointerId: 77, bubbles: true };
            const keys = picture.querySelectorAll('.key');
            if (keys.length === 0) return edit.click();
            if (does < 0.1) return clear.click();
            if (does < 0.4) return picture.dispatchEvent(new MouseEvent('dblclick', at));
            const key = keys[Math.floor(k * keys.length)];
            picture.setPointerCapture = () => {}; // of a pointer that is not there
            key.dispatchEvent(new PointerEvent('pointerdown', { ...at, clientX: at.clientX + 20 }));
            picture.dispatchEvent(new PointerEvent('pointermove', at));
            picture.dispatchEvent(new PointerEvent('pointerup', at));
        }, [this.one([0, 1]), this.random(), this.random(), this.random(), this.random()]);
    }
    async reopen() {
        const address = await this.page.evaluate(() => location.href);
        await closePage(this.page);
        this.cdp = null;
        this.touches.clear();
        this.mouseDown = false;
        this.page = await openPage(this.browser, address, { touch: true });
    }

    async act() {
        const kinds = this.kinds(), all = Object.entries(kinds).flatMap(([name, [weight]]) => Array(weight).fill(name));
        for (let count = this.chance(0.3) ? 3 : 1; count > 0; --count) { // now and then the next before the last is answered
            const name = this.one(all);
            this.done.push(name);
            await kinds[name][1]();
        }
    }

    async check() {
        const { page } = this;
        expect(page.errors.length === 0, `the console says ${page.errors.slice(0, 2).join(' | ')}`);
        const found = await page.evaluate(async () => {
            const late = (what) => new Promise((_, failed) => setTimeout(() => failed(new Error(`${what} for 60 s`)), 60000));
            const until = async (what, holds) => Promise.race([late(what), (async () => { while (!holds()) await new Promise((done) => setTimeout(done, 5)); })()]);
            await until('it is being applied', () => !bough.applying);
            const ask = (name, asked) => Promise.race([late(`the Worker does not answer "${name}"`), bough.client.ask(name, asked)]);
            const frame = await ask('frame', { seconds: 0, buffer: new ArrayBuffer(32 * bough.bodies), targets: [] });
            const pointers = [...bough.pointers.all].map(([hand, { does }]) => [hand, does]);
            const memory = await ask('memory');
            const shown = bough.view.skinned.poses.subarray(0, 8 * bough.bodies);
            return {
                memory, pointers, hands: frame.hands, history: bough.history.past.length + bough.history.future.length,
                bodies: bough.bodies, of_mesh: bough.mesh.parent.length, given: frame.poses.byteLength / 32,
                finite: new Float32Array(frame.poses).every(Number.isFinite) && shown.every(Number.isFinite) && Number.isFinite(frame.time),
                camera: [...bough.view.camera.matrixWorld.elements, ...bough.view.camera.projectionMatrix.elements].every(Number.isFinite),
                arrows: [...bough.view.arrows.keys()],
                shown: [...document.querySelectorAll('.meter .value, input.number:not(.wrong)')].map((one) => one.value ?? one.textContent),
                said: [...document.querySelectorAll('.message')].map((one) => one.firstChild.firstChild.textContent),
            };
        });
        expect(found.finite, 'a pose is not finite');
        expect(found.camera, 'the camera stands nowhere');
        expect(found.bodies === found.of_mesh && found.bodies === found.given, `${found.bodies} bodies run, ${found.of_mesh} are drawn, ${found.given} have poses`);
        expect(found.memory.heap <= mostHeap, `the library has ${found.memory.heap} bytes`);
        const none = found.shown.filter((text) => /NaN|undefined|Infinity/.test(text));
        expect(none.length === 0, `it shows "${none[0]}"`);
        const odd = found.said.filter((text) => !expected.some((one) => one.test(text)));
        expect(odd.length === 0, `the page says "${odd[0]}"`);
        const holds = found.pointers.filter(([, does]) => does === 'holds').map(([hand]) => hand);
        expect(found.hands.every(([hand, force]) => holds.includes(hand) && Number.isFinite(force)), `hands ${JSON.stringify(found.hands)}, pointers ${JSON.stringify(found.pointers)}`);
        expect(found.arrows.every((hand) => holds.includes(hand)), `arrows of ${found.arrows}, held by ${holds}`);
        this.mostUsed = Math.max(this.mostUsed, found.memory.used);
        return found;
    }
}

export async function used_by_chance({ browser, url, top }) {
    const page = await openPage(browser, url, { touch: true });
    const monkey = new Monkey(page, url, top, browser, mulberry(seed));
    try {
        for (let k = 0; k < actions; ++k) {
            await monkey.act();
            await monkey.check();
        }
        console.log(`    seed ${seed}, ${monkey.done.length} things done; memory in use at most ${(monkey.mostUsed / 1e6).toFixed(0)} MB`);
        await closePage(monkey.page);
    } catch (error) {
        throw new Error(`${error.message} (BOUGH_LIVE_SEED=${seed}, action ${monkey.done.length}; the last: ${monkey.done.slice(-8).join(', ')})`);
    }
}

// What was held is let go when a run begins again, and when it is one of other trees; what goes on holds it.
export async function a_run_that_begins_again_holds_nothing({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('willow'));
    const state = async () => page.evaluate(async () => {
        while (bough.applying) await bough.applying;
        return { hands: (await bough.client.ask('memory')).hands, arrows: bough.view.arrows.size, does: [...bough.pointers.all.values()].map(({ does }) => does) };
    });
    const take = async () => {
        await page.mouse.up();
        await page.mouse.move(480, 380);
        for (let k = 0; k < 20; ++k) { // somewhere there is a branch
            await page.mouse.move(420 + 10 * k, 330);
            await page.mouse.down();
            await page.waitForFunction(() => [...bough.pointers.all.values()].every(({ does }) => does !== 'asks'));
            if ((await state()).does[0] === 'holds') break;
            await page.mouse.up();
        }
        await page.mouse.move(600, 300, { steps: 3 });
        await page.waitForFunction(() => bough.view.arrows.size === 1);
        expect((await state()).hands === 1, 'nothing is held');
    };
    await take();
    await page.evaluate(() => { bough.change((own) => { own.stiffness = 2; }, true); });
    const other = await state();
    expect(other.hands === 1 && other.does[0] === 'holds', `other wood: ${JSON.stringify(other)}`);
    const ends = {
        Restart: () => page.evaluate(() => bough.restart()),
        'another tree': () => page.evaluate(() => bough.open('apple')),
        'the tree before': () => page.evaluate(() => bough.undo()),
    };
    for (const [name, act] of Object.entries(ends)) {
        if ((await state()).hands === 0) await take();
        await act();
        const after = await state();
        expect(after.hands === 0 && after.arrows === 0 && !after.does.includes('holds'), `${name}: ${JSON.stringify(after)}`);
    }
    await page.mouse.up();
    await closePage(page);
}

// Many trees one after another, and poses that are kept, do not add up.
export async function memory_is_given_back({ browser, url }) {
    const page = await openPage(browser, url);
    const used = async () => page.evaluate(async () => {
        while (bough.applying) await bough.applying;
        return bough.client.ask('memory');
    });
    const grow = (seed) => page.evaluate((seed) => bough.grow({ species: 'maple', age: 10, bodies: 3000, seed, leaves: true, petals: false, fruit: false }), seed);
    const at = [];
    for (let seed = 1; seed <= 24; ++seed) {
        await grow(1 + seed % 3);
        at.push(await used());
    }
    const [early, late] = [at[5], at[23]]; // the same seed: the same trees are near
    expect(late.used < 1.1 * early.used && late.heap <= early.heap, `after 6 trees ${early.used} bytes, after 24 ${late.used}; heap ${early.heap}, ${late.heap}`);
    expect(late.trees <= 4, `${late.trees} trees are held`);
    for (let k = 0; k < 30; ++k) {
        await page.evaluate(() => bough.keep());
        await used();
    }
    const kept = await used();
    expect(kept.trees <= 26, `${kept.trees} poses are held`);
    console.log(`    a maple of ${await page.evaluate(() => bough.bodies)} bodies: ${(late.used / 1e6).toFixed(1)} MB in use; each pose that is kept ` +
        `${((kept.used - late.used) / kept.trees / 1e6).toFixed(2)} MB`);
    await closePage(page);
}
