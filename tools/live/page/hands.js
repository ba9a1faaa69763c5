// hands.js: hands that hold, in the Worker: each is an attachment (bough_c.h), a spring and a damper between the point that was taken and where the
// pointer is. The spring is `firm` times as stiff as the wood at rest is there, compliance = sum over the joints that bear the point of lever^2 / K: the
// point stays behind the hand by a fiftieth of the way, more where it bends far. However far the pointer goes, the hand goes no farther from where it
// took hold than what would turn a joint by a radian and a half: the wood is to bend, not to be wound up.

const firm = 50; // [1]
const slow = 0.05; // [s] the damper over the spring
const far = 3; // [1] times the way at which the softest joint has turned by half a radian, or all of them by 2 (live_reach)

const less = (a, b) => a.map((value, k) => value - b[k]);
const norm = (a) => Math.hypot(...a);

export class Hands {
    constructor(run) {
        this.run = run;
        this.all = new Map();
        this.gone = [];
    }
    // Nothing where the body is one of a run that is over.
    grab(hand, body, point, run) {
        const { library, simulation, state } = this.run;
        if (run !== this.run.number) return null;
        this.letGo(hand);
        const { compliance, most, at } = library.reach(simulation, body, point, state.stiffness);
        const stiffness = firm / compliance;
        const attachment = library.attach(simulation, body, point, stiffness, slow * stiffness);
        this.all.set(hand, { attachment, at, way: far * most * compliance, target: at });
        return { at, way: far * most * compliance };
    }
    letGo(hand) {
        const held = this.all.get(hand);
        this.all.delete(hand);
        if (held) this.#holds(() => this.run.library.call('let_go', this.run.simulation, held.attachment));
    }
    // A new run has them from the one before; where it begins again, or is one of other trees, they have let go.
    begin(restart, others) {
        if (others && !restart) for (const hand of this.all.keys()) this.letGo(hand); // of a tree that is alike
        if (restart || others) this.all.clear();
    }
    // Where pointers are by now: hands are there in so many steps.
    aim(targets, steps) {
        for (const [hand, to] of targets ?? []) {
            const held = this.all.get(hand);
            if (!held) continue;
            const way = less(to, held.at), share = Math.min(1, held.way / norm(way));
            held.target = held.at.map((value, k) => value + share * way[k]);
        }
        if (steps === 0) return;
        for (const [hand, { attachment, target }] of this.all)
            this.#try(hand, () => this.run.library.moveAttachment(this.run.simulation, attachment, target, steps));
    }
    forces() {
        const all = [];
        for (const [hand, { attachment }] of this.all)
            this.#try(hand, () => all.push([hand, norm(this.run.library.attachmentForce(this.run.simulation, attachment))]));
        return all;
    }
    lost() { return this.gone.splice(0); }
    #try(hand, work) {
        if (this.#holds(work)) return;
        this.all.delete(hand);
        this.gone.push(hand);
    }
    // Whether what is held is there: a branch that broke off has let go by itself.
    #holds(work) {
        try {
            work();
            return true;
        } catch (error) {
            if (!error.message.includes('is not there')) throw error;
            return false;
        }
    }
}
