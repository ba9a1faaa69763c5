// bar.js: the run: go on, one step, slower, from the start; back and forth in what was changed; the pose kept.
import { button, element } from './widgets.js';

// A button whose words become a sign where there is no room.
function signed(words, sign, click, properties) {
    const made = button('', click, { 'aria-label': words, ...properties });
    made.say = (words, sign) => made.replaceChildren(element('span', { class: 'words' }, words), element('span', { class: 'sign' }, sign));
    made.say(words, sign);
    return made;
}

export class Bar {
    // app: { paused, speed, single(), restart(), undo(), redo(), keep() }
    constructor(app) {
        this.app = app;
        this.play = signed('Pause', '❚❚', () => this.toggle(), { id: 'play', title: 'Space' });
        this.back = button('↶', () => app.undo(), { id: 'undo', title: 'Undo (Ctrl Z)', 'aria-label': 'Undo', disabled: true });
        this.forth = button('↷', () => app.redo(), { id: 'redo', title: 'Redo (Ctrl Shift Z)', 'aria-label': 'Redo', disabled: true });
        this.speed = element('select', { 'aria-label': 'Speed', id: 'speed', onchange: () => { app.speed = Number(this.speed.value); } },
            ...[[1, '1 ×'], [0.5, '½ ×'], [0.25, '¼ ×'], [0.1, '⅒ ×']].map(([value, text]) => element('option', { value }, text)));
        const sheet = button('☰', () => this.toggleSheet(), { id: 'sheet', 'aria-label': 'Controls' });
        document.getElementById('bar').append(
            this.play, signed('Step', '▸❘', () => app.single(), { id: 'single', title: 'One step (.)' }), this.speed,
            signed('Restart', '⟲', () => app.restart(), { id: 'restart', title: 'From the start (R)' }),
            this.back, this.forth, signed('Keep pose', 'Keep', () => app.keep(), { id: 'keep', title: 'As it stands now, the tree is at rest (K)' }), sheet);
        let pointed = false;
        addEventListener('pointerdown', () => { pointed = true; }, true);
        addEventListener('keydown', (event) => {
            pointed = false;
            this.key(event);
        });
        addEventListener('click', ({ target }) => { // a box that the mouse has ticked is done with: space is the run's again
            if (pointed && target.matches('input[type=checkbox]')) target.blur();
        });
    }
    toggle(paused = !this.app.paused) {
        this.app.paused = paused;
        this.play.say(paused ? 'Play' : 'Pause', paused ? '▶' : '❚❚');
        this.play.setAttribute('aria-label', paused ? 'Play' : 'Pause');
        this.play.classList.toggle('on', paused);
    }
    toggleSheet() {
        const closed = document.getElementById('panel').classList.toggle('closed');
        document.body.classList.toggle('panel-closed', closed);
        this.app.fit();
    }
    show(history) {
        this.back.disabled = history.past.length === 0;
        this.forth.disabled = history.future.length === 0;
    }
    key(event) {
        const { app } = this, { target } = event, text = target.matches('input[type=text]');
        if (event.altKey || (text && !(event.ctrlKey || event.metaKey))) return;
        if (event.ctrlKey || event.metaKey) {
            if (event.key.toLowerCase() !== 'z' || (text && target.value !== target.defaultValue)) return; // what is being typed is the field's to undo
            event.preventDefault();
            if (event.shiftKey) app.redo();
            else app.undo();
            return;
        }
        const does = {
            ' ': () => this.toggle(), '.': () => app.single(), r: () => app.restart(), k: () => app.keep(), f: () => app.view.whole(), Escape: () => app.pick(null),
        }[event.key];
        if (!does || target.matches('select')) return; // letters choose in a list
        if (event.key === ' ' && target.matches('button, summary, input[type=checkbox]')) return; // which has it pressed
        event.preventDefault();
        does();
    }
}
