// skinned.js: a mesh moved by bodies whose poses stand in a float texture, two texels a body: how far it is from where it was drawn (a place and
// a turn), read by texelFetch for the two bodies that move a vertex. Beside it a byte a body says how it is marked.
import * as THREE from 'three';

const width = 1024; // texels in a row, even: a body's two stand side by side

const declarations = /* glsl */ `
    attribute vec3 bodies; // two of them, and the second's share
    uniform highp sampler2D poses;
    uniform sampler2D marks;
    varying float vMark;
    vec4 offsetOf(float body, int part) {
        int at = 2 * int(body) + part;
        return texelFetch(poses, ivec2(at % ${width}, at / ${width}), 0);
    }
    float markOf(float body) {
        int at = int(body);
        return texelFetch(marks, ivec2(at % ${width}, at / ${width}), 0).r;
    }
    vec3 turned(vec4 q, vec3 v) {
        return v + 2.0 * cross(q.xyz, cross(q.xyz, v) + q.w * v);
    }
`;

function moveBodies(shader, textures, marked) {
    Object.assign(shader.uniforms, textures);
    shader.vertexShader = declarations + shader.vertexShader
        .replace('#include <beginnormal_vertex>', /* glsl */ `
            vec4 turnA = offsetOf(bodies.x, 1), turnB = offsetOf(bodies.y, 1);
            vec3 objectNormal = mix(turned(turnA, normal), turned(turnB, normal), bodies.z);`)
        .replace('#include <begin_vertex>', /* glsl */ `
            vec4 toA = offsetOf(bodies.x, 1), toB = offsetOf(bodies.y, 1);
            vec3 transformed = mix(turned(toA, position) + offsetOf(bodies.x, 0).xyz,
                turned(toB, position) + offsetOf(bodies.y, 0).xyz, bodies.z);
            vMark = markOf(bodies.x);`);
    if (!marked) return;
    shader.fragmentShader = 'varying float vMark;\n' + shader.fragmentShader.replace('#include <color_fragment>', /* glsl */ `
        #include <color_fragment>
        diffuseColor.rgb = mix(diffuseColor.rgb, vec3(0.95, 0.45, 0.08), 0.65 * vMark);`);
}

export class Skinned {
    constructor(mesh) {
        this.bodies = mesh.bodies;
        const rows = Math.max(1, Math.ceil(2 * mesh.bodies / width));
        this.poses = new Float32Array(4 * width * rows);
        this.texture = new THREE.DataTexture(this.poses, width, rows, THREE.RGBAFormat, THREE.FloatType);
        this.marked = new Uint8Array(width * Math.ceil(mesh.bodies / width));
        this.markTexture = new THREE.DataTexture(this.marked, width, this.marked.length / width, THREE.RedFormat, THREE.UnsignedByteType);
        this.markTexture.needsUpdate = true;
        const textures = { poses: { value: this.texture }, marks: { value: this.markTexture } };

        this.vertex = mesh.vertex;
        const numbers = new THREE.InterleavedBuffer(mesh.vertex, 9);
        const geometry = new THREE.BufferGeometry();
        geometry.setAttribute('position', new THREE.InterleavedBufferAttribute(numbers, 3, 0));
        geometry.setAttribute('normal', new THREE.InterleavedBufferAttribute(numbers, 3, 3));
        geometry.setAttribute('bodies', new THREE.InterleavedBufferAttribute(numbers, 3, 6));
        geometry.setAttribute('color', new THREE.BufferAttribute(linear(mesh.color), 4, true));
        geometry.setIndex(new THREE.BufferAttribute(mesh.index, 1));
        const made = new Set(['bark', 'leaf', 'petal', 'fruit']); // of tubes, and leaves of two faces; a file's own may have one
        mesh.parts.forEach((part) => geometry.addGroup(3 * part.first, 3 * part.triangles, made.has(part.name) ? 0 : 1));
        geometry.computeBoundingBox();
        this.box = geometry.boundingBox.clone();

        const material = (side) => {
            const own = new THREE.MeshLambertMaterial({ vertexColors: true, side });
            own.onBeforeCompile = (shader) => moveBodies(shader, textures, true);
            return own;
        };
        this.object = new THREE.Mesh(geometry, [material(THREE.FrontSide), material(THREE.DoubleSide)]);
        this.object.frustumCulled = false; // it moves out of what its box says
        this.object.castShadow = this.object.receiveShadow = true;
        const depth = new THREE.MeshDepthMaterial({ side: THREE.DoubleSide });
        depth.onBeforeCompile = (shader) => moveBodies(shader, textures, false);
        this.object.customDepthMaterial = depth;
    }
    take(poses) { // 8 floats a body
        this.poses.set(poses.length > this.poses.length ? poses.subarray(0, this.poses.length) : poses);
        this.texture.needsUpdate = true;
    }
    mark(bodies) { // a Uint8Array of them, or null
        this.marked.fill(0);
        if (bodies) for (let i = 0; i < bodies.length; ++i) this.marked[i] = bodies[i] ? 255 : 0;
        this.markTexture.needsUpdate = true;
    }
    // A point that moves with a body: where it is now from where it was drawn, and back.
    moved(body, point) {
        const [place, turn] = this.#offset(body);
        return point.clone().applyQuaternion(turn).add(place);
    }
    drawn(body, point) {
        const [place, turn] = this.#offset(body);
        return point.clone().sub(place).applyQuaternion(turn.invert());
    }
    #offset(body) {
        const at = 8 * body, p = this.poses;
        return [new THREE.Vector3(p[at], p[at + 1], p[at + 2]), new THREE.Quaternion(p[at + 4], p[at + 5], p[at + 6], p[at + 7])];
    }
    // Where vertices are, as the shader has them: for tests.
    positions() {
        const out = new Float32Array(this.vertex.length / 3), a = new THREE.Vector3();
        for (let v = 0; v < this.vertex.length / 9; ++v) {
            const [x, y, z, , , , first, second, share] = this.vertex.subarray(9 * v, 9 * v + 9);
            const one = this.moved(first, a.set(x, y, z)), other = this.moved(second, a.set(x, y, z));
            out.set([one.x, one.y, one.z].map((value, k) => value + share * (other.getComponent(k) - value)), 3 * v);
        }
        return out;
    }
    free() {
        this.object.geometry.dispose();
        this.object.material.forEach((material) => material.dispose());
        this.object.customDepthMaterial.dispose();
        this.texture.dispose();
        this.markTexture.dispose();
    }
}

// sRGB bytes as linear ones, which a shader takes.
function linear(bytes) {
    const table = Uint8Array.from({ length: 256 }, (_, k) => {
        const c = k / 255;
        return Math.round(255 * (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    });
    return bytes.map((value, k) => k % 4 === 3 ? 255 : table[value]);
}
