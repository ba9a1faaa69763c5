// refusals.mjs: what is wrong in an address or a scene is told by its place, once, and changes nothing; what the library refuses is said in the page's words.
import fs from 'node:fs';
import path from 'node:path';
import { addressOf, change, closePage, drop, expect, messages, openPage, small, steps, still } from './browser.mjs';

const state = (page) => page.evaluate(() => JSON.stringify(bough.state));
const clear = (page) => page.evaluate(() => document.querySelectorAll('.message').forEach((one) => one.remove()));

// Each: what of a good address is other, and what is said of it.
const edited = [
    [{ wind: { speed: 'x' } }, '/wind/speed: is "x", expected a number from 0 to 1000'], [{ wind: { speed: 1e300 } }, '/wind/speed: is 1e+300, expected a number'],
    [{ wind: 'x' }, '/wind: is "x", expected an object'], [{ wind: { gale: 1 } }, '/wind/gale: is not known here'], [{ curves: null }, '/curves: is null, expected an object'],
    [{ curves: { keys: { stiffness: [[0.1, 1], [0, 2]], damping: [] } } }, '/curves/keys/stiffness/1/0: is 0, expected more than 0.1'],
    [{ curves: { keys: { stiffness: [[0.1]], damping: [] } } }, '/curves/keys/stiffness/0: is [0.1], expected 2'],
    [{ parts: null }, '/parts: is null, expected an array'], [{ parts: [{ place: 1, body: 0, stiffness: 1, damping: 1 }] }, '/parts/0/place: is 1, expected a whole number from 0 to 0'],
    [{ trees: [{ ...small.trees[0], bodies: 'x' }] }, '/trees/0/bodies: is "x", expected a whole number'], [{ trees: [] }, '/trees: is [], expected at least one'],
    [{ trees: [null] }, '/trees/0: is null, expected an object'], [{ trees: [{}] }, '/trees/0/file: is missing, expected text'], [{ places: [null] }, '/places/0: is null, expected an object'],
    [{ places: [{ ...small.places[0], position: [0, 0] }] }, '/places/0/position: is [0,0], expected 3'],
    [{ rate: 0.001 }, '/rate: is 0.001, expected a number from 10 to 1000'], [{ precision: 'half' }, '/precision: is "half", expected float or double'],
    [{ ownMesh: 1 }, '/ownMesh: is 1, expected true or false'], [{ base: { wood: { curves: 5 } } }, '/base/wood/curves: is 5, expected an array'], [{ colour: 1 }, '/colour: is not known here'],
    [{ base: { air_density: 'x' } }, '/air_density: is "x", expected a number'], [{ parts: [{ place: 0, body: 99999, stiffness: 2, damping: 1 }] }, '/wood/curves/0/on: body 9'], // which the library finds
];

export async function an_edited_address_says_what_is_wrong({ browser, url }) {
    const page = await openPage(browser, addressOf(url, small)), before = await state(page);
    const hash = (own) => new URL(addressOf(url, own)).hash;
    for (const [own, told] of [[null, '/: is null, expected an object'], ...edited]) {
        await clear(page);
        await page.evaluate((hash) => { location.hash = hash; }, hash(own && { ...small, ...own }));
        await page.waitForSelector('.message.error', { timeout: 20000 });
        const said = await messages(page);
        expect(said.length === 1 && said[0].startsWith('The address: ') && said[0].includes(told), `${JSON.stringify(own)}: it says ${said}, expected "${told}"`);
        await page.waitForFunction(() => !bough.applying);
        expect(await state(page) === before, `${JSON.stringify(own)} changed the state`);
    }
    await change(page, '(state) => { state.stiffness = 2; }');
    expect(await page.evaluate(() => bough.good.stiffness) === 2, 'a later change is lost');
    await closePage(page);
    for (const own of [null, { ...small, wind: { speed: 'x' } }, { ...small, ...edited.at(-1)[0] }]) {
        const opened = await openPage(browser, addressOf(url, own));
        const said = await messages(opened);
        expect(said.length === 1 && said[0].startsWith('The address: /'), `opened with ${JSON.stringify(own)} it says ${said}`);
        expect(await opened.evaluate(() => bough.state.trees[0].species) === 'maple', 'no built-in tree is shown');
        await closePage(opened);
    }
}

const scenes = [ // what of a good scene is other, and what is said behind the file's name
    [{ trees: 5 }, '/trees: is 5, expected an array'], [{ trees: [null] }, '/trees/0: is null'], [{ trees: [{ file: 7 }] }, '/trees/0/file: is 7, expected text'], [{ trees: [] }, '/trees: is empty'],
    [{ trees: undefined }, '/trees: is empty'],
    [{ trees: [{ file: 'shrub.mtg', places: 5 }] }, '/trees/0/places: is 5'], [{ gravity: null }, '/gravity: is null'], [{ gravity: [0, -9.81] }, '/gravity: has 2 numbers, expected 3'],
    [{ gravity: [1, -9, 0] }, '/gravity: does not point down'], [{ wind: null }, '/wind: is null'], [{ wind: 5 }, '/wind: is 5, expected an object'], [{ wind: { velocity: [5, 0] } }, '/wind/velocity: has 2 numbers'],
    [{ wind: { velocity: [1, 0, 0], turbulence: 'a' } }, '/wind/turbulence: is "a", expected a number'], [{ wind: { velocity: [1e300, 0, 0] } }, '/wind/velocity: is 1e+300, expected a number from 0 to 1000'],
    [{ stiffness_scale: 'x' }, '/stiffness_scale: is "x"'], [{ stiffness_scale: null }, '/stiffness_scale: is null'], [{ wood: { curves: 5 } }, '/wood/curves: is 5'],
    [{ simulate: { subtrees: 5 } }, '/simulate/subtrees: is 5'], [{ simulate: { radius: 5 } }, 'nothing would move: all of it is held by "Rigid below"'],
    [{ version: 99 }, '/version: is 99'], [{ wood: { curves: [{ on: { body: 9999 }, radius: [0], stiffness: [2], relative: true }] } }, '/wood/curves/0/on: body 9'],
];

export async function a_broken_scene_says_what_and_where({ browser, url, top }) {
    const page = await openPage(browser, addressOf(url, small)), before = await state(page);
    const shrub = ['shrub.mtg', fs.readFileSync(path.join(top, 'data/fixtures/shrub.mtg'))];
    for (const [own, told] of scenes) {
        await clear(page);
        await drop(page, [['two.json', JSON.stringify({ format: 'bough-scene', version: 1, trees: [{ file: 'shrub.mtg' }], ...own })], shrub]);
        const said = await messages(page);
        expect(said.length === 1 && said[0].startsWith(`two.json: ${told}`), `${JSON.stringify(own)}: it says ${said}, expected "${told}"`);
        expect(await state(page) === before, `${JSON.stringify(own)} changed the state`);
    }
    await change(page, '(state) => { state.stiffness = 2; }');
    expect(await page.evaluate(() => bough.good.stiffness) === 2, 'a later change is lost');
    expect((await steps(page, 2)).every(Number.isFinite), 'it no longer runs');
    await closePage(page);
}

export async function refusals_are_in_the_pages_words({ browser, url, top }) {
    const page = await openPage(browser, addressOf(url, small));
    const says = async (does) => {
        await clear(page);
        await does();
        await page.waitForSelector('.message.error', { timeout: 20000 });
        return (await messages(page)).join(' | ');
    };
    const rigid = await says(() => change(page, '(state) => { state.least = 0.05; }'));
    expect(rigid.includes('"Rigid below"') && !/held:|\/simulate/.test(rigid), `nothing that moves: "${rigid}"`);
    const levels = await says(() => change(page, '(state) => { state.least = 0.05; state.levels = 1; }'));
    expect(levels.includes('"Moves"') && !/held:|\/simulate/.test(levels), `nothing that moves: "${levels}"`);
    for (const [name, bytes] of [['picture.png', Buffer.from([0x89, 0x50, 0x4e, 0x47, 13, 10, 26, 10, 0, 0])], ['run.json', '{"format": "bough-motion", "version": 1}'], ['thing.dat', 'abc']]) {
        const said = await says(() => drop(page, [[name, Buffer.from(bytes)]]));
        expect(said.startsWith(`${name}: `) && said.includes('SpeedTree XML') && !/--|bough-splines|foreign/.test(said), `${name}: "${said}"`);
    }
    // A branch that lies on the ground is pulled.
    await change(page, '(state) => { state.strength = 0.1; state.wind.speed = 20; }');
    await still(page);
    await steps(page, 120);
    const held = await says(() => page.evaluate(async () => {
        const run = (await bough.client.ask('pick', { ray: [0, 1, 50, 0, 0, -1], aperture: 0.5 })).run;
        for (let body = 1; body < bough.bodies; ++body)
            if (await bough.client.ask('grab', { hand: 9, body, point: [0, 0, 0], run }).then(() => false, (error) => bough.problem(error.message))) return;
    }));
    expect(held.includes('broke off') && !/attach|body [0-9]/.test(held), `a fallen branch: "${held}"`);
    await drop(page, [['shrub.mtg', fs.readFileSync(path.join(top, 'data/fixtures/shrub.mtg'))]]);
    const notes = await page.locator('#panel .note li').allTextContents();
    expect(notes.length > 0 && notes.every((note) => !note.includes('--')), `its notes are ${notes}`);
    await closePage(page);
}
