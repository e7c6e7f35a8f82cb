// The graph's passes: each with its parameters as controls, out of the JSON Schema, and what may take its place.

const WIDE = 1000;  // Ratio of a range whose slider is not linear
const STEPS = 1000;  // Of a slider

export const entryOf = (entry) => (typeof entry === "string" ? { pass: entry } : entry);
export const idOf = (entry) => entryOf(entry).id ?? entryOf(entry).pass;

function make(tag, properties = {}, ...children) {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
}

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

/** @return elements of a parameter's control, and a function that shows a value. */
function controlOf(schema, changed) {
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
        if (schema.minimum === undefined) {
            number.addEventListener("change", () => changed(number.valueAsNumber));
            return [[number], (value) => (number.value = value)];
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
            number.value = value;
            slider.value = STEPS * scale.position(value);
        }];
    }
    // Text, and what JSON can write: vectors
    const isText = schema.type === "string", text = make("input", { type: "text" });
    text.addEventListener("change", () => {
        try {
            changed(isText ? text.value : JSON.parse(text.value));
        } catch {
            changed(text.value);  // Which the config's check refuses in words
        }
    });
    return [[text], (value) => (text.value = isText ? value : JSON.stringify(value))];
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
        const swap = make("select", { title: "Another pass with the same outputs" }, ...this.others(entry, entries));
        swap.value = entry.pass;
        swap.setAttribute("aria-label", `pass of ${id}`);
        swap.addEventListener("change", () => this.changed(id, swap.value));
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
        const [controls, show] = controlOf(schema, (value) => this.changed(path, value));
        const row = make("label", { className: "parameter", title: schema.description }, make("span", { textContent: name }),
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

    /** Options: passes that write what this one writes; those of which an input is missing say so. */
    others(entry, entries) {
        const always = (kind) => this.kinds[kind].outputs.filter((port) => !port.optional).map((port) => port.name);
        const outputs = always(entry.pass);
        const written = new Set(entries.filter((other) => other !== entry)
            .flatMap((other) => this.kinds[other.pass].outputs.map((port) => port.name)));
        return Object.keys(this.kinds).filter((kind) => {
            const theirs = new Set(this.kinds[kind].outputs.map((port) => port.name));
            return kind === entry.pass || (outputs.length > 0 && outputs.every((name) => theirs.has(name)));
        }).map((kind) => {
            const missing = this.kinds[kind].inputs.filter((port) => !port.optional && !written.has(port.name)).map((port) => port.name);
            const needs = missing.length && kind !== entry.pass ? ` (needs ${missing.join(", ")})` : "";
            return make("option", { value: kind, textContent: kind + needs, title: this.schemas.get(kind).pass.description });
        });
    }
}
