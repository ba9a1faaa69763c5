// view.js: what is drawn: the trees, the ground, the light, the arrows of hands; the camera and how it stands.
import * as THREE from 'three';
import { Orbit } from './orbit.js';
import { Skinned } from './skinned.js';

const sky = 0xdfe7ec, earth = 0xb9b7a6;

export class View {
    constructor(canvas) {
        this.canvas = canvas;
        this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, powerPreference: 'high-performance' });
        const gl = this.renderer.getContext(), told = gl.getExtension('WEBGL_debug_renderer_info');
        this.slow = /swiftshader|llvmpipe|software|basic render/i.test(told ? gl.getParameter(told.UNMASKED_RENDERER_WEBGL) : ''); // no graphics card
        this.renderer.shadowMap.enabled = true;
        this.renderer.shadowMap.type = THREE.PCFShadowMap;
        this.scene = new THREE.Scene();
        this.scene.background = new THREE.Color(sky);
        this.scene.fog = new THREE.Fog(sky, 60, 300);
        this.camera = new THREE.PerspectiveCamera(38, 1, 0.01, 1000);
        this.orbit = new Orbit(this.camera);
        this.scene.add(new THREE.HemisphereLight(0xf4f9ff, 0x8d8368, 1.7));
        this.sun = new THREE.DirectionalLight(0xfff3df, 2.2);
        this.sun.castShadow = !this.slow;
        this.sun.shadow.mapSize.set(2048, 2048);
        this.sun.shadow.bias = -0.0005;
        this.sun.shadow.normalBias = 0.02;
        this.scene.add(this.sun, this.sun.target);
        const ground = new THREE.Mesh(new THREE.CircleGeometry(1, 96), new THREE.MeshLambertMaterial({ color: earth }));
        ground.rotation.x = -Math.PI / 2;
        ground.receiveShadow = true;
        this.ground = ground;
        this.scene.add(ground);
        this.arrows = new Map();
        this.skinned = null;
        this.fitted = false;
        new ResizeObserver(() => this.resize()).observe(canvas);
        this.resize();
    }
    resize() {
        const { clientWidth: w, clientHeight: h } = this.canvas;
        if (w === 0 || h === 0) return;
        this.renderer.setPixelRatio(this.slow ? 1 : Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(w, h, false);
        this.camera.aspect = w / h;
        this.camera.updateProjectionMatrix();
        if (this.skinned) this.fit();
    }
    show(mesh) {
        const before = this.skinned;
        this.skinned = new Skinned(mesh);
        this.scene.add(this.skinned.object);
        if (before) {
            this.scene.remove(before.object);
            before.free();
        }
        const box = this.skinned.box, size = box.getSize(new THREE.Vector3()).length(), middle = box.getCenter(new THREE.Vector3());
        const alike = before && Math.abs(Math.log(size / this.size)) < Math.LN2 && middle.distanceTo(this.middle) < 0.5 * size;
        this.size = size;
        this.middle = middle;
        this.ground.scale.setScalar(8 * size);
        this.ground.position.set(middle.x, Math.min(0, box.min.y) - 1e-3 * size, middle.z);
        this.scene.fog.near = 3 * size;
        this.scene.fog.far = 9 * size;
        this.camera.near = 0.002 * size;
        this.camera.far = 30 * size;
        this.sun.target.position.copy(middle);
        this.sun.position.copy(middle).add(new THREE.Vector3(0.45, 0.9, 0.35).multiplyScalar(1.5 * size));
        const lit = this.sun.shadow.camera, reach = 0.75 * size;
        Object.assign(lit, { left: -reach, right: reach, top: reach, bottom: -reach, near: 0.1 * size, far: 4 * size });
        lit.updateProjectionMatrix();
        this.orbit.reach(size);
        if (!alike) this.orbit.touched = false; // what the user looked at is not there
        this.fit();
    }
    // The whole of what is shown, beside the panel (inset: CSS pixels at the right and at the bottom that it covers), unless the user looks at a part.
    fit(inset = this.inset ?? [0, 0]) {
        this.inset = inset;
        const { clientWidth: w, clientHeight: h } = this.canvas, [right, bottom] = inset;
        this.camera.setViewOffset(w, h, right / 2, bottom / 2, w, h);
        const free = [Math.max(0.3, 1 - right / w), Math.max(0.3, 1 - bottom / h)];
        if (!this.orbit.touched) this.orbit.fit(this.skinned.box, this.camera, free);
    }
    whole() {
        this.orbit.touched = false;
        this.fit();
    }
    shadows(on) {
        this.sun.castShadow = on;
        this.shadowsChanged?.(on);
    }
    take(poses) { this.skinned?.take(poses); }

    ray(x, y) { // of a place on the canvas, CSS pixels
        const { clientWidth: w, clientHeight: h } = this.canvas;
        this.camera.updateMatrixWorld();
        const near = new THREE.Vector3(2 * x / w - 1, 1 - 2 * y / h, -1).unproject(this.camera);
        const far = new THREE.Vector3(2 * x / w - 1, 1 - 2 * y / h, 0.5).unproject(this.camera);
        return new THREE.Ray(near, far.sub(near).normalize());
    }
    // Half the angle that so many pixels make.
    aperture(pixels) {
        return Math.atan(pixels / (this.canvas.clientHeight / 2) * Math.tan(this.camera.fov * Math.PI / 360));
    }
    // The plane at a point's depth.
    depthPlane(point) {
        return new THREE.Plane().setFromNormalAndCoplanarPoint(this.camera.getWorldDirection(new THREE.Vector3()), point);
    }
    point([x, y, z]) { return new THREE.Vector3(x, y, z); }
    screen(point) {
        const { clientWidth: w, clientHeight: h } = this.canvas;
        this.camera.updateMatrixWorld();
        const p = point.clone().project(this.camera);
        return [(p.x + 1) / 2 * w, (1 - p.y) / 2 * h];
    }
    arrow(hand, from, to) {
        let arrow = this.arrows.get(hand);
        if (!arrow) {
            arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 1, 0), from, 1, 0xd9480f);
            for (const part of [arrow.line, arrow.cone]) {
                part.material.depthTest = false;
                part.renderOrder = 1;
            }
            this.arrows.set(hand, arrow);
            this.scene.add(arrow);
        }
        const way = to.clone().sub(from), length = Math.max(1e-6, way.length());
        arrow.position.copy(from);
        arrow.setDirection(way.divideScalar(length));
        arrow.setLength(length, Math.min(0.03 * this.size, 0.5 * length), Math.min(0.012 * this.size, 0.25 * length));
    }
    removeArrow(hand) {
        const arrow = this.arrows.get(hand);
        if (!arrow) return;
        this.scene.remove(arrow);
        arrow.dispose();
        this.arrows.delete(hand);
    }
    draw() {
        this.orbit.place(this.camera);
        this.renderer.render(this.scene, this.camera);
    }
}
