// sizes.mjs: the page on a phone, a tablet, a laptop and a desktop: nothing of it is cut off or covered, and the tree stands whole in what is left. Pictures of
// each go to the tests' folder (size_*.png), to be looked at.
import path from 'node:path';
import { closePage, expect, openPage } from './browser.mjs';

const sizes = { phone: [[390, 844], true], tablet: [[1024, 768], true], laptop: [[1280, 800], false], desktop: [[1920, 1080], false] };

// What is wrong with what stands where: texts, one each.
async function faults(page) {
    return page.evaluate(async () => {
        const wrong = [], name = (one) => `${one.tagName} "${(one.getAttribute('aria-label') ?? one.textContent).slice(0, 30)}"`;
        const panel = document.getElementById('panel'), bar = document.getElementById('bar');
        const inside = (one, box) => {
            const own = one.getBoundingClientRect();
            if (own.width === 0) return;
            if (own.left < box.left - 0.5 || own.right > box.right + 0.5) wrong.push(`${name(one)}: from ${own.left} to ${own.right}, has ${box.left} to ${box.right}`);
        };
        if (document.documentElement.scrollWidth > innerWidth) wrong.push(`the page is ${document.documentElement.scrollWidth} px wide`);
        const screen = { left: 0, right: innerWidth };
        for (const one of [bar, document.getElementById('hint'), ...bar.children]) inside(one, screen);
        for (const one of bar.querySelectorAll('button, select')) inside(one, bar.getBoundingClientRect());
        for (const details of panel.querySelectorAll('details')) details.open = true;
        const room = panel.getBoundingClientRect(), most = { left: room.left, right: room.left + panel.clientWidth };
        for (const one of panel.querySelectorAll('*:not(svg *)')) inside(one, most);
        for (const one of panel.querySelectorAll('label, summary, button, .unit, .value, span')) // text that does not fit its own box
            if (one.clientWidth > 0 && one.scrollWidth > one.clientWidth + 1) wrong.push(`${name(one)}: has ${one.clientWidth} px, needs ${one.scrollWidth}`);
        for (const one of panel.querySelectorAll('input.number')) if (one.scrollWidth > one.clientWidth + 1) wrong.push(`${name(one)}: "${one.value}" does not fit`);
        // The last of the panel can be scrolled to, and nothing lies on it then.
        const buttons = [...panel.querySelectorAll('button')], last = buttons.at(-1);
        last.scrollIntoView({ block: 'nearest' });
        const box = last.getBoundingClientRect(), met = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
        if (!last.contains(met)) wrong.push(`${name(last)} is covered by ${met ? name(met) : 'nothing'}`);
        panel.scrollTop = 0;
        const beside = bar.getBoundingClientRect(), sheet = panel.getBoundingClientRect();
        if (beside.right > sheet.left + 0.5 && beside.bottom > sheet.top + 0.5) wrong.push('the bar lies on the panel');
        // The whole tree in what neither covers.
        const places = await bough.client.ask('positions'), free = [innerWidth, innerHeight];
        if (sheet.width < innerWidth) free[0] = sheet.left;
        free[1] = beside.top;
        let out = 0;
        for (let i = 0; i < places.length; i += 3) {
            const [x, y] = bough.view.screen(bough.view.point(places.slice(i, i + 3)));
            if (x < 0 || y < 0 || x > free[0] || y > free[1]) ++out;
        }
        if (out > 0.02 * places.length / 3) wrong.push(`${out} of ${places.length / 3} bodies are outside of ${free}`);
        return wrong;
    });
}

export async function nothing_is_cut_off({ browser, url, work }) {
    for (const [name, [size, touch]] of Object.entries(sizes)) {
        const page = await openPage(browser, url, { size, touch, draws: true });
        await page.waitForFunction(() => bough.frames > 4);
        await page.screenshot({ path: path.join(work, `size_${name}.png`) });
        const wrong = await faults(page);
        expect(wrong.length === 0, `${name}: ${wrong.length} things: ${wrong.slice(0, 6).join('; ')}`);
        await page.screenshot({ path: path.join(work, `size_${name}_open.png`) });
        for (const [k, part] of [0.3, 0.6, 1].entries()) {
            await page.evaluate((part) => { const panel = document.getElementById('panel'); panel.scrollTop = part * panel.scrollHeight; }, part);
            await page.screenshot({ path: path.join(work, `size_${name}_open_${k + 2}.png`) });
        }
        await closePage(page);
    }
}
