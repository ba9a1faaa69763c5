// run.mjs: the tests of the page, one after another: run.mjs one|short|all|NAME... with PAGE_URL and the folders in the environment (tests/live sets them).
import path from 'node:path';
import * as basics from './basics.mjs';
import { openBrowser } from './browser.mjs';
import * as files from './files.mjs';
import * as gestures from './gestures.mjs';
import * as measures from './measures.mjs';
import * as opening from './opening.mjs';
import * as promises from './promises.mjs';
import * as refusals from './refusals.mjs';
import * as scenes from './scenes.mjs';
import * as sizes from './sizes.mjs';
import * as stress from './stress.mjs';

const { BOUGH_LIVE_URL: url, BOUGH_LIVE_PAGE: folder, BOUGH_TOP: top, BOUGH_WORK: work, BOUGH_TOOLS: tools } = process.env;
const { calm: _, ...of_basics } = basics;
const tests = { ...of_basics, ...scenes, ...promises, ...opening, ...gestures, ...files, ...refusals, ...stress, ...sizes, ...measures };
const sets = { one: ['opens_and_moves'], short: ['opens_and_moves', 'pulled_by_mouse'], all: Object.keys(tests) };
const asked = process.argv.slice(2);
const names = sets[asked[0] ?? 'all'] ?? asked;

let browser = await openBrowser(), failed = 0;
for (const name of names) {
    const start = Date.now();
    try {
        await tests[name]({ browser, url, folder, file: path.join(folder, 'bough_live.html'), top, work, tools });
        console.log(`live: ${name}: right (${((Date.now() - start) / 1000).toFixed(1)} s)`);
    } catch (error) {
        ++failed;
        console.log(`live: ${name}: FAILED: ${error.message}`);
        if (!browser.isConnected()) browser = await openBrowser();
        for (const context of browser.contexts()) await context.close();
    }
}
await browser.close();
process.exit(failed > 0 ? 1 : 0);
