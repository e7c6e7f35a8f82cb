// The page of `voxray look`: its parts, put together.

import { FlyCamera } from "./camera.js";
import { freeKeysAfterMouse } from "./keys.js";
import { PassList, idOf } from "./passes.js";
import { PathControls } from "./path.js";
import { ReferenceBox } from "./reference.js";
import { Side } from "./side.js";
import { Split } from "./split.js";
import { frameText, showTimes } from "./times.js";
import { Views } from "./views.js";

const byId = (id) => document.getElementById(id);
const exposure = document.querySelector("[name=exposure]"), variant = document.querySelector("[name=variant]");

const changedVariant = Object.assign(new Option("", ""), { hidden: true });  // So that the variant can be chosen anew
const start = await (await fetch("start.json")).json();
const names = new Set([...start.results, ...JSON.parse(sessionStorage.getItem("names") ?? "[]")]);  // Taken ones, of results
const page = crypto.randomUUID(), errors = new Map();  // By side
const hooks = {
    isMoving: () => camera.isMoving,
    extras: () => views.fields,
    whole: (side, answer) => {
        split.follow(side);
        if (side !== split.edited) return;
        showConfig(side);
        views.take(answer);
    },
    drawn: (side, answer) => {
        side.drawn = answer;
        if (answer.shrink === 1) reference.follow(side);
        if (side !== split.edited) return;
        byId("status").textContent = frameText(answer);
        byId("legend").textContent = answer.legend ?? "";
    },
    presented: (side, answer, ms) => {
        if (answer.shrink > 1)
            state.latencies.push({ side: side.number, ms, set: answer.set_ms, render: answer.render_ms, png: answer.png_ms, frame: answer.frame_ms });
    },
    say,
    ended: (side, error) => say(side, `The program does not answer: ${error.message}. Start voxray look again.`),
};
const sides = ["image", "other"].map((id, number) => new Side(number, page, byId(id), hooks));
const split = new Split(byId("images"), sides, start.variants, { edited: (side) => {
    showConfig(side);
    reference.list();
} });
const camera = new FlyCamera(sides.map((side) => side.canvas), (value, time) => {
    path.fly(value, time);
    changed("scene.camera", value, time);
});
const path = new PathControls(camera, (name, value) => changed(name, value, performance.now()), () => split.edited.config);
const edit = (name, value) => {
    split.edited.isChanged = true;
    split.arrange();
    changed(name, value, performance.now());
};
const passes = new PassList(byId("passes"), start, edit);
// Of scene and reference, what is no matter of a config's first lines
const scene = new PassList(byId("scene"), start, edit);
byId("scene").append(scene.parameter("scene", "materials", start.schema.properties.scene.properties),
    scene.parameter("reference", "spp", passes.schemas.get("path_trace")));
const views = new Views(document.querySelector("[name=show]"), byId("voxels"), start, (time) => split.shown.forEach((side) => side.ask(time)));
const reference = new ReferenceBox(byId("reference"), document.querySelector("[name=show]"), start.metrics, page, () => split.shown, () => split.edited);
// For tests and measurements
export const state = {
    latencies: [],
    get settled() { return !camera.isMoving && split.shown.every((side) => side.isSettled); },
    get config() { return split.edited.config; },
    get configs() { return split.shown.map((side) => side.config); },
};
window.look = state;

function changed(name, value, time) {
    for (const side of split.sidesOf(name)) {
        side.change(name, name === "scene.camera" ? cameraFor(side, value) : value, time);
    }
}

/** A camera takes the place of one with a path: maps are merged. */
function cameraFor(side, camera) {
    const hasPath = side.config?.scene.camera?.path || "path" in (side.pending.get("scene.camera") ?? {});
    return hasPath && !camera.path ? { ...camera, path: null } : camera;
}

function showConfig(side) {
    const { config, answer } = side;
    showErrors();
    if (!config) return;
    document.title = document.querySelector("h1").textContent = config.name;
    changedVariant.textContent = split.titleOf(side);
    variant.value = side.isChanged ? "" : side.variant;
    if (!side.pending.has("image.exposure_stops")) byId("stops").textContent = exposure.value = config.image?.exposure_stops ?? 0;
    byId("times-title").textContent = split.isOpen ? `Times of ${split.titleOf(side)}` : "Times";
    byId("passes-title").textContent = `Passes of ${split.titleOf(side)}`;
    byId("passes-title").hidden = !split.isOpen;
    byId("warnings").replaceChildren(...answer.warnings.map((text) => Object.assign(document.createElement("li"), { textContent: text })));
    for (const show of scene.shows) show(new Map([["scene", config.scene], ["reference", config.reference ?? {}]]), (name) => side.pending.has(name));
    byId("scene").lastElementChild.hidden = !config.reference;
    passes.show(config.graph, new Set((answer.passes ?? config.graph.map((entry) => ({ id: idOf(entry) }))).map((pass) => pass.id)),
        (name) => side.pending.has(name));
    if (side.drawn) byId("status").textContent = frameText(side.drawn);
    if (!answer.camera) return;
    if (!camera.isMoving && !side.pending.has("scene.camera")) camera.take(answer.camera, config.scene.camera?.up, answer.scene_size);
    if (side.isSettled) path.showConfig(config);
    showTimes(byId("times"), answer.passes);
}

function say(side, text) {
    errors.set(side, text);
    showErrors();
}

function showErrors() {
    const lines = split.shown.filter((one) => errors.get(one))
        .map((one) => (split.isOpen ? `${split.titleOf(one)}\n${errors.get(one)}` : errors.get(one)));
    byId("error").textContent = lines.join("\n");
    byId("error").hidden = !lines.length;
}

/** What the opened config's results are not called, nor those of an earlier run or download: NAME_edited, NAME_edited_2 ... */
function newName(name) {
    const base = name.replace(/_edited(_\d+)?$/, "");
    for (let number = 1; ; ++number) {
        const edited = `${base}_edited${number > 1 ? `_${number}` : ""}`;
        if (edited !== name && !names.has(edited)) return edited;
    }
}

async function download() {
    const side = split.edited;
    while (!side.isSettled && !side.hasEnded) await new Promise((done) => setTimeout(done, 50));
    const link = document.createElement("a");
    const name = newName(side.config.name);
    names.add(name);
    sessionStorage.setItem("names", JSON.stringify([...names]));
    // A run warns of passes on which the image does not depend
    const graph = side.config.graph.filter((entry) => !side.answer.left_out.includes(idOf(entry)));
    const config = { ...side.config, name, graph };
    link.href = URL.createObjectURL(new Blob([JSON.stringify(config, null, 2) + "\n"], { type: "application/yaml" }));
    link.download = `${name}.yaml`;
    link.click();
    URL.revokeObjectURL(link.href);
}

exposure.addEventListener("input", () => {
    byId("stops").textContent = exposure.value;
    changed("image.exposure_stops", exposure.valueAsNumber, performance.now());
});
byId("download").addEventListener("click", download);
variant.append(changedVariant, ...start.variants.map(({ id, name }) => new Option(name, id)));
byId("variants").hidden = start.variants.length < 2;
variant.addEventListener("change", () => split.select(start.variants.find(({ id }) => id === variant.value)));
freeKeysAfterMouse(() => split.edited.canvas);
window.addEventListener("pagehide", () => split.isOpen && sides[1].close());
sides[0].next();
