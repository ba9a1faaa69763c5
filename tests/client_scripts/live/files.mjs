// files.mjs: files that are dropped, and what is saved.
import { execFileSync } from 'node:child_process';
import { createRequire } from 'node:module';
import fs from 'node:fs';
import path from 'node:path';
import { addressOf, change, closePage, drop, expect, messages, openPage, restarted, saved, small, steps } from './browser.mjs';

const need = createRequire(path.join(process.env.BOUGH_NODE_MODULES, 'any.js'));

export async function dropped_files_stand_and_move({ browser, url, top, work, tools }) {
    const page = await openPage(browser, url);
    const data = (name) => fs.readFileSync(path.join(top, 'data', name));
    execFileSync('bash', ['-c', `treegen --species apple --age 6 --bodies 400 -q | tee splines.json | treeconvert - -q -o apple.safetensors
        treeconvert splines.json -q -o apple.tree.json`], { cwd: work, env: { ...process.env, PATH: `${tools}:${process.env.PATH}` } });
    const made = (name) => fs.readFileSync(path.join(work, name));
    const files = [
        ['young_maple.xml', data('young_maple.xml')], ['meshed_tree.xml', data('fixtures/meshed_tree.xml')], ['shuffled.swc', data('fixtures/shuffled.swc')],
        ['twig_armature.gltf', embedded(data('fixtures/twig_armature.gltf'), top)], ['lines.obj', data('fixtures/lines.obj')], ['shrub.mtg', data('fixtures/shrub.mtg')],
        ['simpleforest_small.csv', data('fixtures/simpleforest_small.csv')], ['apple.safetensors', made('apple.safetensors')],
        ['apple.tree.json', made('apple.tree.json')], ['splines.json', made('splines.json')],
    ];
    const moved = {};
    for (const [name, bytes] of files) {
        await drop(page, [[name, bytes]]);
        await restarted(page);
        const said = await messages(page);
        expect(said.length === 0, `${name}: ${said}`);
        expect(await page.evaluate(() => bough.state.trees[0].name) === name, `${name} is not what is shown`);
        const all = await steps(page, 10);
        expect(all.length > 0 && all.every(Number.isFinite), `${name}: does not move`);
        moved[name] = all;
    }
    // The same tree by its decimals and by its bits.
    const [decimals, bits] = [moved['apple.tree.json'], moved['apple.safetensors']];
    expect(decimals.every((value, k) => value === bits[k]), 'a tree moves otherwise as JSON than as safetensors');
    // A scene with the tree it names.
    const scene = { format: 'bough-scene', version: 1, trees: [{ file: 'some/apple.safetensors', places: [{ position: [0, 0, 0] }, { position: [5, 0, 0], yaw: 90 }] }],
        wind: { velocity: [0, 0, -9] }, leaves: { kappa: 0.5 } };
    await drop(page, [['two.json', JSON.stringify(scene)], ['apple.safetensors', made('apple.safetensors')]]);
    const state = await page.evaluate(() => bough.state);
    expect(state.places.length === 2 && state.wind.direction === 90 && state.base.leaves.kappa === 0.5, `the scene is ${JSON.stringify(state)}`);
    await closePage(page);
}

function embedded(text, top) { // its buffer inside, as a page reads no file beside it
    const gltf = JSON.parse(text);
    for (const buffer of gltf.buffers ?? [])
        if (buffer.uri && !buffer.uri.startsWith('data:'))
            buffer.uri = 'data:application/octet-stream;base64,' + fs.readFileSync(path.join(top, 'data/fixtures', decodeURIComponent(buffer.uri))).toString('base64');
    return Buffer.from(JSON.stringify(gltf));
}

export async function broken_files_say_what_and_where({ browser, url, top }) {
    const page = await openPage(browser, url);
    const before = await page.evaluate(() => JSON.stringify(bough.state));
    const maple = fs.readFileSync(path.join(top, 'data/young_maple.xml'), 'utf8');
    const cases = [
        ['half.xml', maple.slice(0, maple.length / 2), ['half.xml:', 'line', 'half.xml']],
        ['broken.json', '{"format": "bough-tree", "version": 1, "parent": [0]}', ['broken.json', '/mass']],
        ['picture.png', Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0]), ['picture.png', 'expected']],
        ['old.fbx', Buffer.concat([Buffer.from('Kaydara FBX Binary  \0'), Buffer.alloc(200)]), ['old.fbx', 'FBX', 'treeconvert']],
        ['scene.json', '{"format": "bough-scene", "version": 1, "trees": [{"file": "gone.json"}]}', ['scene.json', 'gone.json', 'dropped']],
    ];
    for (const [name, bytes, words] of cases) {
        await page.evaluate(() => document.querySelectorAll('.message').forEach((one) => one.remove()));
        await drop(page, [[name, Buffer.from(bytes)]]);
        const [text] = await messages(page);
        expect(text && words.some((word) => text.includes(word)) && text.includes(words.at(-1)), `${name}: says "${text}"`);
        expect(await page.evaluate(() => JSON.stringify(bough.state)) === before, `${name}: the scene is no longer what it was`);
    }
    expect((await steps(page, 2)).every(Number.isFinite), 'it no longer runs');
    await closePage(page);
}

export async function treesim_makes_the_same_motion({ browser, url, work, tools }) {
    const page = await openPage(browser, url);
    await sameMotion(page, 'the first scene', { work, tools, perFrame: 2, precision: 'float' }); // 60 steps a second
    await page.evaluate(() => bough.open('apple'));
    await change(page, `(state) => {
        state.precision = 'double'; state.rate = 30; state.damping = 2; state.wind.speed = 6; state.wind.direction = 40;
        state.curves.keys.stiffness = [[0, 1.5], [0.05, 0.8], [0.2, 1]]; state.parts = [{ place: 0, body: 5, stiffness: 2, damping: 1 }];
    }`);
    await sameMotion(page, 'an apple with curves', { work, tools, perFrame: 1, precision: 'double' });
    await closePage(page);
}

// What is shown is saved, and run by treesim: every body over 2 s, frame by frame at 30 a second.
async function sameMotion(page, name, { work, tools, perFrame, precision }) {
    const folder = path.join(work, 'saved');
    fs.rmSync(folder, { recursive: true, force: true });
    fs.mkdirSync(folder);
    await saved(page, '#save-scene', path.join(folder, 'scene.zip'));
    execFileSync('python3', ['-m', 'zipfile', '-e', 'scene.zip', '.'], { cwd: folder });
    execFileSync(path.join(tools, 'treesim'), ['scene.json', '--fps', '30', '--substeps', String(perFrame), '--precision', precision, '--settle', '0',
        '--frames', '61', '--fields', 'pose', '-q', '-o', 'motion.jsonl'], { cwd: folder });
    const frames = fs.readFileSync(path.join(folder, 'motion.jsonl'), 'utf8').trim().split('\n').slice(1).map((line) => JSON.parse(line));
    await restarted(page);
    let off = 0, moved = 0;
    const first = frames[0].position.flat();
    const heights = first.filter((_, k) => k % 3 === 1), height = Math.max(...heights) - Math.min(...heights);
    for (let f = 1; f < frames.length; ++f) {
        const own = await steps(page, perFrame), theirs = frames[f].position.flat();
        expect(own.length === theirs.length, `${name}: ${own.length / 3} bodies, treesim has ${theirs.length / 3}`);
        for (let k = 0; k < own.length; ++k) {
            off = Math.max(off, Math.abs(own[k] - theirs[k]));
            moved = Math.max(moved, Math.abs(theirs[k] - first[k]));
        }
    }
    console.log(`    ${name}: treesim's motion of 2 s: ${off.toExponential(2)} m off at most, ${(off / height).toExponential(1)} of the height; ` +
        `it moves by ${moved.toFixed(3)} m`);
    expect(off < 1e-4 * height && moved > 100 * off, `${name}: off by ${off} m of ${height} m, moving by ${moved} m`);
}

export async function glb_that_the_validator_passes({ browser, url, work }) {
    const page = await openPage(browser, url);
    const validator = need('gltf-validator');
    for (const [name, loop] of [['apple', false], ['young_maple', false], ['apple', true]]) {
        await page.evaluate((name) => bough.open(name), name);
        await page.evaluate((loop) => {
            const section = [...document.querySelectorAll('details')].at(-1);
            section.open = true;
            section.querySelector('input[type=checkbox]').checked = loop;
            const length = section.querySelector('input[aria-label="Length, number"]');
            length.value = '2';
            length.dispatchEvent(new Event('change'));
        }, loop);
        const file = await saved(page, '#save-glb', path.join(work, `${name}${loop ? '_loop' : ''}.glb`));
        const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)));
        expect(report.issues.numErrors === 0, `${name}: ${JSON.stringify(report.issues.messages.slice(0, 3))}`);
        expect(report.info.animationCount === 1 && report.info.totalVertexCount > 1000, `${name}: ${JSON.stringify(report.info)}`);
    }
    await closePage(page);
}

// What is shown goes on while a motion is written, which can be given up.
export async function a_motion_is_written_beside_the_run({ browser, url, work }) {
    const page = await openPage(browser, addressOf(url, small));
    await page.evaluate(() => { for (const one of document.querySelectorAll('details')) one.open = true; });
    const length = page.locator('input[aria-label="Length, number"]');
    await length.fill('60');
    await length.press('Enter');
    await page.click('#save-glb');
    await page.waitForFunction(() => /^Motion: [1-9][0-9]* %/.test(document.querySelector('.message')?.textContent), null, { timeout: 120000 });
    const time = await page.evaluate(() => bough.answer.time);
    await page.waitForFunction((time) => bough.answer.time > time, time, { timeout: 20000 });
    expect(/^Motion: [0-9]+ %/.test(await page.textContent('.message')), 'the run went on only behind what is written');
    await page.click('.message button:has-text("Cancel")');
    await page.waitForFunction(() => !bough.saving && document.querySelectorAll('.message').length === 0, null, { timeout: 20000 });
    // A pose that was kept, on a file's own mesh.
    await page.evaluate(() => bough.open('young_maple'));
    await page.evaluate(async () => {
        await bough.keep();
        while (bough.applying) await bough.applying;
    });
    await length.fill('0.5');
    await length.press('Enter');
    const file = await saved(page, '#save-glb', path.join(work, 'kept.glb'));
    const report = await need('gltf-validator').validateBytes(new Uint8Array(fs.readFileSync(file)));
    expect(report.issues.numErrors === 0 && report.info.totalVertexCount > 3000, `a kept pose: ${JSON.stringify(report.info)}`);
    await closePage(page);
}
