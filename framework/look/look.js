// The page of `voxray look`: what is changed goes to the program, images come back. There is one request for a draft at a
// time; a newer request for a whole image takes the place of the one before.

import { FlyCamera } from "./camera.js";
import { PassList, idOf } from "./passes.js";

const DRAFT_SHRINK = 4;
const STILL_MS = 150;  // After the last change, before the whole image is asked for

const byId = (id) => document.getElementById(id);
const canvas = byId("image"), exposure = document.querySelector("[name=exposure]"), variant = document.querySelector("[name=variant]");

// What the program does not have yet, by path of the config, in order
const pending = new Map();
let selected = "";  // Variant
let version = 1, drafted = 0, shown = 0;  // Numbers of states: of the newest one, and of those that images have shown
let draftInFlight = false, wholeInFlight = 0, lastChange = 0, eventTime = 0, timer = 0, config = null, hasEnded = false;
const page = crypto.randomUUID();
// For tests and measurements
export const state = { latencies: [], get settled() { return shown === version; }, get config() { return config; } };
window.look = state;

const start = await (await fetch("start.json")).json();
const camera = new FlyCamera(canvas, (value, time) => {
    changed("scene.camera", value, time);
});
const passes = new PassList(byId("passes"), start, (path, value) => changed(path, value, performance.now()));

function changed(path, value, time) {
    for (const other of [...pending.keys()])  // A pass that is swapped has other parameters
        if (other === path || other.startsWith(path + ".")) pending.delete(other);
    pending.set(path, value);
    ask(time);
}

function ask(time) {
    version += 1;
    eventTime = time;
    lastChange = performance.now();
    next();
}

const isStill = () => !camera.isMoving && performance.now() - lastChange >= STILL_MS;

/** Sends what is to be sent now. */
function next() {
    clearTimeout(timer);
    if (hasEnded || shown === version) return;
    if (!isStill() && drafted !== version && !draftInFlight) return send(DRAFT_SHRINK);
    if (isStill() && wholeInFlight !== version && !draftInFlight) return send(1);
    timer = setTimeout(next, STILL_MS / 3);
}

async function send(shrink) {
    const sent = { version, pending: new Map(pending), variant: selected, time: eventTime };
    if (shrink > 1) draftInFlight = true;
    else wholeInFlight = version;
    byId("view").setAttribute("aria-busy", "true");
    try {
        const response = await fetch("image", { method: "POST", body: JSON.stringify({
            page, shrink, ...(sent.variant && { variant: sent.variant }),
            changes: [...sent.pending].map(([path, value]) => ({ path, value })) }) });
        const body = new Uint8Array(await response.arrayBuffer());
        if (response.ok) await take(body, sent, shrink);
        else if (response.status !== 409) {
            say(new TextDecoder().decode(body));
            shown = sent.version;
            pending.clear();
        }
    } catch (error) {
        hasEnded = true;
        say(`The program does not answer: ${error.message}. Start voxray look again.`);
    }
    if (shrink > 1) draftInFlight = false;
    else if (wholeInFlight === sent.version) wholeInFlight = 0;
    if (shrink > 1) drafted = sent.version;
    if (shown === version) byId("view").removeAttribute("aria-busy");
    next();
}

/** Shows an answer: a line of JSON, then the image. */
async function take(body, sent, shrink) {
    const end = body.indexOf(10), answer = JSON.parse(new TextDecoder().decode(body.subarray(0, end)));
    if (shrink === 1) {
        if (sent.version < shown) return;
        shown = sent.version;
        for (const [path, value] of sent.pending) if (pending.get(path) === value) pending.delete(path);
        if (selected === sent.variant) selected = "";
        say([...(answer.refused ?? []).map((refusal) => refusal.error), ...(answer.error ? [answer.error] : [])].join("\n"));
        config = answer.config;
        showConfig(answer);
    }
    if (answer.error) return;
    if (shrink > 1 && shown >= sent.version) return;  // The whole image was faster
    const image = await createImageBitmap(new Blob([body.subarray(end + 1)], { type: "image/png" }));
    if (shrink === 1 || !config) [canvas.width, canvas.height] = [answer.width * shrink, answer.height * shrink];
    canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
    requestAnimationFrame(() => {
        const ms = performance.now() - sent.time;
        if (shrink > 1) state.latencies.push({ ms, set: answer.set_ms, render: answer.render_ms, png: answer.png_ms, frame: answer.frame_ms });
        byId("status").textContent = `${answer.width} × ${answer.height}: frame ${answer.frame_ms.toFixed(1)} ms, `
            + `${(1000 / answer.frame_ms).toFixed(0)} a second, ${(answer.memory_bytes / 2 ** 20).toFixed(1)} MiB`;
    });
}

function showConfig(answer) {
    document.title = byId("view").closest("body").querySelector("h1").textContent = config.name;
    exposure.value = config.image?.exposure_stops ?? 0;
    byId("stops").textContent = exposure.value;
    byId("warnings").replaceChildren(...answer.warnings.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
    passes.show(config.graph, new Set((answer.passes ?? config.graph.map((entry) => ({ id: idOf(entry) }))).map((pass) => pass.id)),
        (path) => pending.has(path));
    if (!answer.camera) return;
    if (!camera.isMoving && !pending.has("scene.camera")) camera.take(answer.camera, config.scene.camera?.up ?? [0, 1, 0], answer.scene_size);
    showTimes(answer.passes);
}

/** Bars of the passes' times, those of passes that run once apart from the rest. */
function showTimes(costs) {
    const longest = Math.max(...costs.map((pass) => pass.ms), 1e-6);
    byId("times").replaceChildren(...costs.flatMap((pass) => {
        const [name, track, total] = ["span", "span", "span"].map((tag) => document.createElement(tag));
        name.className = "bar-name";
        name.textContent = pass.phase === "build" ? `${pass.id}, once` : pass.id;
        track.className = "bar-track";
        const bar = document.createElement("i");
        bar.style.width = `${100 * pass.ms / longest}%`;
        bar.style.background = pass.phase === "build" ? "var(--c4)" : "var(--c0)";
        track.append(bar);
        total.className = "bar-total";
        total.textContent = `${pass.ms.toFixed(2)} ms, ${(pass.memory_bytes / 2 ** 20).toFixed(1)} MiB${pass.reused ? ", kept" : ""}`;
        return [name, track, total];
    }));
}

function say(text) {
    byId("error").textContent = text;
    byId("error").hidden = !text;
}

async function download() {
    while (!state.settled && !hasEnded) await new Promise((done) => setTimeout(done, 50));
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([JSON.stringify(config, null, 2) + "\n"], { type: "application/yaml" }));
    link.download = `${config.name}.yaml`;
    link.click();
    URL.revokeObjectURL(link.href);
}

exposure.addEventListener("input", () => {
    byId("stops").textContent = exposure.value;
    changed("image.exposure_stops", exposure.valueAsNumber, performance.now());
});
byId("download").addEventListener("click", download);
variant.append(...start.variants.map(({ id, name }) => new Option(name, id)));
byId("variants").hidden = start.variants.length < 2;
variant.addEventListener("change", () => {
    pending.clear();
    selected = variant.value;
    ask(performance.now());
});
next();
