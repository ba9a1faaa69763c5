// builtins.js: the trees that the page brings: by species and seed, and a SpeedTree file of a young maple. Each in a wind that bends less than 2 % of its wood
// beyond its strength, of the birch 6 % (`treesim --settle 0 --seconds 10 --fields stress`): it blows at once on a tree at rest. None is older than it grows within a second: a
// tree is grown whole before it is resolved by fewer bodies.
import { defaults } from './state.js';

const at = (tree, x, z, yaw = 0, start = 0) => ({ tree, position: [x, 0, z], yaw, start });
const species = (name, age, bodies, seed, more = {}) => ({ species: name, age, bodies, seed, leaves: false, petals: false, fruit: false, ...more });
const wind = (speed, turbulence, gustFactor, gustPeriod) => ({ ...defaults.wind, speed, turbulence, gustFactor, gustPeriod });

export const youngMaple = { file: 'young_maple', name: 'young_maple.xml' }; // its bytes come with the page

export const first = 'maple'; // the one that is shown where nothing else is asked for

export const builtins = {
    maple: {
        label: 'Maple in leaf',
        trees: [species('maple', 16, 6000, 3, { leaves: true })], places: [at(0, 0, 0)], wind: wind(4, 0.2, 1.5, 5),
    },
    willow: {
        label: 'Willow',
        trees: [species('willow', 8, 5000, 7)], places: [at(0, 0, 0)], wind: wind(6, 0.2, 1.5, 6),
    },
    apple: {
        label: 'Apple, with fruit',
        trees: [species('apple', 8, 3000, 2, { leaves: true, fruit: true })], places: [at(0, 0, 0)], wind: wind(4, 0.2, 1.5, 5),
    },
    park: {
        label: 'Park of twelve',
        trees: [
            species('willow', 6, 1600, 4), species('cherry', 9, 900, 1, { leaves: true, petals: true }), species('apple', 7, 900, 3, { leaves: true }),
            species('birch', 10, 900, 2, { leaves: true }), species('maple', 12, 1000, 5, { leaves: true }),
        ],
        places: [
            at(0, -8, -5), at(0, 10, -7, 140, 5), at(1, 1.5, 2.5, 0, 3), at(1, 5, 4, 130, 11), at(1, -0.5, 6.5, 220, 7), at(2, -4, 3, 70, 2),
            at(2, -6.5, 5.5, 200, 6), at(3, 4, -4, 0, 1), at(3, 6, -1, 80, 9), at(3, -2, -6, 200, 4), at(4, 11, 2, 30, 5), at(4, -11, 1.5, 250, 8),
        ],
        wind: wind(5, 0.15, 1.5, 6),
    },
    young_maple: {
        label: 'Young maple (XML)',
        trees: [youngMaple], places: [at(0, 0, 0)], wind: wind(6, 0.2, 1.5, 5),
    },
};

export function builtinState(name) {
    const { label, ...own } = builtins[name];
    return { ...structuredClone(defaults), ...structuredClone(own) };
}
