// What is shown in place of the image: AOVs, images and buffers of passes, voxels.

import { PassList } from "./passes.js";

const VOXELS = "show_voxels";  // The name of a view, and the pass that draws it

const sizeOf = (bytes) => (bytes < 2 ** 20 ? `${(bytes / 2 ** 10).toFixed(1)} KiB` : `${(bytes / 2 ** 20).toFixed(1)} MiB`);
const BYTES = { uint8: 1, float16: 2, uint32: 4, float32: 4, uint64: 8 };

/** The text of a view in the list: its name without that of its pass, and a buffer's size. */
function textOf(view) {
    const what = view.name.slice(view.pass.length + 1);
    return view.kind === "buffer" ? `${what}, ${sizeOf(BYTES[view.type] * view.shape.reduce((a, b) => a * b))}` : what;
}

export class Views {
    /** @param select gets the views after its own options. @param place of the controls of voxels. @param start start.json
     * @param changed is called with the time of the event. */
    constructor(select, place, start, changed) {
        this.select = select;
        this.place = place;
        this.changed = changed;
        this.schema = start.schema.properties.graph.items.oneOf.find(({ properties }) => properties.pass.const === VOXELS)?.properties;
        this.parameters = {};  // Of voxels
        this.listed = "";
        this.passes = new PassList(null, start, (path, value) => {
            this.parameters[path.slice(VOXELS.length + 1)] = value;
            this.showControls();
            changed(performance.now());
        });
        const names = this.schema ? Object.keys(this.schema).filter((name) => !["pass", "id", "inputs"].includes(name)) : [];
        place.append(...names.map((name) => this.passes.parameter(VOXELS, name, this.schema)));
        select.addEventListener("change", () => {
            this.showControls();
            changed(performance.now());
        });
        this.showControls();
    }

    /** Fields of a request. */
    get fields() {
        if (this.select.value === VOXELS) return { show: VOXELS, parameters: this.parameters };
        return this.select.selectedOptions[0].closest("optgroup") ? { show: this.select.value } : {};
    }

    showControls() {
        this.place.hidden = this.select.value !== VOXELS;
        for (const show of this.passes.shows) show(new Map([[VOXELS, { pass: VOXELS, ...this.parameters }]]), () => false);
    }

    /** Lists the views of an answer. One that is not there gives way to the image. */
    take(answer) {
        if (answer.views) this.list(answer.views);
        else if (answer.error && this.select.selectedOptions[0]?.closest("optgroup")) this.leave();
    }

    list(views) {
        const listed = JSON.stringify(views);
        if (listed === this.listed) return;
        this.listed = listed;
        const chosen = this.select.value, groups = new Map();
        for (const view of views) {
            const isVoxels = view.kind === "voxels", group = isVoxels ? "voxels" : view.pass;
            if (!groups.has(group)) groups.set(group, Object.assign(document.createElement("optgroup"), { label: group }));
            groups.get(group).append(new Option(isVoxels ? "voxels" : textOf(view), view.name));
            if (isVoxels) this.allow(view.shows);
        }
        for (const old of this.select.querySelectorAll("optgroup")) old.remove();
        this.select.append(...groups.values());
        this.select.value = chosen;
        if (this.select.value !== chosen) this.leave();
    }

    leave() {
        this.select.value = "image";
        this.showControls();
        this.changed(performance.now());
    }

    /** Leaves those values of `show` that the graph's voxels have. */
    allow(shows) {
        for (const value of this.place.querySelectorAll(`[name="${VOXELS}.show"] option`)) value.disabled = !shows.includes(value.value);
        if (shows.includes(this.parameters.show ?? this.schema.show.default)) return;
        this.parameters.show = shows[0];
        this.showControls();
    }
}
