// orbit.js: the camera about a point: one pointer turns, two or the wheel come nearer and shift.
import * as THREE from 'three';

export class Orbit {
    constructor() {
        this.target = new THREE.Vector3();
        this.azimuth = 0.6; // [rad] about the vertical
        this.height = 0.12; // [rad] above the ground
        this.distance = 10; // [m]
        this.touched = false; // brought nearer or shifted by the user: what fits by itself does not move it any more
    }
    fit(box, camera, [wide, high]) {
        const size = box.getSize(new THREE.Vector3());
        box.getCenter(this.target);
        const half = Math.tan(camera.fov * Math.PI / 360), across = half * camera.aspect * wide, up = half * high;
        const forward = this.#way().negate(), right = new THREE.Vector3().crossVectors(forward, new THREE.Vector3(0, 1, 0)).normalize();
        const above = new THREE.Vector3().crossVectors(right, forward);
        this.distance = 0;
        for (let k = 0; k < 8; ++k) { // each corner within the picture
            const c = new THREE.Vector3(k & 1 ? 0.5 : -0.5, k & 2 ? 0.5 : -0.5, k & 4 ? 0.5 : -0.5).multiply(size), ahead = c.dot(forward);
            this.distance = Math.max(this.distance, 1.06 * Math.abs(c.dot(right)) / across - ahead, 1.06 * Math.abs(c.dot(above)) / up - ahead);
        }
    }
    reach(size) { // [m] of the box's diagonal
        this.nearest = 0.02 * size;
        this.farthest = 6 * size;
    }
    turn(dx, dy) { // pixels
        this.azimuth -= 0.006 * dx;
        this.height = Math.min(1.5, Math.max(-0.2, this.height + 0.006 * dy));
    }
    nearer(factor) {
        this.touched = true;
        this.distance = Math.min(this.farthest ?? Infinity, Math.max(this.nearest ?? 0, this.distance / factor));
    }
    shift(dx, dy, camera, pixels) { // so that what is at the target's depth follows
        this.touched = true;
        const metre = 2 * this.distance * Math.tan(camera.fov * Math.PI / 360) / pixels;
        const x = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 0), y = new THREE.Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
        this.target.addScaledVector(x, -dx * metre).addScaledVector(y, dy * metre);
    }
    place(camera) {
        camera.position.copy(this.#way().multiplyScalar(this.distance).add(this.target));
        if (camera.position.y < 0.02 * this.distance) camera.position.y = 0.02 * this.distance; // stays above the ground
        camera.lookAt(this.target);
    }
    #way() { // from the target to the camera
        const flat = Math.cos(this.height);
        return new THREE.Vector3(Math.sin(this.azimuth) * flat, Math.sin(this.height), Math.cos(this.azimuth) * flat);
    }
}
