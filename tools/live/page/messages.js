// messages.js: what the page says: errors stay until they are closed, notes go by themselves.
import { button, element } from './widgets.js';

const area = () => document.getElementById('messages');

export function say(text, { error = false, key = text, actions = [] } = {}) {
    for (const old of area().children) if (old.dataset.key === key) old.remove();
    const close = button('×', () => made.remove(), { class: 'small', 'aria-label': 'Close' });
    const made = element('div', { class: `message${error ? ' error' : ''}` }, element('div', {}, text,
        actions.length === 0 ? null : element('div', { class: 'buttons' }, ...actions.map(([label, act]) => button(label, () => {
            made.remove();
            act();
        })))), close);
    made.dataset.key = key;
    area().append(made);
    while (area().children.length > 4) area().firstChild.remove();
    if (!error && actions.length === 0) setTimeout(() => made.remove(), 6000);
    return made;
}

export const problem = (text) => say(text, { error: true });

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
