// widgets.js: the panel's parts: elements, a slider with its number, a choice, a dialog's buttons.

export function element(name, properties = {}, ...children) {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(properties)) {
        if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
        else if (key === 'class') made.className = value;
        else if (key in made && key !== 'list') made[key] = value;
        else made.setAttribute(key, value);
    }
    made.append(...children.filter((child) => child !== null));
    return made;
}

export function svg(name, attributes = {}, ...children) {
    const made = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...children);
    return made;
}

let number = 0;

// A slider and a number that follow each other. change(value, done): done is false while the slider is drawn.
// log: equal ways are equal factors. A number beyond the slider's ends is taken within `allowed`.
export function slider({ label, unit = '', min, max, digits = 3, log = false, allowed = [min, max], help = '', change }) {
    const id = `control-${++number}`;
    const toWay = (value) => log ? Math.log(value / min) / Math.log(max / min) : (value - min) / (max - min);
    const toValue = (way) => log ? min * (max / min) ** way : min + (max - min) * way;
    const shown = (value) => String(Number(value.toPrecision(digits)));
    const range = element('input', { type: 'range', min: 0, max: 1000, step: 1, 'aria-label': label, id });
    const text = element('input', { type: 'text', inputMode: 'decimal', class: 'number', 'aria-label': `${label}, number` });
    let value = min;
    const set = (to) => {
        value = to;
        range.value = Math.round(1000 * Math.min(1, Math.max(0, toWay(Math.max(to, log ? min : -Infinity)))));
        text.value = text.defaultValue = shown(to); // what it is until another is typed
        text.classList.remove('wrong');
    };
    const taken = (to, done) => {
        set(to);
        change(to, done);
    };
    range.addEventListener('input', () => taken(Number(shown(toValue(range.value / 1000))), false));
    range.addEventListener('change', () => taken(Number(shown(toValue(range.value / 1000))), true));
    text.addEventListener('change', () => {
        const typed = Number(text.value.replace(',', '.'));
        if (text.value.trim() === '' || !(typed >= allowed[0] && typed <= allowed[1])) {
            text.classList.add('wrong');
            text.title = `expected a number from ${allowed[0]} to ${allowed[1]} ${unit}`;
            return;
        }
        text.title = '';
        taken(typed, true);
    });
    const row = element('div', { class: 'row', title: help },
        element('label', { htmlFor: id }, label), range, text, element('span', { class: 'unit' }, unit));
    return { row, set, get: () => value, range, text };
}

export function choice({ label, options, change }) {
    const select = element('select', { 'aria-label': label, onchange: () => change(select.value) },
        ...options.map(([value, text]) => element('option', { value }, text)));
    const row = element('div', { class: 'row choice' }, element('label', {}, label), select);
    return { row, select, set: (value) => { select.value = value; } };
}

export function button(text, click, properties = {}) {
    return element('button', { type: 'button', onclick: click, ...properties }, text);
}

export function section(title, open, ...children) {
    return element('details', { open }, element('summary', {}, title), ...children);
}
