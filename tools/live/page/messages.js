// messages.js: what the page says: errors stay until they are closed, notes go by themselves.
import { button, element } from './widgets.js';

const area = () => document.getElementById('messages');

// text: to be taken by hand, in a field of its own.
export function say(said, { error = false, key = said, actions = [], text = null } = {}) {
    for (const old of area().children) if (old.dataset.key === key) old.remove();
    const close = button('×', () => made.remove(), { class: 'small', 'aria-label': 'Close' });
    const made = element('div', { class: `message${error ? ' error' : ''}` }, element('div', {}, said,
        text === null ? null : element('input', { type: 'text', class: 'copied', readOnly: true, value: text, 'aria-label': 'Address', onfocus: ({ target }) => target.select() }),
        actions.length === 0 ? null : element('div', { class: 'buttons' }, ...actions.map(([label, act]) => button(label, () => {
            made.remove();
            act();
        })))), close);
    made.dataset.key = key;
    area().append(made);
    while (area().children.length > 4) area().firstChild.remove();
    made.querySelector('.copied')?.focus();
    if (!error && actions.length === 0 && text === null) setTimeout(() => made.remove(), 6000);
    return made;
}

// What the library says, in the words of the page: its controls in place of a document's fields and of a tool's options.
const tree = "a tree: bough's own, SpeedTree XML, glTF, a scan's skeleton (SWC, MTG, OBJ, CSV)";
const fields = [['/simulate/radius', '"Rigid below"'], ['last_level', '"Moves"'], ['/simulate/subtrees', '"Only this moves"'], ["/rigid", 'its file']];
export const plain = (text) => text
    .replace(/nothing is left that moves.*held: (.*)/, (_, held) =>
        `nothing would move: all of it is held by ${fields.filter(([field]) => held.includes(field)).map(([, name]) => name).join(', ') || 'the scene'}. It stays as it was.`)
    .replace(/bough-splines or a (tree file of another program|foreign tree)/, tree)
    .replace(/^attach: body \d+ has broken off/, 'What broke off cannot be held')
    .replace(/^attach: body \d+ stands still.*/, 'This part is rigid: it cannot be pulled')
    .replace(/ \([^()]*--[a-z][^()]*\)/g, '');

export const problem = (text) => say(plain(text), { error: true });

// What goes on, until it ends or is given up.
export function progress(text, giveUp) {
    const made = say(text, { key: 'progress', actions: [['Cancel', giveUp]] });
    const words = made.firstChild.firstChild;
    return { say: (now) => { if (words.textContent !== now) words.textContent = now; }, end: () => made.remove() };
}

export function unsay(key) {
    for (const old of [...area().children]) if (old.dataset.key === key) old.remove();
}

export async function busy(text, work) {
    const sign = document.getElementById('busy');
    sign.textContent = text;
    const late = setTimeout(() => { sign.hidden = false; }, 150);
    try {
        return await work();
    } finally {
        clearTimeout(late);
        sign.hidden = true;
    }
}
