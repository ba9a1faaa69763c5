// played.js: what the pages that play our files share: OBJ frames, skinned vertices, distances, a picture; what was found is sent to open_page.py.
import * as THREE from 'three';

export const query = new URLSearchParams(location.search);

// Sends the canvas, if there is one, then what was found: open_page.py waits for the latter.
export async function say(result) {
    const canvas = document.querySelector('canvas');
    if (canvas !== null) await fetch('/picture', {method: 'POST', body: await new Promise(ready => canvas.toBlob(ready))});
    await fetch('/found', {method: 'POST', body: JSON.stringify(result)});
}
// What nothing caught is sent too.
addEventListener('error', event => say({error: event.message}));
addEventListener('unhandledrejection', event => say({error: String(event.reason)}));

// Numbers of the lines that begin so.
export function objNumbers(text, word) {
    const numbers = [];
    for (const line of text.split('\n'))
        if (line.startsWith(word + ' ')) numbers.push(...line.slice(word.length + 1).split(' ').map(Number));
    return numbers;
}
// Vertices of the faces' corners, in order.
export function objCorners(text) {
    const corners = [];
    for (const line of text.split('\n'))
        if (line.startsWith('f ')) corners.push(...line.slice(2).split(' ').map(corner => Number(corner.split('/')[0]) - 1));
    return corners;
}

export function farthest(a, b) {
    if (a.length !== b.length) throw new Error(`${a.length / 3} vertices, expected ${b.length / 3}`);
    let most = 0;
    for (let i = 0; i < a.length; i += 3)
        most = Math.max(most, Math.hypot(a[i] - b[i], a[i + 1] - b[i + 1], a[i + 2] - b[i + 2]));
    return most;
}

// Vertices of all skinned meshes in the file's order, in the world, as three.js moves them.
export function moved(meshes) {
    const found = [], v = new THREE.Vector3();
    for (const mesh of meshes) {
        mesh.skeleton.update();
        for (let i = 0; i < mesh.geometry.attributes.position.count; ++i) {
            mesh.getVertexPosition(i, v).applyMatrix4(mesh.matrixWorld);
            found.push(v.x, v.y, v.z);
        }
    }
    return found;
}

export function bounds(vertices) {
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    vertices.forEach((x, i) => { low[i % 3] = Math.min(low[i % 3], x); high[i % 3] = Math.max(high[i % 3], x); });
    return {low, high, height: high[1] - low[1]};
}

// Draws the object on a canvas; the share of pixels that are not sky.
export function draw(object, {low, high}) {
    const scene = new THREE.Scene(), size = Math.max(high[1] - low[1], high[0] - low[0]);
    scene.background = new THREE.Color(0.86, 0.91, 0.96);
    scene.add(object, new THREE.HemisphereLight(0xffffff, 0x887766, 2));
    const sun = new THREE.DirectionalLight(0xffffff, 2);
    sun.position.set(1, 2, 3);
    scene.add(sun);
    object.traverse(o => { o.frustumCulled = false; });
    const camera = new THREE.PerspectiveCamera(30, 1, size / 100, size * 100);
    camera.position.set((low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2 + 2.2 * size);
    const renderer = new THREE.WebGLRenderer({antialias: true, preserveDrawingBuffer: true});
    renderer.setSize(700, 700);
    document.body.prepend(renderer.domElement);
    renderer.render(scene, camera);
    const gl = renderer.getContext(), pixels = new Uint8Array(4 * 700 * 700);
    gl.readPixels(0, 0, 700, 700, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    let drawn = 0;
    for (let i = 0; i < pixels.length; i += 4)
        drawn += Math.abs(pixels[i] - pixels[0]) + Math.abs(pixels[i + 1] - pixels[1]) + Math.abs(pixels[i + 2] - pixels[2]) > 24;
    return drawn / (700 * 700);
}
