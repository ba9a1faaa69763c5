// clock.js: how many steps a frame takes: those that the time since the last one asks for, as many as there is time to compute. What does not fit
// is dropped, and said.

const most = 0.05; // [s] of computing in a frame
const beyond = 0.25; // [s] a tab that was hidden does not catch up

export class Clock {
    constructor() {
        this.step = 1 / 60; // [s]
        this.owed = 0; // [s] of motion not yet computed
        this.cost = 0; // [ms] of a step, a mean that forgets
        this.dropped = 0; // [s] of motion since last said
        this.computed = 0; // [ms] in this frame
    }
    begin(step, restart) {
        this.step = step;
        this.owed = restart ? 0 : Math.min(this.owed, step);
        this.cost = 0;
    }
    single() {
        this.owed = this.step * (1 - 1e-6); // all but a next step: what is shown is the new one itself
        this.computed = 0;
        return 1;
    }
    steps(seconds) {
        this.computed = 0;
        this.owed += Math.min(seconds, beyond);
        const wanted = Math.floor(this.owed / this.step + 1e-9);
        const possible = this.cost > 0 ? Math.max(1, Math.floor(1000 * most / this.cost)) : 1;
        const steps = Math.min(wanted, possible);
        this.owed -= steps * this.step;
        if (wanted > steps) {
            this.dropped += (wanted - steps) * this.step;
            this.owed -= (wanted - steps) * this.step;
        }
        return steps;
    }
    took(ms) {
        this.cost = this.cost > 0 ? this.cost + 0.05 * (ms - this.cost) : ms;
        this.computed += ms;
    }
    // What is shown lies between the step before and the last: as far as time has gone.
    fraction() { return Math.min(1, Math.max(0, this.owed / this.step)); }
    spareTime(work) {
        if (this.computed < 8) work();
    }
    said() {
        const dropped = this.dropped;
        this.dropped = 0;
        return { ms: this.cost, dropped };
    }
}
