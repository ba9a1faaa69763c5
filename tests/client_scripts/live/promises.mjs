// promises.mjs: what the page comes with, what it says of itself, what it does without a network, and where it has no time.
import fs from 'node:fs';
import path from 'node:path';
import { calm } from './basics.mjs';
import { addressOf, change, closePage, drop, expect, messages, openPage, restarted, small, steps, still } from './browser.mjs';

// Each tree of a list, as it stands: its bodies' relative turns are left out, its places compared.
const farthest = (a, b) => Math.max(...a.map((value, k) => Math.abs(value - b[k])));

export async function each_built_in_moves({ browser, url }) {
    const page = await openPage(browser, url);
    const wanted = { maple: [1, 4000], willow: [1, 4000], apple: [1, 2000], park: [12, 8000], young_maple: [1, 200] };
    const names = await page.$$eval('option', (all) => all.map(({ value }) => value));
    for (const [name, [places, least]] of Object.entries(wanted)) {
        expect(names.includes(name), `"${name}" is not offered`);
        await page.evaluate((name) => bough.open(name), name);
        await restarted(page);
        const first = await steps(page, 1), later = await steps(page, 60), said = await messages(page);
        const [count, trees, kinds] = await page.evaluate(() => [bough.bodies, bough.state.places.length, new Set(bough.mesh.kind).size]);
        expect(said.length === 0, `${name}: says ${said}`);
        expect(trees === places && count > least, `${name}: ${trees} trees of ${count} bodies`);
        expect(name === 'willow' || kinds > 1, `${name} has no leaves`);
        const way = farthest(later, first);
        expect(later.every(Number.isFinite) && way > 0.01, `${name}: in a second of wind the farthest body goes ${way} m`);
    }
    // The young maple wears the bark of its own file: every vertex of it (16 or 6 sides and a seam around each spine), in its own colours.
    const bark = await page.evaluate(async () => {
        const text = new DOMParser().parseFromString(await (await fetch('young_maple.xml')).text(), 'text/xml');
        const written = [...text.querySelectorAll('Points')].reduce((sum, one) => sum + Number(one.getAttribute('Count')), 0);
        const { geometry } = bough.view.skinned.object, color = geometry.getAttribute('color');
        const shades = new Set();
        for (let v = 0; v < color.count; ++v) shades.add([color.getX(v), color.getY(v), color.getZ(v)].map((c) => c.toFixed(3)).join());
        return { written, shown: color.count, shades: shades.size };
    });
    expect(bark.written > 3000 && bark.shown >= bark.written, `its file has ${bark.written} points of bark, the page shows ${bark.shown} vertices`);
    expect(bark.shades > 20, `its bark has ${bark.shades} colours`);
    await closePage(page);
}

export async function gravity_strength_and_rigid_parts({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('apple'));
    await calm(page);
    await restarted(page);
    const rest = await steps(page, 2);
    const mean = (all) => all.filter((_, k) => k % 3 === 1).reduce((a, b) => a + b, 0) / (all.length / 3);
    await change(page, '(state) => { state.gravity = 0; }');
    const light = await steps(page, 120);
    expect(mean(light) > mean(rest) + 1e-4, `without gravity bodies are ${mean(light) - mean(rest)} m higher`);
    await change(page, '(state) => { state.gravity = state.drawnGravity; }');
    // Thin wood that is not to bend goes with what it hangs on: in a storm it keeps its turn against that.
    await page.click('#wind-storm');
    const bent = async (least) => { // the largest turn of thin wood against what it hangs on
        await change(page, `(state) => { state.least = ${least}; }`);
        await restarted(page);
        await steps(page, 60);
        return page.evaluate((thin) => {
            const { poses } = bough.view.skinned, { parent, kind, size } = bough.mesh;
            let most = 0;
            for (let i = 0; i < parent.length; ++i) {
                const p = parent[i];
                if (kind[i] !== 0 || p < 0 || size[3 * i + 1] > thin || size[3 * p + 1] > thin) continue;
                const a = poses.subarray(8 * i + 4, 8 * i + 8), b = poses.subarray(8 * p + 4, 8 * p + 8);
                most = Math.max(most, 1 - Math.abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]));
            }
            return most;
        }, thin);
    };
    const thin = await page.evaluate(() => bough.thickest / 8), free = await bent(0), rigid = await bent(thin);
    expect(free > 1e-4 && rigid < 1e-6, `thin wood turns by ${free}, where it is rigid by ${rigid}`);
    await change(page, '(state) => { state.least = 0; state.strength = 0.5; }');
    await restarted(page);
    const broke = await page.evaluate(async () => {
        let sum = 0;
        for (let k = 0; k < 180; ++k)
            sum += (await bough.client.ask('frame', { seconds: 0, single: true, buffer: new ArrayBuffer(32 * bough.bodies) })).broke;
        return sum;
    });
    expect(broke > 0, 'wood of half a megapascal does not break in a storm');
    await closePage(page);
}

export async function meters_say_what_it_costs({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('young_maple')); // small: five steps of it have room in a frame
    const read = (key) => page.textContent(`#meter-${key}`);
    await page.waitForFunction(() => /(m|µm)(, |$)/.test(document.getElementById('meter-error').textContent), null, { timeout: 60000 });
    const bodies = await page.evaluate(() => bough.bodies);
    expect(await read('bodies') === bodies.toLocaleString('en'), `bodies: ${await read('bodies')}, there are ${bodies}`);
    expect(parseFloat(await read('step')) > 0, `a step: ${await read('step')}`);
    expect(/ \/s, \d+ late$/.test(await read('frames')), `frames: ${await read('frames')}`);
    const drawn = await page.$eval('.plot', (plot) => new Set(new Uint32Array(plot.getContext('2d').getImageData(0, 0, plot.width, plot.height).data.buffer)).size);
    expect(drawn > 2, 'nothing is plotted');
    // A tab that was away for a second does not catch up: it drops what has no room, and says so.
    await still(page);
    const dropped = await page.evaluate(async () => {
        await bough.client.ask('apply', { state: { ...bough.state, rate: 240 }, restart: true });
        let sum = 0, steps = 0;
        for (let k = 0; k < 20; ++k) {
            const answer = await bough.client.ask('frame', { seconds: 2, buffer: new ArrayBuffer(32 * bough.bodies) });
            sum += answer.dropped;
            steps += answer.steps;
        }
        return [sum, steps / 240];
    });
    expect(Math.abs(dropped[0] + dropped[1] - 20 * 0.25) < 0.05 || dropped[0] === 0, `${dropped[0]} s dropped, ${dropped[1]} s computed, of 5 s`);
    await closePage(page);
}

export async function what_is_too_large_says_so({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.grow({ species: 'maple', age: 22, bodies: 40000, seed: 3, leaves: true, fruit: false, petals: false }));
    const before = await page.evaluate(() => bough.bodies);
    await page.waitForSelector('.message.error .buttons', { timeout: 120000 });
    const [text] = await messages(page), offers = await page.$$eval('.message.error .buttons button', (all) => all.map((one) => one.textContent));
    expect(/A step of these [0-9,]+ bodies takes [0-9.]+ ms: too long for 60 a second/.test(text), `it says "${text}"`);
    expect(['Half the bodies', 'Move only thicker wood', '30 steps a second'].every((offer) => offers.includes(offer)), `it offers ${offers}`);
    await page.click('.message.error .buttons button:has-text("Half the bodies")');
    await page.waitForFunction((before) => !bough.applying && bough.bodies < 0.6 * before, before, { timeout: 60000 });
    await closePage(page);
}

export async function a_file_that_is_too_large_is_offered_with_fewer_bodies({ browser, url, top }) {
    const page = await openPage(browser, addressOf(url, small));
    await drop(page, [['maple.xml', fs.readFileSync(path.join(top, 'data/young_maple.xml'))]]);
    const before = await page.evaluate(() => bough.bodies);
    await page.evaluate(() => { // as where each step took too long
        const { ask } = bough.client;
        bough.client.ask = async function (name, ...others) {
            const answer = await ask.call(this, name, ...others);
            return name === 'frame' ? { ...answer, ms: 100, steps: 1 } : answer;
        };
    });
    await page.evaluate(() => { bough.slow = 89; });
    const offer = page.locator('.message.error .buttons button:has-text("Half the bodies")');
    await offer.waitFor({ timeout: 60000 });
    await offer.click();
    await page.waitForFunction((before) => !bough.applying && bough.bodies < 0.8 * before, before, { timeout: 60000 });
    expect(await page.evaluate(() => bough.state.trees[0].name) === 'maple.xml', 'another tree is shown');
    await closePage(page);
}

export async function nothing_comes_from_elsewhere({ browser, url, file }) {
    for (const address of [url, `file://${file}`]) {
        const asked = [];
        const page = await openPage(browser, 'about:blank', { waits: false });
        page.on('request', (request) => asked.push(request.url()));
        await page.goto(address);
        await page.waitForFunction(() => globalThis.bough?.times.moved, null, { timeout: 60000 });
        await page.evaluate(() => { bough.view.draw = function () { this.orbit.place(this.camera); }; });
        const own = address.startsWith('file:') ? (one) => one === address : (one) => one.startsWith(new URL(url).origin + '/');
        const foreign = asked.filter((one) => !own(one) && !one.startsWith('blob:') && !one.startsWith('data:'));
        expect(asked.length > 0 && foreign.length === 0, `${address} asks for ${foreign}`);
        // Without a network it goes on, with other trees too.
        await page.context().setOffline(true);
        await page.evaluate(() => bough.open('willow'));
        expect(await page.evaluate(() => bough.state.trees[0].species) === 'willow', `it says ${await messages(page)}`);
        await closePage(page);
    }
}
