// measures.mjs: sizes and times. A step's time is printed, and decides nothing: it is the machine's. JavaScript's beside it is small on any.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { closePage, expect, openPage, steps, still } from './browser.mjs';

const most = 1.5e6; // bytes, gzipped: what it loads to open, as is promised

const scriptMost = 5 * 2; // ms of a frame: five times what it may have, as others work on the machine that tests

export async function the_page_is_small({ folder }) {
    const names = ['index.html', 'style.css', 'page.js', 'worker.js', 'bough.wasm'];
    const sizes = names.map((name) => gzipSync(fs.readFileSync(path.join(folder, name)), { level: 9 }).length);
    const all = sizes.reduce((a, b) => a + b, 0);
    const asked = ['young_maple.xml', 'bough_live.html'].map((name) => `${name} ${gzipSync(fs.readFileSync(path.join(folder, name)), { level: 9 }).length}`);
    console.log(`    gzipped: ${names.map((name, k) => `${name} ${sizes[k]}`).join(', ')}; all ${all} bytes. Not counted, as it comes when asked for: ${asked.join(', ')}`);
    expect(all <= most, `${all} bytes gzipped, expected at most ${most}: what was added is worth that, or is left out`);
}

// What the way to the first motion is made of; the quickest of three, in a browser that has nothing of the page yet. Its length is the machine's.
export async function what_opening_takes({ browser, url }) {
    const all = [];
    for (let k = 0; k < 3; ++k) {
        const page = await openPage(browser, url);
        all.push(await page.evaluate(async () => {
            const file = (name) => performance.getEntriesByType('resource').find((one) => one.name.endsWith(`/${name}`));
            return { ...bough.times, ...await bough.client.ask('memory'), asked: file('bough.wasm').startTime, worker: file('worker.js').startTime };
        }));
        await closePage(page);
    }
    const best = all.sort((a, b) => a.moved - b.moved)[0], s = (ms) => (ms / 1000).toFixed(2);
    console.log(`    seconds after the page is asked for: page.js read ${s(best.read)}, library compiled ${s(best.compiled)}, picture and shaders ready ${s(best.view)}, ` +
        `tree grown ${s(best.grown)}, controls ${s(best.built)}, scene made ${s(best.applied)}, first motion ${s(best.moved)}`);
    expect(best.asked < best.read && best.worker < best.read, 'the library and the Worker wait for page.js');
    expect(best.grown < best.applied && best.trees === 1, `the first tree is grown again: ${best.trees} are there`);
}

export async function what_a_step_costs({ browser, url, work, tools }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.grow({ species: 'maple', age: 22, bodies: 10000, seed: 3, leaves: true, fruit: false, petals: false }));
    await page.evaluate(async () => {
        bough.change(({ wind }) => Object.assign(wind, { speed: 8, turbulence: 0.2, gustFactor: 1.6, gustPeriod: 6 }), true);
        bough.change((state) => { state.rate = 30; }, true);
        await bough.apply(true);
    });
    await still(page);
    await steps(page, 60);
    const cost = await page.evaluate(async () => {
        let sum = 0, count = 0;
        for (let k = 0; k < 200; ++k) {
            const { ms } = await bough.client.ask('frame', { seconds: 0, single: true, buffer: new ArrayBuffer(32 * bough.bodies) });
            if (k >= 100) sum += ms, ++count;
        }
        const script = [];
        for (let k = 0; k < 30; ++k) {
            await new Promise((done) => requestAnimationFrame(done));
            script.push(bough.script + (bough.taking ?? 0));
        }
        script.sort((a, b) => a - b);
        // What a frame copies: one buffer of poses goes to the Worker and comes back, and no other is made.
        const own = ArrayBuffer, { worker } = bough.client, post = worker.postMessage;
        let made = 0, frames = 0;
        const moved = new Set();
        globalThis.ArrayBuffer = new Proxy(own, { construct(of, given) { ++made; return new of(...given); } });
        worker.postMessage = function (message, transfer) {
            if (message[1] === 'frame') ++frames, moved.add(transfer.reduce((bytes, one) => bytes + one.byteLength, 0));
            return post.call(worker, message, transfer);
        };
        while (frames < 30) await new Promise((done) => requestAnimationFrame(done));
        globalThis.ArrayBuffer = own;
        worker.postMessage = post;
        return { ms: sum / count, script: script[15], bodies: bough.bodies, made, moved: [...moved] };
    });
    expect(cost.made === 0 && cost.moved.join() === String(32 * cost.bodies), `in 30 frames ${cost.made} buffers were made; each moves ${cost.moved} bytes of ${32 * cost.bodies}`);
    expect(cost.script < scriptMost, `JavaScript takes ${cost.script} ms of a frame, expected less than ${scriptMost}`);
    execFileSync('bash', ['-c', 'treegen --species maple --age 22 --bodies 10000 --seed 3 --leaves -q | treeconvert - -q -o maple.safetensors'],
        { cwd: work, env: { ...process.env, PATH: `${tools}:${process.env.PATH}` } });
    const profile = () => {
        const table = execFileSync(path.join(tools, 'treeprofile'), ['maple.safetensors', '--wind', 'gusty', '--precision', 'float', '--simd', 'baseline',
            '--threads', '1'], { cwd: work, encoding: 'utf8' });
        return Number(/^total +([0-9.]+)/m.exec(table)[1]) * cost.bodies / 1e6; // from ns a body
    };
    const native = Math.min(...[0, 1, 2].map(profile));
    console.log(`    ${cost.bodies} bodies in leaf: a step ${cost.ms.toFixed(2)} ms in the page, ${native.toFixed(2)} ms by treeprofile --simd baseline: ` +
        `${(cost.ms / native).toFixed(2)} times; JavaScript ${cost.script.toFixed(2)} ms a frame`);
    await closePage(page);
}
