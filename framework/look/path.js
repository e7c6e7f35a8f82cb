// A flight of the camera as keys of `scene.camera.path`.

import { onKey } from "./keys.js";

const FRAMES_A_SECOND = 30;
const HOLD_MS = 100;  // Without a sample, the camera rested until shortly before the next one
const LEAST_COMPARED = 3;  // Frames of measure.compare_every
const CLOSE = 0.002;  // Of the scene's size, or radians: how far the keys' straight lines may be from what was flown

const mix = (a, b, t) => a.map((value, i) => value + t * (b[i] - value));
const distance = (a, b) => Math.hypot(...a.map((value, i) => value - b[i]));

/** Pose of a frame between samples, which are in order of time. */
function poseAt(samples, ms) {
    const after = samples.findIndex((sample) => sample.ms >= ms);
    if (after < 1) return samples.at(after);  // The first, or the last
    const [a, b] = [samples[after - 1], samples[after]], t = (ms - a.ms) / (b.ms - a.ms);
    return { position: mix(a.position, b.position, t), target: mix(a.target, b.target, t) };
}

/** Pose of a frame of a camera with a path, as the program has it. */
function poseOf({ position, target, path }, frame) {
    const keys = [{ frame: 0, position, target }, ...path], after = keys.findIndex((key) => key.frame >= frame);
    if (after < 1) return keys.at(after);
    const [a, b] = [keys[after - 1], keys[after]], t = (frame - a.frame) / (b.frame - a.frame);
    return { position: mix(a.position, b.position, t), target: mix(a.target, b.target, t) };
}

/** Frames that are needed so that straight lines between them are close to all poses (Douglas and Peucker 1973). */
function keysOf(poses, first, last, tolerance) {
    let farthest = 0, at = 0;
    for (let i = first + 1; i < last; ++i) {
        const t = (i - first) / (last - first);
        const off = Math.max(...["position", "target"].map((end) =>
            distance(poses[i][end], mix(poses[first][end], poses[last][end], t)) / tolerance[end]));
        if (off > farthest) [farthest, at] = [off, i];
    }
    return farthest <= 1 ? [last] : [...keysOf(poses, first, at, tolerance), ...keysOf(poses, at, last, tolerance)];
}

class PathRecorder {
    constructor() {
        this.samples = null;
    }

    get isRecording() {
        return this.samples !== null;
    }

    /** @param camera a value of scene.camera; its target is 1 m away. */
    begin(camera, ms) {
        this.samples = [{ ...camera, ms }];
    }

    add(camera, ms) {
        if (!this.isRecording) return;
        const last = this.samples.at(-1);
        if (ms - last.ms > HOLD_MS) this.samples.push({ ...last, ms: ms - 1000 / FRAMES_A_SECOND });
        this.samples.push({ ...camera, ms });
    }

    /** @return the camera of the first frame with its path, and the number of frames; null if nothing was flown. */
    end(ms, sceneSize) {
        const samples = this.samples, seconds = (ms - samples[0].ms) / 1000, last = Math.round(seconds * FRAMES_A_SECOND);
        this.samples = null;
        if (samples.length < 2 || last < 1) return null;
        const poses = Array.from({ length: last + 1 }, (_, frame) => poseAt(samples, samples[0].ms + 1000 * frame / FRAMES_A_SECOND));
        const rounded = (vector) => vector.map((value) => Number(value.toPrecision(6)));
        const position = CLOSE * sceneSize, keys = keysOf(poses, 0, last, { position, target: position + CLOSE });
        const { ms: _, ...first } = samples[0];
        return { frames: last + 1, camera: { ...first,
            path: keys.map((frame) => ({ frame, position: rounded(poses[frame].position), target: rounded(poses[frame].target) })) } };
    }
}

/** The button that records, and what was recorded. */
export class PathControls {
    /** @param set is called with a path of the config and its value @param config the present one */
    constructor(camera, set, config) {
        Object.assign(this, { camera, set, config });
        this.recorder = new PathRecorder();
        this.recorded = null;
        this.isTaken = false;  // Whether the config has it
        [this.button, this.line] = ["record", "path"].map((id) => document.getElementById(id));
        [this.text, this.playing, this.back] = this.line.children;
        this.button.disabled = true;  // Until the camera is known
        this.button.addEventListener("click", () => this.toggle());
        this.playing.addEventListener("click", () => this.play());
        this.back.addEventListener("click", () => this.take());
        onKey("KeyR", () => this.button.disabled || this.toggle());
    }

    toggle() {
        const now = performance.now();
        if (this.recorder.isRecording) {
            const recorded = this.recorder.end(now, this.camera.sceneSize);
            if (recorded) this.recorded = recorded;
            if (recorded) this.take();
        } else {
            this.recorder.begin(this.camera.value, now);
        }
        this.show();
    }

    /** Goes to the first frame of what was recorded: the config has the path from there. */
    take() {
        const { frames, compare_every: every } = this.config().measure ?? {};
        this.before ??= { frames: frames ?? null, every: every ?? null };
        this.isTaken = true;
        this.set("measure.frames", this.recorded.frames);  // First: without frames a path has no effect
        if (this.recorded.frames >= LEAST_COMPARED) this.set("measure.compare_every", 1);  // Else the run would keep one image
        this.set("scene.camera", this.recorded.camera);
    }

    /** Shows the frames at their speed, and the first one afterwards. */
    play() {
        const { recorded, camera } = this, start = performance.now();
        if (camera.isMoving) return;
        camera.follow((now) => {
            const frame = (now - start) / 1000 * FRAMES_A_SECOND;
            if (frame < recorded.frames - 1) return poseOf(recorded.camera, frame);
            this.take();
            return null;
        });
    }

    /** The camera was moved: by the next value it is elsewhere, and the config has no path. */
    fly(value, ms) {
        this.recorder.add(value, ms);
        if (this.isTaken && this.recorded) {
            this.set("measure.compare_every", this.before.every);  // First: it needs its frames
            this.set("measure.frames", this.before.frames);
        }
        this.isTaken = false;
        this.show();
    }

    /** The program has a config; its path may be of the file, or of before the page was loaded. */
    showConfig(config) {
        const { camera } = config.scene;
        this.isTaken = Boolean(camera?.path);
        if (this.isTaken && !this.recorded) {
            this.recorded = { frames: config.measure.frames, camera };
            this.before = { frames: null, every: null };
        }
        this.show();
    }

    show() {
        const { isRecording } = this.recorder, { isTaken } = this;
        this.button.disabled = !this.camera.position;
        this.button.textContent = isRecording ? "End path" : "Record path";
        this.button.setAttribute("aria-pressed", isRecording);
        this.line.hidden = !isRecording && !this.recorded;
        this.text.textContent = isRecording ? "Recording: fly, then end the path."
            : this.recorded ? `Path of ${this.recorded.frames} frames, ${this.recorded.camera.path.length + 1} keys`
                + `${isTaken ? ": the config has it." : "; the camera has left it."}` : "";
        this.playing.hidden = isRecording;
        this.back.hidden = isRecording || isTaken;
    }
}
