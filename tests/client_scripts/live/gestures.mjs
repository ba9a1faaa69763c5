// gestures.mjs: fingers, keys and the camera: what a press, a pinch and a key do, and what of the picture stays as the user put it.
import { calm } from './basics.mjs';
import { addressOf, branchOnScreen, change, closePage, expect, held, messages, openPage, small, steps, still } from './browser.mjs';

const idle = (page) => page.evaluate(async () => { while (bough.applying) await bough.applying; });

// A page with a small tree that stands still, and fingers on it.
async function fingers(browser, url) {
    const page = await openPage(browser, addressOf(url, small), { size: [1024, 768], touch: true });
    await calm(page);
    await still(page);
    const cdp = await page.context().newCDPSession(page);
    const send = (type, points) => cdp.send('Input.dispatchTouchEvent', { type, touchPoints: points.map(([x, y, id]) => ({ x, y, id })) });
    return { page, send, branch: await branchOnScreen(page) };
}
const does = (page) => page.evaluate(() => [...bough.pointers.all.values()].map(({ does }) => does).join());

export async function a_pinch_on_the_tree_comes_nearer({ browser, url }) {
    const { page, send, branch: { x, y } } = await fingers(browser, url);
    const far = await page.evaluate(() => bough.view.orbit.distance);
    await send('touchStart', [[x, y, 1]]);
    await held(page);
    await send('touchStart', [[x, y, 1], [x + 40, y, 2]]);
    await page.waitForFunction(() => bough.pointers.all.size === 2 && ![...bough.pointers.all.values()].some(({ does }) => does === 'asks'));
    expect(await does(page) === 'turns,turns', `two fingers on the tree: ${await does(page)}`);
    await send('touchMove', [[x - 40, y, 1], [x + 80, y, 2]]);
    await page.waitForFunction((far) => bough.view.orbit.distance < 0.7 * far, far, { timeout: 10000 });
    const hands = await page.evaluate(async () => (await bough.client.ask('memory')).hands);
    expect(hands === 0 && await page.evaluate(() => bough.view.arrows.size) === 0, `${hands} hands hold while two fingers pinch`);
    await send('touchEnd', []);
    await page.waitForFunction(() => bough.pointers.all.size === 0);
    expect(await page.evaluate(() => bough.picked) === null, 'a pinch picked a branch');
    await closePage(page);
}

export async function two_hands_hold_two_branches({ browser, url }) {
    const { page, send, branch: { x, y } } = await fingers(browser, url);
    await send('touchStart', [[x, y, 1]]);
    await held(page);
    await send('touchMove', [[x + 60, y, 1]]);
    await new Promise((done) => setTimeout(done, 350));
    await send('touchStart', [[x + 60, y, 1], [x, y, 2]]);
    await page.waitForFunction(() => [...bough.pointers.all.values()].filter(({ does }) => does === 'holds').length === 2, null, { timeout: 10000 });
    await send('touchEnd', []);
    await closePage(page);
}

// The Worker answers a press as late as on a slow machine: one that the system took away is none, a short one is one still.
export async function a_press_is_what_it_was({ browser, url }) {
    const { page, send, branch: { x, y } } = await fingers(browser, url);
    await page.evaluate(() => {
        const { ask } = bough.client;
        bough.delay = 100; // ms
        bough.client.ask = async function (name, ...others) {
            if (name !== 'pick') return ask.call(this, name, ...others);
            const answer = await ask.call(this, name, ...others);
            await new Promise((done) => setTimeout(done, bough.delay));
            bough.late = (bough.late ?? 0) + 1;
            return answer;
        };
    });
    const answered = (count) => page.waitForFunction((count) => bough.late === count, count).then(() => page.evaluate(() => new Promise((done) => setTimeout(done, 50))));
    await send('touchStart', [[x, y, 1]]);
    await send('touchCancel', []);
    await answered(1);
    expect(await page.evaluate(() => bough.picked) === null, 'a press that was taken away picked a branch');
    await page.evaluate(() => { bough.delay = 600; });
    await send('touchStart', [[x, y, 1]]);
    await send('touchEnd', []);
    await answered(2);
    expect(await page.evaluate(() => bough.picked !== null), 'a press that was answered late picked nothing');
    await closePage(page);
}

export async function keys_work_after_a_control_was_used({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    const paused = () => page.evaluate(() => bough.paused);
    await page.locator('input[type=range][aria-label="Speed"]').first().focus();
    await page.keyboard.press('ArrowRight');
    await page.waitForFunction(() => bough.history.past.length === 1);
    await page.keyboard.press(' ');
    expect(await paused(), 'space does not pause behind a slider');
    const time = await page.evaluate(() => bough.answer.time);
    await page.keyboard.press('.');
    await page.waitForFunction((time) => bough.answer.time > time, time, { timeout: 10000 });
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => bough.history.past.length === 0, null, { timeout: 10000 });
    await page.evaluate(() => { for (const one of document.querySelectorAll('details')) one.open = true; });
    for (const [name, position] of [['Shadows', { x: 8, y: 16 }], ['A loop', { x: 120, y: 16 }]]) { // the box, and its words
        const before = await paused();
        await page.click(`label:has-text("${name}")`, { position });
        await page.keyboard.press(' ');
        expect(await paused() === !before, `space is dead behind "${name}" that was ticked`);
    }
    // What is typed into a number is the number's.
    await page.locator('input[aria-label="Speed, number"]').focus();
    await page.keyboard.press('.');
    await page.keyboard.press('k');
    expect(await page.evaluate(() => bough.state.trees[0].kept) === undefined, 'a key in a field of text is taken for the page\'s');
    await closePage(page);
}

export async function the_camera_stays_where_it_was_put({ browser, url }) {
    const page = await openPage(browser, url, { size: [390, 844] });
    await page.evaluate(() => bough.open('young_maple'));
    await idle(page);
    const where = () => page.evaluate(() => [bough.view.orbit.distance, ...bough.view.orbit.target.toArray()]);
    const whole = await where();
    await page.mouse.move(150, 200);
    await page.mouse.wheel(0, -600);
    await page.evaluate(() => bough.view.orbit.shift(30, 20, bough.view.camera, 844));
    await page.waitForFunction((far) => bough.view.orbit.distance < 0.8 * far, whole[0]);
    const put = await where(), same = async (what) => expect(JSON.stringify(await where()) === JSON.stringify(put), `${what}: the camera is at ${await where()} behind ${put}`);
    await page.setViewportSize({ width: 844, height: 390 });
    await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
    await same('another window');
    await page.setViewportSize({ width: 390, height: 844 });
    await page.click('#sheet');
    await same('the menu');
    await change(page, '(state) => { state.ownMesh = false; }');
    await same('another mesh');
    await page.evaluate(() => bough.undo());
    await same('undone');
    await page.keyboard.press('f');
    await page.click('#sheet');
    expect(Math.abs((await where())[0] / whole[0] - 1) < 0.01, `the whole is shown from ${(await where())[0]} m, was from ${whole[0]} m`);
    await page.mouse.wheel(0, -600);
    await page.evaluate(() => bough.open('willow'));
    await idle(page);
    expect(await page.evaluate(() => bough.view.orbit.touched) === false, 'another tree is looked at as the one before');
    await closePage(page);
}

export async function curves_and_the_dial_take_keys({ browser, url }) {
    const page = await openPage(browser, addressOf(url, { ...small, curves: { keys: { stiffness: [[0.01, 1], [0.03, 1]], damping: [] } } }));
    await page.evaluate(() => { for (const one of document.querySelectorAll('details')) one.open = true; });
    const keys = async () => {
        await idle(page);
        return page.evaluate(() => bough.state.curves.keys.stiffness);
    };
    const first = await keys();
    await page.locator('#curve-stiffness .key').first().focus();
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('ArrowRight');
    const moved = await keys();
    expect(Math.abs(moved[0][1] - 1.21) < 1e-9 && moved[0][0] > first[0][0] && moved[1].join() === first[1].join(), `arrows move keys to ${JSON.stringify(moved)}`);
    const said = await page.evaluate(() => [document.querySelector('#curve-stiffness output').textContent, document.activeElement.getAttribute('aria-valuetext')]);
    expect(said[0].includes('1.21') && said[0] === said[1], `a key says ${said}`);
    await page.keyboard.press('Delete');
    expect((await keys()).length === 1, 'Delete takes no key away');
    // The dial: its tip is drawn, arrows turn it, and it says what it has.
    await page.locator('.dial').scrollIntoViewIfNeeded();
    const box = await page.locator('.dial').boundingBox(), turn = await page.evaluate(() => bough.view.orbit.azimuth * 180 / Math.PI);
    const unit = box.width / 108, at = [box.x + box.width / 2, box.y + box.height / 2];
    await page.mouse.move(at[0], at[1]);
    await page.mouse.down();
    await page.mouse.move(at[0] + 23 * unit, at[1], { steps: 4 });
    await page.mouse.up();
    await idle(page);
    const drawn = await page.evaluate(() => bough.state.wind);
    expect(drawn.speed === 12.5 && Math.abs(drawn.direction - turn) < 2, `drawn to the right by half, the wind is ${JSON.stringify(drawn)}, the camera at ${turn} degrees`);
    await page.locator('.dial').focus();
    await page.keyboard.press('ArrowUp');
    await page.keyboard.press('ArrowLeft');
    await idle(page);
    const { speed, direction } = await page.evaluate(() => bough.state.wind);
    expect(speed === 13.5 && direction === (drawn.direction + 10) % 360, `arrows turn it to ${speed} m/s, ${direction} degrees`);
    const shown = await page.evaluate(() => ['aria-valuenow', 'aria-valuetext'].map((name) => document.querySelector('.dial').getAttribute(name)));
    expect(shown[0] === '13.5' && shown[1].includes(`${direction}°`), `it says ${shown}`);
    await closePage(page);
}

// Presses of a real mouse: its clicks go to what has captured the pointer.
export async function a_key_goes_and_comes_by_two_presses({ browser, url }) {
    const page = await openPage(browser, addressOf(url, { ...small, curves: { keys: { stiffness: [[0.005, 1], [0.015, 2], [0.03, 1]], damping: [] } } }));
    await page.evaluate(() => { for (const one of document.querySelectorAll('details')) one.open = true; });
    const key = page.locator('#curve-stiffness .key').nth(1);
    await key.scrollIntoViewIfNeeded();
    const { x, y, width } = await key.boundingBox(), at = [x + width / 2 + 2, y + width / 2 + 2];
    const now = async () => {
        await idle(page);
        return page.evaluate(() => [bough.state.curves.keys.stiffness.length, bough.history.past.length].join());
    };
    await page.mouse.click(...at);
    expect(await now() === '3,0', `a press that moves nothing: keys, steps of the history: ${await now()}`);
    await page.mouse.dblclick(...at);
    expect(await now() === '2,1', `pressed twice: ${await now()}`);
    await page.mouse.dblclick(...at);
    expect(await now() === '3,2', `pressed twice where none is: ${await now()}`);
    await page.mouse.move(...at);
    await page.mouse.down();
    await page.mouse.move(at[0], at[1] - 20, { steps: 4 });
    await page.mouse.up();
    const factor = await page.evaluate(() => bough.state.curves.keys.stiffness[1][1]);
    expect(await now() === '3,3' && factor > 2, `drawn: ${await now()}, factor ${factor}`);
    await closePage(page);
}

export async function a_typed_number_is_undone({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    const field = page.locator('input[aria-label="Speed, number"]');
    await field.click({ clickCount: 3 });
    await page.keyboard.type('17');
    await page.keyboard.press('Enter');
    await page.waitForFunction(() => bough.history.past.length === 1 && bough.state.wind.speed === 17);
    await page.keyboard.press('Control+z');
    await page.waitForFunction(() => bough.state.wind.speed === 4 && bough.history.past.length === 0, null, { timeout: 10000 });
    await idle(page);
    expect(await field.inputValue() === '4', `undone, the field shows ${await field.inputValue()}`);
    await page.keyboard.press('Control+Shift+Z');
    await page.waitForFunction(() => bough.state.wind.speed === 17, null, { timeout: 10000 });
    await page.keyboard.press('Control+z');
    await page.keyboard.press('Tab');
    await idle(page);
    expect(await page.evaluate(() => bough.history.past.length) === 0, 'Tab makes a step of what was undone');
    // What is being typed is the field's own to undo.
    await field.click();
    await page.keyboard.type('1');
    const typed = await field.inputValue();
    await page.keyboard.press('Control+z');
    expect(typed !== '4' && await field.inputValue() === '4' && await page.evaluate(() => bough.history.future.length) === 1, `"${typed}" is undone to "${await field.inputValue()}"`);
    await closePage(page);
}

export async function a_pull_says_its_force({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    await calm(page);
    const { x, y } = await branchOnScreen(page);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await held(page);
    await page.mouse.move(x + 30, y + 20, { steps: 3 });
    await page.waitForFunction(() => parseFloat(document.querySelector('.force')?.textContent) > 0, null, { timeout: 20000 });
    const text = await page.textContent('.force');
    expect(/^[0-9.]+ (mN|N|kN)$/.test(text), `it says "${text}"`);
    await page.mouse.up();
    expect(await page.locator('.force').count() === 0, 'let go, the force is still shown');
    await closePage(page);
}

export async function subtrees_that_are_other_are_listed({ browser, url }) {
    const page = await openPage(browser, addressOf(url, { ...small, parts: [{ place: 0, body: 5, stiffness: 3, damping: 1 }, { place: 0, body: 9, stiffness: 1, damping: 2 }] }));
    await page.evaluate(() => { for (const one of document.querySelectorAll('details')) one.open = true; });
    const texts = await page.locator('#parts button').allTextContents();
    expect(texts.length === 2 && texts[0].includes('Body 5') && texts[0].includes('3 ×'), `it lists ${texts}`);
    await page.locator('#parts button').nth(1).click();
    expect(await page.evaluate(() => bough.picked?.own) === 9, 'the one that is pressed is not picked');
    await closePage(page);
}

export async function what_failed_is_said_once({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small));
    await page.evaluate(() => {
        const { ask } = bough.client;
        bough.asked = 0;
        bough.client.ask = function (name, ...others) {
            if (name !== 'frame') return ask.call(this, name, ...others);
            ++bough.asked;
            return Promise.reject(Object.assign(new Error('unreachable'), { known: false, inWorker: 'at wasm' }));
        };
    });
    await page.waitForSelector('.message.error');
    const [text] = await messages(page), actions = await page.locator('.message.error .buttons button').allTextContents();
    expect(text.includes('unreachable') && actions.includes('Load the page again'), `it says "${text}" and offers ${actions}`);
    await page.locator('.message.error button[aria-label="Close"]').click();
    const count = await page.evaluate(() => bough.asked);
    await page.evaluate(async () => { for (let k = 0; k < 5; ++k) await new Promise((done) => requestAnimationFrame(done)); });
    expect(await page.evaluate(() => bough.asked) === count && (await messages(page)).length === 0, `asked ${count} times, then ${await page.evaluate(() => bough.asked)}`);
    page.errors.length = 0; // where it failed stands on the console
    await closePage(page);
}
