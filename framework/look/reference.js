// The reference that gets better while nothing else is asked: its samples and noise, the image or its error map in place of
// the rendered one, and scores against it.

import { make } from "./passes.js";
import { SIDE_NAMES } from "./split.js";

const POLL_MS = 700;
const SCORING_SHARE = 4;  // Times that a score takes pass before the next one
// Black is no error, light yellow is the largest: matplotlib's magma, as in the report
const MAGMA = ["#000004", "#1d1147", "#51127c", "#822681", "#b63679", "#e65164", "#fb8861", "#fec287", "#fcfdbf"]
    .map((color) => [1, 3, 5].map((at) => parseInt(color.slice(at, at + 2), 16)));
// What may be shown in place of the image, by name, with the text of the list
const SHOWN = new Map([["reference", "reference"], ["error", "error (HDR-FLIP)"],
    ["indirect_error", "error of indirect light (HDR-FLIP)"]]);

const figures = (value) => (Math.abs(value) >= 1000 || value === 0 ? value.toFixed(0) : value.toPrecision(3));

/** Colors a grey picture on a canvas in place. */
function colorErrors(context) {
    const { width, height } = context.canvas, picture = context.getImageData(0, 0, width, height), bytes = picture.data;
    for (let i = 0; i < bytes.length; i += 4) {
        const at = bytes[i] / 255 * (MAGMA.length - 1), below = Math.min(Math.floor(at), MAGMA.length - 2);
        for (let c = 0; c < 3; ++c) bytes[i + c] = MAGMA[below][c] + (at - below) * (MAGMA[below + 1][c] - MAGMA[below][c]);
    }
    context.putImageData(picture, 0, 0);
}

const later = (ms) => new Promise((done) => setTimeout(done, ms));

/** @param isShown whether it, or its error map, takes the image's place */
function wordsOf(answer, isShown) {
    if (!answer) return "";
    if (answer.error) return answer.error;
    if (!answer.of) return "The config has no reference: with an entry as 'reference: {pass: path_trace, spp: 256}' errors are shown.";
    const noise = answer.noise.nrmse === undefined ? "" : `, noise ${Number((100 * answer.noise.nrmse).toPrecision(2))} % (nRMSE)`;
    const waits = isShown && answer.samples < 2 ? "; the image is shown until it has 2" : "";
    return `Reference: ${answer.samples} of ${answer.of} samples a pixel${noise}${waits}`;
}

/** A score, with its 95 % interval, or with what a perfect image would score for the reference's noise. */
function cellOf(scores, column) {
    const value = scores[column], low = scores[`${column}_low`], high = scores[`${column}_high`], noise = scores[`${column}_noise`];
    const small = low !== undefined ? `${figures(low)} to ${figures(high)}` : noise !== undefined ? `perfect: ${figures(noise)}` : "";
    return make("td", { className: "number" }, figures(value), make("small", { textContent: small }));
}

export class ReferenceBox {
    /**
     * @param place gets the words and the table @param select gets the options of what is shown @param metrics start.json's
     * @param page id of this page @param sides() that are shown @param edited() the one that is edited
     */
    constructor(place, select, metrics, page, sides, edited) {
        Object.assign(this, { select, metrics, page, sides, edited });
        select.append(...[...SHOWN].map(([value, text]) => new Option(text, value)));
        this.words = make("p", { className: "readout" });
        this.table = make("table");
        place.append(this.words, make("div", { className: "scroll" }, this.table));
        this.answers = new Map();  // By side
        this.rounds = new Map();  // By side: the number of its last round of requests
        this.list();
    }

    /** Asks again and again about the whole image that a side shows now, until it shows another or the reference is whole. */
    async follow(side) {
        const round = (this.rounds.get(side) ?? 0) + 1, isCurrent = () => this.rounds.get(side) === round && side.isSettled;
        this.rounds.set(side, round);
        let known = "";
        while (isCurrent() && this.sides().includes(side)) {
            const show = SHOWN.has(this.select.value) ? this.select.value : "";
            let response, body;
            try {
                response = await fetch("reference", { method: "POST", body: JSON.stringify({ page: this.page, side: side.number, known, show }) });
                body = new Uint8Array(await response.arrayBuffer());
            } catch {
                return;  // Its side tells that the program has ended
            }
            if (!isCurrent()) return;
            if (response.status === 204) {  // An image came first
                await later(POLL_MS);
                continue;
            }
            if (!response.ok) return;
            const end = body.indexOf(10), answer = JSON.parse(new TextDecoder().decode(body.subarray(0, end)));
            await this.take(side, show, known ? this.answers.get(side) : {}, answer, body.subarray(end + 1), isCurrent);
            if (!answer.of || answer.error || answer.samples === answer.of) return;
            known = answer.state;
            await later(Math.max(POLL_MS, SCORING_SHARE * (answer.score_ms ?? 0)));
        }
    }

    /** @param before the answer before on the same image, whose scores are the same where they are not told */
    async take(side, show, before, answer, png, isCurrent) {
        const { scores } = before;
        this.answers.set(side, answer.of && scores ? { scores, ...answer } : answer);
        this.list();
        if (!png.length) return;
        const image = await createImageBitmap(new Blob([png], { type: "image/png" }));
        if (!isCurrent() || this.select.value !== show) return;
        const picture = new OffscreenCanvas(image.width, image.height), context = picture.getContext("2d", { willReadFrequently: true });
        context.drawImage(image, 0, 0);
        if (show !== "reference") colorErrors(context);
        side.canvas.getContext("2d").drawImage(picture, 0, 0, side.canvas.width, side.canvas.height);
    }

    /** Tells of the reference of the side that is edited, and scores of all sides: columns are metrics. */
    list() {
        const sides = this.sides();
        this.words.textContent = wordsOf(this.answers.get(this.edited()), SHOWN.has(this.select.value));
        const rows = sides.flatMap((side) => ["", "indirect_"].map((light) => ({ light, scores: this.answers.get(side)?.scores ?? {},
            name: `${sides.length > 1 ? `${SIDE_NAMES[side.number]}, ` : ""}${light ? "indirect" : "all light"}` })))
            .filter(({ light, scores }) => light + this.metrics[0].name in scores);
        this.table.hidden = !rows.length;
        this.table.replaceChildren(
            make("thead", {}, make("tr", {}, make("th"), ...this.metrics.map(({ label, unit, meaning }) =>
                make("th", { textContent: unit ? `${label}, ${unit}` : label, title: meaning, scope: "col" })))),
            make("tbody", {}, ...rows.map(({ light, scores, name }) => make("tr", {}, make("th", { textContent: name, scope: "row" }),
                ...this.metrics.map((metric) => cellOf(scores, light + metric.name))))));
    }
}
