// opening.mjs: what the page opens and what it keeps: scenes by preset, by zip, by address; settings that outlast the trees.
import { execFileSync, spawn } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { addressOf, change, closePage, drop, expect, messages, openPage, restarted, saved, small, steps } from './browser.mjs';

const sceneOf = (fields) => JSON.stringify({ format: 'bough-scene', version: 1, trees: [{ file: 'shrub.mtg' }], ...fields });
const shrub = (top) => ['shrub.mtg', fs.readFileSync(path.join(top, 'data/fixtures/shrub.mtg'))];
const state = (page) => page.evaluate(() => bough.state);
const clear = (page) => page.evaluate(() => document.querySelectorAll('.message').forEach((one) => one.remove()));

export async function a_scene_names_its_wind({ browser, url, top }) {
    const page = await openPage(browser, addressOf(url, small));
    await drop(page, [['preset.json', sceneOf({ wind: 'gusty' })], shrub(top)]);
    expect((await messages(page)).length === 0, `it says ${await messages(page)}`);
    const opened = (await state(page)).wind;
    await page.click('#wind-calm');
    await page.click('#wind-gusty');
    const pressed = (await state(page)).wind;
    for (const key of ['speed', 'turbulence', 'gustFactor', 'gustPeriod', 'direction'])
        expect(opened[key] === pressed[key] && opened.speed > 0, `${key} is ${opened[key]}, the library's is ${pressed[key]}`);
    await drop(page, [['preset.json', sceneOf({ wind: 'hurricane' })], shrub(top)]);
    const [text] = await messages(page);
    expect(['preset.json', '/wind', 'hurricane', 'storm'].every((word) => text?.includes(word)), `it says "${text}"`);
    await closePage(page);
}

// The scene document that is saved: its text, and the archive.
async function savedScene(page, work) {
    const folder = path.join(work, 'opened');
    fs.rmSync(folder, { recursive: true, force: true });
    fs.mkdirSync(folder);
    const file = await saved(page, '#save-scene', path.join(folder, 'scene.zip'));
    execFileSync('python3', ['-m', 'zipfile', '-e', file, folder]);
    return { document: JSON.parse(fs.readFileSync(path.join(folder, 'scene.json'), 'utf8')), file, folder };
}

export async function a_scene_is_saved_as_it_came({ browser, url, top, work }) {
    const page = await openPage(browser, addressOf(url, small));
    const near = (a, b) => a.every((value, k) => Math.abs(value - b[k]) < 1e-9);
    for (const velocity of [[5, 2, 0], [0, -1, 3], [0, 0, 0]]) {
        await drop(page, [['wind.json', sceneOf({ wind: { velocity, profile: 0.3 } })], shrub(top)]);
        const { document } = await savedScene(page, work), { direction } = (await state(page)).wind;
        expect(near(document.wind.velocity, velocity) && document.wind.profile === 0.3, `${velocity} is saved as ${JSON.stringify(document.wind)}`);
        expect(direction >= 0 && direction < 360, `the direction is ${direction}`);
    }
    await drop(page, [['still.json', sceneOf({})], shrub(top)]);
    expect(!('wind' in (await savedScene(page, work)).document), 'a scene without air is saved with a wind');
    await change(page, '({ wind }) => { wind.speed = 3; }');
    expect(near((await savedScene(page, work)).document.wind.velocity, [3, 0, 0]), 'a wind that was begun is not saved');
    expect((await messages(page)).length === 0, `it says ${await messages(page)}`);
    await closePage(page);
}

export async function its_own_archive_opens_again({ browser, url, work }) {
    const page = await openPage(browser, addressOf(url, small));
    await change(page, '(state) => { state.wind.speed = 7; state.wind.direction = 200; state.stiffness = 2; state.strength = 90; }');
    await restarted(page);
    const first = await steps(page, 20), { file, folder } = await savedScene(page, work), bytes = fs.readFileSync(file);
    await drop(page, [['scene.zip', bytes]]);
    expect((await messages(page)).length === 0, `it says ${await messages(page)}`);
    const now = await state(page);
    expect(Math.abs(now.wind.direction - 200) < 1e-6 && now.stiffness === 2 && now.strength === 90 && now.trees[0].file, `it is ${JSON.stringify(now)}`);
    await restarted(page);
    const again = await steps(page, 20), off = Math.max(...again.map((value, k) => Math.abs(value - first[k])));
    expect(off < 1e-6, `opened again it moves otherwise, by ${off} m`);
    execFileSync('python3', ['-c', 'import zipfile; z = zipfile.ZipFile("packed.zip", "w", zipfile.ZIP_DEFLATED); z.write("scene.json")'], { cwd: folder });
    for (const [name, content, word] of [['packed.zip', fs.readFileSync(path.join(folder, 'packed.zip')), 'compressed'], ['half.zip', bytes.subarray(0, bytes.length / 2), 'cut off']]) {
        await clear(page);
        await drop(page, [[name, content]]);
        const [text] = await messages(page);
        expect(text?.startsWith(name) && text.includes(word), `${name}: says "${text}"`);
    }
    await closePage(page);
}

export async function other_trees_keep_what_was_set({ browser, url, top }) {
    const page = await openPage(browser, addressOf(url, small));
    await change(page, `(state) => {
        state.rate = 120; state.precision = 'double'; state.stiffness = 3; state.damping = 2; state.gravity = 5; state.strength = 80; state.wind.speed = 2;
        state.curves.keys.stiffness = [[0, 2], [0.1, 1]];
    }`);
    const own = ({ rate, precision, stiffness, damping, gravity, strength, wind, curves }) => JSON.stringify([rate, precision, stiffness, damping, gravity, strength, wind, curves]);
    const set = own(await state(page));
    const seed = page.locator('input[aria-label="Seed, number"]');
    await seed.fill('5');
    await seed.press('Enter');
    await page.waitForFunction(() => !bough.applying && bough.state.trees[0].seed === 5);
    expect(own(await state(page)) === set, `another seed has ${own(await state(page))} after ${set}`);
    await drop(page, [shrub(top)]);
    expect(own(await state(page)) === set, `a dropped file has ${own(await state(page))} after ${set}`);
    await drop(page, [['scene.json', sceneOf({ damping_scale: 5 })], shrub(top)]); // a scene says its own, but for how it is computed
    const { rate, precision, damping, stiffness } = await state(page);
    expect(rate === 120 && precision === 'double' && damping === 5 && stiffness === 1, `a scene has ${[rate, precision, damping, stiffness]}`);
    await closePage(page);
}

export async function an_address_is_put_in_place_of_another({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    const other = new URL(addressOf(url, { ...small, stiffness: 4, wind: { speed: 9 } })).hash;
    await page.evaluate((hash) => { location.hash = hash; }, other);
    await page.waitForFunction(() => bough.state.stiffness === 4 && !bough.applying, null, { timeout: 20000 });
    expect((await state(page)).wind.speed === 9 && (await state(page)).wind.gustFactor > 1, `the wind is ${JSON.stringify((await state(page)).wind)}`);
    await page.waitForFunction(() => !document.getElementById('undo').disabled);
    const before = await page.evaluate(() => location.hash);
    await page.evaluate(() => { location.hash = '#s=nothing'; });
    await page.waitForSelector('.message.error');
    const [text] = await messages(page);
    expect(text.includes('address') && text.includes('stays as it was'), `it says "${text}"`);
    await page.waitForFunction((before) => location.hash === before, before);
    expect((await state(page)).stiffness === 4, 'a broken address changed the scene');
    await closePage(page);
}

export async function a_scene_too_long_for_the_address_stays({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    await change(page, '(state) => { state.stiffness = 2; }');
    await page.waitForFunction((url) => location.href !== url, addressOf(url, small));
    const fitted = await page.evaluate(() => location.hash);
    for (const factor of [1, 2])
        await change(page, `(state) => { state.parts = Array.from({ length: 150 }, (_, k) => ({ place: 0, body: k + 1, stiffness: ${factor} + Math.sin(k) ** 2, damping: 1 })); }`);
    await page.waitForSelector('.message');
    const said = await page.$$eval('.message', (all) => all.map((one) => one.textContent));
    expect(said.length === 1 && said[0].includes('too long for an address') && said[0].includes('Scene for treesim'), `it says ${said}`);
    expect(await page.evaluate(() => location.hash) === fitted, 'the address that fitted is gone');
    const before = JSON.stringify(await state(page));
    await page.reload();
    await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
    const { parts, stiffness } = await state(page);
    expect(JSON.stringify(await state(page)) === before, `loaded again it has ${parts.length} subtrees, stiffness ${stiffness}`);
    await change(page, '(state) => { state.parts = []; state.stiffness = 3; }'); // fits again
    await page.waitForFunction((fitted) => location.hash !== fitted, fitted);
    await page.reload();
    await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
    expect((await state(page)).stiffness === 3 && (await state(page)).parts.length === 0, 'what fits is not what is loaded');
    await closePage(page);
}

export async function gravity_that_is_not_saved_is_told({ browser, url, work }) {
    const page = await openPage(browser, addressOf(url, small)), said = () => page.$$eval('.message', (all) => all.map((one) => one.firstChild.textContent));
    await savedScene(page, work);
    expect((await said()).length === 0, `it says ${await said()}`);
    await change(page, '(state) => { state.gravity = 25; }');
    await savedScene(page, work);
    expect((await said()).some((text) => text.includes('25') && text.includes('9.81')), `a saved scene: it says ${await said()}`);
    await clear(page);
    const length = page.locator('input[aria-label="Length, number"]');
    await length.fill('0.5');
    await length.press('Enter');
    await saved(page, '#save-glb', path.join(work, 'gravity.glb'));
    await page.waitForFunction(() => /MB written/.test(document.getElementById('messages').textContent));
    expect((await said()).some((text) => text.includes('25') && text.includes('9.81')), `a motion: it says ${await said()}`);
    await closePage(page);
}

export async function a_served_file_is_loaded_again({ browser, folder, top }) {
    const server = spawn('python3', [path.join(top, 'tools/live/serve.py'), folder, '0', path.join(top, 'data/fixtures/shrub.mtg')]);
    try {
        const address = await new Promise((done, failed) => {
            server.stdout.once('data', (text) => done(String(text).trim()));
            server.once('exit', () => failed(new Error('no server')));
        });
        const page = await openPage(browser, address);
        const opened = await page.evaluate(() => [bough.state.trees[0].name, bough.history.past.length]);
        expect(opened[0] === 'shrub.mtg' && opened[1] === 0, `first it shows ${opened[0]}, behind ${opened[1]} others`);
        await change(page, '(state) => { state.wind.speed = 11; state.stiffness = 2; }');
        await page.waitForFunction(() => location.hash.startsWith('#s='));
        await page.reload();
        await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
        const again = await page.evaluate(() => [bough.state.trees[0].name, bough.state.wind.speed, bough.state.stiffness].join());
        expect(again === 'shrub.mtg,11,2' && (await messages(page)).length === 0, `loaded again it is ${again}, and says ${await messages(page)}`);
        await closePage(page);
    } finally {
        server.kill();
    }
}

export async function without_a_clipboard_the_address_is_shown({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small), { before: 'Object.defineProperty(navigator, "clipboard", { value: undefined });' });
    await page.evaluate(() => { [...document.querySelectorAll('details')].at(-1).open = true; });
    await page.click('#share');
    await page.waitForSelector('.message');
    const text = await page.textContent('.message');
    expect(!text.includes('is copied'), `it says "${text}"`);
    const [shown, address, chosen] = await page.evaluate(() => [document.querySelector('.message input')?.value, location.href, String(getSelection())]);
    expect(shown === address, `it shows ${shown} in place of ${address}`);
    expect(chosen === '' || chosen === address, `"${chosen}" is chosen`);
    await closePage(page);
}

// Copied to another web server, below its root, in a folder whose name has a blank; then to one that does not know what WebAssembly is.
export async function another_server_has_it_below_its_root({ browser, folder, work }) {
    const root = path.join(work, 'other_server'), place = 'a b/trees.live';
    fs.rmSync(root, { recursive: true, force: true });
    fs.cpSync(folder, path.join(root, place), { recursive: true });
    const own = ['-u', '-m', 'http.server', '0', '--bind', '127.0.0.1'];
    const untold = ['-u', '-c', 'import http.server as s; s.SimpleHTTPRequestHandler.extensions_map[".wasm"] = "text/plain"; s.test(s.SimpleHTTPRequestHandler, s.ThreadingHTTPServer, port=0, bind="127.0.0.1")'];
    for (const command of [own, untold]) {
        const server = spawn('python3', command, { cwd: root });
        try {
            const port = await new Promise((done, failed) => {
                server.stdout.on('data', (text) => /port (\d+)/.test(text) && done(/port (\d+)/.exec(text)[1]));
                server.once('exit', () => failed(new Error('no server')));
            });
            const address = `http://127.0.0.1:${port}/${encodeURI(place)}/`, asked = [], bad = [];
            const page = await openPage(browser, 'about:blank', { waits: false });
            page.on('request', (request) => asked.push(request.url()));
            page.on('response', (answer) => answer.status() >= 400 && bad.push(answer.url()));
            await page.goto(address);
            await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
            await page.evaluate(() => { bough.view.draw = function () { this.orbit.place(this.camera); }; });
            await page.evaluate(() => bough.open('young_maple'));
            expect(await page.evaluate(() => bough.state.trees[0].file) === 'young_maple' && (await messages(page)).length === 0, `it says ${await messages(page)}`);
            const elsewhere = asked.filter((one) => !one.startsWith(address) && !/^(blob|data):/.test(one));
            expect(asked.length >= 5 && elsewhere.length === 0 && bad.length === 0, `asks for ${elsewhere}, is refused ${bad}`);
            await page.waitForFunction(() => location.hash.startsWith('#s='));
            const shared = await page.evaluate(() => location.href);
            await closePage(page);
            const other = await openPage(browser, shared); // an address that was passed on
            expect(await other.evaluate(() => bough.state.trees[0].file) === 'young_maple', 'the address opens another tree');
            await closePage(other);
        } finally {
            server.kill();
        }
    }
}
