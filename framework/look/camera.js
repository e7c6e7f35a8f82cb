// A camera that is flown with mouse and keys.

import { isFree } from "./keys.js";

const TURN = 0.004;  // Radians by pixel of a drag
const KEY_TURN = 1.2;  // Radians in a second
const CROSS_SECONDS = 8;  // For the scene's size at first
const UP = [0, 1, 0];
const POLE = 0.05;  // Smallest angle to `up`, radians
const MOVES = { KeyW: [0, 0, 1], KeyS: [0, 0, -1], KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyE: [0, 1, 0], KeyQ: [0, -1, 0] };
const TURNS = { ArrowLeft: [1, 0], ArrowRight: [-1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

const add = (a, b, scale = 1) => a.map((value, i) => value + scale * b[i]);
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => a.map((value) => value / Math.hypot(...a));
const rotate = (v, axis, angle) =>  // Rodrigues
    add(add(v.map((value) => value * Math.cos(angle)), cross(axis, v), Math.sin(angle)), axis, dot(axis, v) * (1 - Math.cos(angle)));

export class FlyCamera {
    /** @param moved is called with a value of scene.camera, and the time of the event. */
    constructor(canvases, moved) {
        this.moved = moved;
        this.keys = new Set();
        this.speed = null;  // m/s
        this.isDragged = this.isFollowing = false;
        for (const canvas of canvases) this.watch(canvas);
        document.addEventListener("keydown", (event) => {
            this.isFast = event.shiftKey;
            if (!(event.code in MOVES) && !(event.code in TURNS) || !isFree(event)) return;
            event.preventDefault();
            if (!this.keys.size) this.fly(event.timeStamp);
            this.keys.add(event.code);
        });
        document.addEventListener("keyup", (event) => {
            if (this.keys.has(event.code)) this.advance(event.timeStamp);  // Frames may be rarer than keys
            this.isFast = event.shiftKey;
            this.keys.delete(event.code);
        });
        window.addEventListener("blur", () => this.keys.clear());
    }

    watch(canvas) {
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            canvas.focus();
            this.isDragged = true;
            canvas.classList.add("dragged");
        });
        canvas.addEventListener("pointermove", (event) => {
            if (!this.isDragged || !this.position) return;
            this.turn(-TURN * event.movementX, -TURN * event.movementY);
            this.tell(event.timeStamp);
        });
        for (const name of ["pointerup", "pointercancel"])
            canvas.addEventListener(name, () => {
                this.isDragged = false;
                canvas.classList.remove("dragged");
            });
        canvas.addEventListener("wheel", (event) => {
            event.preventDefault();
            if (this.speed) this.speed *= 1.1 ** -Math.sign(event.deltaY);
        }, { passive: false });
    }

    get isMoving() {
        return this.isDragged || this.keys.size > 0 || this.isFollowing;
    }

    /** Where the image was taken from, unless the camera was moved since. */
    take({ position, target, fov_deg }, up = UP, sceneSize) {
        this.fov = Number(fov_deg.toPrecision(6));
        this.position = position;
        this.forward = unit(add(target, position, -1));
        this.up = unit(up);
        this.sceneSize = sceneSize;
        this.speed ??= sceneSize / CROSS_SECONDS;
    }

    turn(yaw, pitch) {
        const angle = Math.acos(dot(this.forward, this.up));
        const allowed = Math.min(Math.max(pitch, angle - Math.PI + POLE), angle - POLE);
        const right = unit(cross(this.forward, this.up));
        this.forward = unit(rotate(rotate(this.forward, right, allowed), this.up, yaw));
    }

    /** Moves until no key is held. */
    fly(time) {
        this.last = time;
        const step = (now) => {
            if (!this.keys.size) return;
            this.advance(now);
            requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    /** Moves by the time since the last move. */
    advance(now) {
        const seconds = Math.min(Math.max(now - this.last, 0) / 1000, 0.2);
        this.last = now;
        if (!this.position || !seconds) return;
        const right = unit(cross(this.forward, this.up)), way = seconds * this.speed * (this.isFast ? 4 : 1);
        for (const key of this.keys) {
            const [x, y, z] = MOVES[key] ?? [0, 0, 0];
            this.position = add(add(add(this.position, right, way * x), this.up, way * y), this.forward, way * z);
            const [yaw, pitch] = TURNS[key] ?? [0, 0];
            this.turn(KEY_TURN * seconds * yaw, KEY_TURN * seconds * pitch);
        }
        this.tell(now);
    }

    /** Takes poses until there are no more, or until it is flown. @param poseAt is called with the time in ms */
    follow(poseAt) {
        this.isFollowing = true;
        const step = (now) => {
            const pose = this.isDragged || this.keys.size ? null : poseAt(now);
            this.isFollowing = pose !== null;
            if (!pose) return;
            this.position = pose.position;
            this.forward = unit(add(pose.target, pose.position, -1));
            this.tell(now);
            requestAnimationFrame(step);
        };
        requestAnimationFrame(step);
    }

    /** A value of scene.camera. */
    get value() {
        const up = this.up.some((value, i) => value !== UP[i]) ? { up: this.up } : {};
        return { position: this.position, target: add(this.position, this.forward), ...up, fov_deg: this.fov };
    }

    tell(time) {
        this.moved(this.value, time);
    }
}
