// basics.mjs: the page opens and moves; a branch is pulled by mouse and by touch and comes back; what a browser lacks is said.
import { at, branchOnScreen, closePage, expect, held, less, messages, norm, openPage, restarted, steps, still } from './browser.mjs';

export async function opens_and_moves({ browser, url }) {
    const page = await openPage(browser, url);
    const bodies = await page.evaluate(() => bough.bodies);
    expect(bodies > 1000, `${bodies} bodies, expected a tree`);
    await restarted(page);
    const before = await steps(page, 1), after = await steps(page, 20);
    const way = Math.max(...after.map((value, k) => Math.abs(value - before[k])));
    expect(way > 0.005 && way < 1, `in a third of a second of wind the farthest body goes ${way} m`);
    const vertices = await page.evaluate(() => {
        const all = bough.view.skinned.positions();
        return [all.every(Number.isFinite), all.length / 3];
    });
    expect(vertices[0] && vertices[1] > bodies, `${vertices[1]} vertices, all finite: ${vertices[0]}`);
    const colors = await page.evaluate(() => {
        delete bough.view.draw; // openPage's
        bough.view.draw();
        const { canvas } = bough.view, copy = document.createElement('canvas');
        copy.width = copy.height = 64;
        const pen = copy.getContext('2d');
        pen.drawImage(canvas, 0, 0, 64, 64);
        return new Set(Array.from(new Uint32Array(pen.getImageData(0, 0, 64, 64).data.buffer))).size;
    });
    expect(colors > 100, `the picture has ${colors} colours, expected a tree`);
    await closePage(page);
}

export async function pulled_by_mouse({ browser, url }) {
    const page = await openPage(browser, url);
    await page.evaluate(() => bough.open('willow'));
    await calm(page);
    const branch = await branchOnScreen(page);
    expect(branch, 'no branch is on the screen');
    await still(page);
    const drawn = await steps(page, 1);
    const azimuth = await page.evaluate(() => bough.view.orbit.azimuth);
    await page.mouse.move(branch.x, branch.y);
    await page.mouse.down();
    const hand = await held(page), rest = at(drawn, hand.body); // which need not be the branch itself: twigs stand before it
    const [across, up] = await page.evaluate(([joint, world]) => { // to its side: what is drawn along itself is taut at once
        const [from, to] = [joint, world].map((place) => bough.view.screen(bough.view.point(place)));
        const length = Math.hypot(to[0] - from[0], to[1] - from[1]);
        return [-(to[1] - from[1]) / length, (to[0] - from[0]) / length];
    }, [rest, hand.world]);
    await page.mouse.move(branch.x + 24 * across, branch.y + 24 * up, { steps: 4 });
    const targets = await page.evaluate(() => bough.pointers.targets());
    expect(targets.length === 1, 'the hand has no target');
    const pulled = at(await steps(page, 120, targets), hand.body);
    const wanted = less(targets[0][1], hand.world), way = less(pulled, rest);
    // What was taken is where the hand is, and the hand where the pointer is, or as far towards it as it goes.
    const { point, far, forces } = await grip(page);
    const share = Math.min(1, far / norm(wanted)), to = hand.world.map((value, k) => value + share * wanted[k]);
    const off = norm(less(point, to)), drawnBy = share * norm(wanted);
    expect(drawnBy > 0.05, `the hand goes ${drawnBy} m of ${norm(wanted)} m`);
    expect(off < 0.2 * drawnBy, `drawn by ${drawnBy} m of ${far} m that it goes at most, the branch is ${off} m from the hand`);
    expect(forces.length === 1 && forces[0][1] > 0, `forces are ${forces}`);
    console.log(`    a hand ${drawnBy.toFixed(2)} m away: the branch is ${(1000 * off).toFixed(1)} mm behind it, ${forces[0][1].toFixed(1)} N`);
    // A hand that is moved on is followed; it cannot be drawn beyond what the wood bears, however far the pointer goes.
    await page.mouse.move(branch.x + 600, branch.y - 10, { steps: 4 });
    const beyond = await page.evaluate(() => bough.pointers.targets());
    const torn = await steps(page, 120, beyond);
    expect(torn.every(Number.isFinite) && norm(less((await grip(page)).point, hand.world)) < 1.3 * far, 'it was drawn beyond its reach');
    expect(await page.evaluate(() => bough.view.arrows.size) === 1, 'no arrow is drawn');
    expect(await page.evaluate(() => bough.view.orbit.azimuth) === azimuth, 'the camera turned while a branch was held');
    await page.mouse.up();
    expect(await page.evaluate(() => bough.view.arrows.size) === 0, 'the arrow stays');
    const back = at(await steps(page, 1200), hand.body);
    expect(norm(less(back, rest)) < 0.3 * norm(way), `let go, it is ${norm(less(back, rest))} m off after ${norm(way)} m`);
    // Beside the tree the same turns the camera.
    await page.mouse.move(30, 400);
    await page.mouse.down();
    await page.waitForFunction(() => [...bough.pointers.all.values()].some(({ does }) => does === 'turns'));
    await page.mouse.move(130, 400, { steps: 4 });
    await page.mouse.up();
    expect(await page.evaluate(() => bough.view.orbit.azimuth) !== azimuth, 'beside the tree the camera does not turn');
    await closePage(page);
}

// Where the point is that the pointer holds, how far its hand goes, what hands pull with [N].
async function grip(page) {
    return page.evaluate(async () => {
        const [pointer] = [...bough.pointers.all.values()];
        const answer = await bough.client.ask('frame', { seconds: 0, buffer: new ArrayBuffer(0) });
        return { point: bough.view.skinned.moved(pointer.body, pointer.drawn).toArray(), far: pointer.way, forces: answer.hands };
    });
}

export async function calm(page) {
    await page.evaluate(async () => {
        bough.change(({ wind }) => Object.assign(wind, { speed: 0, turbulence: 0, gustFactor: 1 }), true);
        await bough.apply(true);
        for (let k = 0; k < 2; ++k) await new Promise((done) => requestAnimationFrame(done)); // the camera stands where the tree asks for it
    });
}

export async function pulled_by_touch({ browser, url }) {
    const page = await openPage(browser, url, { size: [1024, 768], touch: true });
    await page.evaluate(() => bough.open('willow'));
    await calm(page);
    await still(page);
    const branch = await branchOnScreen(page);
    const touch = await page.context().newCDPSession(page);
    const send = (type, points) => touch.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y, id = 1]) => ({ x, y, id })) });
    expect(await page.$eval('#picture', (canvas) => getComputedStyle(canvas).touchAction) === 'none', 'the browser takes fingers for itself');
    const drawn = await steps(page, 1);
    await send('touchStart', [[branch.x, branch.y - 14]]); // a finger is no needle: 15 px beside it is on it
    const hand = await held(page);
    await send('touchMove', [[branch.x + 50, branch.y + 30]]);
    const targets = await page.evaluate(() => bough.pointers.targets());
    await steps(page, 90, targets);
    expect(await page.evaluate(() => bough.view.arrows.size) === 1, 'no arrow is drawn');
    const { point, far: reach } = await grip(page), wanted = norm(less(targets[0][1], hand.world));
    const way = norm(less(point, hand.world));
    expect(way > 0.85 * Math.min(wanted, reach), `the finger moved it by ${way} m of ${Math.min(wanted, reach)} m`);
    await send('touchEnd', []);
    await page.waitForFunction(() => bough.pointers.all.size === 0);
    const rest = at(drawn, hand.body), off = norm(less(at(await steps(page, 1), hand.body), rest));
    const back = norm(less(at(await steps(page, 1200), hand.body), rest));
    expect(back < 0.3 * off, `let go, it is ${back} m off after ${off} m`);
    // Two fingers beside the tree come nearer.
    const far = await page.evaluate(() => bough.view.orbit.distance);
    await send('touchStart', [[20, 60, 1]]);
    await page.waitForFunction(() => [...bough.pointers.all.values()].some(({ does }) => does === 'turns'));
    await send('touchStart', [[20, 60, 1], [60, 60, 2]]);
    await page.waitForFunction(() => bough.pointers.all.size === 2);
    await send('touchMove', [[20, 60, 1], [120, 60, 2]]);
    await send('touchEnd', []);
    const near = await page.evaluate(() => bough.view.orbit.distance);
    expect(near < 0.8 * far, `two fingers: from ${far} m to ${near} m`);
    await closePage(page);
}

export async function what_the_browser_lacks_is_said({ browser, url }) {
    const says = async (before, words) => {
        const page = await openPage(browser, url, { before, waits: false });
        await page.waitForSelector('.message.error');
        const [text] = await messages(page);
        expect(words.every((word) => text.includes(word)), `says "${text}", expected ${words}`);
        await page.context().close();
    };
    await says('WebAssembly.validate = () => false;', ['SIMD', 'Firefox 89']);
    await says('HTMLCanvasElement.prototype.getContext = () => null;', ['WebGL2']);
    await says('const get = window.fetch; window.fetch = (name) => get(String(name).replace("bough.wasm", "gone.wasm"));', ['bough.wasm', '404']);
}

export async function one_file_from_disk({ browser, file }) {
    const page = await openPage(browser, `file://${file}`);
    await page.evaluate(() => bough.open('young_maple'));
    expect(await page.evaluate(() => bough.state.trees[0].file) === 'young_maple', `it says: ${await messages(page)}`);
    await closePage(page);
}
