// The graph's passes: each with its parameters as controls, out of the JSON Schema, and what may take its place.

const WIDE = 1000;  // Ratio of a range whose slider is not linear
const STEPS = 1000;  // Of a slider
const TEXT_LINES = 6;
// What passes cannot be planned without, or would keep the page waiting for, to begin with
const FIRST_VALUES = {
    path_trace: { spp: 1 },
    glsl: { source: "vec3 shade(ivec2 pixel, ivec2 texel) {\n    return texelFetch(albedo, texel, 0).rgb;\n}\n" },
};

export const entryOf = (entry) => (typeof entry === "string" ? { pass: entry } : entry);
export const idOf = (entry) => entryOf(entry).id ?? entryOf(entry).pass;

/** An element with properties and children. */
export function make(tag, properties = {}, ...children) {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
}

/** Alternatives on which a port depends, as [parameter, values], out of the words of `./voxray passes`. */
const conditionsOf = (port) => port.with.split(", or ").map((words) => {
    const [name, values] = words.split(": ");
    return [name, values.split(" | ")];
});

/** Slider position, 0 to 1, to value and back. */
function scaleOf({ minimum: low, maximum: high, type }) {
    const whole = type === "integer" ? Math.round : (value) => Number(value.toPrecision(4));
    if (type === "integer" && high - low > WIDE) {
        const all = Math.log(high - low + 1);
        return { value: (t) => whole(low + Math.exp(t * all) - 1), position: (value) => Math.log(value - low + 1) / all };
    }
    if (low > 0 && high / low > WIDE)
        return { value: (t) => whole(low * (high / low) ** t), position: (value) => Math.log(value / low) / Math.log(high / low) };
    if (low === 0 && high > WIDE) return { value: (t) => whole(high * t ** 6), position: (value) => (value / high) ** (1 / 6) };
    return { value: (t) => whole(low + t * (high - low)), position: (value) => (value - low) / (high - low) };
}

/** Shows a value in a box, unless it is being typed into. */
function showerOf(box, textOf) {
    let isTyped = false;
    box.addEventListener("input", () => (isTyped = true));
    box.addEventListener("change", () => (isTyped = false));
    return (value) => {
        if (!isTyped) box.value = textOf(value);
    };
}

/** @return elements of a parameter's control, and a function that shows a value. */
function controlOf(name, schema, changed) {
    if (schema.enum) {
        const select = make("select", {}, ...schema.enum.map((value) => make("option", { value, textContent: value })));
        select.addEventListener("change", () => changed(schema.enum[select.selectedIndex]));
        return [[select], (value) => (select.value = value)];
    }
    if (schema.type === "boolean") {
        const box = make("input", { type: "checkbox" });
        box.addEventListener("change", () => changed(box.checked));
        return [[box], (value) => (box.checked = value)];
    }
    if (schema.type === "integer" || schema.type === "number") {
        const number = make("input", { type: "number", step: schema.type === "integer" ? 1 : "any" });
        const showNumber = showerOf(number, (value) => value);
        if (schema.minimum === undefined) {
            number.addEventListener("change", () => changed(number.valueAsNumber));
            return [[number], showNumber];
        }
        Object.assign(number, { min: schema.minimum, max: schema.maximum });
        const scale = scaleOf(schema), slider = make("input", { type: "range", min: 0, max: STEPS, step: 1 });
        slider.addEventListener("input", () => {
            number.value = scale.value(slider.value / STEPS);
            changed(number.valueAsNumber);
        });
        number.addEventListener("change", () => {
            slider.value = STEPS * scale.position(number.valueAsNumber);
            changed(number.valueAsNumber);
        });
        return [[slider, number], (value) => {
            showNumber(value);
            slider.value = STEPS * scale.position(value);
        }];
    }
    // Text, and what JSON can write: vectors
    const isText = schema.type === "string";
    const text = isText && name === "source" ? make("textarea", { rows: TEXT_LINES, spellcheck: false }) : make("input", { type: "text" });
    text.addEventListener("change", () => {
        try {
            changed(isText ? text.value : JSON.parse(text.value));
        } catch {
            changed(text.value);  // Which the config's check refuses in words
        }
    });
    let known;  // A text that was refused stays, to be mended
    const show = showerOf(text, (value) => (isText ? value : JSON.stringify(value)));
    return [[text], (value) => {
        if (value !== known || text.tagName !== "TEXTAREA") show(value);
        known = value;
    }];
}

export class PassList {
    /** @param start start.json @param changed is called with a path and its value. */
    constructor(place, start, changed) {
        this.place = place;
        this.kinds = start.passes;
        this.schemas = new Map();
        for (const { properties } of start.schema.properties.graph.items.oneOf) this.schemas.set(properties.pass.const, properties);
        this.changed = changed;
        this.structure = "";
        this.shows = [];
    }

    /** Shows the values of a config's graph. @param ran ids of passes that ran, @param held whether a path is left alone. */
    show(graph, ran, held) {
        const entries = graph.map(entryOf), structure = JSON.stringify(entries.map((entry) => [idOf(entry), entry.pass]));
        if (structure !== this.structure) {
            this.structure = structure;
            const closed = new Set([...this.place.querySelectorAll("details:not([open])")].map((details) => details.dataset.id));
            this.shows = [];
            this.place.replaceChildren(...entries.map((entry) => this.card(entry, entries, !closed.has(idOf(entry)))));
        }
        for (const card of this.place.children) card.classList.toggle("culled", !ran.has(card.dataset.id));
        for (const show of this.shows) show(new Map(entries.map((entry) => [idOf(entry), entry])), held);
    }

    card(entry, entries, isOpen) {
        const id = idOf(entry), schema = this.schemas.get(entry.pass), help = schema.pass.description;
        const others = this.others(entry, entries);
        const swap = make("select", { title: "Another pass that writes what is read of this one" }, ...this.options(others, entry, entries));
        swap.value = entry.pass;
        swap.setAttribute("aria-label", `pass of ${id}`);
        swap.addEventListener("change", () => this.changed(id, others[swap.selectedIndex]));
        this.shows.push((byId) => (swap.value = byId.get(id).pass));
        const rows = Object.keys(schema).filter((name) => !["pass", "id", "inputs"].includes(name))
            .map((name) => this.parameter(id, name, schema));
        const details = make("details", { open: isOpen }, make("summary", { title: help }, make("b", { textContent: id })),
            make("p", { className: "note", textContent: help.split(". ")[0] + "." }), swap, ...rows);
        details.dataset.id = id;
        const card = make("section", {}, details);
        card.dataset.id = id;
        return card;
    }

    parameter(id, name, properties) {
        const schema = properties[name], path = `${id}.${name}`;
        const [controls, show] = controlOf(name, schema, (value) => this.changed(path, value));
        const row = make("label", { className: "parameter", title: schema.description }, make("span", {}, ...name.split(/(?<=_)/).flatMap((part) => [part, make("wbr")])),
            make("span", {}, ...controls));
        for (const control of controls) control.name = path;
        const valueOf = (entry, parameter) => entry[parameter] ?? properties[parameter].default;
        this.shows.push((byId, held) => {
            const entry = byId.get(id), conditions = schema["x-only-with"] ?? [];
            row.hidden = conditions.length > 0 && !conditions.some(({ parameter, in: among, not_in: outside }) => {
                const value = String(valueOf(entry, parameter));
                return among ? among.includes(value) : !outside.includes(value);
            });
            if (!held(path)) show(valueOf(entry, name) ?? "");
        });
        return row;
    }

    /** Whether a pass with an entry's values has a port. */
    has(entry, port) {
        const schema = this.schemas.get(entry.pass);
        return !port.with || conditionsOf(port).some(([name, values]) => values.includes(String(entry[name] ?? schema[name].default)));
    }

    /** Entries of passes that write what others read of this one alone; parameters on which that depends are set. */
    others(entry, entries) {
        const namesOf = (one, ports) => this.kinds[one.pass][ports].filter((port) => this.has(one, port)).map((port) => port.name);
        const rest = entries.filter((other) => other !== entry), written = namesOf(entry, "outputs");
        const read = new Set(["final", ...rest.flatMap((other) => namesOf(other, "inputs"))]);
        for (const name of rest.flatMap((other) => namesOf(other, "outputs"))) read.delete(name);
        const readHere = written.filter((name) => read.has(name)), outputs = readHere.length ? readHere : written;
        return Object.keys(this.kinds).map((kind) => {
            if (kind === entry.pass) return { pass: kind };
            if (this.kinds[kind].family === "external") return null; // Its program comes from the config's file alone
            const other = { pass: kind, ...FIRST_VALUES[kind] };
            for (const name of outputs) {
                const port = this.kinds[kind].outputs.find((port) => port.name === name);
                if (!port) return null;
                if (this.has(other, port)) continue;
                const [[parameter, [value]]] = conditionsOf(port);
                other[parameter] = value;
            }
            return outputs.length && outputs.every((name) => this.kinds[kind].outputs.some((port) => port.name === name && this.has(other, port)))
                ? other : null;
        }).filter(Boolean);
    }

    /** Options of a list of entries; those of which an input is missing say so, and can't be chosen. */
    options(others, entry, entries) {
        const written = new Set(entries.filter((other) => other !== entry)
            .flatMap((other) => this.kinds[other.pass].outputs.map((port) => port.name)));
        return others.map((other) => {
            const missing = this.kinds[other.pass].inputs.filter((port) => !port.optional && this.has(other, port) && !written.has(port.name))
                .map((port) => port.name);
            const needs = missing.length && other.pass !== entry.pass ? ` (needs ${missing.join(", ")})` : "";
            return make("option", { value: other.pass, disabled: Boolean(needs), textContent: other.pass + needs, title: this.schemas.get(other.pass).pass.description });
        });
    }
}
