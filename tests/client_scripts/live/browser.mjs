// browser.mjs: the page in a real Chromium, as the tests use it.
import { createRequire } from 'node:module';
import path from 'node:path';
import { deflateRawSync } from 'node:zlib';

const { chromium } = createRequire(path.join(process.env.BOUGH_NODE_MODULES, 'any.js'))('playwright-core');

const flags = ['--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--no-first-run', '--no-default-browser-check'];

export async function openBrowser() {
    return chromium.launch({ executablePath: '/usr/bin/chromium', args: flags, chromiumSandbox: false });
}

export function expect(holds, what) {
    if (!holds) throw new Error(what);
}
export const norm = (a) => Math.hypot(...a);
export const less = (a, b) => a.map((value, k) => value - b[k]);

// A page that has begun; behind its first pictures it draws none, unless `draws`: without a graphics card they take a second each.
export async function openPage(browser, url, { size = [1280, 800], touch = false, before = null, waits = true, draws = false } = {}) {
    const context = await browser.newContext({
        viewport: { width: size[0], height: size[1] }, hasTouch: touch, acceptDownloads: true, permissions: ['clipboard-read', 'clipboard-write'],
    });
    const page = await context.newPage();
    page.errors = [];
    page.on('pageerror', (error) => page.errors.push(String(error)));
    page.on('console', (message) => message.type() === 'error' && page.errors.push(message.text()));
    if (before) await page.addInitScript(before);
    await page.goto(url);
    if (!waits) return page;
    await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
    if (!draws) await page.evaluate(() => { bough.view.draw = function () { this.orbit.place(this.camera); }; });
    return page;
}

// What a page said on the console as an error fails its test.
export async function closePage(page) {
    await page.context().close();
    expect(page.errors.length === 0, `the console says: ${page.errors.slice(0, 3).join(' | ')}`);
}

// A tree that is there at once, and an address that holds a state, or what of it is not the page's own.
export const small = {
    trees: [{ species: 'apple', age: 4, bodies: 200, seed: 1, leaves: false, petals: false, fruit: false }],
    places: [{ tree: 0, position: [0, 0, 0], yaw: 0, start: 0 }],
};
export const addressOf = (url, state) => `${url}#s=${deflateRawSync(JSON.stringify(state)).toString('base64url')}`;

// What a button of the panel's last part has the browser save.
export async function saved(page, button, to) {
    await page.evaluate(() => { [...document.querySelectorAll('details')].at(-1).open = true; });
    const [download] = await Promise.all([page.waitForEvent('download', { timeout: 180000 }), page.click(button)]);
    await download.saveAs(to);
    return to;
}

// The page stands still, and takes single steps as they are asked for.
export async function still(page) {
    await page.evaluate(() => new Promise((done) => {
        bough.bar.toggle(true);
        const wait = () => bough.asking ? setTimeout(wait, 10) : done();
        wait();
    }));
}
export async function restarted(page) {
    await still(page);
    await page.evaluate(async () => bough.apply(true));
}
// So many steps, hands at their targets; the places of all bodies behind the last.
export async function steps(page, count, targets = []) {
    return page.evaluate(async ([count, targets]) => {
        for (let k = 0; k < count; ++k) {
            const answer = await bough.client.ask('frame', { seconds: 0, single: true, buffer: new ArrayBuffer(32 * bough.bodies), targets });
            bough.view.take(new Float32Array(answer.poses));
        }
        return Array.from(await bough.client.ask('positions'));
    }, [count, targets]);
}
export const at = (positions, body) => positions.slice(3 * body, 3 * body + 3);

// The page's state changed as its controls do it, and taken.
export async function change(page, edit) {
    await page.evaluate(`(async () => {
        bough.change(${edit}, true);
        while (bough.applying) await bough.applying;
    })()`);
}

// A thick branch that ends far out, and where on the screen it is: [body, x, y].
export async function branchOnScreen(page) {
    return page.evaluate(async () => {
        const { view, mesh } = bough, places = await bough.client.ask('positions');
        const carries = new Uint8Array(mesh.parent.length);
        mesh.parent.forEach((parent) => { if (parent >= 0) carries[parent] = 1; });
        const found = [];
        for (let i = 0; i < mesh.parent.length; ++i) {
            if (mesh.kind[i] !== 0 || mesh.parent[i] < 0) continue;
            const p = view.point(places.slice(3 * i, 3 * i + 3));
            const [x, y] = view.screen(p);
            const canvas = view.canvas;
            if (x < 60 || y < 60 || x > canvas.clientWidth - 420 || y > canvas.clientHeight - 140) continue;
            found.push([i, x, y, p.y]);
        }
        found.sort((a, b) => b[3] - a[3]);
        // What the ray through that point meets is the branch itself.
        for (const [body, x, y] of found) {
            const ray = view.ray(x, y);
            const hit = await bough.client.ask('pick', { ray: [...ray.origin.toArray(), ...ray.direction.toArray()], aperture: view.aperture(4) });
            if (hit && mesh.kind[hit.body] === 0) return { body: hit.body, x, y, world: hit.world };
        }
        return null;
    });
}

// What the pointer that is down holds, once it does: its body, and where it was taken.
export async function held(page) {
    await page.waitForFunction(() => [...bough.pointers.all.values()].some(({ does }) => does === 'holds'));
    return page.evaluate(() => {
        const { body, world } = [...bough.pointers.all.values()][0];
        return { body, world: world.toArray() };
    });
}

// Files as if they were dropped: [name, bytes] each.
export async function drop(page, files) {
    const all = files.map(([name, bytes]) => [name, Buffer.from(bytes).toString('base64')]);
    await page.evaluate(async (all) => {
        const data = new DataTransfer();
        for (const [name, text] of all) data.items.add(new File([Uint8Array.from(atob(text), (c) => c.charCodeAt(0))], name));
        const opened = bough.files.open;
        let done;
        bough.files.open = (files) => done = opened.call(bough.files, files);
        document.body.dispatchEvent(new DragEvent('drop', { dataTransfer: data, bubbles: true, cancelable: true }));
        bough.files.open = opened;
        await done;
        while (bough.applying) await bough.applying;
    }, all);
}
export async function messages(page) {
    return page.$$eval('.message.error', (all) => all.map((one) => one.firstChild.firstChild.textContent));
}
