// client.js: the Worker as the page calls it: ask(name, arguments) gives a promise of its answer, or of its error.

export class Client {
    constructor(worker) {
        this.worker = worker;
        this.open = new Map();
        this.number = 0;
        worker.onmessage = ({ data: [number, error, result] }) => {
            if (number === 0) return this.progress?.(result);
            const { done, failed } = this.open.get(number);
            this.open.delete(number);
            if (error) failed(Object.assign(new Error(error.message), { known: error.known, inWorker: error.stack }));
            else done(result);
        };
        worker.onerror = (event) => {
            for (const { failed } of this.open.values()) failed(new Error(event.message || 'the Worker could not be started'));
            this.open.clear();
        };
    }
    // Whatever it is at.
    end() {
        this.worker.terminate();
        for (const { failed } of this.open.values()) failed(new Error('ended'));
        this.open.clear();
    }
    ask(name, asked, transfer = []) {
        const number = ++this.number;
        return new Promise((done, failed) => {
            this.open.set(number, { done, failed });
            this.worker.postMessage([number, name, asked], transfer);
        });
    }
}
