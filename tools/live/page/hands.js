// hands.js: hands that pull, in the Worker. The force of a hand is that of a soft thread to the pointer as the wood at rest would answer it,
//   F = (target - where the point was when it was taken) / compliance,  compliance = sum over the joints that bear it of lever^2 / K,
// at most what turns no joint by half a radian, and it follows the pointer with a delay. It does not hang on where the point is now: a spring taken
// explicitly to a light twig is unstable at any stiffness that is worth having.

const delay = 0.1; // [s]

const less = (a, b) => a.map((value, k) => value - b[k]);
const norm = (a) => Math.hypot(...a);

export class Hands {
    constructor(run) {
        this.run = run;
        this.all = new Map();
        this.gone = [];
    }
    grab(hand, body, point) {
        const { library, simulation, state } = this.run;
        const reach = library.reach(simulation, body, point, state.stiffness);
        this.all.set(hand, { body, point, ...reach, target: reach.at, force: [0, 0, 0] });
        return reach;
    }
    letGo(hand) { this.all.delete(hand); }
    begin(restart) {
        if (restart) this.all.clear();
    }
    aim(targets) {
        for (const [hand, target] of targets ?? []) if (this.all.has(hand)) this.all.get(hand).target = target;
    }
    pull() {
        const { library, simulation, clock } = this.run;
        const share = 1 - Math.exp(-clock.step / delay);
        for (const [id, hand] of this.all) {
            const way = less(hand.target, hand.at), length = norm(way);
            const size = hand.compliance > 0 ? Math.min(length / hand.compliance, hand.most) : 0;
            const wanted = length > 0 ? way.map((value) => value / length * size) : [0, 0, 0];
            hand.force = hand.force.map((value, k) => value + share * (wanted[k] - value));
            try {
                library.pulled(simulation, hand.body, hand.point, hand.force);
            } catch (error) {
                this.all.delete(id); // a branch that broke off is no longer the tree's
                this.gone.push([id, error.message]);
            }
        }
    }
    forces() { return Array.from(this.all, ([id, hand]) => [id, norm(hand.force)]); }
    lost() { return this.gone.splice(0); }
}
