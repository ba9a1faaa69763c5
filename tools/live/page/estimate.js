// estimate.js: the step's error, in spare time: a copy of the run goes on for half a second beside a companion of steps a quarter as long
// (lib/simulation/error_estimate.h), without hands; then another copy.

const length = 0.5; // [s]

export class Estimate {
    constructor(run) {
        this.run = run;
        this.handle = 0;
        this.found = null;
        this.wait = 0;
    }
    drop() {
        this.run.library.release(this.handle);
        this.handle = 0;
        this.found = null;
        this.wait = 30; // frames in which what was changed is answered first
    }
    work() {
        const { library, state, clock } = this.run;
        if (this.wait-- > 0 || clock.cost > 3) return; // five steps of this size are too much for a frame
        if (!this.handle && !this.#begin()) return;
        library.call('estimate_step', this.handle, library.scratch);
        const [rms, worst, deflection, known, steps] = library.doubles(library.scratch, 5);
        if (steps * (1 / state.rate) < length) return;
        this.found = { rms, worst, deflection, known: known !== 0 };
        library.release(this.handle);
        this.handle = 0;
        this.wait = 10;
    }
    #begin() {
        try {
            this.handle = this.run.library.handle('estimate', this.run.simulation);
        } catch (error) { // such as where wood may break: for as long as the run is this one
            this.found = { refused: error.message };
            this.wait = Infinity;
        }
        return this.handle !== 0;
    }
}
