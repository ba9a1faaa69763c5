// shape.js: what a state may hold. One that comes from outside, by an address or in a scene document, is compared with it where it is read.

// [least, most] is a number, [least, most, 1] a whole one; [[...], ...] so many values; 'text' any, 'a or b' one of these; an object its fields,
// of which those with ? may be missing. open: with other fields, which the library reads.
const list = (of, least = 0, rises = false) => ({ list: of, least, rises });
const open = (fields = {}) => ({ open: fields });
const any = [-1e9, 1e9], factor = [1e-9, 1e12], damping = [0, 1e12], body = [0, 2 ** 31, 1], place = (_, { places }) => [0, places.length - 1, 1];
const keys = list([[0, 1e3], factor], 0, true);

const grown = {
    species: 'text', 'age?': [0, 1e3], bodies: [1, 1e6, 1], seed: [0, 2 ** 53, 1], 'leaves?': true, 'petals?': true, 'fruit?': true,
};
const file = { file: 'text', name: 'text', 'material?': 'text', 'maxBodies?': body, 'unit?': damping };
const shape = {
    trees: list((value) => value?.species === undefined ? file : grown, 1),
    places: list({ tree: (_, { trees }) => [0, trees.length - 1, 1], position: [any, any, any], yaw: any, 'start?': any }, 1),
    base: open({ 'wood?': open({ 'curves?': list(open()) }), 'wind?': open(), 'fracture?': open(), 'simulate?': open() }),
    ownMesh: true,
    wind: {
        speed: [0, 1e3], direction: [-360, 360], rise: [-1e3, 1e3], turbulence: [0, 1e3], gustFactor: [1, 1e3], gustPeriod: [1e-3, 1e9], seed: [0, 2 ** 64, 1], 'blows?': true,
    },
    gravity: [-1e3, 1e3], drawnGravity: [-1e3, 1e3], stiffness: factor, damping, curves: { keys: { stiffness: keys, damping: keys } },
    parts: list({ place, body, stiffness: factor, damping }), strength: damping, least: [0, 1e3], levels: body, only: list({ place, body }),
    rate: [10, 1e3], precision: 'float or double',
};

const isObject = (value) => typeof value === 'object' && value !== null && !Array.isArray(value);

// Throws for the first value that is none of its kind, by its JSON pointer.
export function check(value, kind = shape, at = '', state = value) {
    const fail = (expected, found = value, where = at) => {
        const is = found === undefined ? 'missing' : typeof found === 'number' ? found : JSON.stringify(found).slice(0, 60);
        throw new Error(`${where || '/'}: is ${is}, expected ${expected}`);
    };
    const inside = (key, of) => check(value[key], of, `${at}/${key}`, state);
    if (typeof kind === 'function') kind = kind(value, state);
    if (kind === true) return typeof value === 'boolean' || fail('true or false');
    if (typeof kind === 'string') return (kind === 'text' ? typeof value === 'string' : kind.split(' or ').includes(value)) || fail(kind);
    if (kind.list) {
        if (!Array.isArray(value)) fail('an array');
        if (value.length < kind.least) fail('at least one');
        value.forEach((_, k) => inside(k, kind.list));
        const falls = kind.rises ? value.findIndex(([x], k) => k > 0 && x <= value[k - 1][0]) : -1;
        if (falls > 0) fail(`more than ${value[falls - 1][0]}`, value[falls][0], `${at}/${falls}/0`);
    } else if (Array.isArray(kind[0])) {
        if (!Array.isArray(value) || value.length !== kind.length) fail(`${kind.length} numbers`);
        kind.forEach((of, k) => inside(k, of));
    } else if (Array.isArray(kind)) {
        const [least, most, whole] = kind;
        if (!(value >= least && value <= most) || typeof value !== 'number' || (whole && value % 1 !== 0)) fail(`a ${whole ? 'whole ' : ''}number from ${least} to ${most}`);
    } else {
        if (!isObject(value)) fail('an object');
        const fields = Object.entries(kind.open ?? kind), known = new Set(fields.map(([key]) => key.replace('?', '')));
        const other = kind.open ? undefined : Object.keys(value).find((key) => !known.has(key));
        if (other !== undefined) throw new Error(`${at}/${other}: is not known here`);
        for (const [key, of] of fields) {
            const own = key.replace('?', '');
            if (own === key || value[own] !== undefined) inside(own, of);
        }
    }
}
