"use strict";
// The page of `voxray pareto`: its switches, its matrix, a chart for each scene, its tables.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const state = { cost: 0, error: data.error, rival: 0, method: null, off: new Set() };
let pictures = null; // parsed where the first one is shown

const methodName = (m) => data.methods[m].name;
const rivalMethod = () => data.rivals[state.rival];
const cellOf = (s, m) => data.factors[state.rival][state.cost][state.error][s][m];
const costWords = () => data.costs[state.cost].label.replace(/, \w+$/, "");

function swatch(m) {
    const made = d3.create("svg").attr("class", "swatch").attr("viewBox", "-7 -7 14 14").attr("aria-hidden", "true");
    made.append("path").attr("d", data.methods[m].mark).attr("fill", `var(--${data.methods[m].color})`);
    return made.node();
}

// --- The matrix

function order() {
    const medians = data.medians[state.rival][state.cost][state.error];
    return d3.range(data.methods.length).sort((a, b) => (medians[b] ?? 0) - (medians[a] ?? 0));
}
function tell(s, m) {
    const cell = cellOf(s, m), who = `${methodName(m)} in ${data.scenes[s].name}`, rival = methodName(rivalMethod());
    if (m === rivalMethod()) return `${who}: what others are compared with.`;
    if (cell === null) return `${who}: not compared with ${rival}.`;
    const error = data.errors[state.error].name, count = data.count[state.rival][state.cost][state.error][s];
    if (cell === 0) return `${who}: reaches none of the ${count} errors (${error}) of ${rival}.`;
    const [value, low, high, reached] = cell;
    const open = isOpen(cell) ? "; that leaves open which is better" : "";
    const ends = `(${factorText(low)} to ${high === null ? "∞" : factorText(high)} within the intervals${open})`;
    const words = data.costs[state.cost].key === "memory" ? `memory of ${rival} over its own at equal ${error}: ${factorText(value)} ${ends}`
        : `${factorText(value)} times as fast as ${rival} at equal ${error} ${ends}, by ${costWords()}`;
    return `${who}: ${words}. It reaches ${reached} of ${count} errors.`;
}
function showMatrix() {
    const rows = order();
    const cost = data.costs[state.cost], rival = methodName(rivalMethod()), error = data.errors[state.error].name;
    byId("matrix-title").textContent = cost.key === "memory" ? `How many times less memory than ${rival} at equal ${error}`
        : `Speed-up over ${rival} at equal ${error}, by ${costWords()}`;
    drawMatrix(byId("matrix"), {
        columns: data.scenes.map((scene) => scene.name), totalName: "median", counts: data.count[state.rival][state.cost][state.error],
        rows: rows.map((m) => ({ name: methodName(m), title: data.methods[m].chain, swatch: swatch(m), isSelf: m === rivalMethod(), total: data.medians[state.rival][state.cost][state.error][m],
                                 cells: data.scenes.map((_, s) => cellOf(s, m)) })),
        tell: (r, s) => tell(s, rows[r]),
        onPoint: (r, s) => {
            byId("cell").textContent = tell(s, rows[r]);
            byId("chain").textContent = `${data.methods[rows[r]].chain}. ${bestWords(s, rows[r])}`;
            byId("cell-images").replaceChildren(...imagesOf(s, bestOf(s, rows[r])));
        },
        onPick: (r, s) => pick(s, rows[r]),
    });
}
// The most accurate variant of a method
const bestOf = (s, m) => (data.scenes[s].fronts[state.cost][state.error][m] ?? []).slice(-1)[0];
function bestWords(s, m) {
    const { cost, error, label } = data.scenes[s], i = bestOf(s, m);
    if (i === undefined) return "";
    const costs = data.costs.map((one, c) => `${one.name} ${figures(cost[c][i])} ${one.label.split(", ").pop()}`);
    return `Its most accurate variant, ${label[i]}: ${[...costs, ...data.errors.map(({ name }, e) => `${name} ${figures(error[e][0][i])}`)].join(", ")}.`;
}
function pick(s, m) {
    state.off.delete(m);
    set({ method: m });
    charts[s].figure.scrollIntoView({ block: "center", behavior: "instant" });
    charts[s].chart.select(bestOf(s, m));
    charts[s].plot.focus({ preventScroll: true });
}

// --- The charts

function contentOf(scene) {
    const { cost, error } = state, rival = rivalMethod();
    const [value, low, high] = scene.error[error];
    const fronts = scene.fronts[cost][error], series = new Map();
    scene.method.forEach((m, index) => {
        if (state.off.has(m) || !(scene.cost[cost][index] > 0 && value[index] > 0)) return;
        if (!series.has(m)) series.set(m, { ...data.methods[m], method: m, points: [], line: [], isBold: m === rival || m === state.method,
                                            isFaint: state.method !== null && m !== state.method && m !== rival });
        series.get(m).points.push({ index, x: scene.cost[cost][index], y: value[index], low: low[index], high: high[index] });
    });
    const byIndex = new Map([...series.values()].flatMap((one) => one.points.map((p) => [p.index, p])));
    for (const [m, one] of series) one.line = (fronts[m] ?? []).map((index) => byIndex.get(index));
    const drawn = [...series.values()], x = scene.cost[cost];
    const labels = drawn.filter((one) => one.line.length && !one.isFaint).sort((a, b) => b.isBold - a.isBold)
        .map((one) => ({ text: one.name, color: one.color, isBold: one.isBold, point: one.line[one.line.length - 1] }));
    return { series: drawn, labels, paths: drawn.map(({ line }) => line), front: scene.front[cost][error].map((index) => [x[index], value[index]]),
             xLabel: data.costs[cost].label, yLabel: `${data.errors[error].name}, ${data.light} light`,
             text: `${scene.name}: ${data.errors[error].name} against ${data.costs[cost].label}. ${frontWords(scene)}` };
}
function frontWords(scene) {
    const unit = (/, (\w+)$/.exec(data.costs[state.cost].label) ?? ["", ""])[1], runs = [];
    for (const i of scene.front[state.cost][state.error]) {
        if (runs.length && scene.method[runs[runs.length - 1][0]] === scene.method[i]) runs[runs.length - 1].push(i);
        else runs.push([i]);
    }
    const span = (run, values) => [...new Set([run[0], run[run.length - 1]].map((i) => figures(values[i])))].join("–");
    const words = runs.map((run) => `${methodName(scene.method[run[0]])} ${span(run, scene.cost[state.cost])} ${unit} → ${span(run, scene.error[state.error][0])}`);
    return `Front, from cheap to accurate: ${words.join("; ") || "nothing"}.`;
}
function makeFigure(scene, s) {
    const plot = element("div", { class: "plot", tabindex: "0", role: "group", "aria-roledescription": "chart",
                                  "aria-label": `Chart of ${scene.name}: arrow keys move along the fronts, + enlarges, Escape shows all` });
    const said = element("output", { class: "said", "aria-live": "polite" }), strip = element("div", { class: "strip" });
    const words = element("figcaption", { class: "note" });
    const chart = makeChart(plot, (point) => showPoint(scene, s, point, said, strip));
    const reset = element("button", { type: "button", class: "reset", onclick: chart.resetZoom }, "Show all");
    const file = element("button", { type: "button", onclick: () => save(`${scene.name}.svg`, "image/svg+xml", chart.svg()) }, "Save SVG");
    const figure = element("figure", { class: "scene", id: `scene-${s}` }, element("h3", {}, scene.name, element("span", { class: "filter" }, reset, file)),
                           plot, said, strip, words);
    byId("scenes").append(figure);
    return { figure, plot, chart, words, scene };
}
function showPoint(scene, s, point, said, strip) {
    const i = point.index, cost = data.costs[state.cost], error = data.errors[state.error].name;
    said.textContent = `${methodName(scene.method[i])} · ${scene.label[i]}: ${figures(point.x)} ${cost.label.split(", ").pop()}, `
        + `${error} ${figures(point.y)} (${figures(point.low)} to ${figures(point.high)})`;
    strip.replaceChildren(...imagesOf(s, i));
}
function imagesOf(s, i) {
    pictures ??= JSON.parse(byId("pictures").textContent);
    const [image, map] = pictures[s][i] ?? [], [reference] = pictures[s].reference ?? [], name = methodName(data.scenes[s].method[i] ?? 0);
    return [[reference, "reference"], [image, name], [map, "its error (FLIP)"]].filter(([uri]) => uri && image).map(([uri, caption]) =>
        element("figure", {}, element("img", { src: uri, alt: `${caption}, ${data.scenes[s].name}` }), element("figcaption", {}, caption)));
}
function showCharts(keepZoom = false) {
    for (const { chart, words, scene } of charts) {
        chart.update(contentOf(scene), keepZoom);
        words.textContent = frontWords(scene);
    }
    for (const button of byId("methods").querySelectorAll("button[data-method]")) {
        const m = Number(button.dataset.method);
        button.setAttribute("aria-pressed", !state.off.has(m));
        button.classList.toggle("highlighted", m === state.method);
    }
    byId("everything").hidden = state.off.size === 0 && state.method === null;
}

// --- Switches and tables

function set(changes, remember = true) {
    Object.assign(state, changes);
    for (const key of ["cost", "error"]) for (const radio of document.getElementsByName(key)) radio.checked = Number(radio.value) === state[key];
    document.getElementsByName("rival")[0].value = state.rival;
    const compared = ["cost", "error", "rival"].some((key) => key in changes);
    if (compared) {
        showMatrix();
        for (const id of ["cell", "chain", "cell-images"]) byId(id).replaceChildren();
    }
    showCharts(!("cost" in changes || "error" in changes));
    if (compared) speedUps.show();
    if (remember) history.replaceState(null, "", `#cost=${state.cost}&error=${state.error}&rival=${state.rival}`);
}
function radios(key, entries) {
    byId(key).append(...entries.map(({ name }, i) => element("label", {},
        element("input", { type: "radio", name: key, value: i, onchange: () => set({ [key]: i }) }), element("span", {}, name))));
}
radios("cost", data.costs);
radios("error", data.errors);
byId("rival").append(element("select", { name: "rival", onchange: ({ target }) => set({ rival: Number(target.value) }) },
                             ...data.rivals.map((m, i) => element("option", { value: i }, methodName(m)))));
byId("methods").append(...data.methods.map((method, m) => element("button", { type: "button", "data-method": m, title: method.chain, onclick: () => {
    if (!state.off.delete(m)) state.off.add(m);
    set({ method: state.method === m ? null : state.method });
} }, swatch(m), method.name)), element("button", { type: "button", id: "everything", onclick: () => {
    state.off.clear();
    set({ method: null });
} }, "Show all methods"));

const speedUps = foldedTable("Speed-ups of the matrix", "As the switches say; low and high: the ends by the intervals of both errors.", () => ({
    head: ["method", "scene", "factor", "low", "high", "errors reached", "of"],
    rows: data.scenes.flatMap((scene, s) => order().filter((m) => cellOf(s, m)).map((m) =>
        [methodName(m), scene.name, ...cellOf(s, m), data.count[state.rival][state.cost][state.error][s]])),
}));
const variants = foldedTable("All variants", "The CSV next to the page has them with more digits, rays and voxel steps.", () => ({
    head: ["scene", "method", "variant", ...data.costs.map((cost) => cost.name), ...data.errors.flatMap(({ name }) => [name, `${name} low`, `${name} high`])],
    rows: data.scenes.flatMap((scene) => scene.label.map((label, i) =>
        [scene.name, methodName(scene.method[i]), label, ...scene.cost.map((cost) => cost[i]), ...scene.error.flatMap((error) => error.map((end) => end[i]))])),
}));
byId("tables").append(...[...data.tables.map((table) => foldedTable(table.title, table.note, () => table)), speedUps, variants].map(({ folded }) => folded));

drawScale(byId("scale"));
const charts = data.scenes.map(makeFigure);
const address = new URLSearchParams(location.hash.slice(1));
const chosen = (key, count) => (d3.range(count).map(String).includes(address.get(key)) ? Number(address.get(key)) : state[key]);
set({ cost: chosen("cost", data.costs.length), error: chosen("error", data.errors.length), rival: chosen("rival", data.rivals.length) }, false);
addEventListener("resize", () => charts.forEach(({ chart }) => chart.redraw()));
