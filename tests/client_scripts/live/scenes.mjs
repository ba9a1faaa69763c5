// scenes.mjs: what is changed while it runs: wind, wood, curves, a subtree, the pose; pause and steps, undo, the address.
import { calm } from './basics.mjs';
import { at, branchOnScreen, change, closePage, expect, held, less, norm, openPage, restarted, steps, still } from './browser.mjs';

const mean = (rows) => rows[0].map((_, k) => rows.reduce((sum, row) => sum + row[k], 0) / rows.length);

async function leaning(page, count, skip) { // mean x and z of all bodies over the last steps
    await steps(page, skip);
    const rows = [];
    for (let k = 0; k < count; ++k) {
        const all = await steps(page, 5);
        rows.push([0, 2].map((axis) => all.filter((_, i) => i % 3 === axis).reduce((a, b) => a + b, 0) / (all.length / 3)));
    }
    return mean(rows);
}

export async function wind_blows_where_it_is_said({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('apple'));
    await calm(page);
    await still(page);
    const rest = await leaning(page, 2, 1);
    for (const [direction, along] of [[0, [1, 0]], [90, [0, -1]], [180, [-1, 0]]]) {
        await change(page, `({ wind }) => Object.assign(wind, { speed: 15, direction: ${direction}, turbulence: 0, gustFactor: 1 })`);
        const way = less(await leaning(page, 12, 150), rest), share = way[0] * along[0] + way[1] * along[1];
        expect(share > 0.01 && share > 0.9 * norm(way), `towards ${direction} degrees bodies lean ${way} m`);
    }
    // The presets are the library's, and the dial and the numbers show them.
    await page.click('#wind-storm');
    const [speed, shown] = await page.evaluate(() => [bough.state.wind.speed, document.querySelector('input[aria-label="Speed, number"]').value]);
    expect(speed === 20 && shown === '20', `a storm is ${speed} m/s, shown as ${shown}`);
    await closePage(page);
}

export async function pause_step_slow_restart({ browser, url }) {
    const page = await openPage(browser, url);
    await page.click('#play');
    await still(page);
    const time = () => page.evaluate(() => bough.answer.time);
    const start = await page.evaluate(async () => (await bough.client.ask('frame', { seconds: 0, buffer: new ArrayBuffer(0) })).time);
    const later = await page.evaluate(async () => {
        await new Promise((done) => setTimeout(done, 300));
        return (await bough.client.ask('frame', { seconds: 0, buffer: new ArrayBuffer(0) })).time;
    });
    expect(later === start, `paused, it went on from ${start} to ${later} s`);
    await page.click('#single');
    await page.waitForFunction((start) => bough.answer.time > start, start);
    expect(Math.abs(await time() - start - 1 / 60) < 1e-9, `one step took it from ${start} to ${await time()} s`);
    // At a tenth of the speed a tenth of the time is asked for.
    const asked = await page.evaluate(async () => {
        document.getElementById('speed').value = '0.1';
        document.getElementById('speed').dispatchEvent(new Event('change'));
        const ask = bough.client.ask, all = [];
        bough.client.ask = (name, what, transfer) => {
            if (name === 'frame') all.push([what.seconds, bough.before]);
            return ask.call(bough.client, name, what, transfer);
        };
        bough.bar.toggle(false);
        const begin = performance.now();
        await new Promise((done) => setTimeout(done, 1500));
        bough.bar.toggle(true);
        bough.client.ask = ask;
        return [all.reduce((sum, [seconds]) => sum + seconds, 0), (performance.now() - begin) / 1000];
    });
    expect(asked[0] > 0.03 * asked[1] && asked[0] < 0.2 * asked[1], `at a tenth of the speed ${asked[0]} s of ${asked[1]} s were asked for`);
    await page.click('#restart');
    await page.waitForFunction(() => !bough.applying);
    const again = await page.evaluate(async () => (await bough.client.ask('frame', { seconds: 0, single: true, buffer: new ArrayBuffer(0) })).time);
    expect(Math.abs(again - 1 / 60) < 1e-9, `one step behind a restart it is ${again} s`);
    await closePage(page);
}

// Fritsch and Butland's cubic, written again: harmonic means of the slopes beside a key, 0 at the ends and where they differ in sign.
function monotone(xs, ys, x) {
    if (x <= xs[0]) return ys[0];
    const last = xs.length - 1;
    if (x >= xs[last]) return ys[last];
    const slopes = xs.slice(1).map((_, k) => (ys[k + 1] - ys[k]) / (xs[k + 1] - xs[k]));
    const m = xs.map((_, k) => k === 0 || k === last || slopes[k - 1] * slopes[k] <= 0 ? 0 : 2 * slopes[k - 1] * slopes[k] / (slopes[k - 1] + slopes[k]));
    let k = 0;
    while (x > xs[k + 1]) ++k;
    const h = xs[k + 1] - xs[k], t = (x - xs[k]) / h;
    return (1 + 2 * t) * (1 - t) ** 2 * ys[k] + t * (1 - t) ** 2 * h * m[k] + t * t * (3 - 2 * t) * ys[k + 1] + t * t * (t - 1) * h * m[k + 1];
}

export async function curves_over_radius({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('apple'));
    await page.evaluate(() => { [...document.querySelectorAll('details')].find((one) => one.textContent.startsWith('Wood')).open = true; });
    await page.click('#curve-stiffness button:has-text("Edit")');
    await page.waitForFunction(() => !bough.applying && document.querySelectorAll('#curve-stiffness .key').length === 3);
    const key = page.locator('#curve-stiffness .key').first();
    await key.scrollIntoViewIfNeeded();
    const box = await key.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + 20, box.y - 40, { steps: 5 });
    await page.mouse.up();
    await page.waitForFunction(() => !bough.applying);
    const keys = await page.evaluate(() => bough.state.curves.keys.stiffness);
    expect(keys.length === 3 && keys[0][1] > 2, `the key was drawn to ${keys[0]}`);
    const [x, y] = [keys.map(([r]) => r), keys.map(([, f]) => f)], top = x[2] * 1.1;
    const drawn = await page.evaluate(([x, y, top]) => bough.client.ask('curve', { x, y, from: 0, to: top, samples: 200 }), [x, y, top]);
    const off = Math.max(...drawn.map((value, k) => Math.abs(value - monotone(x, y, top * k / 199))));
    expect(off < 1e-9 * Math.max(...y), `the curve is off by ${off}`);
    const line = await page.getAttribute('#curve-stiffness .curve', 'd');
    expect(line.split('L').length > 50, 'the curve is not drawn');
    // Stiff all over moves less.
    const moved = async (factor) => {
        await change(page, `(state) => { state.curves.keys.stiffness = [[0, ${factor}], [1, ${factor}]]; }`);
        await restarted(page);
        const rest = await steps(page, 1), later = await steps(page, 90);
        return Math.sqrt(later.reduce((sum, value, k) => sum + (value - rest[k]) ** 2, 0));
    };
    const soft = await moved(1), stiff = await moved(16);
    expect(stiff < 0.5 * soft, `16 times as stiff it moves ${stiff / soft} times as far`);
    await closePage(page);
}

export async function a_picked_subtree_is_stiffened({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('willow'));
    await calm(page);
    await still(page);
    const branch = await branchOnScreen(page);
    await page.mouse.click(branch.x, branch.y);
    await page.waitForFunction(() => bough.picked);
    const picked = await page.evaluate(() => ({ ...bough.picked, marked: bough.view.skinned.marked.filter((one) => one > 0).length }));
    expect(picked.marked === picked.count, `${picked.marked} bodies are marked, ${picked.count} hang on the one that was picked`);
    // Another that bears many, picked by its number.
    const bears = await page.evaluate(() => {
        const { parent, kind } = bough.mesh, count = new Array(parent.length).fill(1);
        for (let i = parent.length - 1; i > 0; --i) if (parent[i] >= 0) count[parent[i]] += count[i];
        const body = count.findIndex((own, i) => own > 10 && own < 200 && kind[i] === 0);
        bough.pick(body);
        return { body, parent: Array.from(parent) };
    });
    const bent = async () => { // how far bodies of the subtree turn in their parents: root of the squares, in a step wind
        await change(page, '({ wind }) => Object.assign(wind, { speed: 20, turbulence: 0, gustFactor: 1 })');
        await restarted(page);
        await steps(page, 40);
        return page.evaluate(({ body }) => {
            const { poses, marked } = bough.view.skinned, { parent } = bough.mesh;
            let sum = 0;
            for (let i = body + 1; i < parent.length; ++i) {
                if (!marked[i]) continue;
                const a = poses.subarray(8 * i + 4, 8 * i + 8), b = poses.subarray(8 * parent[i] + 4, 8 * parent[i] + 8);
                const dot = Math.abs(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]);
                sum += 1 - Math.min(1, dot);
            }
            return Math.sqrt(sum);
        }, bears);
    };
    const before = await bent();
    await page.evaluate(() => {
        const input = document.querySelector('details:nth-of-type(4) input[aria-label="Stiffness, number"]');
        input.value = '1000';
        input.dispatchEvent(new Event('change'));
    });
    await page.waitForFunction(() => !bough.applying);
    expect(await page.evaluate(() => bough.state.parts.length) === 1, 'the subtree has no override');
    const after = await bent();
    expect(after < 0.1 * before, `its joints turn ${after} after ${before}`);
    await closePage(page);
}

export async function a_part_moves_alone({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('willow'));
    await page.click('#wind-storm');
    await still(page);
    const inside = await page.evaluate(() => {
        const { parent, kind } = bough.mesh, count = new Array(parent.length).fill(1);
        for (let i = parent.length - 1; i > 0; --i) if (parent[i] >= 0) count[parent[i]] += count[i];
        bough.pick(count.findIndex((own, i) => own > 10 && own < 200 && kind[i] === 0 && parent[i] >= 0));
        return Array.from(bough.view.skinned.marked.subarray(0, parent.length), (one) => one > 0);
    });
    const way = async () => { // how far bodies go in a second of storm: [in the part, elsewhere]
        await restarted(page);
        const first = await steps(page, 1), later = await steps(page, 60), most = [0, 0];
        inside.forEach((own, i) => { most[own ? 0 : 1] = Math.max(most[own ? 0 : 1], norm(less(at(later, i), at(first, i)))); });
        return most;
    };
    await page.click('#only');
    await page.waitForFunction(() => !bough.applying && bough.state.only.length === 1);
    const alone = await way();
    expect(alone[0] > 1e-3 && alone[1] < 1e-9, `the part goes ${alone[0]} m, what is to stand still ${alone[1]} m`);
    expect((await page.textContent('#parts')).includes('only this moves'), 'it is not listed');
    await page.click('#only');
    await page.waitForFunction(() => !bough.applying && bough.state.only.length === 0);
    const all = await way();
    expect(all[1] > 1e-2, `all of it is to move, and goes ${all[1]} m`);
    await page.evaluate(() => document.querySelectorAll('details').forEach((one) => { one.open = true; }));
    const turning = async (levels) => { // how many bodies turn in what bears them
        await page.selectOption('select[aria-label="Moves"]', String(levels));
        await page.waitForFunction((levels) => !bough.applying && bough.state.levels === levels, levels);
        await restarted(page);
        await steps(page, 30);
        return page.evaluate(() => {
            const { poses } = bough.view.skinned, { parent } = bough.mesh;
            let count = 0;
            for (let i = 0; i < parent.length; ++i) {
                if (parent[i] < 0) continue;
                const a = poses.subarray(8 * i + 4, 8 * i + 8), b = poses.subarray(8 * parent[i] + 4, 8 * parent[i] + 8);
                const off = (sign) => Math.hypot(...a.map((one, k) => one - sign * b[k])); // q and -q are one turn
                if (Math.min(off(1), off(-1)) > 1e-5) ++count;
            }
            return count;
        });
    };
    const [trunk, two, every] = [await turning(1), await turning(2), await turning(0)];
    expect(trunk > 0 && trunk < 0.05 * inside.length && two > 2 * trunk && every > 2 * two, `${trunk}, ${two} and ${every} of ${inside.length} bodies turn`);
    await closePage(page);
}

export async function keep_the_pose_and_undo({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('willow'));
    await calm(page);
    await still(page);
    const branch = await branchOnScreen(page);
    const drawn = await steps(page, 1);
    await page.mouse.move(branch.x, branch.y);
    await page.mouse.down();
    const hand = await held(page), rest = at(drawn, hand.body);
    await page.mouse.move(branch.x + 70, branch.y, { steps: 3 });
    const targets = await page.evaluate(() => bough.pointers.targets());
    const pulled = at(await steps(page, 240, targets), hand.body), way = norm(less(pulled, rest));
    await page.keyboard.press('k');
    await page.waitForFunction(() => !bough.applying && bough.state.trees[0].kept);
    await page.mouse.up();
    const stays = at(await steps(page, 600), hand.body);
    expect(norm(less(stays, pulled)) < 0.2 * way, `kept, it goes ${norm(less(stays, pulled))} m of ${way} m`);
    await page.click('#undo');
    await page.waitForFunction(() => !bough.applying && !bough.state.trees[0].kept);
    const back = at(await steps(page, 1200), hand.body);
    expect(norm(less(back, rest)) < 0.3 * way, `undone, it is ${norm(less(back, rest))} m off after ${way} m`);
    await page.click('#redo');
    await page.waitForFunction(() => !bough.applying && bough.state.trees[0].kept);
    await closePage(page);
}

export async function undo_goes_back_in_wind_and_wood({ browser, url }) {
    const page = await openPage(browser, url);
    const first = await page.evaluate(() => JSON.stringify(bough.state));
    await page.click('#wind-storm');
    await page.waitForFunction(() => bough.history.past.length === 1);
    await change(page, '(state) => { state.stiffness = 3; }');
    await page.waitForFunction(() => bough.history.past.length === 2);
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => bough.history.past.length === 0 && !bough.applying);
    expect(await page.evaluate(() => JSON.stringify(bough.state)) === first, 'two undone are not what was first');
    await page.keyboard.press('Control+Shift+Z');
    await page.waitForFunction(() => bough.state.wind.speed === 20);
    await closePage(page);
}

export async function the_address_holds_the_scene({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('park'));
    await change(page, '(state) => { state.stiffness = 0.7; state.wind.speed = 9; state.curves.keys.damping = [[0, 2], [0.1, 1]]; }');
    await page.waitForFunction(() => location.hash.startsWith('#s='));
    await page.evaluate(() => { [...document.querySelectorAll('details')].at(-1).open = true; });
    await page.click('#share');
    const address = await page.evaluate(() => location.href);
    expect(address.length < 2000, `the address has ${address.length} characters`);
    await restarted(page);
    const own = await steps(page, 30);
    const other = await openPage(browser, address);
    await restarted(other);
    const theirs = await steps(other, 30);
    expect(own.length === theirs.length && own.every((value, k) => value === theirs[k]), 'the same address moves otherwise');
    await closePage(other);
    const broken = await openPage(browser, address.slice(0, -30));
    const [text] = await broken.$$eval('.message.error', (all) => all.map((one) => one.firstChild.textContent));
    expect(text?.includes('address'), `a cut address says "${text}"`);
    await closePage(broken);
    await closePage(page);
}
